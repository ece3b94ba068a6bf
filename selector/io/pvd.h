// The index of a series of result files, as ParaView reads it.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace elastogen::selector {

/// One file of a series.
struct SeriesFile {
  double time = 0;   ///< [s], or the load factor
  std::string name;  ///< path from the index's folder; without characters special to XML
};

/// Writes the index, a VTK collection (.pvd), atomically.
/// @throws WorkError  when it cannot be written
void write_pvd(const std::filesystem::path& file, const std::vector<SeriesFile>& series);

}  // namespace elastogen::selector
