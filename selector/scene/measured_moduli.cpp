#include "selector/scene/measured_moduli.h"

#include <fmt/format.h>

#include "runtime/error.h"

namespace elastogen::selector {
namespace {

double mean_displacement(const std::vector<std::int32_t>& nodes, std::size_t component,
                         const BodyState& state) {
  double sum = 0;
  for (const std::int32_t node : nodes) {
    sum += state.displacement[static_cast<Eigen::Index>(3 * static_cast<std::size_t>(node) +
                                                        component)];
  }
  return sum / static_cast<double>(nodes.size());
}

/// Strain across a section along y or z: how far its two sides have moved apart.
double lateral_strain(const Problem& problem, const std::vector<std::int32_t>& section,
                      std::size_t component, double size, const BodyState& state) {
  std::vector<std::int32_t> low, high;
  for (const std::int32_t node : section) {
    const double x = problem.mesh.mesh.positions[3 * static_cast<std::size_t>(node) + component];
    if (x < 1e-9 * size) low.push_back(node);
    if (x > (1 - 1e-9) * size) high.push_back(node);
  }
  return (mean_displacement(high, component, state) - mean_displacement(low, component, state)) /
         size;
}

}  // namespace

MeasuredModuli measure_moduli(const Scene& scene, const Problem& problem, const BodyState& state) {
  const std::array<double, 3>& size = scene.bar->size;
  const SceneMesh& mesh = problem.mesh;
  MeasuredModuli measured;
  measured.strain = (mean_displacement(mesh.section_nodes.back(), 0, state) -
                     mean_displacement(mesh.section_nodes.front(), 0, state)) /
                    size[0];
  if (measured.strain == 0) return measured;
  if (scene.measure.young) {
    double force = 0;
    for (const std::int32_t node : mesh.section_nodes.front()) {
      force -= state.reactions[static_cast<Eigen::Index>(3 * static_cast<std::size_t>(node))];
    }
    measured.young = force / (size[1] * size[2]) / measured.strain;
  }
  if (scene.measure.poisson) {
    const std::size_t middle = mesh.section_x.size() / 2;
    const double strain = (mean_displacement(mesh.section_nodes[middle + 1], 0, state) -
                           mean_displacement(mesh.section_nodes[middle - 1], 0, state)) /
                          (mesh.section_x[middle + 1] - mesh.section_x[middle - 1]);
    const std::vector<std::int32_t>& section = mesh.section_nodes[middle];
    measured.poisson = -0.5 *
                       (lateral_strain(problem, section, 1, size[1], state) +
                        lateral_strain(problem, section, 2, size[2], state)) /
                       strain;
  }
  return measured;
}

void check_measurable(const Scene& scene, const Problem& problem) {
  if (!scene.measure.poisson || problem.mesh.section_x.size() > 2) return;
  throw InputError(fmt::format(
      "{}: measure: Poisson's ratio is measured in a section between the ends: divide the bar into "
      "2 cells along x, or more",
      scene.file.string()));
}

}  // namespace elastogen::selector
