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

NodeField as_node_field(const FieldArray& array) {
  return {array.shape.name, array.values, array.shape.width(), array.shape.components};
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
  return {probe.name,         probe.nodes.size(), to_array(displacement),
          to_array(reaction), to_array(moment),   {}};
}

std::vector<ProbeResult> evaluate_probes(const Scene& scene, const Problem& problem,
                                         const BodyState& state, FieldEvaluator& fields) {
  std::vector<ProbeResult> results;
  std::vector<double> quantities;
  if (shows_probe_fields(scene)) quantities = fields.nodal_quantities(state.displacement);
  for (const Probe& probe : problem.probes) {
    results.push_back(evaluate_probe(probe, problem.mesh.mesh, state));
    if (quantities.empty()) continue;
    results.back().fields = fields.at_probe(quantities, probe.nodes);
  }
  return results;
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
                 const FieldSettings& chosen, const FieldValues& fields) {
  VtuFields written;
  const auto add = [&](const std::string& name, const Vector& vector) {
    if (vector.size() > 0 && chosen.has(name)) written.nodes.push_back({name, values_of(vector)});
  };
  add("displacement", state.displacement);
  add("internal_forces", state.internal_forces);
  add("reactions", state.reactions);
  add("velocity", state.velocity);
  for (const FieldArray& array : fields.nodes) written.nodes.push_back(as_node_field(array));
  for (const FieldArray& array : fields.elements) {
    written.elements.push_back(
        {array.shape.name, array.values, array.shape.width(), array.shape.components});
  }
  written.labels = element_labels(mesh);
  write_vtu(file, mesh.mesh, written);
}

void write_points(const std::filesystem::path& file, const BodyState& state,
                  FieldEvaluator& evaluator, const FieldValues& fields) {
  const std::vector<double> displacement = evaluator.point_displacements(state.displacement);
  const std::vector<double> elements = evaluator.point_elements();
  std::vector<NodeField> written = {{"displacement", displacement, 3}, {"element", elements, 1}};
  for (const FieldArray& array : fields.points) written.push_back(as_node_field(array));
  write_points_vtu(file, evaluator.point_positions(), written);
}

}  // namespace elastogen::selector
