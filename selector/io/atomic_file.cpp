#include "selector/io/atomic_file.h"

#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <system_error>

#include "runtime/error.h"
#include "selector/support/temporary_file.h"

namespace elastogen::selector {
void write_atomically(const std::filesystem::path& path,
                      const std::function<void(const std::filesystem::path& temporary)>& write) {
  const std::filesystem::path temporary =
      temporary_beside(path, path.stem().string(), path.extension().string().substr(1));
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

void check_can_be_written(const std::filesystem::path& folder) {
  std::error_code error;
  if (!std::filesystem::exists(folder, error)) return;
  if (!std::filesystem::is_directory(folder, error)) {
    throw InputError(fmt::format("{}: results need a folder, and this is a file: name another",
                                 folder.string()));
  }
  if (::access(folder.c_str(), W_OK | X_OK) != 0) {
    throw WorkError(fmt::format("{}: results cannot be written there: {}", folder.string(),
                                std::strerror(errno)));
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
