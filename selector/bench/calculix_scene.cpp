#include "selector/bench/calculix_scene.h"

#include <map>

#include "runtime/vector.h"

namespace elastogen::selector {

std::vector<std::string> calculix_elements(const std::string& element) {
  static const std::map<std::string, std::vector<std::string>> elements = {
      {"tet4", {"C3D4"}},
      {"prism6", {"C3D6"}},
      {"hexa8", {"C3D8", "C3D8I"}},
      {"tet10", {"C3D10"}},
      {"hexa20", {"C3D20", "C3D20R"}}};
  const auto found = elements.find(element);
  return found == elements.end() ? std::vector<std::string>{} : found->second;
}

bool calculix_has_law(const std::string& law) { return law == "hooke" || law == "stvk"; }

CalculixProblem calculix_problem(const Scene& scene, const Problem& problem,
                                 const std::string& element_type, double young, double poisson) {
  CalculixProblem result;
  result.mesh = &problem.mesh.mesh;
  result.element_type = element_type;
  result.young = young;
  result.poisson = poisson;
  result.density = problem.materials.front().density;
  result.gravity = scene.gravity;
  result.large_deformation = problem.materials.front().law != "hooke";

  std::vector<NodalValue>& prescribed = result.prescribed.emplace_back();
  for (std::size_t dof = 0; dof < problem.constraints.num_dofs(); ++dof) {
    if (!problem.constraints.is_constrained(dof)) continue;
    prescribed.push_back({dof / 3, static_cast<int>(dof % 3), problem.constraints.value(dof)});
  }
  Vector load = Vector::Zero(static_cast<Eigen::Index>(problem.constraints.num_dofs()));
  for (const SurfaceLoad& surface : problem.surface_loads) {
    add_surface_load(problem.mesh.mesh, surface, load);
  }
  for (std::size_t dof = 0; dof < problem.constraints.num_dofs(); ++dof) {
    const double force = load[static_cast<Eigen::Index>(dof)];
    if (force != 0) result.forces.push_back({dof / 3, static_cast<int>(dof % 3), force});
  }
  return result;
}

}  // namespace elastogen::selector
