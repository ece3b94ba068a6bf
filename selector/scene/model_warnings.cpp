#include "selector/scene/model_warnings.h"

#include <fmt/format.h>

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <optional>
#include <set>
#include <span>
#include <utility>

#include "selector/support/names.h"
#include "symgen/law/moduli.h"
#include "symgen/law/stability.h"

namespace elastogen::selector {
namespace {

constexpr double nearly_incompressible = 0.49;  // Poisson's ratio
constexpr double small_strain = 0.05;
constexpr double small_rotation = 5 * std::numbers::pi / 180;

double in_degrees(double angle) { return angle * 180 / std::numbers::pi; }

/// A law with values of its parameters, and where it is used.
struct MaterialUse {
  std::set<std::string> regions, linear_elements;

  [[nodiscard]] std::string where() const {
    return fmt::format("{} '{}'", regions.size() == 1 ? "region" : "regions",
                       fmt::join(regions, "', '"));
  }
};

using MaterialUses = std::map<std::pair<std::string, std::vector<double>>, MaterialUse>;

MaterialUses uses_of_materials(const Problem& problem) {
  static const std::set<std::string> linear = {"tri3",  "quad4",  "tet4",
                                               "hexa8", "prism6", "pyramid5"};
  MaterialUses uses;
  for (std::size_t b = 0; b < problem.materials.size(); ++b) {
    const BlockMaterial& material = problem.materials[b];
    const SceneMesh::Block& block = problem.mesh.blocks[b];
    MaterialUse& use = uses[{material.law, material.parameters}];
    use.regions.insert(block.region);
    if (linear.contains(block.association.element)) {
      use.linear_elements.insert(block.association.element);
    }
  }
  return uses;
}

std::string parameters_text(const symgen::Law& law, const std::vector<double>& values) {
  std::string text;
  for (std::size_t p = 0; p < values.size(); ++p) {
    text += fmt::format("{}{} = {:.6g}", p == 0 ? "" : ", ", law.parameters[p].name, values[p]);
  }
  return text;
}

std::string locking_warning(const std::string& law, const MaterialUse& use, double poisson,
                            int dim) {
  return fmt::format(
      "{}: law '{}' is nearly incompressible (nu = {:.6g} > {}), where the linear elements {} "
      "lock: they bend and shear several times too little; {} (docs/stability.md, which "
      "elements lock)",
      use.where(), law, poisson, nearly_incompressible, fmt::join(use.linear_elements, ", "),
      dim == 2
          ? "there are no quadratic plane elements: take a slice of hexa20 or tet10 in 3D, held "
            "across its thickness"
          : "take hexa20 or tet10");
}

std::string unstable_at_rest_warning(const symgen::Law& law, const std::vector<double>& parameters,
                                     const MaterialUse& use, const symgen::ModuliAtRest& moduli) {
  return fmt::format(
      "{}: law '{}' is unstable at rest with {}: its shear modulus is {:.6g} Pa and 3 lambda + 2 "
      "mu is {:.6g} Pa, both must be > 0; mend the parameters",
      use.where(), law.name, parameters_text(law, parameters), moduli.mu,
      3 * moduli.lambda + 2 * moduli.mu);
}

std::string unstable_stretch_warning(const symgen::Law& law, const std::vector<double>& parameters,
                                     const MaterialUse& use,
                                     const std::vector<symgen::UnstableStretch>& unstable) {
  std::vector<std::string> modes;
  for (const symgen::UnstableStretch& one : unstable) {
    modes.push_back(fmt::format("{} beyond a stretch of {:.3g}", one.mode, one.stretch));
  }
  return fmt::format(
      "{}: law '{}' with {} is unstable in {}: an increment of strain takes less stress there; "
      "mend the parameters, or stay below",
      use.where(), law.name, parameters_text(law, parameters), fmt::join(modes, ", "));
}

/// Largest principal strain in size, and rotation [rad], of F = R U.
struct StrainAndRotation {
  double strain = 0, rotation = 0;

  /// How far beyond what is small.
  [[nodiscard]] double excess() const {
    return std::max(strain / small_strain, rotation / small_rotation);
  }
};

/// By the principal axes of F^T F. The third axis of both frames is the product of the others, so
/// that R is a rotation and what is turned inside out has a negative stretch along it, the
/// smallest.
StrainAndRotation strain_and_rotation(const Eigen::Matrix3d& gradient) {
  const Eigen::Matrix3d f = Eigen::Matrix3d::Identity() + gradient;
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> principal(f.transpose() * f);
  Eigen::Matrix3d before, after;
  before.col(0) = principal.eigenvectors().col(2);
  before.col(1) = principal.eigenvectors().col(1);
  before.col(2) = before.col(0).cross(before.col(1));
  const Eigen::Matrix3d images = f * before;
  after.col(0) = images.col(0).normalized();
  after.col(1) = images.col(1).normalized();
  after.col(2) = after.col(0).cross(after.col(1));
  const Eigen::Vector3d stretches = after.cwiseProduct(images).colwise().sum();
  const Eigen::Matrix3d r = after * before.transpose();
  const Eigen::Vector3d axis(r(2, 1) - r(1, 2), r(0, 2) - r(2, 0), r(1, 0) - r(0, 1));
  return {(stretches.array() - 1).abs().maxCoeff(), std::atan2(axis.norm(), r.trace() - 1)};
}

/// Elements of which something is said, and the worst of them; the first of equally bad ones.
struct Elements {
  std::size_t count = 0, of = 0, worst = 0;
  StrainAndRotation most;

  void add(std::size_t element, const StrainAndRotation& found) {
    if (count++ > 0 && found.excess() <= most.excess()) return;
    worst = element;
    most = found;
  }
};

std::string inverted_warning(const Mesh& mesh, const Elements& inverted) {
  return fmt::format(
      "{} of {} elements {} inside out at the end (det F <= 0 at a point), the first is element "
      "{}: the result means nothing there; load in more and smaller steps, divide the mesh more "
      "finely there, or take a law that resists being crushed, like neo_hookean",
      inverted.count, inverted.of, inverted.count == 1 ? "is" : "are",
      mesh.element_number(inverted.worst));
}

std::string not_small_warning(const Mesh& mesh, const std::string& law, const Elements& beyond) {
  return fmt::format(
      "law '{}' is for small displacements and rotations, but {} of its {} elements are strained "
      "by more than {:g} % or turned by more than {:g} degrees at the end, most of all element {}, "
      "by {:.3g} % and {:.3g} degrees: take stvk or neo_hookean",
      law, beyond.count, beyond.of, 100 * small_strain, in_degrees(small_rotation),
      mesh.element_number(beyond.worst), 100 * beyond.most.strain,
      in_degrees(beyond.most.rotation));
}

bool is_inverted(const PointStress& point) {
  return (Eigen::Matrix3d::Identity() + point.gradient).determinant() <= 0;
}

std::span<const PointStress> points_of(const StressField& field, std::size_t element) {
  return {field.points.data() + field.first[element],
          field.first[element + 1] - field.first[element]};
}

StrainAndRotation most_of(std::span<const PointStress> points) {
  StrainAndRotation most;
  for (const PointStress& point : points) {
    const StrainAndRotation found = strain_and_rotation(point.gradient);
    if (found.excess() > most.excess()) most = found;
  }
  return most;
}

}  // namespace

std::vector<std::string> material_warnings(const Problem& problem) {
  std::vector<std::string> warnings;
  for (const auto& [material, use] : uses_of_materials(problem)) {
    const auto& [name, parameters] = material;
    const symgen::Law& law = problem.laws.at(name);
    const std::optional<symgen::ModuliAtRest> moduli = symgen::moduli_at_rest(law, parameters);
    if (!moduli) continue;  // no run can start from such a rest state; it says so
    if (!moduli->is_stable()) {
      warnings.push_back(unstable_at_rest_warning(law, parameters, use, *moduli));
      continue;
    }
    if (moduli->poisson() > nearly_incompressible && !use.linear_elements.empty()) {
      warnings.push_back(locking_warning(name, use, moduli->poisson(), problem.mesh.mesh.dim));
    }
    if (law.small_strain || symgen::follows_from_young_poisson(law)) continue;
    const std::vector<symgen::UnstableStretch> unstable =
        symgen::unstable_stretches(law, parameters);
    if (!unstable.empty()) {
      warnings.push_back(unstable_stretch_warning(law, parameters, use, unstable));
    }
  }
  return warnings;
}

std::vector<std::string> deformation_warnings(const Problem& problem, const StressField& field) {
  Elements inverted;
  inverted.of = problem.mesh.mesh.num_elements();
  std::map<std::string, Elements> not_small;  // by law
  std::size_t element = 0;
  for (std::size_t b = 0; b < problem.materials.size(); ++b) {
    const std::string& law = problem.materials[b].law;
    const bool shall_be_small = problem.laws.at(law).small_strain;
    for (std::size_t e = 0; e < problem.mesh.mesh.blocks[b].num_elements(); ++e, ++element) {
      const std::span<const PointStress> points = points_of(field, element);
      if (std::any_of(points.begin(), points.end(), is_inverted)) inverted.add(element, {});
      if (!shall_be_small) continue;
      ++not_small[law].of;
      const StrainAndRotation most = most_of(points);
      if (most.excess() > 1) not_small[law].add(element, most);
    }
  }
  std::vector<std::string> warnings;
  if (inverted.count > 0) warnings.push_back(inverted_warning(problem.mesh.mesh, inverted));
  for (const auto& [law, beyond] : not_small) {
    if (beyond.count > 0) warnings.push_back(not_small_warning(problem.mesh.mesh, law, beyond));
  }
  return warnings;
}

}  // namespace elastogen::selector
