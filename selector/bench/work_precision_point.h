// What the benchmark of work against precision keeps of each of its runs.
#pragma once

#include <cstddef>
#include <string>

namespace elastogen::selector {

/// One measured point of time against error: one problem on one mesh, by one program, with one
/// solver and tolerance. Wall times unless said otherwise.
struct WorkPrecisionPoint {
  std::string problem;      ///< "bending", "torsion", "sphere", "sphere_large", "bar_dynamics"
  std::string program;      ///< "elastogen", "calculix"
  std::string association;  ///< "stvk-hexa8-q8-none"; CalculiX: law and element, "stvk C3D20R"
  std::string law;          ///< "stvk"
  std::string element;      ///< "hexa8"; CalculiX: "C3D20R"
  std::string quadrature;   ///< "q8"; CalculiX: ""
  std::string resolution;   ///< "48x8x8"
  std::string
      solver;  ///< "cholesky", "cg", "cholesky_cg"; CalculiX: what it says; dynamics: the scheme
  std::string precision;  ///< of the kernels: "double", "mixed", "single"; CalculiX: "double"
  double tolerance = 0;   ///< Newton's relative residual
  std::size_t num_elements = 0;
  std::size_t num_dofs = 0;
  double error = 0;  ///< relative error of the problem's quantity, dimensionless; see `failure`
  double value = 0;  ///< that quantity, SI
  double process_seconds = 0;      ///< of the whole process, median of its runs
  double process_seconds_min = 0;  ///< least of its runs
  double cpu_seconds = 0;          ///< user and system time of the process, median

  // Phases of elastogen's median run [s]; 0 for CalculiX.
  double mesh = 0;
  double kernels = 0;
  double setup = 0;
  double linearization = 0;
  double linear_solve = 0;
  double forces = 0;
  double output = 0;
  double solve_seconds = 0;  ///< setup and solve: what a simulator that links the runtime pays

  int runs = 0;         ///< that the medians are of
  std::string scene;    ///< file of the scene or deck, relative to the results' folder
  std::string failure;  ///< why there is no `error`; empty if there is one

  [[nodiscard]] bool succeeded() const { return failure.empty(); }
  /// "cg", "cg in mixed precision"
  [[nodiscard]] std::string solver_text() const {
    return precision == "double" ? solver : solver + " in " + precision + " precision";
  }
};

/// Calls `visit(name, member)` for every member in the order above: the one list of them that
/// storing, reading and printing go by. Names are those of the members.
template <class Point, class Visit>
void for_each_field(Point& point, Visit&& visit) {
  visit("problem", point.problem);
  visit("program", point.program);
  visit("association", point.association);
  visit("law", point.law);
  visit("element", point.element);
  visit("quadrature", point.quadrature);
  visit("resolution", point.resolution);
  visit("solver", point.solver);
  visit("precision", point.precision);
  visit("tolerance", point.tolerance);
  visit("num_elements", point.num_elements);
  visit("num_dofs", point.num_dofs);
  visit("error", point.error);
  visit("value", point.value);
  visit("process_seconds", point.process_seconds);
  visit("process_seconds_min", point.process_seconds_min);
  visit("cpu_seconds", point.cpu_seconds);
  visit("mesh", point.mesh);
  visit("kernels", point.kernels);
  visit("setup", point.setup);
  visit("linearization", point.linearization);
  visit("linear_solve", point.linear_solve);
  visit("forces", point.forces);
  visit("output", point.output);
  visit("solve_seconds", point.solve_seconds);
  visit("runs", point.runs);
  visit("scene", point.scene);
  visit("failure", point.failure);
}

}  // namespace elastogen::selector
