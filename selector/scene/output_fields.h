// The fields that results can show, one row each (docs/scene.md).
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "runtime/stress_measures.h"

namespace elastogen::selector {

/// What is computed at quadrature points, and averaged from there.
enum class PointQuantity {
  none,  ///< the field is a vector of the nodes that the solver has anyhow
  energy_density,
  volume_ratio,
  cauchy_stress,
  first_piola_kirchhoff_stress,
  second_piola_kirchhoff_stress,
  green_lagrange_strain,
  logarithmic_strain,
};

/// Numbers of a quantity.
[[nodiscard]] int quantity_width(PointQuantity quantity);

/// Of a point: quantity_width() numbers, tensors as symmetric_names or tensor_names have them.
void write_quantity(PointQuantity quantity, const PointStress& point, Kinematics kinematics,
                    double* out);

/// What is made of the quantity's mean: invariants are those of the averaged tensor.
enum class Invariant { itself, von_mises, principal_values, principal_directions };

struct OutputField {
  std::string_view name;   ///< "von_mises"
  std::string_view title;  ///< "von Mises stress", of pictures
  std::string_view unit;   ///< "Pa"; empty: none
  PointQuantity quantity = PointQuantity::none;
  Invariant invariant = Invariant::itself;

  [[nodiscard]] bool of_points() const { return quantity != PointQuantity::none; }
};

[[nodiscard]] std::span<const OutputField> output_fields();
/// Null for an unknown name.
[[nodiscard]] const OutputField* find_output_field(std::string_view name);

/// One array that a field is written as: principal directions are three, all others one.
struct FieldShape {
  std::string name;                     ///< "principal_direction_1", mostly that of the field
  std::vector<std::string> components;  ///< of scalars none
  [[nodiscard]] int width() const {
    return components.empty() ? 1 : static_cast<int>(components.size());
  }
};
[[nodiscard]] std::vector<FieldShape> field_shapes(const OutputField& field);

/// The numbers of all its arrays, one behind the other, from those of its quantity.
void write_field(const OutputField& field, const double* quantity, double* out);

}  // namespace elastogen::selector
