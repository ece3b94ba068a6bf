#include "selector/bench/speed/speed_compare.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <vector>

namespace elastogen::selector {
namespace {

double noise(const SpeedRecord& record) {
  return std::max(0.02, record.median / record.minimum - 1);
}

}  // namespace

std::string compare_speed(const SpeedResults& before, const SpeedResults& after) {
  std::map<std::string, const SpeedRecord*> old;
  for (const SpeedRecord& record : before.records) old[record.key()] = &record;
  std::string text;
  if (before.run.processor != after.run.processor) {
    text += fmt::format("the processors differ: {} and {}\n", before.run.processor,
                        after.run.processor);
  }
  struct Change {
    double ratio;
    std::string line;
  };
  std::vector<Change> changes;
  std::size_t unchanged = 0, added = 0;
  for (const SpeedRecord& record : after.records) {
    const auto found = old.find(record.key());
    if (found == old.end()) {
      ++added;
      continue;
    }
    const SpeedRecord& was = *found->second;
    old.erase(found);
    const double ratio = record.minimum / was.minimum;
    if (std::abs(std::log(ratio)) <= std::log1p(std::max(noise(was), noise(record)))) {
      ++unchanged;
      continue;
    }
    changes.push_back({ratio, fmt::format("{:6.3f} x  {:8.2f} -> {:8.2f} ns  {}\n", ratio,
                                          was.minimum, record.minimum, record.key())});
  }
  std::sort(changes.begin(), changes.end(),
            [](const Change& a, const Change& b) { return a.ratio > b.ratio; });
  for (const Change& change : changes) text += change.line;
  return text + fmt::format("{} changed beyond noise, {} did not, {} only before, {} only after\n",
                            changes.size(), unchanged, old.size(), added);
}

}  // namespace elastogen::selector
