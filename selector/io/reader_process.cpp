#include "selector/io/reader_process.h"

#include <fmt/format.h>
#include <sys/mman.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

#include "runtime/error.h"
#include "selector/support/files.h"
#include "selector/support/process.h"

namespace elastogen::selector {
namespace {

namespace fs = std::filesystem;

/// A file in memory that another process of this user can open by name. Unlike one on disk, a kill
/// leaves nothing behind.
class SharedFile {
 public:
  SharedFile() : descriptor_(memfd_create("elastogen-mesh", MFD_CLOEXEC)) {
    if (descriptor_ < 0) {
      throw WorkError(fmt::format("no memory for reading a mesh: {}", std::strerror(errno)));
    }
  }
  SharedFile(const SharedFile&) = delete;
  SharedFile& operator=(const SharedFile&) = delete;
  ~SharedFile() { close(descriptor_); }

  [[nodiscard]] fs::path path() const {
    return fmt::format("/proc/{}/fd/{}", getpid(), descriptor_);
  }

 private:
  int descriptor_;
};

/// Beside this program: ../libexec/elastogen/elastogen-gmsh, installed and in the build tree.
fs::path reader_program(const std::string& name) {
  std::error_code error;
  const fs::path self = fs::read_symlink("/proc/self/exe", error);
  fs::path reader =
      self.parent_path().parent_path() / "libexec" / "elastogen" / ("elastogen-" + name);
  if (!fs::exists(reader, error)) {
    throw WorkError(
        fmt::format("the program that reads mesh files is not there: {}; build or "
                    "install elastogen again",
                    reader.string()));
  }
  return reader;
}

}  // namespace

RawMesh read_with(MeshLibrary library, const fs::path& file, const std::string& region_array) {
  const std::string name = library == MeshLibrary::gmsh ? "gmsh" : "vtk";
  const SharedFile record;
  std::vector<std::string> command = {reader_program(name).string(), fs::absolute(file).string(),
                                      record.path().string()};
  if (!region_array.empty()) command.push_back(region_array);
  const ProcessResult result = run_process(command);
  if (result.signal != 0) {
    // Gmsh 4.8 does on some sound files, too, so the file is only suspected.
    throw InputError(fmt::format(
        "{}: {} crashed while reading it (signal {}): the file may be damaged, or name elements or "
        "nodes that it does not define; try to open it in {}, and save it anew as {}",
        file.string(), name, result.signal, library == MeshLibrary::gmsh ? "gmsh" : "ParaView",
        library == MeshLibrary::gmsh ? ".msh" : ".vtu"));
  }
  if (result.exit_status != 0) {
    throw InputError(fmt::format("{}: {} cannot read it: {}", file.string(), name, result.output));
  }
  return unpack(read_text_file(record.path(), "record"));
}

}  // namespace elastogen::selector
