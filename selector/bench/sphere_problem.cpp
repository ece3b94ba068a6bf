#include "selector/bench/sphere_problem.h"

#include <fmt/format.h>

#include <Eigen/Core>
#include <cmath>
#include <map>

#include "runtime/error.h"
#include "selector/bench/choices.h"
#include "selector/bench/radial_sphere.h"
#include "symgen/law/law.h"
#include "symgen/law/parameters.h"

namespace elastogen::selector {
namespace {

constexpr double inner = 1, outer = 2, young = 1e6, poisson = 0.3;

class Sphere : public WorkPrecisionProblem {
 public:
  Sphere(bool large, std::vector<std::filesystem::path> law_folders)
      : large_(large),
        pressure_(large ? 4e5 : 1e4),
        law_folders_(std::move(law_folders)),
        text_{large ? "sphere_large" : "sphere",
              large ? "Thick sphere, large strain" : "Thick sphere, small strain",
              fmt::format("Radii {} and {} m, E = 1 MPa, nu = {}, pressure {} kPa from inside, as "
                          "a dead load; an eighth of it.",
                          inner, outer, poisson, pressure_ / 1e3),
              large ? "displacement of all nodes, root mean square, against the equation along the "
                      "radius solved to 1e-10"
                    : "displacement of all nodes, root mean square, against Lame's solution "
                      "(hooke), or the equation along the radius solved to 1e-10"} {}

  const ProblemText& text() const override { return text_; }

  std::vector<WorkPrecisionChoice> choices(const WorkPrecisionSelection& selection) const override {
    static const MeshFamilies meshes = {{{2, 2}, {4, 4}, {8, 8}, {12, 12}, {16, 16}},
                                        {{1, 1}, {2, 2}, {4, 4}, {6, 6}}};
    const std::vector<std::string> laws =
        large_ ? std::vector<std::string>{"neo_hookean", "stable_neo_hookean"}
               : std::vector<std::string>{"hooke"};
    return all_choices(selection, laws, meshes,
                       {{"cholesky_cg", Precision::double_precision, 1e-8},
                        {"cholesky", Precision::double_precision, 1e-8},
                        {"cg", Precision::double_precision, 1e-8},
                        {"cg", Precision::mixed, 1e-8},
                        {"cg", Precision::single_precision, 1e-4}});
  }

  std::string scene(const WorkPrecisionChoice& choice) const override {
    return fmt::format(R"(title = "{}"

[sphere]
inner = {:.1f}
outer = {:.1f}
cells = [{}]
association = "{}"
region = "sphere"

[material.sphere]
density = 1000.0
young = {}
poisson = {}

[[constraint]]
plane = {{ x = 0.0 }}
fixed = ["x"]

[[constraint]]
plane = {{ y = 0.0 }}
fixed = ["y"]

[[constraint]]
plane = {{ z = 0.0 }}
fixed = ["z"]

[[load]]
boundary = "inner"
pressure = {}

[solver]
method = "{}"
precision = "{}"
tolerance = {}

[output]
write = ["vtu"]
)",
                       text_.title, inner, outer, fmt::join(choice.cells, ", "),
                       choice.association.text(), young, poisson, pressure_, choice.solver.method,
                       precision_name(choice.solver.precision), choice.solver.tolerance);
  }

  std::optional<WorkPrecisionChoice> reference(const std::string&) const override {
    return std::nullopt;
  }

  Measurement measure(const WorkPrecisionChoice& choice, const SolvedScene& solved,
                      const SolvedScene*) const override {
    const RadialSphere& exact = radial(choice.association.law);
    double error = 0, scale = 0, at_inner = 0;
    int inner_nodes = 0;
    for (std::size_t k = 0; k < solved.positions.size(); k += 3) {
      const Eigen::Map<const Eigen::Vector3d> x(solved.positions.data() + k);
      const Eigen::Map<const Eigen::Vector3d> u(solved.displacements.data() + k);
      const double radius = x.norm();
      const double expected = exact.displacement(radius);
      error += (u - expected / radius * x).squaredNorm();
      scale += expected * expected;
      if (radius < inner * (1 + 1e-9)) {
        at_inner += u.dot(x) / radius;
        ++inner_nodes;
      }
    }
    if (inner_nodes == 0) throw WorkError("the result has no nodes on the inner surface");
    return {at_inner / inner_nodes, std::sqrt(error / scale)};
  }

  bool measures_displacements() const override { return true; }

 private:
  const RadialSphere& radial(const std::string& name) const {
    const auto found = exact_.find(name);
    if (found != exact_.end()) return found->second;
    const symgen::Law law = symgen::read_law(symgen::find_law_file(name, law_folders_));
    const RadialProblem problem{inner, outer, pressure_,
                                symgen::parameters_from_young_poisson(law, young, poisson)};
    return exact_.emplace(name, RadialSphere(law, problem)).first->second;
  }

  bool large_;
  double pressure_;
  std::vector<std::filesystem::path> law_folders_;
  ProblemText text_;
  mutable std::map<std::string, RadialSphere> exact_;  // by law, solved when first needed
};

}  // namespace

std::unique_ptr<WorkPrecisionProblem> make_sphere_problem(
    bool large, std::vector<std::filesystem::path> law_folders) {
  return std::make_unique<Sphere>(large, std::move(law_folders));
}

}  // namespace elastogen::selector
