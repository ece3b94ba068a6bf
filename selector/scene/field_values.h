// The fields of a state: stress, strain and energy at elements, nodes and quadrature points.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "runtime/model.h"
#include "runtime/nodal_recovery.h"
#include "selector/scene/output_fields.h"
#include "selector/scene/problem.h"

namespace elastogen::selector {

/// An array of results: values[k * shape.width() + component].
struct FieldArray {
  FieldShape shape;
  std::vector<double> values;
};

/// Where a number is greatest among the quadrature points of all elements.
struct GreatestAtPoints {
  double value = 0;
  std::size_t element = 0;
};

/// What files show of a state beside the vectors of its nodes. Arrays at nodes end in the name of
/// the nodal method: "von_mises_average".
struct FieldValues {
  std::vector<FieldArray> elements, nodes, points;
};

/// A number for each node of each element, in the mesh's order of elements, for a picture.
struct ElementNodeValues {
  std::string title;  ///< "Cauchy stress XX"
  std::string unit;
  std::vector<double> values;
};

/// Evaluates what a scene's [output] chooses. Recovers nodes' values within each material by
/// itself: stress jumps between materials.
class FieldEvaluator {
 public:
  /// @param parts  the model's, with kernels that have the operation `stress` if needs_stress()
  /// All must outlive the evaluator.
  FieldEvaluator(const Scene& scene, const Problem& problem, Model& model,
                 std::span<const ModelPart> parts);

  [[nodiscard]] FieldValues at(const Vector& displacement);
  /// The fields' quantities at all nodes, for at_probe().
  [[nodiscard]] std::vector<double> nodal_quantities(const Vector& displacement);
  /// Fields of the quantities' mean over a probe's nodes; one tuple in each array.
  [[nodiscard]] std::vector<FieldArray> at_probe(const std::vector<double>& nodal_quantities,
                                                 std::span<const std::int32_t> nodes) const;
  /// The picture's field: at nodes where fields are, else the elements' means.
  [[nodiscard]] ElementNodeValues picture(const Vector& displacement);

  /// Rest positions of the quadrature points in space [3 * point + i], and displacements there [m].
  [[nodiscard]] std::vector<double> point_positions();
  [[nodiscard]] std::vector<double> point_displacements(const Vector& displacement);
  /// The element of each point.
  [[nodiscard]] std::vector<double> point_elements();

  /// What the kernels say of all quadrature points; valid until the next evaluation. Needs stress.
  [[nodiscard]] const StressField& points_at(const Vector& displacement);

  /// Of a scalar field in the last evaluation; none where the scene does not have it, or no point
  /// has a finite number.
  [[nodiscard]] std::optional<GreatestAtPoints> greatest(std::string_view field) const;

  /// What was found wrong in the last evaluation; empty: nothing.
  [[nodiscard]] const std::string& trouble() const { return trouble_; }

 private:
  void evaluate(const Vector& displacement);
  [[nodiscard]] NodalRecovery& recovery();
  [[nodiscard]] std::vector<double> element_means() const;
  [[nodiscard]] std::vector<double> slot_values(NodalMethod method);
  void add_arrays(std::span<const double> quantities, const std::string& suffix,
                  std::vector<FieldArray>& arrays) const;
  [[nodiscard]] const double* quantity_of(const OutputField& field, const double* quantities) const;

  const Scene& scene_;
  const FieldSettings& settings_;
  const Problem& problem_;
  Model& model_;
  std::span<const ModelPart> parts_;
  std::vector<const OutputField*> fields_;  // of points
  std::vector<PointQuantity> quantities_;   // that they need
  int width_ = 0;                           // of all quantities
  std::vector<Kinematics> kinematics_;      // [block]
  std::optional<NodalRecovery> recovery_;   // when needed
  StressField points_;                      // of the last evaluation; so is the next
  std::vector<double> values_;              // [point * width + k]
  std::string trouble_;
};

/// Whether a scene's results need the operation `stress`: all fields of points do, but for the
/// energy density of elements alone.
[[nodiscard]] bool needs_stress(const Scene& scene);
/// Whether probes show fields, in the summary and the history.
[[nodiscard]] bool shows_probe_fields(const Scene& scene);
/// Whether elements' energies are shown without it.
[[nodiscard]] bool needs_element_energies(const Scene& scene);

}  // namespace elastogen::selector
