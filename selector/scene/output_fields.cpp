#include "selector/scene/output_fields.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

namespace elastogen::selector {
namespace {

using Q = PointQuantity;

constexpr std::array<OutputField, 14> all_fields = {{
    {"displacement", "displacement", "m"},
    {"velocity", "velocity", "m/s"},
    {"internal_forces", "internal forces", "N"},
    {"reactions", "reactions", "N"},
    {"energy_density", "energy density", "J/m^3", Q::energy_density},
    {"cauchy_stress", "Cauchy stress", "Pa", Q::cauchy_stress},
    {"first_piola_kirchhoff_stress", "first Piola-Kirchhoff stress", "Pa",
     Q::first_piola_kirchhoff_stress},
    {"second_piola_kirchhoff_stress", "second Piola-Kirchhoff stress", "Pa",
     Q::second_piola_kirchhoff_stress},
    {"green_lagrange_strain", "Green-Lagrange strain", "", Q::green_lagrange_strain},
    {"logarithmic_strain", "logarithmic strain", "", Q::logarithmic_strain},
    {"volume_ratio", "volume ratio", "", Q::volume_ratio},
    {"von_mises", "von Mises stress", "Pa", Q::cauchy_stress, Invariant::von_mises},
    {"principal_stress", "principal stress", "Pa", Q::cauchy_stress, Invariant::principal_values},
    {"principal_directions", "principal directions", "", Q::cauchy_stress,
     Invariant::principal_directions},
}};

template <std::size_t size>
void put(const std::array<double, size>& numbers, double* out) {
  std::copy(numbers.begin(), numbers.end(), out);
}

}  // namespace

int quantity_width(PointQuantity quantity) {
  switch (quantity) {
    case Q::none:
      return 0;
    case Q::energy_density:
    case Q::volume_ratio:
      return 1;
    case Q::first_piola_kirchhoff_stress:
      return static_cast<int>(tensor_names.size());
    default:
      return num_symmetric;
  }
}

void write_quantity(PointQuantity quantity, const PointStress& point, Kinematics kinematics,
                    double* out) {
  switch (quantity) {
    case Q::none:
      break;
    case Q::energy_density:
      *out = point.energy_density;
      break;
    case Q::volume_ratio:
      *out = elastogen::volume_ratio(point, kinematics);
      break;
    case Q::cauchy_stress:
      put(symmetric_components(elastogen::cauchy_stress(point, kinematics)), out);
      break;
    case Q::first_piola_kirchhoff_stress:
      for (int k = 0; k < 9; ++k) out[k] = point.first_piola(k / 3, k % 3);
      break;
    case Q::second_piola_kirchhoff_stress:
      put(symmetric_components(elastogen::second_piola_kirchhoff_stress(point, kinematics)), out);
      break;
    case Q::green_lagrange_strain:
      put(symmetric_components(elastogen::green_lagrange_strain(point, kinematics)), out);
      break;
    case Q::logarithmic_strain:
      put(symmetric_components(elastogen::logarithmic_strain(point, kinematics)), out);
      break;
  }
}

std::span<const OutputField> output_fields() { return all_fields; }

const OutputField* find_output_field(std::string_view name) {
  const auto found = std::find_if(all_fields.begin(), all_fields.end(),
                                  [&](const OutputField& field) { return field.name == name; });
  return found == all_fields.end() ? nullptr : &*found;
}

std::vector<FieldShape> field_shapes(const OutputField& field) {
  const std::string name(field.name);
  switch (field.invariant) {
    case Invariant::itself:
      break;
    case Invariant::von_mises:
      return {{name, {}}};
    case Invariant::principal_values:
      return {{name, {"1", "2", "3"}}};
    case Invariant::principal_directions: {
      std::vector<FieldShape> shapes;
      for (int k = 1; k <= 3; ++k) {
        shapes.push_back({fmt::format("principal_direction_{}", k), {"X", "Y", "Z"}});
      }
      return shapes;
    }
  }
  switch (quantity_width(field.quantity)) {
    case 1:
      return {{name, {}}};
    case num_symmetric:
      return {{name, {symmetric_names.begin(), symmetric_names.end()}}};
    default:
      return {{name, {tensor_names.begin(), tensor_names.end()}}};
  }
}

void write_field(const OutputField& field, const double* quantity, double* out) {
  if (field.invariant == Invariant::itself) {
    std::copy_n(quantity, quantity_width(field.quantity), out);
    return;
  }
  SymmetricTensor components;
  std::copy_n(quantity, num_symmetric, components.begin());
  const Eigen::Matrix3d stress = tensor_of(components);
  if (field.invariant == Invariant::von_mises) {
    *out = von_mises(stress);
    return;
  }
  const PrincipalStress principal = principal_stress(stress);
  if (field.invariant == Invariant::principal_values) {
    std::copy_n(principal.values.data(), 3, out);
  } else {
    std::copy_n(principal.directions.data(), 9, out);  // by columns: one direction after another
  }
}

}  // namespace elastogen::selector
