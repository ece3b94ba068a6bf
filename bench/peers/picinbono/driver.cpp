// Measures the mass-tensor method on tetrahedra, one after the other and as lanes.
#include <algorithm>
#include <type_traits>

#include "bench/peers/lanes.h"
#include "bench/peers/peer_driver.h"
#include "sums.h"

namespace elastogen::peers {
namespace {

constexpr int num_nodes = 4;
constexpr int node_order[num_nodes] = {0, 1, 2, 3};

/// Forces and products over the whole mesh of a problem, whose last batch is full.
template <template <class> class Tensors, class Number>
class Passes {
 public:
  explicit Passes(const Problem& problem)
      : problem_(problem), nodes_(batch_nodes(problem, lanes, node_order)) {
    tensors_.resize(nodes_.size() / per_batch);
    const std::size_t num_elements = problem.connectivity.size() / num_nodes;
    for (std::size_t element = 0; element < num_elements; ++element) store_tensors(element);
  }

  void forces(std::vector<double>& sum) const {
    run(sum, [this](const Tensors<Number>& tensors, const std::int32_t* nodes, auto& result) {
      VertexVectors<Number> u;
      gather<num_nodes>(problem_.displacement.data(), nodes, u[0]);
      add_forces(tensors, u, result);
    });
  }

  void product(std::vector<double>& sum) const {
    run(sum, [this](const Tensors<Number>& tensors, const std::int32_t* nodes, auto& result) {
      VertexVectors<Number> v;
      gather<num_nodes>(problem_.direction.data(), nodes, v[0]);
      if constexpr (is_linear) {
        add_forces(tensors, v, result);
      } else {
        VertexVectors<Number> u;
        gather<num_nodes>(problem_.displacement.data(), nodes, u[0]);
        add_product(tensors, u, v, result);
      }
    });
  }

 private:
  static constexpr int lanes = num_lanes<Number>;
  static constexpr std::size_t per_batch = num_nodes * lanes;
  static constexpr bool is_linear = std::is_same_v<Tensors<Number>, HookeTensors<Number>>;

  void store_tensors(std::size_t element) {
    const double* vertices[num_nodes];
    for (int j = 0; j < num_nodes; ++j) {
      vertices[j] = &problem_.positions[3 * problem_.connectivity[num_nodes * element + j]];
    }
    Tensors<double> tensors;
    make_tensors(measure_tetrahedron(vertices), problem_.lambda, problem_.mu, tensors);
    constexpr std::size_t count = sizeof tensors / sizeof(double);
    const auto* from = reinterpret_cast<const double*>(&tensors);
    auto* to = reinterpret_cast<double*>(&tensors_[element / lanes]) + element % lanes;
    for (std::size_t k = 0; k < count; ++k) to[k * lanes] = from[k];
  }

  /// Asks for tensors while those before them are worked on: a pass reads more of them than
  /// processors foresee.
  static void prefetch(const Tensors<Number>* tensors) {
    constexpr int line = 64;
    const auto* bytes = reinterpret_cast<const char*>(tensors);
    for (std::size_t begin = 0; begin < sizeof *tensors; begin += line) {
      __builtin_prefetch(bytes + begin);
    }
  }

  template <class Kernel>
  void run(std::vector<double>& sum, Kernel kernel) const {
    std::fill(sum.begin(), sum.end(), 0.0);
    for (std::size_t batch = 0; batch < tensors_.size(); ++batch) {
      const std::int32_t* nodes = nodes_.data() + batch * per_batch;
      prefetch(&tensors_[batch] + 1);
      VertexVectors<Number> result = {};
      kernel(tensors_[batch], nodes, result);
      scatter_add<num_nodes>(1, result[0], nodes, sum.data());
    }
  }

  const Problem& problem_;
  std::vector<std::int32_t> nodes_;
  std::vector<Tensors<Number>> tensors_;  // [batch][tensor][lane]
};

template <template <class> class Tensors, class Number>
void measure_variant(const Problem& problem, const char* variant) {
  const Passes<Tensors, Number> passes(problem);
  std::vector<double> sum(problem.positions.size());
  measure(problem, variant, "forces", sum, [&] { passes.forces(sum); });
  measure(problem, variant, "product", sum, [&] { passes.product(sum); });
}

template <template <class> class Tensors>
void measure_law(const Problem& problem) {
  std::printf("# %zu bytes stored per element; vectors of %d elements\n", sizeof(Tensors<double>),
              num_lanes<Lanes>);
  measure_variant<Tensors, double>(problem, "scalar");
  measure_variant<Tensors, Lanes>(problem, "vectors");
}

void measure_all(Problem problem) {
  fill_last_batch(problem, num_nodes, num_lanes<Lanes>);
  if (problem.law == "hooke") {
    measure_law<HookeTensors>(problem);
  } else {
    measure_law<StvkTensors>(problem);
  }
}

}  // namespace
}  // namespace elastogen::peers

int main(int argc, char** argv) {
  return elastogen::peers::run_driver(argc, argv, elastogen::peers::measure_all);
}
