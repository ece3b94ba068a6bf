#include <fmt/format.h>

#include <algorithm>
#include <fstream>

#include "selector/bench/speed/operator_speed.h"
#include "selector/bench/speed/speed_mesh.h"

namespace elastogen::selector {
namespace {

using Add = std::function<void(const SpeedRecord&)>;

std::vector<std::size_t> usual_sizes(const std::string& element) {
  if (symgen::find_element(element).num_nodes() <= 4) {
    return {1000, 10000, 100000, 1000000, 10000000};
  }
  return {1000, 10000, 100000, 1000000};
}

/// Bytes of memory that programs may still take; the system's own figure.
double available_bytes() {
  std::ifstream file("/proc/meminfo");
  double kibibytes = 0;
  for (std::string word; file >> word;) {
    if (word == "MemAvailable:" && file >> kibibytes) break;
  }
  return 1024 * kibibytes;
}

/// Of meshes in three orders, and a model whose elements each have constants of their own.
double needed_bytes(const AssociationKernels& kernels, std::size_t elements) {
  const KernelTable<double>& table = kernels.in_double.table<double>();
  const double mesh = 4.0 * table.num_nodes + 4 + 8.0 * table.dim;
  const double model = 8.0 * table.variants[0].num_constants + 4.0 * table.num_nodes + 8;
  return static_cast<double>(elements) * (3 * mesh + 2 * model);
}

void measure_mesh(const AssociationKernels& kernels, const std::string& shape, std::size_t size,
                  const SpeedOptions& options, const MachineLimits& limits, const Add& add) {
  const Mesh natural = make_speed_mesh(kernels.id, size, shape == "distorted");
  SpeedRecord record = record_on_mesh("scaling", kernels, natural, shape);
  for (const std::string& order : options.orders) {
    const Mesh mesh = order == "natural" ? natural : shuffled(natural);
    for (const int threads : options.threads) {
      options.tell(fmt::format("{} on {} {} elements in {} order, {} {}", record.association,
                               record.elements, shape, order, threads,
                               threads == 1 ? "thread" : "threads"));
      record.order = order;
      record.threads = threads;
      OperatorSpeed speed(kernels, mesh, record, options, limits, add);
      speed.measure_forces();
      for (const std::string& strategy : options.strategies) speed.measure_products(strategy);
      if (options.interrupted()) return;
    }
  }
}

}  // namespace

void measure_scaling(const SpeedOptions& options, const MachineLimits& limits, const Add& add) {
  for (const symgen::AssociationId& id : options.associations) {
    const AssociationKernels kernels = load_kernels(id, options);
    for (const std::string& shape : options.meshes) {
      for (const std::size_t size :
           options.elements.empty() ? usual_sizes(id.element) : options.elements) {
        const double needed = needed_bytes(kernels, size);
        const double available = available_bytes();
        if (needed > 0.8 * available) {
          options.tell(
              fmt::format("{} elements are left out: they would take {:.1f} GB, and "
                          "{:.1f} GB are free",
                          size, 1e-9 * needed, 1e-9 * available));
          continue;
        }
        measure_mesh(kernels, shape, size, options, limits, add);
        if (options.interrupted()) return;
      }
    }
  }
}

}  // namespace elastogen::selector
