#include "selector/bench/bar_motion_problem.h"

#include <fmt/format.h>

#include <cmath>
#include <numbers>
#include <sstream>

#include "runtime/error.h"
#include "selector/bench/choices.h"
#include "selector/support/files.h"

namespace elastogen::selector {
namespace {

constexpr double young = 1e6, density = 1000;
const HangingBar bar = {8, std::sqrt(young / density), 0.1};

/// Times and displacements of the end from a run's history.
std::vector<std::pair<double, double>> read_history(const std::filesystem::path& file) {
  std::istringstream text(read_text_file(file, "history"));
  std::string line, field;
  std::getline(text, line);
  std::istringstream names(line);
  std::size_t time = 0, end = 0;
  for (std::size_t column = 0; std::getline(names, field, ','); ++column) {
    if (field == "time") time = column;
    if (field == "end_ux") end = column;
  }
  std::vector<std::pair<double, double>> rows;
  while (std::getline(text, line)) {
    std::istringstream fields(line);
    std::pair<double, double> row;
    for (std::size_t column = 0; std::getline(fields, field, ','); ++column) {
      if (column == time) row.first = std::stod(field);
      if (column == end) row.second = std::stod(field);
    }
    rows.push_back(row);
  }
  if (end == 0 || rows.empty()) {
    throw WorkError(fmt::format("{} has no displacement of the end", file.string()));
  }
  return rows;
}

class BarMotion : public WorkPrecisionProblem {
 public:
  const ProblemText& text() const override {
    static const ProblemText text = {
        "bar_dynamics", "Bar that starts to hang",
        fmt::format("8 x 1 x 1 m, clamped at one end, its weight acting along it from t = 0 on; E "
                    "= 1 MPa, nu = 0, 1000 kg/m^3, g = {} m/s^2; one period of {:.3f} s.",
                    bar.gravity, bar.period()),
        "displacement of the free end over the period, root mean square, against the exact series"};
    return text;
  }

  std::vector<WorkPrecisionChoice> choices(const WorkPrecisionSelection& selection) const override {
    static const MeshFamilies meshes = {
        {{8, 1, 1}, {16, 1, 1}, {32, 1, 1}, {64, 1, 1}, {128, 1, 1}},
        {{4, 2, 2}, {8, 2, 2}, {16, 2, 2}, {32, 2, 2}}};
    return all_choices(selection, {"hooke"}, meshes,
                       {{"central_differences", Precision::double_precision, 0},
                        {"central_differences", Precision::single_precision, 0},
                        {"symplectic_euler", Precision::double_precision, 0},
                        {"implicit_euler", Precision::double_precision, 0.5},
                        {"implicit_euler", Precision::double_precision, 0.05}});
  }

  std::string scene(const WorkPrecisionChoice& choice) const override {
    std::string text = fmt::format(R"(title = "Bar that starts to hang"
gravity = [{}, 0.0, 0.0]

[bar]
length = {:.1f}
width = 1.0
height = 1.0
cells = [{}]

[[bar.section]]
until = 1.0
association = "{}"
region = "bar"

[material.bar]
density = {}
young = {}
poisson = 0.0

[[constraint]]
plane = {{ x = 0.0 }}
fixed = ["x", "y", "z"]

[[probe]]
name = "end"
plane = {{ x = {:.1f} }}

[output]
write = ["history"]

[dynamics]
scheme = "{}"
end = {}
)",
                                   bar.gravity, bar.length, fmt::join(choice.cells, ", "),
                                   choice.association.text(), density, young, bar.length,
                                   choice.solver.method, bar.period());
    if (choice.solver.tolerance > 0) {
      text += fmt::format("step = {}\n",
                          choice.solver.tolerance * bar.length / choice.cells[0] / bar.wave_speed);
    }
    text +=
        fmt::format("\n[solver]\nprecision = \"{}\"\n", precision_name(choice.solver.precision));
    if (choice.solver.method == "implicit_euler") text += "method = \"cholesky\"\n";
    return text;
  }

  std::optional<WorkPrecisionChoice> reference(const std::string&) const override {
    return std::nullopt;
  }

  Measurement measure(const WorkPrecisionChoice&, const SolvedScene& solved,
                      const SolvedScene*) const override {
    double error = 0, scale = 0, largest = 0;
    for (const auto& [time, u] : read_history(solved.folder / "history.csv")) {
      const double exact = bar.end_displacement(time);
      error += (u - exact) * (u - exact);
      scale += exact * exact;
      largest = std::max(largest, u);
    }
    return {largest, std::sqrt(error / scale)};
  }

  bool measures_displacements() const override { return false; }
};

}  // namespace

double HangingBar::end_displacement(double time) const {
  constexpr int terms = 2000;  // the rest is below 1e-10
  double sum = 0;
  for (int n = 2 * terms - 1; n > 0; n -= 2) {
    const double sign = n % 4 == 1 ? 1 : -1;
    sum += sign * std::cos(n * std::numbers::pi * wave_speed * time / (2 * length)) /
           (static_cast<double>(n) * n * n);
  }
  const double series = 16 / std::pow(std::numbers::pi, 3) * sum;
  return gravity * length * length / (wave_speed * wave_speed) * (0.5 - series);
}

std::unique_ptr<WorkPrecisionProblem> make_bar_motion_problem() {
  return std::make_unique<BarMotion>();
}

}  // namespace elastogen::selector
