#include "selector/scene/body_state.h"

#include <Eigen/Geometry>
#include <map>

#include "selector/io/vtu.h"
#include "selector/scene/node_vector.h"

namespace elastogen::selector {
namespace {

/// Which association and region each element has.
std::vector<ElementLabels> element_labels(const SceneMesh& mesh) {
  ElementLabels associations{"association", {}, {}}, regions{"region", {}, mesh.mesh.region_names};
  std::map<std::string, std::int32_t> numbers;
  for (std::size_t b = 0; b < mesh.blocks.size(); ++b) {
    const std::string name = mesh.blocks[b].association.text();
    const auto number = static_cast<std::int32_t>(numbers.size());
    const auto [entry, is_new] = numbers.emplace(name, number);
    if (is_new) associations.names.push_back(name);
    const ElementBlock& block = mesh.mesh.blocks[b];
    associations.values.insert(associations.values.end(), block.num_elements(), entry->second);
    regions.values.insert(regions.values.end(), block.region.begin(), block.region.end());
  }
  return {associations, regions};
}

std::array<double, 3> to_array(const Eigen::Vector3d& v) { return {v[0], v[1], v[2]}; }

}  // namespace

ProbeResult evaluate_probe(const Probe& probe, const Mesh& mesh, const BodyState& state) {
  const auto dim = static_cast<std::size_t>(mesh.dim);
  const auto count = static_cast<double>(probe.nodes.size());
  Eigen::Vector3d centre = Eigen::Vector3d::Zero(), displacement = centre, reaction = centre,
                  moment = centre;
  for (const std::int32_t n : probe.nodes) {
    centre += at_node(mesh.positions, static_cast<std::size_t>(n), dim) / count;
  }
  for (const std::int32_t n : probe.nodes) {
    const auto node = static_cast<std::size_t>(n);
    const Eigen::Vector3d u = at_node(values_of(state.displacement), node, dim);
    const Eigen::Vector3d force = at_node(values_of(state.reactions), node, dim);
    displacement += u / count;
    reaction += force;
    moment += (at_node(mesh.positions, node, dim) + u - centre).cross(force);
  }
  return {probe.name, probe.nodes.size(), to_array(displacement), to_array(reaction),
          to_array(moment)};
}

Momentum momentum_of(const Mesh& mesh, std::span<const double> mass, const BodyState& state) {
  const auto dim = static_cast<std::size_t>(mesh.dim);
  Eigen::Vector3d linear = Eigen::Vector3d::Zero(), angular = linear;
  for (std::size_t node = 0; node < mass.size(); ++node) {
    const Eigen::Vector3d p = mass[node] * at_node(values_of(state.velocity), node, dim);
    linear += p;
    angular +=
        (at_node(mesh.positions, node, dim) + at_node(values_of(state.displacement), node, dim))
            .cross(p);
  }
  return {to_array(linear), to_array(angular)};
}

std::vector<double> energy_density(Model& model, const Vector& displacement) {
  std::vector<double> density;
  model.element_energies(displacement, density);
  const std::span<const double> volumes = model.element_volumes();
  for (std::size_t e = 0; e < volumes.size(); ++e) density[e] /= volumes[e];
  return density;
}

void write_state(const std::filesystem::path& file, const SceneMesh& mesh, const BodyState& state,
                 std::span<const double> energy_density) {
  VtuFields fields;
  fields.nodes = {{"displacement", values_of(state.displacement)},
                  {"internal_forces", values_of(state.internal_forces)},
                  {"reactions", values_of(state.reactions)}};
  if (state.velocity.size() > 0) fields.nodes.push_back({"velocity", values_of(state.velocity)});
  if (!energy_density.empty()) fields.elements = {{"energy_density", energy_density}};
  fields.labels = element_labels(mesh);
  write_vtu(file, mesh.mesh, fields);
}

}  // namespace elastogen::selector
