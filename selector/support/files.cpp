#include "selector/support/files.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <iterator>
#include <system_error>

#include "runtime/error.h"
#include "selector/support/temporary_file.h"

namespace elastogen::selector {
namespace fs = std::filesystem;

std::string read_text_file(const fs::path& file, std::string_view what) {
  std::error_code error;
  if (!fs::exists(file, error)) {
    throw InputError(fmt::format("{} file '{}' does not exist", what, file.string()));
  }
  if (fs::is_directory(file, error)) {
    throw InputError(fmt::format("{} file '{}' is a folder; name a file", what, file.string()));
  }
  std::ifstream stream(file, std::ios::binary);
  std::string text{std::istreambuf_iterator<char>(stream), {}};
  if (!stream.is_open() || stream.bad()) {
    throw InputError(
        fmt::format("{} file '{}' cannot be read: {}", what, file.string(), std::strerror(errno)));
  }
  return text;
}

void write_text_file(const fs::path& file, std::string_view text) {
  const auto fail = [&](const std::string& reason) {
    throw WorkError(fmt::format("cannot write '{}': {}", file.string(), reason));
  };
  std::error_code error;
  if (file.has_parent_path()) fs::create_directories(file.parent_path(), error);
  if (error) fail(error.message());

  std::string temporary = temporary_beside(file, file.filename().string(), "XXXXXX").string();
  const int descriptor = mkostemp(temporary.data(), O_CLOEXEC);
  if (descriptor < 0) fail(std::strerror(errno));
  const auto discard = [&](const std::string& reason) {
    close(descriptor);
    unlink(temporary.c_str());
    fail(reason);
  };
  for (std::size_t written = 0; written < text.size();) {
    const ssize_t n = write(descriptor, text.data() + written, text.size() - written);
    if (n < 0 && errno != EINTR) discard(std::strerror(errno));
    if (n > 0) written += static_cast<std::size_t>(n);
  }
  // mkostemp makes files for the owner only; these are ordinary results.
  const mode_t mask = umask(0);
  umask(mask);
  if (fchmod(descriptor, 0666 & ~mask) != 0) discard(std::strerror(errno));
  if (close(descriptor) != 0) fail(std::strerror(errno));
  fs::rename(temporary, file, error);
  if (error) {
    unlink(temporary.c_str());
    fail(error.message());
  }
}

}  // namespace elastogen::selector
