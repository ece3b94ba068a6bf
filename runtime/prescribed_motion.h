// Displacements that are given as functions of time, or of the load factor of a static solve.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "runtime/constraints.h"
#include "runtime/mesh.h"
#include "runtime/vector.h"

namespace elastogen {

/// Part of a motion that has been made at a time.
class History {
 public:
  /// h(t) = t: what a static solve takes, with the load factor as t.
  History() = default;

  /// Piecewise linear between (time [s], value), constant outside.
  /// @throws InputError  no point; times that do not ascend; a number that is not finite
  [[nodiscard]] static History table(std::vector<std::pair<double, double>> points);

  /// h(t) = sin(2 pi f t) with the frequency f [Hz].
  /// @throws InputError  a frequency that is not positive and finite
  [[nodiscard]] static History sine(double frequency);

  [[nodiscard]] double operator()(double time) const;

 private:
  std::vector<std::pair<double, double>> points_;
  double frequency_ = 0;
};

/// A turn about an axis.
struct Rotation {
  std::array<double, 3> point{};           ///< on the axis [m]
  std::array<double, 3> axis = {1, 0, 0};  ///< direction; of any length but 0
  double angle = 0;                        ///< [rad], right-handed about the axis
};

/// The given displacements of constrained degrees of freedom at any time.
class PrescribedMotion {
 public:
  /// Whatever the constraints give, at all times.
  explicit PrescribedMotion(const Constraints& constraints);

  /// Each given displacement grows as h(t) = t.
  [[nodiscard]] static PrescribedMotion growing(const Constraints& constraints);

  /// Component `component` of a node moves by h(t) * displacement [m].
  /// @throws InternalError  that degree of freedom is not constrained
  void translate(std::size_t node, int component, double displacement, const History& history);

  /// Nodes turn about an axis by the angle h(t) * rotation.angle: they move on circles. In the
  /// plane the axis must be along z.
  /// @throws InputError     an axis without direction, or numbers that are not finite
  /// @throws InternalError  a degree of freedom of theirs is not constrained
  void rotate(const Mesh& mesh, std::span<const std::int32_t> nodes, const Rotation& rotation,
              const History& history);

  /// Whether anything moves by a history.
  [[nodiscard]] bool empty() const { return translations_.empty() && rotations_.empty(); }

  /// Nodes whose displacement is 0 in every component at all times, ascending.
  [[nodiscard]] std::vector<std::int32_t> held_nodes() const;

  /// Sets u to the given displacements at a time where constrained.
  void impose(double time, VectorRef u) const;

 private:
  struct Translation {
    std::size_t dof;
    double displacement;
    History history;
  };
  struct Turn {
    std::vector<std::size_t> nodes;
    std::vector<double> arms;  // [node][i]: rest position from the axis's point
    std::array<double, 3> axis;
    double angle;
    History history;
  };

  Constraints constraints_;
  std::vector<Translation> translations_;
  std::vector<Turn> rotations_;
};

}  // namespace elastogen
