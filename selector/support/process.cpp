#include "selector/support/process.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <signal.h>
#include <spawn.h>
#include <sys/resource.h>
#include <sys/time.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <sstream>
#include <string_view>

#include "runtime/error.h"

extern char** environ;

namespace elastogen::selector {
namespace fs = std::filesystem;

namespace {

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

double seconds(const timeval& time) {
  return static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec);
}

/// Our environment with the settings of the options.
std::vector<std::string> environment_of(const ProcessOptions& options) {
  std::vector<std::string> settings;
  for (const auto& [name, value] : options.environment) settings.push_back(name + '=' + value);
  for (char** entry = environ; *entry != nullptr; ++entry) {
    const std::string_view ours = *entry;
    const bool replaced =
        std::any_of(options.environment.begin(), options.environment.end(),
                    [&](const auto& set) { return ours.substr(0, ours.find('=')) == set.first; });
    if (!replaced) settings.emplace_back(ours);
  }
  return settings;
}

std::vector<char*> pointers(std::vector<std::string>& texts) {
  std::vector<char*> result;
  for (std::string& text : texts) result.push_back(text.data());
  result.push_back(nullptr);
  return result;
}

/// Appends what comes until the writing end is closed, or until the time is over.
/// @return whether the writing end was closed
bool read_until(int pipe_end, Clock::time_point start, double time_limit, std::string& output) {
  char buffer[4096];
  for (;;) {
    if (time_limit > 0) {
      const double left = time_limit - seconds_since(start);
      if (left <= 0) return false;
      pollfd waiting{pipe_end, POLLIN, 0};
      // At most an hour at once: milliseconds are an int.
      const int ready = poll(&waiting, 1, static_cast<int>(std::ceil(1e3 * std::min(left, 3600.))));
      if (ready <= 0) continue;
    }
    const ssize_t n = read(pipe_end, buffer, sizeof buffer);
    if (n > 0) {
      output.append(buffer, static_cast<std::size_t>(n));
    } else if (n == 0 || errno != EINTR) {
      return true;
    }
  }
}

}  // namespace

ProcessResult run_process(const std::vector<std::string>& command, const ProcessOptions& options) {
  const auto fail = [&](int error) {
    throw WorkError(fmt::format("cannot run '{}': {}", command.front(), std::strerror(error)));
  };
  // Close-on-exec: other threads may start programs at this moment, which must not inherit the
  // writing end, or reading would wait for them too.
  int pipe_ends[2];
  if (pipe2(pipe_ends, O_CLOEXEC) != 0) fail(errno);

  std::vector<std::string> words = command;
  std::vector<std::string> settings = environment_of(options);
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  if (!options.folder.empty()) {
    if (words.front().find('/') != std::string::npos) words.front() = fs::absolute(words.front());
    posix_spawn_file_actions_addchdir_np(&actions, options.folder.c_str());
  }
  posix_spawn_file_actions_addopen(&actions, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
  posix_spawn_file_actions_adddup2(&actions, pipe_ends[1], STDOUT_FILENO);
  posix_spawn_file_actions_adddup2(&actions, pipe_ends[1], STDERR_FILENO);
  pid_t child = 0;
  const Clock::time_point start = Clock::now();
  const int error = posix_spawnp(&child, words.front().c_str(), &actions, nullptr,
                                 pointers(words).data(), pointers(settings).data());
  posix_spawn_file_actions_destroy(&actions);
  close(pipe_ends[1]);
  if (error != 0) {
    close(pipe_ends[0]);
    fail(error);
  }

  ProcessResult result;
  if (!read_until(pipe_ends[0], start, options.time_limit, result.output)) {
    // A child of the program may hold the pipe open for long: it is not read to its end.
    kill(child, SIGKILL);
    result.timed_out = true;
  }
  close(pipe_ends[0]);
  int status = 0;
  rusage usage{};
  while (wait4(child, &status, 0, &usage) < 0) {
    if (errno != EINTR) fail(errno);
  }
  result.wall_seconds = seconds_since(start);
  result.cpu_seconds = seconds(usage.ru_utime) + seconds(usage.ru_stime);
  if (WIFSIGNALED(status)) {
    result.signal = WTERMSIG(status);
  } else {
    result.exit_status = WEXITSTATUS(status);
  }
  return result;
}

std::optional<fs::path> find_program(const std::string& name) {
  const auto runs = [](const fs::path& file) {
    std::error_code error;
    return fs::is_regular_file(file, error) && access(file.c_str(), X_OK) == 0;
  };
  if (name.find('/') != std::string::npos) {
    return runs(name) ? std::optional<fs::path>(name) : std::nullopt;
  }
  const char* path = std::getenv("PATH");
  std::istringstream folders(path != nullptr ? path : "/usr/local/bin:/usr/bin:/bin");
  for (std::string folder; std::getline(folders, folder, ':');) {
    const fs::path file = fs::path(folder.empty() ? "." : folder) / name;
    if (!name.empty() && runs(file)) return file;
  }
  return std::nullopt;
}

}  // namespace elastogen::selector
