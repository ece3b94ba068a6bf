#include "selector/io/atomic_file.h"

#include <fmt/format.h>
#include <unistd.h>

#include <system_error>

#include "runtime/error.h"

namespace elastogen::selector {
namespace {

/// ".NAME.PID.EXT" beside the file: hidden, apart from those of other processes, and on the same
/// file system, as renaming needs.
std::filesystem::path temporary_beside(const std::filesystem::path& path) {
  const std::string name =
      fmt::format(".{}.{}{}", path.stem().string(), ::getpid(), path.extension().string());
  return path.parent_path() / name;
}

}  // namespace

void write_atomically(const std::filesystem::path& path,
                      const std::function<void(const std::filesystem::path& temporary)>& write) {
  const std::filesystem::path temporary = temporary_beside(path);
  std::error_code error;
  try {
    write(temporary);
  } catch (...) {
    std::filesystem::remove(temporary, error);
    throw;
  }
  std::filesystem::rename(temporary, path, error);
  if (error) {
    const std::string reason = error.message();
    std::filesystem::remove(temporary, error);
    throw WorkError(fmt::format("{}: cannot be written: {}", path.string(), reason));
  }
}

void create_folder(const std::filesystem::path& folder) {
  std::error_code error;
  const bool is_file =
      std::filesystem::exists(folder, error) && !std::filesystem::is_directory(folder, error);
  if (!is_file) std::filesystem::create_directories(folder, error);
  if (is_file || error) {
    throw WorkError(fmt::format("{}: cannot be created as a folder: {}", folder.string(),
                                is_file ? "a file has that name" : error.message()));
  }
}

}  // namespace elastogen::selector
