// What the commands of the command line share.
//
// Each command has a header with one function
//   void add_NAME_command(CLI::App& app, Context& context);
// that declares its options and, when the command line chose it, sets `context.action`. `main`
// calls the action after the command line was read completely.
#pragma once

#include <CLI/CLI.hpp>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "selector/jit/kernel_loader.h"
#include "symgen/law/law.h"
#include "symgen/pipeline.h"

namespace elastogen::selector {

/// Exit status of a run that Ctrl-C ended; its results are written and valid.
inline constexpr int exit_interrupted = 130;

/// Options before the command, and what the command line chose.
struct Context {
  std::vector<std::filesystem::path> user_law_folders;  ///< --laws, searched first
  symgen::GenerateOptions generate;                     ///< --profile, --grouping, --derive
  int threads = 0;                                      ///< 0: as many as the machine has
  bool quiet = false;                                   ///< no progress on standard error
  bool no_cache = false;                                ///< compile kernels anew, keep nothing
  std::function<int()> action;                          ///< returns the exit status

  /// Folders of law files in the order of search: --laws, ELASTOGEN_LAWS (separated by ':'),
  /// share/elastogen/laws beside the program's folder.
  /// @throws InputError  when a folder that the user named does not exist
  [[nodiscard]] std::vector<std::filesystem::path> law_folders() const;

  /// Cache, threads, profile and progress for kernels made on the fly.
  [[nodiscard]] LoaderOptions loader_options() const;

  /// A line on standard error, unless --quiet.
  void tell(const std::string& line) const;
};

/// share/elastogen beside the program's folder: what comes with it.
[[nodiscard]] std::filesystem::path shared_folder();

/// Reads the law of an association from the law folders.
/// @throws InputError  unknown law (with the nearest known), the file's errors, or a quadrature
///                     that the law cannot have
[[nodiscard]] symgen::Law read_law_of(const symgen::AssociationId& id, const Context& context);

}  // namespace elastogen::selector
