// The state of a body at one moment, as results show it.
#pragma once

#include <array>
#include <filesystem>
#include <string>
#include <vector>

#include "runtime/model.h"
#include "runtime/vector.h"
#include "selector/scene/field_values.h"
#include "selector/scene/problem.h"

namespace elastogen::selector {

/// Vectors over the degrees of freedom [dim * node + component].
struct BodyState {
  Vector displacement;        ///< [m]
  Vector velocity;            ///< [m/s]; empty in statics
  Vector internal_forces;     ///< -dW/dU [N]
  Vector reactions;           ///< forces of the supports on the body [N]
  double kinetic_energy = 0;  ///< [J]
};

[[nodiscard]] inline std::span<const double> values_of(const Vector& vector) {
  return {vector.data(), static_cast<std::size_t>(vector.size())};
}

/// Means and sums over a probe's nodes; in the plane the last components are 0.
struct ProbeResult {
  std::string name;
  std::size_t num_nodes = 0;
  std::array<double, 3> displacement{};  ///< mean [m]
  std::array<double, 3> reaction{};      ///< sum of the supports' forces on the body there [N]
  /// Moment of those forces, where they act now, about the centre of the nodes at rest [N m]; in
  /// the plane only the last component.
  std::array<double, 3> moment{};
  std::vector<FieldArray> fields;  ///< of the nodes' mean, where probes show fields
};

[[nodiscard]] ProbeResult evaluate_probe(const Probe& probe, const Mesh& mesh,
                                         const BodyState& state);

/// All of them, with fields where the scene's probes show fields.
[[nodiscard]] std::vector<ProbeResult> evaluate_probes(const Scene& scene, const Problem& problem,
                                                       const BodyState& state,
                                                       FieldEvaluator& fields);

/// Of a body in motion.
struct Momentum {
  std::array<double, 3> linear{};   ///< [kg m/s]
  std::array<double, 3> angular{};  ///< about the origin [kg m^2/s]; in the plane about z
};

/// @param mass  of each node [kg]
[[nodiscard]] Momentum momentum_of(const Mesh& mesh, std::span<const double> mass,
                                   const BodyState& state);

/// Elastic energy of each element per rest volume [J/m^3].
[[nodiscard]] std::vector<double> energy_density(Model& model, const Vector& displacement);

/// Writes mesh, state, associations and regions for ParaView (docs/scene.md), atomically.
/// @param chosen  says which of the state's vectors are written
/// @throws WorkError  when the file cannot be written
void write_state(const std::filesystem::path& file, const SceneMesh& mesh, const BodyState& state,
                 const FieldSettings& chosen, const FieldValues& fields);

/// Writes the quadrature points at rest with their displacements and fields, likewise.
void write_points(const std::filesystem::path& file, const BodyState& state,
                  FieldEvaluator& evaluator, const FieldValues& fields);

}  // namespace elastogen::selector
