// The system's C++ compiler as a subprocess.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "runtime/error.h"

namespace elastogen::selector {

/// The compiler rejected generated code; its log is worth keeping.
class CompilationFailed : public WorkError {
 public:
  using WorkError::WorkError;
};

/// A compiler that can make shared libraries.
struct Compiler {
  std::vector<std::string> command;  ///< program and leading arguments ("ccache", "g++")
  std::string version;               ///< all that `--version` prints
  std::vector<std::string> flags;    ///< for kernels; chosen for this compiler
};

/// The environment's CXX, else the first of c++, g++, clang++ found in PATH.
/// @throws WorkError  when there is none; says what was tried and how to mend it
[[nodiscard]] Compiler find_compiler();

/// Compiles sources into one shared library.
///
/// @param include  folder for `#include "runtime/..."`
/// @param log      the compiler's output is kept here
/// @throws CompilationFailed  with the first lines of the log, and where the log lies
/// @throws WorkError          when a signal interrupted it (Ctrl-C reaches the compiler too)
void compile_shared_library(const Compiler& compiler,
                            const std::vector<std::filesystem::path>& sources,
                            const std::filesystem::path& include,
                            const std::filesystem::path& library, const std::filesystem::path& log);

/// Names the processor that -march=native compiles for: a library made on one machine of a shared
/// home folder must not be loaded on another.
[[nodiscard]] std::string processor_identity();

}  // namespace elastogen::selector
