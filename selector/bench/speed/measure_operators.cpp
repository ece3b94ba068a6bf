#include <fmt/format.h>

#include "selector/bench/speed/association_kernels.h"
#include "selector/bench/speed/operator_speed.h"
#include "selector/bench/speed/speed_mesh.h"

namespace elastogen::selector {
namespace {

using Add = std::function<void(const SpeedRecord&)>;

/// As in the tables of published figures: in cache, about at its end, and in memory.
std::vector<std::size_t> usual_sizes(const std::string& element) {
  const int num_nodes = symgen::find_element(element).num_nodes();
  if (num_nodes <= 4) return {10000, 100000, 1000000};
  if (num_nodes <= 8) return {20000, 100000, 200000};
  return {2000, 20000, 50000};
}

/// Bytes that a matrix of all element pairs takes with its pattern, at most.
double matrix_bytes(const Mesh& mesh) {
  double bytes = 0;
  for (const ElementBlock& block : mesh.blocks) {
    const double n = block.nodes_per_element;
    bytes += static_cast<double>(block.num_elements()) * n * n * (4 + 12.0 * mesh.dim * mesh.dim);
  }
  return bytes;
}

void measure_mesh(const AssociationKernels& kernels, const std::string& shape, std::size_t size,
                  const SpeedOptions& options, const MachineLimits& limits, const Add& add) {
  const Mesh mesh = make_speed_mesh(kernels.id, size, shape == "distorted");
  options.tell(fmt::format("{} on {} {} elements", kernels.id.text(), mesh.num_elements(), shape));
  for (const std::string& precision : options.precisions) {
    for (const int threads : options.threads) {
      SpeedRecord record = record_on_mesh("operators", kernels, mesh, shape);
      record.precision = precision;
      record.threads = threads;
      OperatorSpeed speed(kernels, mesh, record, options, limits, add);
      speed.measure_forces();
      speed.measure_energy();
      for (const std::string& strategy : options.strategies) {
        if (options.interrupted()) return;
        if (strategy == "assembled" &&
            matrix_bytes(mesh) > static_cast<double>(options.most_bytes)) {
          options.tell(
              fmt::format("the assembled matrix of {} elements is left out: it may take "
                          "{:.1f} GB",
                          mesh.num_elements(), 1e-9 * matrix_bytes(mesh)));
          continue;
        }
        speed.measure_products(strategy);
      }
    }
  }
}

}  // namespace

void measure_operators(const SpeedOptions& options, const MachineLimits& limits, const Add& add) {
  for (const symgen::AssociationId& id : options.associations) {
    const AssociationKernels kernels = load_kernels(id, options);
    for (const std::string& shape : options.meshes) {
      for (const std::size_t size :
           options.elements.empty() ? usual_sizes(id.element) : options.elements) {
        measure_mesh(kernels, shape, size, options, limits, add);
        if (options.interrupted()) return;
      }
    }
  }
}

}  // namespace elastogen::selector
