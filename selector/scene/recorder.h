// What a run that goes through steps leaves behind on its way: a series of result files with its
// index, a table of what probes saw, and checkpoints to go on from.
#pragma once

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "selector/scene/body_state.h"
#include "selector/scene/checkpoint.h"

namespace elastogen::selector {

/// Results that an earlier run may have left where this one has none.
inline constexpr const char* points_file = "points.vtu";
inline constexpr const char* stress_picture = "stress.png";

/// Which steps are recorded.
struct RecordIntervals {
  std::int64_t series = 0;   ///< every so many steps; 0: never
  std::int64_t history = 0;  ///< likewise
};

/// A column of history.csv.
struct HistoryColumn {
  std::string name;      ///< "tip_von_mises"
  std::string quantity;  ///< of probes: "u", "r", "m", or a field, "von_mises", "cauchy_stress.XX"
};

/// series.pvd, series/step_NNNNNN.vtu (with points also points.pvd, series/points_NNNNNN.vtu),
/// history.csv and state.cbor in a folder of results. A kill at
/// any moment leaves whole files; what is recorded after the last checkpoint is recorded again when
/// the run is resumed.
class Recorder {
 public:
  /// @param fingerprint  of the run, for its checkpoints
  /// All must outlive the recorder, which writes nothing before `start` or `resume`.
  Recorder(const Scene& scene, const Problem& problem, Model& model, FieldEvaluator& fields,
           std::filesystem::path folder, RecordIntervals intervals, std::string fingerprint);

  /// Begins a new record; removes what is left of an older one.
  /// @throws WorkError  when the folder cannot be written
  void start();
  /// Goes on from where a checkpoint was.
  /// @throws InputError  when files of the record are missing, or the history has other columns
  void resume(const Checkpoint& checkpoint);

  /// Whether anything is recorded of a step.
  [[nodiscard]] bool wants(std::int64_t step) const;
  /// @param time  [s], or the load factor
  /// @throws WorkError  when a file cannot be written
  void record(std::int64_t step, double time, const BodyState& state);

  /// Writes a checkpoint after a step. Writing takes at most about a twentieth of the run: where
  /// steps are short, some are passed over unless it `must` be written.
  /// @param state  with the run's own part: motion and quiet_steps, or load
  void keep(Checkpoint state, bool must);

  [[nodiscard]] const std::string& fingerprint() const { return fingerprint_; }
  /// Names of the files of the record, for the summary.
  [[nodiscard]] std::vector<std::string> files() const;
  /// Columns of history.csv, the step and the time being the first.
  [[nodiscard]] const std::vector<HistoryColumn>& columns() const { return columns_; }
  [[nodiscard]] std::filesystem::path history_file() const { return folder_ / "history.csv"; }

 private:
  using Clock = std::chrono::steady_clock;

  void open_history(std::ios::openmode mode);
  [[nodiscard]] std::string header() const;  // of history.csv
  void begin_history();
  void append(const std::string& line);
  void record_history(std::int64_t step, double time, const BodyState& state);
  void record_series(std::int64_t step, double time, const BodyState& state);

  const Scene& scene_;
  const Problem& problem_;
  Model& model_;
  FieldEvaluator& fields_;
  std::filesystem::path folder_;
  RecordIntervals intervals_;
  std::string fingerprint_;
  std::vector<HistoryColumn> columns_;
  std::vector<SeriesFile> series_;
  std::ofstream history_;
  std::uint64_t history_bytes_ = 0;
  bool keeps_ = false;  // whether a checkpoint has been written
  Clock::time_point kept_at_{};
  Clock::duration keeping_took_{};
};

}  // namespace elastogen::selector
