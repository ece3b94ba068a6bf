// From a problem and its kernels to a model, its load, and results.
#pragma once

#include <array>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "runtime/model.h"
#include "runtime/newton.h"
#include "selector/io/deflection_curve.h"
#include "selector/scene/problem.h"

namespace elastogen::selector {

/// Operations that a solve calls; kernels need no others.
[[nodiscard]] std::vector<std::string> operations_of(LinearSolverKind method,
                                                     const Constraints& constraints);

/// @param kernels  one table for each block of the mesh
/// @param threads  0: all
/// @throws InputError  an inverted or degenerate element, by its number
[[nodiscard]] Model make_model(const Problem& problem,
                               std::span<const KernelTable<double>* const> kernels, int threads);

/// Gravity as a consistent body load, the nodal forces and those of surface loads [N].
[[nodiscard]] Vector make_load(const Scene& scene, const Problem& problem, const Model& model);

/// Means and sums over a probe's nodes; in the plane the last components are 0.
struct ProbeResult {
  std::string name;
  std::size_t num_nodes = 0;
  std::array<double, 3> displacement{};  ///< mean [m]
  std::array<double, 3> reaction{};      ///< sum of the supports' forces on the body there [N]
};

/// What a run found, ready to be written.
struct SceneResults {
  NewtonResult newton;
  Vector displacement;                 ///< [dim * node + component], m
  std::vector<double> energy_density;  ///< of each element, per rest volume [J/m^3]
  std::vector<ProbeResult> probes;
  std::optional<DeflectionCurve> curve;   ///< of bars
  std::optional<CurveDistance> distance;  ///< with a reference
};

/// Evaluates the state that Newton ended in.
[[nodiscard]] SceneResults collect_results(const Problem& problem, Model& model,
                                           NewtonResult newton, Vector displacement);

}  // namespace elastogen::selector
