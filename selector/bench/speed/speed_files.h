// Results of speed on the disk.
#pragma once

#include <filesystem>
#include <memory>

#include "selector/bench/speed/speed_record.h"

namespace elastogen::selector {

/// An SQLite file that keeps each record as soon as it is measured, with the runs before. Columns
/// of table `records` are those of for_each_speed_field.
class SpeedDatabase {
 public:
  /// Opens or makes the file and notes the run.
  /// @throws InputError  for a file that is none of ours
  /// @throws WorkError   when it cannot be written
  SpeedDatabase(const std::filesystem::path& file, const BenchRun& run);
  ~SpeedDatabase();

  void add(const SpeedRecord& record);

 private:
  struct Connection;
  std::unique_ptr<Connection> connection_;
};

/// Results as JSON.
[[nodiscard]] std::string speed_json(const SpeedResults& results);

/// @throws InputError  when the file cannot be read or holds something else
[[nodiscard]] SpeedResults read_speed_json(const std::filesystem::path& file);

}  // namespace elastogen::selector
