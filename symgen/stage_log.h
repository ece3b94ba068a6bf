// How large the expression graph is after each stage of the pipeline, and how long that took.
#pragma once

#include <algorithm>
#include <chrono>
#include <string>
#include <vector>

namespace elastogen::symgen {

struct StageRecord {
  std::string stage;      ///< "factor"
  std::size_t nodes = 0;  ///< of the graphs that the stage left
  double seconds = 0;
};

/// Records in the order in which stages first ran; what a stage does for every fragment adds up.
class StageLog {
 public:
  /// A stage has ended: the time since the last one ended is its.
  void end(const std::string& stage, std::size_t nodes) {
    const auto now = std::chrono::steady_clock::now();
    const auto known = std::find_if(records_.begin(), records_.end(),
                                    [&](const StageRecord& r) { return r.stage == stage; });
    StageRecord& record =
        known != records_.end() ? *known : records_.emplace_back(StageRecord{stage, 0, 0});
    record.nodes += nodes;
    record.seconds += std::chrono::duration<double>(now - last_).count();
    last_ = now;
  }
  [[nodiscard]] const std::vector<StageRecord>& records() const { return records_; }

 private:
  std::chrono::steady_clock::time_point last_ = std::chrono::steady_clock::now();
  std::vector<StageRecord> records_;
};

}  // namespace elastogen::symgen
