#include "selector/io/pvd.h"

#include <fmt/format.h>

#include "selector/support/files.h"

namespace elastogen::selector {

void write_pvd(const std::filesystem::path& file, const std::vector<SeriesFile>& series) {
  std::string text =
      "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"0.1\" "
      "byte_order=\"LittleEndian\">\n  <Collection>\n";
  for (const SeriesFile& entry : series) {
    text += fmt::format("    <DataSet timestep=\"{}\" group=\"\" part=\"0\" file=\"{}\"/>\n",
                        entry.time, entry.name);
  }
  write_text_file(file, text + "  </Collection>\n</VTKFile>\n");
}

}  // namespace elastogen::selector
