#include "selector/scene/simulation.h"

#include "runtime/loads.h"

namespace elastogen::selector {
namespace {

std::span<const double> values_of(const Vector& vector) {
  return {vector.data(), static_cast<std::size_t>(vector.size())};
}

ProbeResult evaluate_probe(const Probe& probe, std::size_t dim, const Vector& displacement,
                           const Vector& reactions) {
  ProbeResult result{probe.name, probe.nodes.size(), {}, {}};
  for (const std::int32_t node : probe.nodes) {
    for (std::size_t c = 0; c < dim; ++c) {
      const auto dof = static_cast<Eigen::Index>(dim * static_cast<std::size_t>(node) + c);
      result.displacement[c] += displacement[dof] / static_cast<double>(probe.nodes.size());
      result.reaction[c] += reactions[dof];
    }
  }
  return result;
}

}  // namespace

std::vector<std::string> operations_of(LinearSolverKind method, const Constraints& constraints) {
  // Conjugate gradient takes the blocks of its preconditioner from the stiffness. Prescribed motion
  // starts from the linear answer to it, which takes products of constrained degrees of freedom.
  if (method == LinearSolverKind::conjugate_gradient || constraints.has_motion()) {
    return {"energy", "forces", "product", "stiffness"};
  }
  return {"energy", "forces", "stiffness"};
}

Model make_model(const Problem& problem, std::span<const KernelTable<double>* const> kernels,
                 int threads) {
  const Mesh& mesh = problem.mesh.mesh;
  std::vector<ModelPart> parts;
  for (std::size_t b = 0; b < mesh.blocks.size(); ++b) {
    const BlockMaterial& material = problem.materials[b];
    // All elements of a block are of one region.
    parts.push_back({b, elements_of_region(mesh.blocks[b], mesh.blocks[b].region.front()),
                     kernels[b], material.parameters, material.density});
  }
  ModelOptions options;
  options.threads = threads;
  return Model(mesh, parts, options);
}

Vector make_load(const Scene& scene, const Problem& problem, const Model& model) {
  Vector load = Vector::Zero(static_cast<Eigen::Index>(model.num_dofs()));
  const auto dim = static_cast<std::size_t>(model.dim());
  add_gravity(model, std::span(scene.gravity).first(dim), load);
  for (const NodalForce& force : problem.forces) {
    add_nodal_force(force.node, std::span(force.force).first(dim), load);
  }
  for (const SurfaceLoad& surface : problem.surface_loads) {
    add_surface_load(problem.mesh.mesh, surface, load);
  }
  return load;
}

SceneResults collect_results(const Problem& problem, Model& model, NewtonResult newton,
                             Vector displacement) {
  SceneResults results;
  model.element_energies(displacement, results.energy_density);
  const std::span<const double> volumes = model.element_volumes();
  for (std::size_t e = 0; e < volumes.size(); ++e) results.energy_density[e] /= volumes[e];
  const auto dim = static_cast<std::size_t>(model.dim());
  for (const Probe& probe : problem.probes) {
    results.probes.push_back(evaluate_probe(probe, dim, displacement, newton.reactions));
  }
  if (!problem.mesh.section_x.empty()) {
    results.curve = mean_of_sections(problem.mesh.section_x, problem.mesh.section_nodes,
                                     values_of(displacement), model.dim());
    if (problem.reference) results.distance = distance(*results.curve, *problem.reference);
  }
  results.newton = std::move(newton);
  results.displacement = std::move(displacement);
  return results;
}

}  // namespace elastogen::selector
