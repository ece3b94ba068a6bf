// From a problem and its kernels to a model, its load, and results.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "runtime/model.h"
#include "selector/io/deflection_curve.h"
#include "selector/io/displacement_field.h"
#include "selector/scene/body_state.h"
#include "selector/scene/measured_moduli.h"
#include "selector/scene/problem.h"

namespace elastogen::selector {

/// The kernels of one block of the mesh; `in_single` for precisions other than double.
struct BlockKernels {
  const KernelTable<double>* in_double = nullptr;
  const KernelTable<float>* in_single = nullptr;
};

/// How products with the tangent shall be computed.
[[nodiscard]] TangentProduct tangent_product_of(const Scene& scene, const Problem& problem);

/// Operations that a scene's run calls; kernels need no others.
/// @param tangent  how products are computed; automatic: whatever may be chosen
[[nodiscard]] std::vector<std::string> operations_of(const Scene& scene, const Problem& problem,
                                                     TangentProduct tangent);

/// Which of them are called in double, and which in single precision.
struct OperationsByPrecision {
  std::vector<std::string> in_double, in_single;
};
[[nodiscard]] OperationsByPrecision divide_operations(const std::vector<std::string>& operations,
                                                      Precision precision);

/// The model's parts: one for each block of the mesh.
/// @param kernels  of each block
[[nodiscard]] std::vector<ModelPart> make_parts(const Problem& problem,
                                                std::span<const BlockKernels> kernels);

/// With what the scene's solver and skip settings say of it.
/// @param threads  0: all
/// @throws InputError  an inverted or degenerate element, by its number
[[nodiscard]] Model make_model(const Scene& scene, const Problem& problem,
                               std::span<const ModelPart> parts, int threads);

/// Gravity as a consistent body load, the nodal forces and those of surface loads [N].
[[nodiscard]] Vector make_load(const Scene& scene, const Problem& problem, const Model& model);

/// What a run found in its last state, ready to be written.
struct SceneResults {
  BodyState state;
  FieldValues fields;
  std::optional<GreatestAtPoints> von_mises;  ///< where it is among the fields
  std::optional<ElementNodeValues> picture;   ///< where a field is drawn
  std::string trouble;                        ///< that a field has; empty: none
  std::vector<ProbeResult> probes;
  std::optional<DeflectionCurve> curve;         ///< of bars
  std::optional<CurveDistance> distance;        ///< with a reference that is a curve
  std::optional<FieldDistance> field_distance;  ///< with one that is a result file
  std::optional<MeasuredModuli> moduli;         ///< where the scene measures them
};

/// Evaluates the state that a run ended in.
[[nodiscard]] SceneResults collect_results(const Scene& scene, const Problem& problem, Model& model,
                                           FieldEvaluator& fields, BodyState state);

}  // namespace elastogen::selector
