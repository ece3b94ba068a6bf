#include "selector/bench/beam_problems.h"

#include <fmt/format.h>

#include <Eigen/Core>
#include <cmath>

#include "runtime/error.h"
#include "selector/bench/choices.h"

namespace elastogen::selector {
namespace {

constexpr double length = 8;

const MeshFamilies meshes = {
    {{6, 1, 1}, {12, 2, 2}, {24, 4, 4}, {36, 6, 6}, {48, 8, 8}, {72, 12, 12}},
    // With one hexa20 of 8 points across, motions without energy spoil the bending.
    {{4, 2, 2}, {8, 2, 2}, {12, 2, 2}, {16, 3, 3}, {24, 4, 4}}};
const std::vector<SolverChoice> solvers = {{"cholesky_cg", Precision::double_precision, 1e-8},
                                           {"cholesky", Precision::double_precision, 1e-8},
                                           {"cg", Precision::double_precision, 1e-8},
                                           {"cg", Precision::mixed, 1e-8},
                                           {"cholesky_cg", Precision::double_precision, 1e-4},
                                           {"cg", Precision::single_precision, 1e-4}};

std::string beam(const std::string& title, std::span<const BeamSection> sections,
                 const std::vector<int>& cells) {
  std::string text = fmt::format(R"(title = "{}"

[bar]
length = {:.1f}
width = 1.0
height = 1.0
cells = [{}]
)",
                                 title, length, fmt::join(cells, ", "));
  for (const BeamSection& section : sections) {
    text += fmt::format(R"(
[[bar.section]]
until = {:.4}
association = "{}"
region = "beam"
)",
                        section.until, section.association);
  }
  return text + R"(
[material.beam]
density = 1000.0
young = 1e8
poisson = 0.0

[[constraint]]
plane = { x = 0.0 }
fixed = ["x", "y", "z"]

[[probe]]
name = "end"
plane = { x = 8.0 }
)";
}

std::string ending(const SolverChoice& solver, int load_steps) {
  return fmt::format(R"(
[solver]
method = "{}"
precision = "{}"
tolerance = {}
load_steps = {}
max_iterations = 1000

[output]
write = ["vtu"]
)",
                     solver.method, precision_name(solver.precision), solver.tolerance, load_steps);
}

WorkPrecisionChoice over_resolved(const std::string& law) {
  return {symgen::AssociationId::parse(law + "-hexa20-q27-none"),
          {32, 8, 8},
          {"cg", Precision::double_precision, 1e-9}};
}

std::vector<BeamSection> whole(const WorkPrecisionChoice& choice) {
  return {{1.0, choice.association.text()}};
}

/// Mean displacement of the nodes at x = length.
Eigen::Vector3d end_displacement(const SolvedScene& solved) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  int count = 0;
  for (std::size_t k = 0; k < solved.positions.size(); k += 3) {
    if (std::abs(solved.positions[k] - length) > 1e-6) continue;
    sum += Eigen::Map<const Eigen::Vector3d>(solved.displacements.data() + k);
    ++count;
  }
  if (count == 0) throw WorkError("the result has no nodes at the beam's end");
  return sum / count;
}

double end_moment(const SolvedScene& solved) {
  return solved.summary.at("probes").at(0).at("moment").at(0).get<double>();
}

class Bending : public WorkPrecisionProblem {
 public:
  const ProblemText& text() const override {
    static const ProblemText text = {
        "bending", "Beam in bending",
        "8 x 1 x 1 m, clamped at one end, under its own weight; E = 100 MPa, nu = 0, 1000 kg/m^3, "
        "g = 9.81 m/s^2, full load in one step.",
        "mean displacement of the end face, against 32 x 8 x 8 hexa20 with 27 points (St "
        "Venant-Kirchhoff: u_z = -0.6076 m)"};
    return text;
  }
  std::vector<WorkPrecisionChoice> choices(const WorkPrecisionSelection& selection) const override {
    return all_choices(selection, {"stvk", "neo_hookean"}, meshes, solvers);
  }
  std::string scene(const WorkPrecisionChoice& choice) const override {
    return bending_scene(whole(choice), choice.cells, choice.solver);
  }
  std::optional<WorkPrecisionChoice> reference(const std::string& law) const override {
    return over_resolved(law);
  }
  Measurement measure(const WorkPrecisionChoice&, const SolvedScene& solved,
                      const SolvedScene* reference) const override {
    const Eigen::Vector3d u = end_displacement(solved), exact = end_displacement(*reference);
    return {u[2], (u - exact).norm() / exact.norm()};
  }
  bool measures_displacements() const override { return true; }
};

class Torsion : public WorkPrecisionProblem {
 public:
  const ProblemText& text() const override {
    static const ProblemText text = {
        "torsion", "Beam in torsion",
        "The same beam without weight, its end turned about the axis by half a turn in five load "
        "steps.",
        "moment at the end, against 32 x 8 x 8 hexa20 with 27 points"};
    return text;
  }
  std::vector<WorkPrecisionChoice> choices(const WorkPrecisionSelection& selection) const override {
    const MeshFamilies coarser = {{meshes.linear.begin(), meshes.linear.end() - 1},
                                  {meshes.quadratic.begin(), meshes.quadratic.end() - 1}};
    return all_choices(selection, {"stvk"}, coarser,
                       {{"cholesky_cg", Precision::double_precision, 1e-6},
                        {"cholesky", Precision::double_precision, 1e-6},
                        {"cg", Precision::double_precision, 1e-6},
                        {"cg", Precision::mixed, 1e-6}});
  }
  std::string scene(const WorkPrecisionChoice& choice) const override {
    return torsion_scene(whole(choice), choice.cells, choice.solver);
  }
  std::optional<WorkPrecisionChoice> reference(const std::string& law) const override {
    return over_resolved(law);
  }
  Measurement measure(const WorkPrecisionChoice&, const SolvedScene& solved,
                      const SolvedScene* reference) const override {
    const double moment = end_moment(solved), exact = end_moment(*reference);
    return {moment, std::abs(moment - exact) / std::abs(exact)};
  }
  bool measures_displacements() const override { return false; }
};

}  // namespace

std::string bending_scene(std::span<const BeamSection> sections, const std::vector<int>& cells,
                          const SolverChoice& solver) {
  return "gravity = [0.0, 0.0, -9.81]\n" + beam("Beam in bending", sections, cells) +
         ending(solver, 1);
}

std::string torsion_scene(std::span<const BeamSection> sections, const std::vector<int>& cells,
                          const SolverChoice& solver) {
  return beam("Beam in torsion", sections, cells) + R"(
[[constraint]]
plane = { x = 8.0 }
rotation = { point = [8.0, 0.5, 0.5], axis = [1.0, 0.0, 0.0], turns = 0.5 }
)" + ending(solver, 5);
}

std::unique_ptr<WorkPrecisionProblem> make_bending_problem() { return std::make_unique<Bending>(); }

std::unique_ptr<WorkPrecisionProblem> make_torsion_problem() { return std::make_unique<Torsion>(); }

}  // namespace elastogen::selector
