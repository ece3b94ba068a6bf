#include "symgen/reference_kernels.h"

#include <algorithm>
#include <map>
#include <numeric>
#include <unordered_map>
#include <utility>

#include "symgen/mechanics/expanded_formulation.h"
#include "symgen/mechanics/reference_gradients.h"

namespace elastogen::symgen {
namespace {

/// Kernels of one piece per operation, for evaluation only.
VariantKernels whole_kernels(Dag dag, NodeId energy, const std::vector<NodeId>& forces,
                             const std::vector<NodeId>& product) {
  std::vector<int> rows(forces.size());
  std::iota(rows.begin(), rows.end(), 0);
  const int num_dofs = static_cast<int>(forces.size());
  VariantKernels kernels;
  kernels.operations = {{"energy", 1, {{{energy}, {0}, {}}}, {}},
                        {"forces", num_dofs, {{forces, rows, {}}}, {}},
                        {"product", num_dofs, {{product, rows, {}}}, {}}};
  kernels.dag = std::move(dag);
  return kernels;
}

/// Operations of a loop as graphs of the element's inputs, their structure unchanged.
class WrittenOut {
 public:
  WrittenOut(const VariantKernels& kernels, Dag& target) : kernels_(kernels), target_(target) {
    gradients_["U"] = interpolated("U", Stage::state);
    gradients_["V"] = interpolated("V", Stage::direction);
    gradients_["X"] = kernels.loop->is_affine ? copied(kernels.loop->jacobian.pieces[0].roots, {})
                                              : interpolated("X", Stage::rest);
  }

  /// What an operation computes at point g.
  [[nodiscard]] std::vector<NodeId> at_point(const std::vector<NodeId>& roots,
                                             std::size_t g) const {
    Images images;
    const auto entries = static_cast<std::size_t>(kernels_.dim * kernels_.dim);
    for (const auto& [field, gradients] : gradients_) {
      const std::size_t first = gradients.size() > entries ? g * entries : 0;
      for (int i = 0; i < kernels_.dim; ++i) {
        for (int k = 0; k < kernels_.dim; ++k) {
          images[gradient_name(field, i, k)] =
              gradients[first + static_cast<std::size_t>(i * kernels_.dim + k)];
        }
      }
    }
    return copied(roots, images);
  }

  /// Nodal values of the fluxes that an operation computes at all points.
  [[nodiscard]] std::vector<NodeId> integrated(const std::vector<NodeId>& roots) const {
    Images images;
    for (std::size_t g = 0; g < kernels_.loop->weights.size(); ++g) {
      const std::vector<NodeId> fluxes = at_point(roots, g);
      for (std::size_t k = 0; k < fluxes.size(); ++k) images[flux_name(g, k)] = fluxes[k];
    }
    return copied(kernels_.loop->integrate.pieces[0].roots, images);
  }

 private:
  using Images = std::map<std::string, NodeId>;  // of inputs, by name

  [[nodiscard]] std::vector<NodeId> interpolated(const std::string& field, Stage stage) const {
    Images images;
    for (int a = 0; a < kernels_.num_nodes; ++a) {
      for (int i = 0; i < kernels_.dim; ++i) {
        images[nodal_name("U", a, i)] = target_.symbol(nodal_name(field, a, i), stage);
      }
    }
    return copied(kernels_.loop->interpolate.pieces[0].roots, images);
  }

  /// Inputs without an image keep their names.
  [[nodiscard]] std::vector<NodeId> copied(const std::vector<NodeId>& roots,
                                           const Images& images) const {
    return rebuild(kernels_.dag, roots, [&](NodeId id, Node node) {
      if (node.kind == Kind::symbol) {
        const std::string& name = kernels_.dag.symbol_name(id);
        const auto image = images.find(name);
        return image == images.end() ? target_.symbol(name, node.stage) : image->second;
      }
      std::sort(node.operands.begin(), node.operands.end());
      return target_.intern(std::move(node));
    });
  }

  const VariantKernels& kernels_;
  Dag& target_;
  std::map<std::string, std::vector<NodeId>> gradients_;
};

}  // namespace

VariantKernels written_out(const VariantKernels& kernels) {
  if (!kernels.loop) return kernels;
  const PointLoop& loop = *kernels.loop;
  Dag dag(kernels.dag.number_pool());
  const WrittenOut write(kernels, dag);
  const Piece& energy_at_point = kernels.operation("energy").pieces[0];
  std::vector<Operand> energies;
  std::vector<NodeId> margins;
  for (std::size_t g = 0; g < loop.weights.size(); ++g) {
    energies.push_back({write.at_point(energy_at_point.roots, g)[0], loop.weights[g]});
    const std::vector<NodeId> more = write.at_point(energy_at_point.margins, g);
    margins.insert(margins.end(), more.begin(), more.end());
  }
  const NodeId energy = dag.sum(std::move(energies));
  const auto nodal = [&](const char* operation) {
    return write.integrated(kernels.operation(operation).pieces[0].roots);
  };
  const std::vector<NodeId> forces = nodal("forces"), product = nodal("product");
  VariantKernels whole = whole_kernels(std::move(dag), energy, forces, product);
  whole.operations[0].pieces[0].margins = margins;
  return whole;
}

VariantKernels unoptimised_kernels(ElementGraph graph) {
  std::vector<Operand> summands;
  for (const std::vector<NodeId>& term : graph.energies) {
    for (const NodeId at_point : term) summands.push_back({at_point, NumberPool::one});
  }
  const NodeId energy = graph.dag.sum(std::move(summands));
  const std::vector<NodeId> forces = forces_of(graph, energy);
  const std::vector<NodeId> product = product_of(graph, forces);
  return whole_kernels(std::move(graph.dag), energy, forces, product);
}

VariantKernels expanded_kernels(ElementGraph graph) {
  const ExpandedFormulation expanded = expand_formulation(graph);
  const EnergyConstants& definition = expanded.definition;
  std::unordered_map<NodeId, NodeId> images;
  const auto put = [&](const std::vector<NodeId>& inputs, const std::vector<NodeId>& values) {
    for (std::size_t k = 0; k < inputs.size(); ++k) images[inputs[k]] = values[k];
  };
  put(expanded.parameters, graph.parameters);
  put(expanded.constants, copy_into(graph.dag, definition.graph.dag, definition.constants));
  put(expanded.displacement, graph.displacement);
  put(expanded.direction, graph.direction);
  const auto substituted = [&](const std::vector<NodeId>& values) {
    return substitute_into(graph.dag, expanded.dag, values, images);
  };
  const NodeId energy = substituted({expanded.energy})[0];
  const std::vector<NodeId> forces = substituted(expanded.forces);
  const std::vector<NodeId> product = substituted(expanded.product);
  return whole_kernels(std::move(graph.dag), energy, forces, product);
}

}  // namespace elastogen::symgen
