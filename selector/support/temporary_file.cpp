#include "selector/support/temporary_file.h"

#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cctype>
#include <cerrno>
#include <charconv>
#include <csignal>
#include <fstream>
#include <optional>
#include <string>
#include <string_view>
#include <system_error>

namespace elastogen::selector {
namespace fs = std::filesystem;
namespace {

// Hidden files of users have names of many kinds; none has this before a number.
constexpr std::string_view mark = "elastogen-";

bool is_ending(std::string_view text) {
  if (text == "png" || text == "gnuplot") return true;
  return text.size() == 6 && std::all_of(text.begin(), text.end(),
                                         [](unsigned char c) { return std::isalnum(c) != 0; });
}

/// The process in a name of the form of `temporary_beside`.
std::optional<pid_t> process_of(std::string_view name) {
  const std::size_t last = name.rfind('.');
  if (!name.starts_with('.') || last == 0 || last == std::string_view::npos) return std::nullopt;
  const std::size_t middle = name.rfind('.', last - 1);
  if (middle == 0 || middle == 1 || middle == std::string_view::npos) return std::nullopt;
  if (!is_ending(name.substr(last + 1))) return std::nullopt;
  std::string_view number = name.substr(middle + 1, last - middle - 1);
  if (!number.starts_with(mark)) return std::nullopt;
  number.remove_prefix(mark.size());
  pid_t process = 0;
  const char* const end = number.data() + number.size();
  const auto read = std::from_chars(number.data(), end, process);
  if (read.ec != std::errc{} || read.ptr != end || process <= 0) return std::nullopt;
  return process;
}

/// Also what has ended without its parent having noticed yet (a zombie): proc(5), field 3 of stat.
bool is_gone(pid_t process) {
  if (::kill(process, 0) != 0) return errno == ESRCH;
  std::ifstream file(fmt::format("/proc/{}/stat", process));
  std::string text;
  std::getline(file, text);
  const std::size_t name_end = text.rfind(") ");
  return name_end != std::string::npos && (text[name_end + 2] == 'Z' || text[name_end + 2] == 'X');
}

bool is_own_file(const fs::path& path) {
  struct stat status {};
  return lstat(path.c_str(), &status) == 0 && S_ISREG(status.st_mode) && status.st_uid == geteuid();
}

}  // namespace

fs::path temporary_beside(const fs::path& file, const std::string& name,
                          const std::string& ending) {
  return file.parent_path() / fmt::format(".{}.{}{}.{}", name, mark, ::getpid(), ending);
}

void remove_left_temporaries(const fs::path& folder) {
  std::error_code error;
  for (fs::directory_iterator entry(folder, error), end; !error && entry != end;
       entry.increment(error)) {
    const std::optional<pid_t> process = process_of(entry->path().filename().string());
    if (!process || !is_gone(*process) || !is_own_file(entry->path())) continue;
    std::error_code ignored;  // what cannot be removed is in nobody's way
    fs::remove(entry->path(), ignored);
  }
}

}  // namespace elastogen::selector
