// Measures FFCx's code of one law on one element, as it is and on lanes; forms.py generated it.
#include <algorithm>
#include <initializer_list>

#include "bench/peers/lanes.h"
#include "bench/peers/peer_driver.h"
#include "kernels.h"

using elastogen::peers::Lanes;

extern "C" {
void tabulate_forces(double* vector, const double* coefficients, const double* constants,
                     const double* positions, const int*, const std::uint8_t*);
void tabulate_product(double* vector, const double* coefficients, const double* constants,
                      const double* positions, const int*, const std::uint8_t*);
}
void tabulate_forces(Lanes* vector, const Lanes* coefficients, const Lanes* constants,
                     const Lanes* positions, const int*, const std::uint8_t*);
void tabulate_product(Lanes* vector, const Lanes* coefficients, const Lanes* constants,
                      const Lanes* positions, const int*, const std::uint8_t*);

namespace elastogen::peers {
namespace {

/// Forces and products over the whole mesh of a problem, whose last batch is full.
template <class Number>
class Passes {
 public:
  explicit Passes(const Problem& problem)
      : problem_(problem),
        nodes_(batch_nodes(problem, num_lanes<Number>, vtk_nodes)),
        constants_{Number{} + problem.lambda, Number{} + problem.mu} {}

  void forces(std::vector<double>& sum) const {
    const auto kernel = [](auto... arguments) { tabulate_forces(arguments...); };
    run(kernel, {&problem_.displacement}, sum);
  }

  void product(std::vector<double>& sum) const {
    const auto kernel = [](auto... arguments) { tabulate_product(arguments...); };
    if constexpr (product_depends_on_displacement) {
      run(kernel, {&problem_.displacement, &problem_.direction}, sum);
    } else {
      run(kernel, {&problem_.direction}, sum);
    }
  }

 private:
  using Vectors = std::initializer_list<const std::vector<double>*>;
  static constexpr int num_values = 3 * num_nodes;

  /// Sums what `kernel` makes of each element, with the sign of forces.
  template <class Kernel>
  void run(Kernel kernel, Vectors coefficients, std::vector<double>& sum) const {
    std::fill(sum.begin(), sum.end(), 0.0);
    constexpr std::size_t per_batch = num_nodes * num_lanes<Number>;
    for (std::size_t begin = 0; begin < nodes_.size(); begin += per_batch) {
      const std::int32_t* nodes = nodes_.data() + begin;
      Number positions[num_values], values[2 * num_values], result[num_values] = {};
      gather<num_nodes>(problem_.positions.data(), nodes, positions);
      Number* next = values;
      for (const std::vector<double>* vector : coefficients) {
        gather<num_nodes>(vector->data(), nodes, next);
        next += num_values;
      }
      kernel(result, values, constants_, positions, nullptr, nullptr);
      scatter_add<num_nodes>(-1, result, nodes, sum.data());
    }
  }

  const Problem& problem_;
  std::vector<std::int32_t> nodes_;
  Number constants_[2];
};

template <class Number>
void measure_variant(const Problem& problem, const char* variant) {
  const Passes<Number> passes(problem);
  std::vector<double> sum(problem.positions.size());
  measure(problem, variant, "forces", sum, [&] { passes.forces(sum); });
  measure(problem, variant, "product", sum, [&] { passes.product(sum); });
}

void measure_all(Problem problem) {
  std::printf("# FFCx %s, scalar code by %s, vectors of %d elements\n", ffcx_version,
              SCALAR_COMPILER, num_lanes<Lanes>);
  fill_last_batch(problem, num_nodes, num_lanes<Lanes>);
  measure_variant<double>(problem, SCALAR_COMPILER);
  measure_variant<Lanes>(problem, "vectors");
}

}  // namespace
}  // namespace elastogen::peers

int main(int argc, char** argv) {
  return elastogen::peers::run_driver(argc, argv, elastogen::peers::measure_all);
}
