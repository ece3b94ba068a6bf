#include "symgen/mechanics/stress_graph.h"

#include <unordered_map>
#include <utility>

#include "symgen/dag/lower.h"
#include "symgen/mechanics/density_graph.h"
#include "symgen/mechanics/element_graph.h"

namespace elastogen::symgen {
namespace {

class Builder {
 public:
  Builder(const Law& law, const Element& element, const Quadrature& quadrature, Geometry geometry,
          const StressOptions& options, std::shared_ptr<NumberPool> numbers)
      : dim_(element.dim),
        shape_(element, quadrature, geometry),
        density_(build_stress_density(law, energy_density(law, 3, options.energy),
                                      options.derivation, numbers)) {
    graph_.dag = Dag(std::move(numbers));
    for (const Parameter& parameter : law.parameters) {
      graph_.parameters.push_back(graph_.dag.symbol(parameter.name, Stage::material));
    }
  }

  void add_points(const Element& element, const Quadrature& quadrature) {
    Dag& dag = graph_.dag;
    graph_.positions = nodal_inputs(dag, "X", element, Stage::rest);
    graph_.displacement = nodal_inputs(dag, "U", element, Stage::state);
    for (int g = 0; g < quadrature.num_points(); ++g) {
      add_point(shape_.jacobian(dag, graph_.positions, g),
                shape_.gradients().of(dag, graph_.displacement, g),
                dag.number(exact_value(quadrature.weights[g], {})));
    }
  }

  void add_point_alone() {
    Dag& dag = graph_.dag;
    const NodeMatrix jacobian = gradient_inputs(dag, "X", dim_, Stage::rest);
    const NodeMatrix gradient = gradient_inputs(dag, "U", dim_, Stage::state);
    append(graph_.positions, jacobian);
    append(graph_.displacement, gradient);
    graph_.weight = {dag.symbol("w", Stage::rest)};
    add_point(shape_.jacobian_of(dag, jacobian), gradient, graph_.weight[0]);
  }

  StressGraph take() { return std::move(graph_); }

 private:
  /// @param gradient  of the displacement in reference coordinates
  /// @param volume    of the reference shape that the point stands for
  void add_point(const NodeMatrix& jacobian, const NodeMatrix& gradient, NodeId volume) {
    Dag& dag = graph_.dag;
    const NodeMatrix in_plane = matrix_product(dag, gradient, shape_.inverse(dag, jacobian));
    std::vector<NodeId>& numbers = graph_.points.emplace_back(9, dag.number(NumberPool::zero));
    for (int i = 0; i < dim_; ++i) {
      for (int j = 0; j < dim_; ++j) numbers[i * 3 + j] = in_plane[i][j];
    }
    std::unordered_map<NodeId, NodeId> images;
    for (std::size_t c = 0; c < numbers.size(); ++c) images[density_.gradient[c]] = numbers[c];
    for (std::size_t p = 0; p < graph_.parameters.size(); ++p) {
      images[density_.parameters[p]] = graph_.parameters[p];
    }
    std::vector<NodeId> roots = density_.stress;
    roots.push_back(density_.value);
    roots.push_back(density_.energy);
    std::vector<NodeId> of_point = substitute_into(dag, density_.dag, roots, images);
    graph_.margins.push_back(domain_of(dag, of_point.back()));
    of_point.back() = dag.multiply(volume, determinant_of(dag, jacobian));
    numbers.insert(numbers.end(), of_point.begin(), of_point.end());
  }

  int dim_;
  RestShape shape_;
  DensityGraph density_;
  StressGraph graph_;
};

}  // namespace

StressGraph build_stress_graph(const Law& law, const Element& element, const Quadrature& quadrature,
                               Geometry geometry, const StressOptions& options,
                               std::shared_ptr<NumberPool> numbers) {
  Builder builder(law, element, quadrature, geometry, options, std::move(numbers));
  builder.add_points(element, quadrature);
  return builder.take();
}

StressGraph build_pointwise_stress_graph(const Law& law, const Element& element,
                                         const Quadrature& quadrature, Geometry geometry,
                                         const StressOptions& options,
                                         std::shared_ptr<NumberPool> numbers) {
  Builder builder(law, element, quadrature, geometry, options, std::move(numbers));
  builder.add_point_alone();
  return builder.take();
}

}  // namespace elastogen::symgen
