// Kernels on the fly: generate, compile with the system's compiler, load, cache.
#pragma once

#include <filesystem>
#include <functional>
#include <semaphore>
#include <string>
#include <vector>

#include "runtime/kernel_abi.h"
#include "selector/jit/compiler.h"
#include "selector/jit/shared_library.h"
#include "symgen/law/law.h"
#include "symgen/pipeline.h"

namespace elastogen::selector {

/// Kernels that somebody wants to call.
struct KernelRequest {
  symgen::AssociationId id;
  symgen::Law law;
  symgen::Instantiation what;
};

struct LoaderOptions {
  symgen::GenerateOptions generate;
  std::filesystem::path cache_folder;  ///< empty: `default_cache_folder()`
  bool use_cache = true;               ///< off: everything is made anew, and kept nowhere
  int threads = 0;                     ///< compilations at the same time; 0: hardware threads
  /// Called from the calling thread with a line for the user ("generating stvk-hexa8-q8-none").
  std::function<void(const std::string&)> progress;
};

/// What it took to get one association's kernels.
struct KernelBuildReport {
  std::string association;
  bool up_to_date = false;       ///< taken from the cache; the times are then zero
  double generate_seconds = 0;   ///< law to C++ source
  double compile_seconds = 0;    ///< wall time of the compiler; several run side by side
  std::filesystem::path folder;  ///< where source, log and library lie; empty without cache
};

/// A loaded library of one request. Its table stays valid as long as the object or a copy lives.
class LoadedKernels {
 public:
  /// The kernel table.
  /// @throws InternalError  when Scalar is not the precision that was requested
  template <class Scalar>
  [[nodiscard]] const KernelTable<Scalar>& table() const;

  /// "double" or "float"
  [[nodiscard]] const char* scalar() const { return single_precision_ ? "float" : "double"; }

  [[nodiscard]] const KernelBuildReport& report() const { return report_; }

 private:
  friend class KernelLoader;
  SharedLibrary library_;  ///< closed with the last copy
  const void* table_ = nullptr;
  bool single_precision_ = false;
  KernelBuildReport report_;
};

/// Makes and loads kernel libraries. A cache entry is a folder named by a hash of everything that
/// the machine code depends on: the association's own hash (law, options, generator version), the
/// instantiation, the headers that go with generated code, compiler, flags and processor. It holds
/// the sources, the compiler's log and the library, and appears by one rename, so two processes,
/// or an interruption, never leave half an entry.
class KernelLoader {
 public:
  explicit KernelLoader(LoaderOptions options);

  /// Kernels of all requests, in their order. Generation is sequential (GiNaC is not made for
  /// threads); compilations run beside it and beside each other.
  /// @throws InputError  from the generator
  /// @throws WorkError   no compiler, the compiler failed (with its first lines and the log's
  ///                     place), or it was interrupted
  [[nodiscard]] std::vector<LoadedKernels> load(const std::vector<KernelRequest>& requests);

 private:
  struct Job;

  [[nodiscard]] Job describe(const KernelRequest& request, const Compiler& compiler) const;
  [[nodiscard]] bool take_from_cache(Job& job) const;
  void start(Job& job, const Compiler& compiler, std::counting_semaphore<>& free_slots) const;
  void finish(Job& job) const;
  static void open(Job& job, const std::filesystem::path& library);
  void tell(const std::string& line) const;

  LoaderOptions options_;
};

}  // namespace elastogen::selector
