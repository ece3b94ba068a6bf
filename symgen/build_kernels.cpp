#include "symgen/build_kernels.h"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>
#include <unordered_map>
#include <utility>

#include "runtime/error.h"
#include "symgen/dag/differentiate.h"
#include "symgen/mechanics/reference_gradients.h"
#include "symgen/passes/absorb_factor.h"
#include "symgen/passes/cost.h"
#include "symgen/passes/extract_grouped_constants.h"
#include "symgen/passes/factor.h"
#include "symgen/passes/group_stages.h"
#include "symgen/passes/share_pairs.h"
#include "symgen/passes/simplify.h"

namespace elastogen::symgen {
namespace {

std::vector<int> counting(std::size_t count) {
  std::vector<int> indices(count);
  std::iota(indices.begin(), indices.end(), 0);
  return indices;
}

template <class Value>
std::vector<Value> selected(const std::vector<Value>& values, const std::vector<int>& indices) {
  std::vector<Value> result;
  for (const int index : indices) result.push_back(values[index]);
  return result;
}

/// Values and derivatives of one energy part, in a graph of their own.
struct PartGraph {
  Dag dag;
  NodeId energy;
  std::vector<NodeId> forces, product, margins;
};

/// @param energies  [law term][Gauss point]
NodeId sum_of(ElementGraph& element, const std::vector<std::vector<NodeId>>& energies,
              const EnergyPart& part) {
  std::vector<Operand> summands;
  for (const auto& [term, point] : part.summands) {
    summands.push_back({energies[term][point], NumberPool::one});
  }
  return element.dag.sum(std::move(summands));
}

/// The product is the derivative of the factored forces: it inherits their factors, which is
/// cheaper than factoring the derivative of flat ones (5 % fewer operations on hexahedra).
NodalDerivatives derived_on_graph(ElementGraph& element, NodeId energy) {
  NodalDerivatives derivatives;
  derivatives.forces = forces_of(element, energy);
  Graph factored{Dag(element.dag.number_pool()), {}};
  factored.roots = copy_into(factored.dag, element.dag, derivatives.forces);
  factored = factor(factored);
  derivatives.product = product_of(element, copy_into(element.dag, factored.dag, factored.roots));
  return derivatives;
}

/// The derivatives that GiNaC took of each energy, added up.
NodalDerivatives derived_by_ginac(ElementGraph& element, const EnergyPart& part) {
  const auto total = [&](std::vector<NodeId> NodalDerivatives::*operation) {
    std::vector<NodeId> sums;
    for (std::size_t row = 0; row < element.displacement.size(); ++row) {
      std::vector<Operand> summands;
      for (const auto& [term, point] : part.summands) {
        const NodeId value = (element.derivatives[term][point].*operation)[row];
        summands.push_back({value, NumberPool::one});
      }
      sums.push_back(element.dag.sum(std::move(summands)));
    }
    return sums;
  };
  return {total(&NodalDerivatives::forces), total(&NodalDerivatives::product)};
}

PartGraph differentiated(ElementGraph& element, const EnergyPart& part) {
  const NodeId energy = sum_of(element, element.energies, part);
  const auto [forces, product] = element.derivatives.empty() ? derived_on_graph(element, energy)
                                                             : derived_by_ginac(element, part);
  PartGraph result{Dag(element.dag.number_pool()), 0, {}, {}, {}};
  const auto copied = [&](const std::vector<NodeId>& roots) {
    return copy_into(result.dag, element.dag, roots);
  };
  result.energy = copied({sum_of(element, element.energy_values, part)})[0];
  result.forces = copied(forces);
  result.product = copied(product);
  result.margins = copied(domain_of(element.dag, energy));
  return result;
}

struct ElementSize {
  explicit ElementSize(const ElementGraph& whole)
      : num_nodes(static_cast<int>(whole.nodal_volumes.size())),
        dim(static_cast<int>(whole.positions.size()) / num_nodes),
        num_points(static_cast<int>(whole.determinants.size())) {}
  int num_nodes, dim, num_points;
};

class Builder {
 public:
  /// @param graph  of an element, or of one point of it
  Builder(ElementGraph graph, const ElementSize& whole, Geometry geometry, const Split& split,
          const Profile& profile, StageLog& log)
      : element_(std::move(graph)), split_(split), profile_(profile), log_(log) {
    kernels_.geometry = geometry;
    kernels_.num_nodes = whole.num_nodes;
    kernels_.dim = whole.dim;
    kernels_.num_points = whole.num_points;
    kernels_.dag = Dag(element_.dag.number_pool());
  }

  /// Derivatives of every energy part, then the passes on every fragment, all in one graph.
  void collect_pieces() {
    const int num_dofs = static_cast<int>(element_.displacement.size());
    const auto parts = energy_parts(split_, static_cast<int>(element_.energies.size()),
                                    static_cast<int>(element_.determinants.size()));
    const auto rows = row_parts(split_, num_dofs / kernels_.dim, kernels_.dim);
    energy_ = {"energy", 1, {}, {}};
    forces_ = {"forces", num_dofs, {}, {}};
    product_ = {"product", num_dofs, {}, {}};
    for (const EnergyPart& part : parts) {
      const PartGraph graph = differentiated(element_, part);
      log_.end("differentiate", graph.dag.size());
      energy_.pieces.push_back(piece(graph.dag, {graph.energy}, {0}, graph.margins));
      std::vector<NodeId> margins = graph.margins;  // one fragment of the rows checks them
      for (const std::vector<int>& fragment_rows : rows) {
        forces_.pieces.push_back(
            piece(graph.dag, selected(graph.forces, fragment_rows), fragment_rows, margins));
        product_.pieces.push_back(
            piece(graph.dag, selected(graph.product, fragment_rows), fragment_rows, margins));
        margins.clear();
      }
    }
    pieces_per_part_ = rows.size();
  }

  /// Volumes of the whole element.
  void collect_geometry(const ElementGraph& whole) {
    std::vector<NodeId> measures = whole.nodal_volumes;
    for (const auto* more : {&whole.lumped_volumes, &whole.determinants}) {
      measures.insert(measures.end(), more->begin(), more->end());
    }
    geometry_ = {"geometry", static_cast<int>(measures.size()), {}, {}};
    Graph graph{Dag(whole.dag.number_pool()), {}};
    graph.roots = copy_into(graph.dag, whole.dag, measures);
    graph = group_stages(graph);
    geometry_.pieces.push_back(
        {copy_into(kernels_.dag, graph.dag, graph.roots), counting(measures.size())});
    node_positions_ = names_of(whole.dag, whole.positions);
  }

  /// The maps between nodes and points. Shared pairs make the integration cheapest where it is the
  /// transpose of the interpolation as that is computed.
  void collect_loop(const PointwiseGraph& graph) {
    PointLoop& loop = kernels_.loop.emplace();
    loop.weights = graph.weights;
    loop.is_affine = graph.is_affine;
    const ElementGraph& whole = graph.whole;
    const auto simplified_copy = [&](const std::vector<NodeId>& roots) {
      Graph copy{Dag(whole.dag.number_pool()), {}};
      copy.roots = copy_into(copy.dag, whole.dag, roots);
      return simplified(std::move(copy), Stage::state, log_);
    };
    const Graph gradients = simplified_copy(graph.gradients);
    loop.interpolate = map_of("interpolate", gradients, names_of(whole.dag, whole.displacement),
                              Slot::displacement, Stage::state);
    std::vector<std::string> fluxes;
    const Graph nodal = transposed(gradients, graph, fluxes);
    loop.integrate = map_of("integrate", nodal, fluxes, Slot::displacement, Stage::state);
    Graph energy{Dag(whole.dag.number_pool()), {}};
    std::vector<Operand> densities;
    std::vector<std::string> density_names;
    for (std::size_t g = 0; g < graph.weights.size(); ++g) {
      density_names.push_back(fmt::format("W{}", g));
      densities.push_back(
          {energy.dag.symbol(density_names.back(), Stage::state), graph.weights[g]});
    }
    energy.roots = {energy.dag.sum(std::move(densities))};
    loop.weigh = map_of("weigh", energy, density_names, Slot::displacement, Stage::state);
    if (graph.is_affine) {
      loop.jacobian = map_of("jacobian", simplified_copy(graph.jacobians), node_positions_,
                             Slot::position, Stage::rest);
    }
    end_stage("interpolate and integrate");
  }

  /// The stages that see the fragments of all operations, which share one graph from here on.
  void choose_what_is_stored(Grouping grouping) {
    end_stage("collect fragments");
    share_what_is_known_at_rest();
    end_stage("share_pairs at rest");
    choose_constants(grouping);
    end_stage("extract_grouped_constants");
    cut_product();
    end_stage("cut the product");
  }

  /// Common pairs of what is known at rest, over all operations together, so that they agree on
  /// what may be stored.
  void share_what_is_known_at_rest() {
    const Dag& dag = kernels_.dag;
    std::vector<bool> read(dag.size(), false);
    for (const auto* operation : {&energy_, &forces_, &product_, &geometry_}) {
      for (const Piece& each : operation->pieces) {
        for (const NodeId value : values_of(each)) read[value] = true;
      }
    }
    for (std::size_t i = 0; i < dag.size(); ++i) {
      const Node& node = dag[static_cast<NodeId>(i)];
      if (node.stage <= Stage::rest) continue;
      for (const Operand& operand : node.operands) read[operand.node] = true;
    }
    Graph at_rest{dag, {}};
    for (std::size_t i = 0; i < dag.size(); ++i) {
      const NodeId id = static_cast<NodeId>(i);
      if (read[i] && dag[id].stage <= Stage::rest) at_rest.roots.push_back(id);
    }
    const Graph shared = share_pairs(at_rest, Stage::material);

    Dag result(dag.number_pool());
    const std::vector<NodeId> images = copy_into(result, shared.dag, shared.roots);
    std::vector<NodeId> image(dag.size());
    for (std::size_t k = 0; k < at_rest.roots.size(); ++k) image[at_rest.roots[k]] = images[k];
    for (std::size_t i = 0; i < dag.size(); ++i) {
      Node node = dag[static_cast<NodeId>(i)];
      if (node.stage <= Stage::rest) continue;
      if (node.kind == Kind::symbol) {
        image[i] = result.symbol(dag.symbol_name(static_cast<NodeId>(i)), node.stage);
        continue;
      }
      for (Operand& operand : node.operands) operand.node = image[operand.node];
      // A shared pair may have become a multiple of another node: keep sums in normal form.
      image[i] = node.kind == Kind::sum       ? result.sum(std::move(node.operands), node.value)
                 : node.kind == Kind::product ? result.product_of_groups(std::move(node.operands))
                                              : result.intern(std::move(node));
    }
    for (auto* operation : {&energy_, &forces_, &product_, &geometry_}) {
      for (Piece& each : operation->pieces) {
        for (NodeId& root : each.roots) root = image[root];
        for (NodeId& margin : each.margins) margin = image[margin];
      }
    }
    kernels_.dag = std::move(result);
  }

  void choose_constants(Grouping grouping) {
    std::vector<NodeId> roots;
    for (const auto* operation : {&energy_, &forces_, &product_}) {
      for (const Piece& each : operation->pieces) {
        const std::vector<NodeId> values = values_of(each);
        roots.insert(roots.end(), values.begin(), values.end());
      }
    }
    const std::vector<NodeId> greedy = algorithm6(kernels_.dag, roots, Stage::rest);
    kernels_.constants_algorithm6 = static_cast<int>(greedy.size());
    kernels_.constants = grouping == Grouping::algorithm6
                             ? greedy
                             : minimum_cut(kernels_.dag, roots, Stage::rest, profile_.prices);
  }

  /// The product in two stages: the same cut, one stage later, for each energy part.
  void cut_product() {
    linearize_ = {"linearize", 0, {}, {}};
    apply_ = {"apply", product_.num_outputs, {}, {}};
    for (std::size_t first = 0; first < product_.pieces.size(); first += pieces_per_part_) {
      std::vector<NodeId> roots;
      for (std::size_t k = first; k < first + pieces_per_part_; ++k) {
        const std::vector<NodeId>& rows = product_.pieces[k].roots;
        roots.insert(roots.end(), rows.begin(), rows.end());
      }
      const std::vector<NodeId> state =
          minimum_cut(kernels_.dag, roots, Stage::state, profile_.prices);
      Piece stored{{}, {}, product_.pieces[first].margins};
      for (const NodeId id : state) {  // parts may share state: store it once
        if (!state_index_.try_emplace(id, kernels_.num_state).second) continue;
        stored.roots.push_back(id);
        stored.outputs.push_back(kernels_.num_state++);
      }
      linearize_.pieces.push_back(std::move(stored));
      for (std::size_t k = first; k < first + pieces_per_part_; ++k) {
        apply_.pieces.push_back({product_.pieces[k].roots, product_.pieces[k].outputs});
      }
    }
    linearize_.num_outputs = kernels_.num_state;
  }

  /// Every operation's pieces are final before this.
  void schedule_all() {
    constants_ = {"constants", static_cast<int>(kernels_.constants.size()), {}, {}};
    constants_.pieces.push_back({kernels_.constants, counting(kernels_.constants.size())});
    const Inputs plain = symbols();
    const Inputs of_nodes = inputs_named(node_positions_, Slot::position, Stage::rest);
    Inputs with_constants = plain;
    for (std::size_t k = 0; k < kernels_.constants.size(); ++k) {
      with_constants[kernels_.constants[k]] = {Slot::constant, static_cast<int>(k)};
    }
    Inputs with_state = with_constants;
    for (const auto& [id, index] : state_index_) with_state[id] = {Slot::state, index};
    absorb_factor_in_constant();
    for (OperationKernels* operation :
         {&constants_, &geometry_, &energy_, &forces_, &product_, &linearize_, &apply_}) {
      const bool at_rest = operation == &constants_ || operation == &geometry_;
      const Inputs& inputs = operation == &geometry_ ? of_nodes
                             : at_rest               ? plain
                             : operation == &apply_  ? with_state
                                                     : with_constants;
      schedule(*operation, kernels_.dag, inputs, !at_rest);
      if (!at_rest && reads(*operation, Slot::position)) kernels_.reads_positions = true;
      kernels_.operations.push_back(std::move(*operation));
    }
    end_stage("kernel_ast");
  }

  /// What energies are of.
  [[nodiscard]] const ElementGraph& element() const { return element_; }

  VariantKernels take() { return std::move(kernels_); }

 private:
  void end_stage(const char* stage) { log_.end(stage, kernels_.dag.size()); }

  Piece piece(const Dag& source, std::vector<NodeId> roots, std::vector<int> outputs,
              const std::vector<NodeId>& margins) {
    roots.insert(roots.end(), margins.begin(), margins.end());
    Graph graph{Dag(source.number_pool()), {}};
    graph.roots = copy_into(graph.dag, source, roots);
    graph = simplified(std::move(graph), Stage::state, log_);
    roots = copy_into(kernels_.dag, graph.dag, graph.roots);
    const auto first_margin = roots.begin() + static_cast<std::ptrdiff_t>(outputs.size());
    Piece result{{roots.begin(), first_margin}, std::move(outputs), {first_margin, roots.end()}};
    return result;
  }

  /// A linear map as an operation of one fragment.
  OperationKernels map_of(const std::string& name, const Graph& graph,
                          const std::vector<std::string>& inputs, Slot slot, Stage stage) {
    OperationKernels operation{name, static_cast<int>(graph.roots.size()), {}, {}};
    operation.pieces.push_back(
        {copy_into(kernels_.dag, graph.dag, graph.roots), counting(graph.roots.size())});
    schedule(operation, kernels_.dag, inputs_named(inputs, slot, stage), false);
    return operation;
  }

  /// sum_k w_g F_k d G_k / d U for every nodal value, of gradients G in the form that they have.
  /// @param fluxes  gets the names of F
  static Graph transposed(const Graph& gradients, const PointwiseGraph& graph,
                          std::vector<std::string>& fluxes) {
    Graph nodal{gradients.dag, {}};
    std::vector<NodeId> displacement;
    for (const NodeId node : graph.whole.displacement) {
      displacement.push_back(nodal.dag.symbol(graph.whole.dag.symbol_name(node), Stage::state));
    }
    const std::size_t num_entries = gradients.roots.size() / graph.weights.size();
    std::vector<Operand> terms;
    for (std::size_t k = 0; k < gradients.roots.size(); ++k) {
      fluxes.push_back(flux_name(k / num_entries, k % num_entries));
      const NodeId flux = nodal.dag.symbol(fluxes.back(), Stage::state);
      terms.push_back(
          {nodal.dag.multiply(flux, gradients.roots[k]), graph.weights[k / num_entries]});
    }
    const NodeId work = nodal.dag.sum(std::move(terms));
    nodal.roots = gradient(nodal.dag, work, displacement);
    return share_pairs(nodal, Stage::state);
  }

  Inputs inputs_named(const std::vector<std::string>& names, Slot slot, Stage stage) {
    Inputs inputs;
    for (std::size_t k = 0; k < names.size(); ++k) {
      inputs[kernels_.dag.symbol(names[k], stage)] = {slot, static_cast<int>(k)};
    }
    return inputs;
  }

  /// Energies, forces and products may all be proportional to one constant, which then takes what
  /// multiplies them.
  void absorb_factor_in_constant() {
    std::vector<NodeId> nodal, energies, margins;
    for (const auto* operation : {&energy_, &forces_, &product_}) {
      std::vector<NodeId>& results = operation == &energy_ ? energies : nodal;
      for (const Piece& each : operation->pieces) {
        results.insert(results.end(), each.roots.begin(), each.roots.end());
        margins.insert(margins.end(), each.margins.begin(), each.margins.end());
      }
    }
    const std::optional<AbsorbedFactor> absorbed =
        absorb_factor(kernels_.dag, nodal, energies, margins, kernels_.constants);
    if (!absorbed) return;
    NodeId& stored = constants_.pieces[0].roots[absorbed->constant];
    stored = kernels_.dag.scale(absorbed->factor, stored);
    const NumberId inverse = kernels_.dag.numbers().inverse(absorbed->factor);
    for (OperationKernels* operation : {&energy_, &forces_, &product_, &apply_}) {
      for (Piece& each : operation->pieces) {
        for (NodeId& root : each.roots) root = kernels_.dag.scale(inverse, root);
      }
    }
  }

  /// The kernel's inputs. A symbol that no kernel needs joins the graph here, unread.
  Inputs symbols() {
    Inputs inputs;
    const auto add = [&](const std::vector<NodeId>& nodes, Slot slot) {
      for (std::size_t k = 0; k < nodes.size(); ++k) {
        const NodeId id =
            kernels_.dag.symbol(element_.dag.symbol_name(nodes[k]), element_.dag[nodes[k]].stage);
        inputs[id] = {slot, static_cast<int>(k)};
      }
    };
    add(element_.positions, Slot::position);
    add(element_.parameters, Slot::parameter);
    add(element_.displacement, Slot::displacement);
    add(element_.direction, Slot::direction);
    return inputs;
  }

  ElementGraph element_;
  const Split& split_;
  const Profile& profile_;
  StageLog& log_;
  VariantKernels kernels_;
  OperationKernels constants_, geometry_, energy_, forces_, product_, linearize_, apply_;
  std::size_t pieces_per_part_ = 1;
  std::map<NodeId, int> state_index_;        // of stored state
  std::vector<std::string> node_positions_;  // names of the element's rest positions
};

}  // namespace

VariantKernels build_kernels(ElementGraph graph, Geometry geometry, const Split& split,
                             const Profile& profile, Grouping grouping, StageLog& log) {
  const ElementSize size(graph);
  Builder builder(std::move(graph), size, geometry, split, profile, log);
  builder.collect_pieces();
  builder.collect_geometry(builder.element());
  builder.choose_what_is_stored(grouping);
  builder.schedule_all();
  return builder.take();
}

VariantKernels build_point_kernels(PointwiseGraph graph, Geometry geometry, const Profile& profile,
                                   Grouping grouping, StageLog& log) {
  const Split unsplit;
  Builder builder(std::move(graph.point), ElementSize(graph.whole), geometry, unsplit, profile,
                  log);
  builder.collect_pieces();
  builder.collect_geometry(graph.whole);
  builder.choose_what_is_stored(grouping);
  builder.collect_loop(graph);
  builder.schedule_all();
  return builder.take();
}

long typical_fragment_flops(ElementGraph graph, const Split& split) {
  const auto parts = energy_parts(split, static_cast<int>(graph.energies.size()),
                                  static_cast<int>(graph.determinants.size()));
  const int num_nodes = static_cast<int>(graph.nodal_volumes.size());
  const int dim = static_cast<int>(graph.positions.size()) / num_nodes;
  const std::vector<int> rows = row_parts(split, num_nodes, dim)[0];
  // Parts of different Gauss points are alike, those of different law terms are not.
  const std::size_t stride = split.gauss_point ? graph.determinants.size() : 1;
  long largest = 0;
  for (std::size_t part = 0; part < parts.size(); part += stride) {
    const PartGraph derivatives = differentiated(graph, parts[part]);
    Graph piece{Dag(graph.dag.number_pool()), {}};
    piece.roots = copy_into(piece.dag, derivatives.dag, selected(derivatives.product, rows));
    StageLog unread;
    piece = simplified(std::move(piece), Stage::state, unread);
    largest = std::max(largest, flops_after_rest(piece));
  }
  return largest;
}

}  // namespace elastogen::symgen
