#include "selector/jit/kernel_loader.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <future>
#include <map>
#include <optional>
#include <semaphore>
#include <thread>

#include "runtime/error.h"
#include "selector/jit/cache.h"
#include "selector/jit/embedded_headers.h"
#include "selector/support/files.h"
#include "selector/support/names.h"
#include "symgen/emit/content_hash.h"

namespace elastogen::selector {
namespace fs = std::filesystem;
namespace {

using Clock = std::chrono::steady_clock;

constexpr const char* library_name = "kernels.so";

double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

/// All that the machine code of a request depends on.
std::string cache_key(const KernelRequest& request, const std::string& hash,
                      const Compiler& compiler) {
  std::vector<std::string> operations = request.what.operations;
  std::sort(operations.begin(), operations.end());
  const std::string symbol = symgen::registration_symbol(request.id, request.what);
  const std::string operation_text = join(operations, " ");
  const std::string command = join(compiler.command, " ");
  const std::string flags = join(compiler.flags, " ");
  const std::string processor = processor_identity();
  const std::string generator = symgen::generator_fingerprint();
  std::vector<std::string_view> parts = {hash,    generator, symbol,    operation_text,
                                         command, flags,     processor, compiler.version};
  for (const EmbeddedHeader& header : embedded_headers()) parts.push_back(header.text);
  return request.id.identifier() + "-" + symgen::content_hash(parts);
}

void write_sources(const KernelRequest& request, const symgen::GeneratedAssociation& generated,
                   const fs::path& folder) {
  const std::string name = request.id.identifier();
  write_text_file(folder / (name + ".h"), generated.header);
  write_text_file(folder / (name + ".cpp"),
                  symgen::registration_source(request.id, request.law, request.what));
  for (const EmbeddedHeader& header : embedded_headers()) {
    write_text_file(folder / header.path, header.text);
  }
}

template <class Scalar>
void check_table(const KernelTable<Scalar>& table, const KernelRequest& request,
                 const std::string& hash) {
  const auto expect = [](bool good, const std::string& what) {
    if (!good) throw BadLibrary("its table has another " + what);
  };
  expect(table.abi_version == kernel_abi_version, "version of the kernel interface");
  expect(table.association == request.id.text(), "association");
  expect(table.hash == hash, "content hash");
  expect((table.lanes > 1) == request.what.simd, "number of lanes");
  expect(table.num_parameters == static_cast<int>(request.law.parameters.size()),
         "number of parameters");
}

template <class Scalar>
const void* fetch_table(const SharedLibrary& library, const KernelRequest& request,
                        const std::string& hash) {
  const auto function = library.function<const KernelTable<Scalar>* (*)()>(
      symgen::registration_symbol(request.id, request.what));
  const KernelTable<Scalar>* table = function();
  check_table(*table, request, hash);
  return table;
}

/// One of the compilations that may run at a time.
class Slot {
 public:
  explicit Slot(std::counting_semaphore<>& slots) : slots_(slots) { slots_.acquire(); }
  ~Slot() { slots_.release(); }
  Slot(const Slot&) = delete;
  Slot& operator=(const Slot&) = delete;

 private:
  std::counting_semaphore<>& slots_;
};

}  // namespace

template <class Scalar>
const KernelTable<Scalar>& LoadedKernels::table() const {
  if (table_ == nullptr || single_precision_ != std::is_same_v<Scalar, float>) {
    throw InternalError("kernels of " + report_.association +
                        " were asked for in a precision that was not requested");
  }
  return *static_cast<const KernelTable<Scalar>*>(table_);
}
template const KernelTable<float>& LoadedKernels::table() const;
template const KernelTable<double>& LoadedKernels::table() const;

KernelLoader::KernelLoader(LoaderOptions options) : options_(std::move(options)) {
  if (options_.cache_folder.empty()) {
    options_.cache_folder = options_.use_cache ? default_cache_folder() : fs::temp_directory_path();
  }
  if (options_.threads <= 0) {
    options_.threads = static_cast<int>(std::max(1U, std::thread::hardware_concurrency()));
  }
}

/// One request on its way to loaded kernels.
struct KernelLoader::Job {
  /// A compilation under way: the folder that it works in, and how long it will have taken.
  struct Compilation {
    // clang 14 does not make aggregates in place.
    Compilation(WorkFolder where, std::future<double> time)
        : folder(std::move(where)), seconds(std::move(time)) {}

    WorkFolder folder;
    std::future<double> seconds;
  };

  const KernelRequest* request = nullptr;
  std::string hash;  ///< of the association
  fs::path entry;    ///< in the cache
  std::optional<Compilation> compilation;
  LoadedKernels result;
};

void KernelLoader::tell(const std::string& line) const {
  if (options_.progress) options_.progress(line);
}

KernelLoader::Job KernelLoader::describe(const KernelRequest& request,
                                         const Compiler& compiler) const {
  Job job;
  job.request = &request;
  job.hash = symgen::association_hash(request.id, request.law, options_.generate);
  job.entry = options_.cache_folder / cache_key(request, job.hash, compiler);
  job.result.single_precision_ = request.what.single_precision;
  job.result.report_.association = request.id.text();
  if (options_.use_cache) job.result.report_.folder = job.entry;
  return job;
}

void KernelLoader::open(Job& job, const fs::path& library) {
  const KernelRequest& request = *job.request;
  job.result.library_ = SharedLibrary(library);
  job.result.table_ = request.what.single_precision
                          ? fetch_table<float>(job.result.library_, request, job.hash)
                          : fetch_table<double>(job.result.library_, request, job.hash);
}

bool KernelLoader::take_from_cache(Job& job) const {
  // Entries appear whole: one without a library is as damaged as one with a bad library, and in
  // the way of the one that replaces it.
  std::error_code error;
  if (!options_.use_cache || !fs::exists(job.entry, error)) return false;
  try {
    open(job, job.entry / library_name);
  } catch (const BadLibrary& bad) {
    tell(fmt::format("cached kernels of {} are damaged ({}); making them again",
                     job.result.report_.association, bad.what()));
    fs::remove_all(job.entry, error);
    return false;
  }
  job.result.report_.up_to_date = true;
  return true;
}

void KernelLoader::start(Job& job, const Compiler& compiler,
                         std::counting_semaphore<>& free_slots) const {
  const KernelRequest& request = *job.request;
  tell("generating " + request.id.text());
  const Clock::time_point begin = Clock::now();
  const symgen::GeneratedAssociation generated =
      symgen::generate_association(request.id, request.law, options_.generate);
  WorkFolder folder(options_.cache_folder);
  write_sources(request, generated, folder.path());
  job.result.report_.generate_seconds = seconds_since(begin);

  tell("compiling " + request.id.text());
  const fs::path where = folder.path();
  const fs::path source = where / (request.id.identifier() + ".cpp");
  auto compile = [where, source, &compiler, &free_slots] {
    const Slot slot(free_slots);
    const Clock::time_point start = Clock::now();
    compile_shared_library(compiler, {source}, where, where / library_name, where / "compile.log");
    return seconds_since(start);
  };
  job.compilation.emplace(std::move(folder), std::async(std::launch::async, compile));
}

void KernelLoader::finish(Job& job) const {
  Job::Compilation& compilation = *job.compilation;
  KernelBuildReport& report = job.result.report_;
  try {
    report.compile_seconds = compilation.seconds.get();
  } catch (const CompilationFailed&) {
    compilation.folder.keep();  // the message points to the log in it
    throw;
  }
  fs::path library = compilation.folder.path() / library_name;
  if (options_.use_cache) {
    compilation.folder.publish(job.entry);
    library = job.entry / library_name;
  }
  try {
    open(job, library);
  } catch (const BadLibrary& bad) {
    throw InternalError(fmt::format("freshly compiled kernels of {} ('{}') cannot be used: {}",
                                    report.association, library.string(), bad.what()));
  }
  tell(fmt::format("compiled {} in {:.1f} s", report.association, report.compile_seconds));
}

std::vector<LoadedKernels> KernelLoader::load(const std::vector<KernelRequest>& requests) {
  const Compiler compiler = find_compiler();
  if (options_.use_cache) remove_stale_work_folders(options_.cache_folder);

  // Outlives the compilations, which wait for it and are waited for when they are destroyed.
  std::counting_semaphore<> free_slots(options_.threads);
  std::vector<Job> jobs;
  std::map<fs::path, std::size_t> job_of_entry;  // the same request twice is one job
  std::vector<std::size_t> job_of_request;
  for (const KernelRequest& request : requests) {
    Job job = describe(request, compiler);
    const auto [known, is_new] = job_of_entry.emplace(job.entry, jobs.size());
    job_of_request.push_back(known->second);
    if (!is_new) continue;
    if (!take_from_cache(job)) start(job, compiler, free_slots);
    jobs.push_back(std::move(job));
  }
  for (Job& job : jobs) {
    if (job.compilation) finish(job);
  }

  std::vector<LoadedKernels> loaded;
  for (const std::size_t job : job_of_request) loaded.push_back(jobs[job].result);
  return loaded;
}

}  // namespace elastogen::selector
