// Points of time against error in an SQLite file: a benchmark that was stopped goes on where it
// was.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "selector/bench/bench_run.h"
#include "selector/bench/work_precision_point.h"

namespace elastogen::selector {

/// What makes a point the same as one measured before.
struct PointKey {
  std::string problem;
  std::string program;
  std::string association;
  std::string resolution;
  std::string solver;
  std::string precision;
  double tolerance = 0;
  std::string
      scene_hash;  ///< of the content of scene or deck, and of all else that must not change
};

/// A file of points and of the runs that measured them.
///
/// Every call that changes something is on the disk when it returns, so that a kill at any moment
/// loses only the point being measured. Several processes may use one file; they wait for each
/// other.
///
/// Any call throws WorkError when the file cannot be read or written (full disk, permissions,
/// locked for ten seconds), and InputError when it turns out to be damaged.
class ResultsDatabase {
 public:
  /// Opens the file; makes it, and its folder, where there is none.
  /// @throws InputError  for a file that is no SQLite database, is damaged, holds something else,
  ///                     or was made by another version of the schema; it is left as it is
  explicit ResultsDatabase(const std::filesystem::path& file);
  ~ResultsDatabase();
  ResultsDatabase(const ResultsDatabase&) = delete;
  ResultsDatabase& operator=(const ResultsDatabase&) = delete;

  /// Notes a run; later points belong to it.
  void begin_run(const BenchRun& run);

  /// Keeps a point, in place of one with the same key but for the scene's hash: a scene that was
  /// changed is measured anew and its old figures go.
  /// @throws InternalError  without a run
  void insert(const WorkPrecisionPoint& point, const std::string& scene_hash);

  /// The point with that key, the scene's hash included.
  [[nodiscard]] std::optional<WorkPrecisionPoint> find(const PointKey& key) const;

  /// The points that may be compared with a run's: measured on the same processor with as many
  /// cores, by the same compiler and version. Ordered by problem, program, association, solver,
  /// precision, tolerance and dofs.
  [[nodiscard]] std::vector<WorkPrecisionPoint> points_like(const BenchRun& run) const;

  /// All runs, in the order of their beginning.
  [[nodiscard]] std::vector<BenchRun> runs() const;

 private:
  struct Connection;
  std::unique_ptr<Connection> connection_;
  std::int64_t run_ = 0;
};

/// Writes points as a table: names, then a line for each, 17 digits, atomically. Texts with commas,
/// quotes or line ends are quoted as RFC 4180 says; a figure that is none is left out.
/// @throws WorkError  when the file cannot be written
void write_points_csv(const std::filesystem::path& file,
                      const std::vector<WorkPrecisionPoint>& points);

}  // namespace elastogen::selector
