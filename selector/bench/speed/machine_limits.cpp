#include "selector/bench/speed/machine_limits.h"

#include <fmt/format.h>
#include <omp.h>

#include <algorithm>
#include <filesystem>

#include "runtime/aligned_vector.h"
#include "runtime/error.h"
#include "selector/bench/speed/timing.h"
#include "selector/jit/cache.h"
#include "selector/jit/compiler.h"
#include "selector/jit/embedded_headers.h"
#include "selector/jit/shared_library.h"
#include "selector/support/files.h"

namespace elastogen::selector {
namespace {

/// Twelve independent chains hide the latency of a multiply-add on every current processor, and
/// with the two factors fit in 16 registers.
constexpr const char* loops = R"(
#include <cstddef>
#include "runtime/kernel_functions.h"

namespace {
template <class V>
void multiply_add(long steps, elastogen::kernel::Scalar<V>* out) {
  using S = elastogen::kernel::Scalar<V>;
  constexpr int chains = 12;
  V x[chains];
#pragma GCC unroll 12
  for (int k = 0; k < chains; ++k) x[k] = V{} + S(k);
  const V factor = V{} + S(0.999999), term = V{} + S(1e-7);
  for (long step = 0; step < steps; ++step) {
#pragma GCC unroll 12
    for (int k = 0; k < chains; ++k) x[k] = x[k] * factor + term;
  }
  V sum = V{};
#pragma GCC unroll 12
  for (int k = 0; k < chains; ++k) sum += x[k];
  *out = sum[0];
}
}  // namespace

extern "C" void elastogen_multiply_add_f64(long steps, double* out);
extern "C" void elastogen_multiply_add_f64(long steps, double* out) {
  multiply_add<elastogen::kernel::DoublePack>(steps, out);
}
extern "C" void elastogen_multiply_add_f32(long steps, float* out);
extern "C" void elastogen_multiply_add_f32(long steps, float* out) {
  multiply_add<elastogen::kernel::FloatPack>(steps, out);
}
extern "C" int elastogen_vector_bytes();
extern "C" int elastogen_vector_bytes() { return elastogen::kernel::vector_bytes; }
extern "C" void elastogen_triad(std::size_t n, double* a, const double* b, const double* c);
extern "C" void elastogen_triad(std::size_t n, double* a, const double* b, const double* c) {
#pragma GCC ivdep
  for (std::size_t i = 0; i < n; ++i) a[i] = b[i] + 3.0 * c[i];
}
)";

constexpr long peak_steps = 20000;
constexpr double flops_per_lane = 2.0 * 12 * peak_steps;
constexpr double seconds_per_figure = 0.15;

class Loops {
 public:
  Loops() {
    WorkFolder folder(std::filesystem::temp_directory_path());
    const std::filesystem::path source = folder.path() / "loops.cpp";
    write_text_file(source, loops);
    for (const EmbeddedHeader& header : embedded_headers()) {
      write_text_file(folder.path() / header.path, header.text);
    }
    const std::filesystem::path file = folder.path() / "loops.so";
    compile_shared_library(find_compiler(), {source}, folder.path(), file,
                           folder.path() / "compile.log");
    library_ = SharedLibrary(file);
    in_double = library_.function<void (*)(long, double*)>("elastogen_multiply_add_f64");
    in_single = library_.function<void (*)(long, float*)>("elastogen_multiply_add_f32");
    triad = library_.function<void (*)(std::size_t, double*, const double*, const double*)>(
        "elastogen_triad");
    vector_bytes = library_.function<int (*)()>("elastogen_vector_bytes")();
  }

  void (*in_double)(long, double*) = nullptr;
  void (*in_single)(long, float*) = nullptr;
  void (*triad)(std::size_t, double*, const double*, const double*) = nullptr;
  int vector_bytes = 0;

 private:
  SharedLibrary library_;
};

/// Calls `function(thread)` in each thread.
template <class Function>
void in_threads(int threads, Function&& function) {
  if (threads == 1) {
    function(0);
    return;
  }
#pragma omp parallel num_threads(threads)
  function(omp_get_thread_num());
}

template <class Scalar>
PeakFlops measure_peak(void (*loop)(long, Scalar*), int vector_bytes, int threads) {
  std::vector<AlignedVector<Scalar>> out(static_cast<std::size_t>(threads),
                                         AlignedVector<Scalar>(64 / sizeof(Scalar)));
  const Timing time = time_calls(threads, seconds_per_figure, [&] {
    in_threads(threads,
               [&](int thread) { loop(peak_steps, out[static_cast<std::size_t>(thread)].data()); });
  });
  const double flops = flops_per_lane * vector_bytes / sizeof(Scalar) * threads;
  return {sizeof(Scalar) == 4, threads, 1e-9 * flops / time.minimum};
}

TriadBandwidth measure_triad(const Loops& loop, std::size_t bytes, int threads) {
  const std::size_t count = bytes / 24 / static_cast<std::size_t>(threads);
  std::vector<AlignedVector<double>> arrays(3 * static_cast<std::size_t>(threads));
  // Each thread touches its pages first.
  in_threads(threads, [&](int thread) {
    for (std::size_t k = 0; k < 3; ++k) {
      arrays[3 * static_cast<std::size_t>(thread) + k].assign(count, 1.0);
    }
  });
  const long repeat = std::max(1L, static_cast<long>(2e6 / static_cast<double>(bytes)));
  const Timing time = time_calls(threads, seconds_per_figure, [&] {
    in_threads(threads, [&](int thread) {
      AlignedVector<double>* a = &arrays[3 * static_cast<std::size_t>(thread)];
      for (long k = 0; k < repeat; ++k) loop.triad(count, a[0].data(), a[1].data(), a[2].data());
    });
  });
  const double moved = 24.0 * static_cast<double>(count) * threads * static_cast<double>(repeat);
  return {bytes, threads, 1e-9 * moved / time.minimum};
}

}  // namespace

double MachineLimits::peak(bool single_precision, int threads) const {
  for (const PeakFlops& peak : peaks) {
    if (peak.single_precision == single_precision && peak.threads == threads) return peak.gigaflops;
  }
  throw InternalError(fmt::format("no peak was measured in {} threads", threads));
}

double MachineLimits::bandwidth(double bytes, int threads) const {
  const TriadBandwidth* best = nullptr;
  for (const TriadBandwidth& triad : triads) {
    if (triad.threads != threads) continue;
    if (best == nullptr || static_cast<double>(triad.bytes) <= bytes) best = &triad;
  }
  if (best == nullptr) {
    throw InternalError(fmt::format("no bandwidth was measured in {} threads", threads));
  }
  return best->gigabytes_per_second;
}

MachineLimits measure_limits(int threads, const std::function<void(const std::string&)>& tell) {
  const Loops loop;
  MachineLimits limits;
  constexpr std::size_t KiB = 1024, MiB = 1024 * KiB;
  for (const int t : threads == 1 ? std::vector<int>{1} : std::vector<int>{1, threads}) {
    tell(fmt::format("measuring the machine's limits, {} {}", t, t == 1 ? "thread" : "threads"));
    limits.peaks.push_back(measure_peak(loop.in_double, loop.vector_bytes, t));
    limits.peaks.push_back(measure_peak(loop.in_single, loop.vector_bytes, t));
    for (const std::size_t bytes : {24 * KiB, 384 * KiB, 3 * MiB, 24 * MiB, 96 * MiB, 768 * MiB}) {
      limits.triads.push_back(measure_triad(loop, bytes, t));
    }
  }
  return limits;
}

}  // namespace elastogen::selector
