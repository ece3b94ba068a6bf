#include "symgen/mechanics/element_graph.h"

#include <algorithm>
#include <optional>
#include <utility>

#include "runtime/error.h"
#include "symgen/dag/differentiate.h"
#include "symgen/dag/lower.h"
#include "symgen/mechanics/reference_gradients.h"

namespace elastogen::symgen {
namespace {

/// Builds the parts of the graph that belong to one quadrature point after the other.
class Builder {
 public:
  Builder(const Element& element, const Quadrature& quadrature, Geometry geometry)
      : element_(element),
        quadrature_(quadrature),
        geometry_(geometry),
        shape_(element, quadrature, geometry) {}

  void add_inputs(const Law& law) {
    add_parameters(law);
    add_fields();
  }

  void add_fields() {
    graph_.positions = nodal_inputs(graph_.dag, "X", element_, Stage::rest);
    graph_.displacement = nodal_inputs(graph_.dag, "U", element_, Stage::state);
    graph_.direction = nodal_inputs(graph_.dag, "V", element_, Stage::direction);
  }

  void add_energies(const Law& law, const EnergyDensity& energy, Derivation derivation) {
    std::optional<GinacDerivatives> by_ginac;
    if (derivation == Derivation::ginac) {
      by_ginac.emplace(law, energy, element_.num_nodes(), shape_.gradients().differences(),
                       graph_.dag.number_pool());
      graph_.derivatives.resize(energy.terms.size());
    }
    for (int g = 0; g < quadrature_.num_points(); ++g) {
      const NodeMatrix jacobian = jacobian_at(g);
      const NodeMatrix inverse = add_jacobian(jacobian);
      const NodeMatrix gradient = shape_.gradients().of(graph_.dag, graph_.displacement, g);
      const ExactNumber weight = exact_value(quadrature_.weights[g], {});
      add_point(law, energy, inverse, gradient, weight);
      if (!by_ginac) continue;
      const PointValues values{
          graph_.parameters,
          graph_.displacement,
          graph_.direction,
          shape_.gradients().coefficients(graph_.dag, g),
          inverse,
          graph_.dag.scale(graph_.dag.numbers().intern(weight), graph_.determinants.back())};
      for (std::size_t l = 0; l < energy.terms.size(); ++l) {
        graph_.derivatives[l].push_back(by_ginac->at_point(graph_.dag, l, values));
      }
    }
  }

  void add_volumes() {
    const Quadrature& rule = richest_quadrature(element_.name);
    Builder rich(element_, rule, geometry_);
    rich.graph_.dag = std::move(graph_.dag);
    rich.graph_.positions = graph_.positions;
    Dag& dag = rich.graph_.dag;
    NumberPool& numbers = dag.numbers();
    const auto num_nodes = static_cast<std::size_t>(element_.num_nodes());
    std::vector<std::vector<Operand>> terms(num_nodes), squares(num_nodes);
    std::vector<ExactNumber> reference_volumes(num_nodes);
    for (int g = 0; g < rule.num_points(); ++g) {
      const NodeId determinant = determinant_of_point(rich, g);
      std::map<GiNaC::ex, ExactNumber, GiNaC::ex_is_less> values;
      for (int k = 0; k < element_.dim; ++k) {
        values[element_.coordinates[k]] = exact_value(rule.points[g][k], {});
      }
      const ExactNumber weight = exact_value(rule.weights[g], {});
      for (std::size_t a = 0; a < num_nodes; ++a) {
        const ExactNumber shape = exact_value(element_.shape_functions[a], values);
        terms[a].push_back({determinant, numbers.intern(weight * shape)});
        squares[a].push_back({determinant, numbers.intern(weight * shape * shape)});
        reference_volumes[a] = reference_volumes[a] + weight * shape;
      }
    }
    for (std::vector<Operand>& sum : terms) graph_.nodal_volumes.push_back(dag.sum(std::move(sum)));
    const bool all_positive = std::all_of(reference_volumes.begin(), reference_volumes.end(),
                                          [](const ExactNumber& v) { return v.to_double() > 0; });
    graph_.lumped_volumes =
        all_positive ? graph_.nodal_volumes : scaled_diagonal(dag, std::move(squares));
    graph_.dag = std::move(rich.graph_.dag);
  }

  /// The energy at any one point, of the gradients in reference coordinates of position,
  /// displacement and direction there, which are its inputs; without the point's weight.
  void add_point_alone(const Law& law, const EnergyDensity& energy) {
    add_parameters(law);
    const auto inputs = [&](const char* field, Stage stage) {
      return gradient_inputs(graph_.dag, field, element_.dim, stage);
    };
    const NodeMatrix jacobian = inputs("X", Stage::rest);
    const NodeMatrix gradient = inputs("U", Stage::state);
    append(graph_.positions, jacobian);
    append(graph_.displacement, gradient);
    append(graph_.direction, inputs("V", Stage::direction));
    add_point(law, energy, add_jacobian(shape_.jacobian_of(graph_.dag, jacobian)), gradient,
              ExactNumber(cln::cl_RA(1)));
  }

  /// d X_i / d xi_k, as [i * dim + k]: at each point after the other, or once where they are the
  /// same everywhere.
  std::vector<NodeId> jacobians() {
    std::vector<NodeId> entries;
    const int num_different = geometry_ == Geometry::general ? quadrature_.num_points() : 1;
    for (int g = 0; g < num_different; ++g) {
      append(entries, jacobian_at(g));
    }
    return entries;
  }

  /// The Jacobian's determinant at each point, where no energies have asked for it.
  void add_determinants() {
    for (int g = 0; g < quadrature_.num_points(); ++g) {
      graph_.determinants.push_back(determinant_of(graph_.dag, jacobian_at(g)));
    }
  }

  /// d U_i / d xi_k at each point, as [(g * dim + i) * dim + k].
  std::vector<NodeId> displacement_gradients() {
    std::vector<NodeId> entries;
    for (int g = 0; g < quadrature_.num_points(); ++g) {
      append(entries, shape_.gradients().of(graph_.dag, graph_.displacement, g));
    }
    return entries;
  }

  /// Before anything is added: the graph takes the pool of another's.
  void share_numbers(const Builder& other) { graph_.dag = Dag(other.graph_.dag.number_pool()); }

  ElementGraph take() { return std::move(graph_); }

 private:
  void add_parameters(const Law& law) {
    for (const Parameter& parameter : law.parameters) {
      graph_.parameters.push_back(graph_.dag.symbol(parameter.name, Stage::material));
    }
  }

  /// Takes the determinant to the graph's; returns the inverse.
  NodeMatrix add_jacobian(const NodeMatrix& jacobian) {
    graph_.determinants.push_back(determinant_of(graph_.dag, jacobian));
    return shape_.inverse(graph_.dag, jacobian);
  }

  /// Energies at the point of the last determinant.
  /// @param gradient  of the displacement, in reference coordinates
  void add_point(const Law& law, const EnergyDensity& energy, const NodeMatrix& inverse_jacobian,
                 const NodeMatrix& gradient, const ExactNumber& exact_weight) {
    const NodeId determinant = graph_.determinants.back();
    const NodeMatrix displacement_gradient = matrix_product(graph_.dag, gradient, inverse_jacobian);
    SymbolNodes symbols;
    for (std::size_t p = 0; p < law.parameters.size(); ++p) {
      symbols[law.parameters[p].symbol] = graph_.parameters[p];
    }
    for (int i = 0; i < element_.dim; ++i) {
      for (int j = 0; j < element_.dim; ++j) {
        symbols[energy.gradient[i * element_.dim + j]] = displacement_gradient[i][j];
      }
    }
    for (const Definition& definition : energy.definitions) {
      symbols[definition.symbol] = lower(graph_.dag, definition.value, symbols);
    }
    const NumberId weight = graph_.dag.numbers().intern(exact_weight);
    graph_.energies.resize(energy.terms.size());
    graph_.energy_values.resize(energy.terms.size());
    for (std::size_t l = 0; l < energy.terms.size(); ++l) {
      graph_.energies[l].push_back(
          weighted(lower(graph_.dag, energy.terms[l], symbols), determinant, weight));
      graph_.energy_values[l].push_back(
          weighted(lower(graph_.dag, energy.values[l], symbols), determinant, weight));
    }
  }

  /// The volume, shared out in proportion to the sums.
  std::vector<NodeId> scaled_diagonal(Dag& dag, std::vector<std::vector<Operand>> sums) const {
    std::vector<NodeId> shares;
    std::vector<Operand> volume, total;
    for (std::vector<Operand>& sum : sums) {
      shares.push_back(dag.sum(std::move(sum)));
      total.push_back({shares.back(), NumberPool::one});
    }
    for (const NodeId nodal : graph_.nodal_volumes) volume.push_back({nodal, NumberPool::one});
    const NodeId scale =
        dag.multiply(dag.sum(std::move(volume)), dag.inverse(dag.sum(std::move(total))));
    for (NodeId& share : shares) share = dag.multiply(scale, share);
    return shares;
  }

  static NodeId determinant_of_point(Builder& builder, int g) {
    return determinant_of(builder.graph_.dag, builder.jacobian_at(g));
  }

  NodeMatrix jacobian_at(int g) { return shape_.jacobian(graph_.dag, graph_.positions, g); }

  /// weight * determinant * density, the determinant joining the parameters of each summand: they
  /// make one grouped constant.
  NodeId weighted(NodeId density, NodeId determinant, NumberId weight) {
    Dag& dag = graph_.dag;
    const auto times_determinant = [&](NodeId summand) {
      const Node node = dag[summand];
      std::vector<Operand> factors = node.operands;
      if (node.kind != Kind::product) factors = {{summand, NumberPool::one}};
      factors.push_back({determinant, NumberPool::one});
      return dag.product(std::move(factors));
    };
    const Node node = dag[density];
    if (node.kind != Kind::sum) return dag.scale(weight, times_determinant(density));
    std::vector<Operand> terms;
    if (node.value != NumberPool::zero) {
      terms.push_back({determinant, dag.numbers().multiply(node.value, weight)});
    }
    for (const Operand& operand : node.operands) {
      terms.push_back(
          {times_determinant(operand.node), dag.numbers().multiply(operand.factor, weight)});
    }
    return dag.sum(std::move(terms));
  }

  const Element& element_;
  const Quadrature& quadrature_;
  Geometry geometry_;
  RestShape shape_;
  ElementGraph graph_;
};

}  // namespace

ElementGraph build_element_graph(const Law& law, const EnergyDensity& energy,
                                 const Element& element, const Quadrature& quadrature,
                                 Geometry geometry, Derivation derivation) {
  Builder builder(element, quadrature, geometry);
  builder.add_inputs(law);
  builder.add_energies(law, energy, derivation);
  builder.add_volumes();
  return builder.take();
}

PointwiseGraph build_pointwise_graph(const Law& law, const EnergyDensity& energy,
                                     const Element& element, const Quadrature& quadrature,
                                     Geometry geometry) {
  Builder point(element, quadrature, geometry);
  point.add_point_alone(law, energy);
  Builder whole(element, quadrature, geometry);
  whole.share_numbers(point);
  whole.add_fields();
  whole.add_determinants();
  whole.add_volumes();
  PointwiseGraph result;
  result.is_affine = geometry != Geometry::general;
  result.jacobians = whole.jacobians();
  result.gradients = whole.displacement_gradients();
  result.whole = whole.take();
  result.point = point.take();
  for (const GiNaC::ex& weight : quadrature.weights) {
    result.weights.push_back(result.whole.dag.numbers().intern(exact_value(weight, {})));
  }
  return result;
}

std::vector<std::string> names_of(const Dag& dag, const std::vector<NodeId>& inputs) {
  std::vector<std::string> names;
  for (const NodeId input : inputs) names.push_back(dag.symbol_name(input));
  return names;
}

std::vector<NodeId> domain_of(Dag& dag, NodeId energy) {
  const std::vector<bool> needed = dag.reachable(std::vector<NodeId>{energy});
  std::vector<NodeId> margins;
  const auto add = [&](NodeId margin) {
    const bool is_new = std::find(margins.begin(), margins.end(), margin) == margins.end();
    if (is_new && dag[margin].stage >= Stage::state) margins.push_back(margin);
  };
  for (std::size_t i = 0; i < needed.size(); ++i) {
    if (!needed[i]) continue;
    const Node node = dag[static_cast<NodeId>(i)];  // a copy: the graph grows below
    if (node.kind == Kind::function && node.function == Function::log) {
      add(node.operands[0].node);
    } else if (node.kind == Kind::function &&
               (node.function == Function::log1p || node.function == Function::log1p_remainder)) {
      add(dag.sum({node.operands[0]}, NumberPool::one));
    } else if (node.kind == Kind::product) {
      for (const Operand& operand : node.operands) {
        if (exponent_of(dag.numbers(), operand.factor).denominator != 1) add(operand.node);
      }
    }
  }
  return margins;
}

std::vector<NodeId> forces_of(ElementGraph& graph, NodeId energy) {
  std::vector<NodeId> forces = gradient(graph.dag, energy, graph.displacement);
  for (NodeId& force : forces) force = graph.dag.scale(NumberPool::minus_one, force);
  return forces;
}

std::vector<NodeId> product_of(ElementGraph& graph, const std::vector<NodeId>& forces) {
  std::unordered_map<NodeId, NodeId> direction_of;
  for (std::size_t k = 0; k < graph.displacement.size(); ++k) {
    direction_of[graph.displacement[k]] = graph.direction[k];
  }
  return directional_derivative(graph.dag, forces, direction_of);
}

}  // namespace elastogen::symgen
