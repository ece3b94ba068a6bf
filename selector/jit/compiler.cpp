#include "selector/jit/compiler.h"

#include <fmt/format.h>

#include <algorithm>
#include <csignal>
#include <cstdlib>
#include <fstream>
#include <map>
#include <sstream>

#include "runtime/kernel_selection.h"
#include "selector/support/files.h"
#include "selector/support/names.h"
#include "selector/support/process.h"

namespace elastogen::selector {
namespace fs = std::filesystem;
namespace {

/// The instruction set that kernels are compiled for: that of this processor, or the one in the
/// environment, for results like those of a machine that has no more.
std::string architecture() {
  const char* const variable = std::getenv(instruction_set_variable);
  const std::string wanted = variable != nullptr ? variable : "";
  std::vector<std::string> sets = {"native"};
  std::map<std::string, std::string> names = {{"native", "native"}};
#if defined(__x86_64__)
  sets = {"x86_64", "avx2", "avx512", "native"};
  names.insert({{"x86_64", "x86-64"}, {"avx2", "x86-64-v3"}, {"avx512", "x86-64-v4"}});
#endif
  return names.at(choose_instruction_set("what is run", sets, wanted, processor_supports));
}

std::vector<std::string> kernel_flags(bool clang) {
  std::vector<std::string> flags = {
      "-std=c++20", "-O3", "-march=" + architecture(), "-ffp-contract=fast", "-fno-math-errno",
      // Kernels report what is not finite, so no -ffast-math; but nobody reads the trap flags.
      "-fno-trapping-math", "-Wno-psabi", "-shared", "-fPIC",
      // Each library calls its own functions, whatever else is loaded.
      "-Wl,-Bsymbolic"};
#if defined(__x86_64__)
  // A batch fills one 64-byte register; gcc would otherwise halve it.
  flags.push_back("-mprefer-vector-width=512");
#endif
  if (clang) return flags;
  // gcc makes inline variables unique across all loaded libraries: two builds of one association
  // (other operations, other precision) would share them.
  flags.emplace_back("-fno-gnu-unique");
  // Of a long kernel's instructions half move spilled values; these save a fifth of them.
  flags.insert(flags.end(), {"-flive-range-shrinkage", "-frename-registers"});
  return flags;
}

/// "ccache g++ -m64" as words; a path with spaces that is a program is one word.
std::vector<std::string> command_words(const std::string& text) {
  if (find_program(text)) return {text};
  std::istringstream stream(text);
  std::vector<std::string> words;
  for (std::string word; stream >> word;) words.push_back(word);
  return words;
}

std::vector<std::string> find_command() {
  const char* from_environment = std::getenv("CXX");
  if (from_environment != nullptr && *from_environment != '\0') {
    const std::vector<std::string> words = command_words(from_environment);
    if (words.empty() || !find_program(words.front())) {
      throw WorkError(fmt::format(
          "CXX = '{}' is not a program that can be run, and kernels must be compiled; set CXX to "
          "a C++20 compiler, or unset it to take the first of c++, g++, clang++ in PATH",
          from_environment));
    }
    return words;
  }
  for (const char* name : {"c++", "g++", "clang++"}) {
    if (find_program(name)) return {name};
  }
  throw WorkError(
      "no C++ compiler: kernels are compiled when they are first needed, and none of c++, g++, "
      "clang++ is in PATH; install one (Debian: apt-get install g++) or set CXX");
}

std::string first_lines(const std::string& text, int count) {
  std::istringstream stream(text);
  std::string result;
  std::string line;
  while (count-- > 0 && std::getline(stream, line)) result += "\n  " + line;
  if (std::getline(stream, line)) result += "\n  ...";
  return result;
}

}  // namespace

Compiler find_compiler() {
  Compiler compiler;
  compiler.command = find_command();
  std::vector<std::string> command = compiler.command;
  command.push_back("--version");
  const ProcessResult result = run_process(command);
  if (result.exit_status != 0 || result.signal != 0) {
    throw WorkError(
        fmt::format("'{}' failed:{}", join(command, " "), first_lines(result.output, 5)));
  }
  compiler.version = result.output;
  compiler.flags = kernel_flags(compiler.version.find("clang") != std::string::npos);
  return compiler;
}

void compile_shared_library(const Compiler& compiler, const std::vector<fs::path>& sources,
                            const fs::path& include, const fs::path& library, const fs::path& log) {
  std::vector<std::string> command = compiler.command;
  command.insert(command.end(), compiler.flags.begin(), compiler.flags.end());
  command.insert(command.end(), {"-I", include.string(), "-o", library.string()});
  for (const fs::path& source : sources) command.push_back(source.string());

  const ProcessResult result = run_process(command);
  write_text_file(log, join(command, " ") + "\n" + result.output);
  if (result.signal == SIGINT || result.signal == SIGTERM) {
    throw WorkError("compilation of kernels was interrupted; nothing was kept of it");
  }
  if (result.signal != 0 || result.exit_status != 0) {
    const std::string how = result.signal != 0
                                ? fmt::format("was ended by signal {}", result.signal)
                                : fmt::format("exited with {}", result.exit_status);
    throw CompilationFailed(fmt::format(
        "the compiler '{}' {} on generated kernels:{}\n  whole log: {}",
        join(compiler.command, " "), how, first_lines(result.output, 12), log.string()));
  }
}

std::string processor_identity() {
  // One core's worth of /proc/cpuinfo: name and instruction sets (x86: flags, ARM: Features).
  std::ifstream stream("/proc/cpuinfo");
  std::string identity;
  for (std::string line; std::getline(stream, line) && !line.empty();) {
    for (const char* key : {"model name", "flags", "Features", "CPU part"}) {
      if (line.starts_with(key)) identity += line + "\n";
    }
  }
  return identity;
}

}  // namespace elastogen::selector
