#include "selector/scene/simulation.h"

#include "runtime/loads.h"

namespace elastogen::selector {

namespace {

/// What products with the tangent may be computed by.
std::vector<std::string> product_operations(TangentProduct product) {
  switch (product) {
    case TangentProduct::recompute:
      return {"product"};
    case TangentProduct::two_stage:
      return {"linearize", "apply"};
    case TangentProduct::automatic:
      return {"product", "linearize", "apply"};
    case TangentProduct::assembled:
      break;
  }
  return {};
}

/// Products that follow a linearisation, about: few where a factor preconditions.
double products_per_tangent(LinearSolverKind method) {
  return method == LinearSolverKind::conjugate_gradient ? 20 : 4;
}

}  // namespace

TangentProduct tangent_product_of(const Scene& scene, const Problem& problem) {
  // Where nothing iterates.
  if (problem.solver.kind == LinearSolverKind::cholesky) return TangentProduct::recompute;
  return scene.solver.tangent;
}

std::vector<std::string> operations_of(const Scene& scene, const Problem& problem,
                                       TangentProduct tangent) {
  const std::vector<std::string> products = product_operations(tangent);
  if (scene.dynamics) {
    std::vector<std::string> operations = {"forces"};
    // The right side of implicit Euler is a product, the preconditioner has blocks of the
    // stiffness.
    if (!is_explicit(scene.dynamics->options.scheme)) {
      operations.insert(operations.end(), products.begin(), products.end());
      operations.emplace_back("stiffness");
    }
    if (scene.output.energy || needs_element_energies(scene)) {
      operations.insert(operations.begin(), "energy");
    }
    if (needs_stress(scene)) operations.emplace_back("stress");
    return operations;
  }
  // Conjugate gradient takes the blocks of its preconditioner from the stiffness. Where constrained
  // nodes have to move, a solve starts from the linear answer to that, which takes products.
  std::vector<std::string> operations = {"energy", "forces"};
  const bool has_gap = !problem.motion.empty() || scene.start != Start::rest;
  if (problem.solver.kind != LinearSolverKind::cholesky || has_gap) {
    operations.insert(operations.end(), products.begin(), products.end());
  }
  operations.emplace_back("stiffness");
  if (needs_stress(scene)) operations.emplace_back("stress");
  return operations;
}

OperationsByPrecision divide_operations(const std::vector<std::string>& operations,
                                        Precision precision) {
  OperationsByPrecision divided;
  for (const std::string& operation : operations) {
    const bool of_tangent = operation != "energy" && operation != "forces" && operation != "stress";
    const bool single =
        precision == Precision::single_precision || (precision == Precision::mixed && of_tangent);
    (single ? divided.in_single : divided.in_double).push_back(operation);
  }
  return divided;
}

std::vector<ModelPart> make_parts(const Problem& problem, std::span<const BlockKernels> kernels) {
  const Mesh& mesh = problem.mesh.mesh;
  std::vector<ModelPart> parts;
  for (std::size_t b = 0; b < mesh.blocks.size(); ++b) {
    const BlockMaterial& material = problem.materials[b];
    // All elements of a block are of one region.
    parts.push_back({b, elements_of_region(mesh.blocks[b], mesh.blocks[b].region.front()),
                     kernels[b].in_double, material.parameters, material.density,
                     kernels[b].in_single});
  }
  return parts;
}

Model make_model(const Scene& scene, const Problem& problem, std::span<const ModelPart> parts,
                 int threads) {
  ModelOptions options;
  options.threads = threads;
  options.precision = scene.solver.precision;
  options.tangent_product = tangent_product_of(scene, problem);
  options.products_per_tangent = products_per_tangent(problem.solver.kind);
  options.share_constants = scene.skip.congruent;
  if (scene.skip.at_rest) options.held_nodes = problem.motion.held_nodes();
  options.sleep = scene.skip.sleep;
  return Model(problem.mesh.mesh, parts, options);
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

SceneResults collect_results(const Scene& scene, const Problem& problem, Model& model,
                             FieldEvaluator& fields, BodyState state) {
  SceneResults results;
  results.state = std::move(state);
  const Vector& displacement = results.state.displacement;
  results.fields = fields.at(displacement);
  results.von_mises = fields.greatest("von_mises");
  results.probes = evaluate_probes(scene, problem, results.state, fields);
  if (scene.output.fields.picture) results.picture = fields.picture(displacement);
  results.trouble = fields.trouble();
  if (!problem.mesh.section_x.empty()) {
    results.curve = mean_of_sections(problem.mesh.section_x, problem.mesh.section_nodes,
                                     values_of(results.state.displacement), model.dim());
    if (problem.reference) results.distance = distance(*results.curve, *problem.reference);
  }
  if (problem.reference_displacement) {
    results.field_distance = field_distance(values_of(results.state.displacement),
                                            *problem.reference_displacement, model.dim());
  }
  if (scene.measure.young || scene.measure.poisson) {
    results.moduli = measure_moduli(scene, problem, results.state);
  }
  return results;
}

}  // namespace elastogen::selector
