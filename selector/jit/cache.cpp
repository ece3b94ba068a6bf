#include "selector/jit/cache.h"

#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <cstdlib>
#include <cstring>
#include <utility>

#include "runtime/error.h"

namespace elastogen::selector {
namespace fs = std::filesystem;
namespace {

constexpr const char* work_prefix = "work-";

/// An environment variable that is set to something.
const char* environment(const char* name) {
  const char* value = std::getenv(name);
  return value != nullptr && *value != '\0' ? value : nullptr;
}

/// Libraries in the cache are loaded, that is executed: below /tmp the folder must be ours alone.
fs::path private_temporary_folder() {
  const fs::path folder =
      fs::temp_directory_path() / fmt::format("elastogen-{}", static_cast<long>(getuid()));
  if (mkdir(folder.c_str(), 0700) != 0 && errno != EEXIST) {
    throw WorkError(fmt::format("cannot make the cache folder '{}': {}; set ELASTOGEN_CACHE_DIR",
                                folder.string(), std::strerror(errno)));
  }
  struct stat status {};
  if (lstat(folder.c_str(), &status) != 0 || !S_ISDIR(status.st_mode) ||
      status.st_uid != getuid() || (status.st_mode & 0077) != 0) {
    throw WorkError(
        fmt::format("the cache folder '{}' is not a folder that only this user can "
                    "open; remove it or set ELASTOGEN_CACHE_DIR",
                    folder.string()));
  }
  return folder;
}

}  // namespace

fs::path default_cache_folder() {
  if (const char* folder = environment("ELASTOGEN_CACHE_DIR")) return folder;
  if (const char* folder = environment("XDG_CACHE_HOME")) return fs::path(folder) / "elastogen";
  if (const char* home = environment("HOME")) return fs::path(home) / ".cache" / "elastogen";
  return private_temporary_folder();
}

WorkFolder::WorkFolder(const fs::path& parent) {
  const auto fail = [&](const std::string& reason) {
    throw WorkError(
        fmt::format("cannot make a folder for compiled kernels in '{}': {}; set "
                    "ELASTOGEN_CACHE_DIR to one that can be written",
                    parent.string(), reason));
  };
  std::error_code error;
  fs::create_directories(parent, error);
  if (error) fail(error.message());
  std::string name = (parent / work_prefix).string() + "XXXXXX";
  if (mkdtemp(name.data()) == nullptr) fail(std::strerror(errno));
  path_ = name;
}

WorkFolder::~WorkFolder() {
  std::error_code ignored;  // what cannot be removed now is removed as stale later
  if (owned_) fs::remove_all(path_, ignored);
}

WorkFolder::WorkFolder(WorkFolder&& other) noexcept
    : path_(std::move(other.path_)), owned_(std::exchange(other.owned_, false)) {}

void WorkFolder::publish(const fs::path& entry) {
  std::error_code error;
  fs::rename(path_, entry, error);
  if (!error) {
    owned_ = false;
  } else if (!fs::is_directory(entry)) {
    throw WorkError(fmt::format("cannot rename '{}' to '{}': {}", path_.string(), entry.string(),
                                error.message()));
  }
}

void remove_stale_work_folders(const fs::path& parent) {
  std::error_code ignored;
  const auto limit = fs::file_time_type::clock::now() - std::chrono::hours(24);
  for (const fs::directory_entry& entry : fs::directory_iterator(parent, ignored)) {
    std::error_code error;
    const bool stale = entry.path().filename().string().starts_with(work_prefix) &&
                       entry.last_write_time(error) < limit && !error;
    if (stale) fs::remove_all(entry.path(), error);
  }
}

}  // namespace elastogen::selector
