#include "selector/scene/fingerprint.h"

#include <fmt/format.h>

#include <cstdint>
#include <string_view>
#include <vector>

#include "symgen/emit/content_hash.h"

namespace elastogen::selector {
namespace {

template <class Number>
std::string_view bytes_of(const Number* numbers, std::size_t count) {
  return {reinterpret_cast<const char*>(numbers), count * sizeof(Number)};
}

/// Settings of the steps; a number's shortest text that reads back as itself stands for it.
std::string settings_text(const Scene& scene, LinearSolverKind solver, double time_step) {
  const std::string method =
      fmt::format("{} {} {} {}", precision_name(scene.solver.precision), solver_name(solver),
                  tangent_product_name(scene.solver.tangent),
                  scene.solver.projection ? projection_name(*scene.solver.projection) : "default");
  if (!scene.dynamics) {
    return fmt::format("static {} {} {}", method, scene.solver.tolerance, scene.solver.load_steps);
  }
  const IntegratorOptions& options = scene.dynamics->options;
  return fmt::format("{} {} {} {} {} {} {} {} {} {} {}", scheme_name(options.scheme), method,
                     time_step, options.damping, options.linear_tolerance,
                     options.newton_iterations, options.newton_tolerance,
                     fmt::join(scene.dynamics->velocity, " "), fmt::join(scene.dynamics->spin, " "),
                     scene.skip.sleep.motion, scene.skip.sleep.calls);
}

}  // namespace

std::string run_fingerprint(const Scene& scene, const Problem& problem,
                            std::span<const BlockKernels> kernels, const Vector& load,
                            double time_step) {
  const Mesh& mesh = problem.mesh.mesh;
  const std::string settings = settings_text(scene, problem.solver.kind, time_step);
  std::vector<std::string_view> parts = {
      settings, bytes_of(mesh.positions.data(), mesh.positions.size()),
      bytes_of(load.data(), static_cast<std::size_t>(load.size()))};
  for (std::size_t b = 0; b < mesh.blocks.size(); ++b) {
    const BlockMaterial& material = problem.materials[b];
    parts.emplace_back(kernels[b].in_double->hash);
    parts.push_back(bytes_of(mesh.blocks[b].nodes.data(), mesh.blocks[b].nodes.size()));
    parts.push_back(bytes_of(material.parameters.data(), material.parameters.size()));
    parts.push_back(bytes_of(&material.density, 1));
  }
  for (const ConstraintDescription& constraint : scene.constraints) {
    parts.emplace_back(constraint.text);
  }
  return symgen::content_hash(parts);
}

}  // namespace elastogen::selector
