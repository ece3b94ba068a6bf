// The state of a run between two steps, kept in a file so that a killed run can go on.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "runtime/integrator.h"
#include "runtime/newton.h"
#include "selector/io/pvd.h"

namespace elastogen::selector {

/// How far a run is.
struct RunPosition {
  std::int64_t step = 0;  ///< time or load steps that are complete
  double time = 0;        ///< [s], or the load factor
};

/// Everything that the steps to come depend on, and what had been recorded up to then.
struct Checkpoint {
  std::string fingerprint;            ///< of the scene's problem; see `run_fingerprint`
  int threads = 0;                    ///< that computed it: others change the last bits
  std::optional<MotionState> motion;  ///< of a motion in time; so is the next
  std::int64_t quiet_steps = 0;       ///< for how many steps the body has been at rest
  std::optional<LoadState> load;      ///< of a static solve
  std::vector<SeriesFile> series;
  std::uint64_t history_bytes = 0;  ///< length of history.csv

  /// @param time_step  of motions [s]
  [[nodiscard]] RunPosition position(double time_step) const;
};

/// Where a folder of results has its checkpoint.
[[nodiscard]] std::filesystem::path checkpoint_file(const std::filesystem::path& folder);

/// Writes a checkpoint, atomically, as CBOR (RFC 8949) with vectors as byte strings of doubles.
/// @throws WorkError  when it cannot be written
void write_checkpoint(const std::filesystem::path& file, const Checkpoint& checkpoint);

/// @throws InputError  when the file is missing, damaged, or of another version
[[nodiscard]] Checkpoint read_checkpoint(const std::filesystem::path& file);

}  // namespace elastogen::selector
