// Saint-Venant Kirchhoff kernels written straight from the textbook, as the runtime's tests need
// kernels that owe nothing to the generator.
//
//   F = I + H, E = (H + H^T + H^T H) / 2, S = lambda tr(E) I + 2 mu E, P = F S
//   W = sum_q w_q (lambda / 2 tr(E)^2 + mu E : E), f_a = -sum_q w_q P grad Lambda_a
//   dP = dF S + F (lambda tr(dE) I + 2 mu dE), dE = sym(F^T dF)
//
// Source: Bonet & Wood, Nonlinear Continuum Mechanics, 2nd ed., sections 6.4 and 9.4.
#pragma once

#include <Eigen/Dense>
#include <cmath>
#include <vector>

#include "runtime/kernel_abi.h"
#include "runtime/nodal_pass.h"
#include "tests/unit/each_batch.h"

namespace elastogen::test {

using Matrix3 = Eigen::Matrix3d;
using Vector3 = Eigen::Vector3d;

struct Tet4 {
  static constexpr const char* name = "tet4";
  static constexpr int num_nodes = 4;
  static constexpr int num_points = 1;
  using Nodes3 = Eigen::Matrix<double, 3, num_nodes>;

  static double weight(int) { return 1.0 / 6; }
  static Vector3 point(int) { return Vector3::Constant(0.25); }
  static Eigen::Matrix<double, num_nodes, 1> values_at(const Vector3& at) {
    return {1 - at.sum(), at[0], at[1], at[2]};
  }
  static Nodes3 gradients_at(const Vector3&) {
    Nodes3 g;
    g << -1, 1, 0, 0, -1, 0, 1, 0, -1, 0, 0, 1;
    return g;
  }
  static Eigen::Matrix<double, num_nodes, 1> values(int q) { return values_at(point(q)); }
  static Nodes3 gradients(int q) { return gradients_at(point(q)); }
  /// Four points, exact for products of two linear functions (Keast 1986).
  template <class Add>
  static void add_rich_points(Add&& add) {
    const double a = (5 - std::sqrt(5.0)) / 20, b = (5 + 3 * std::sqrt(5.0)) / 20;
    add({a, a, a}, 1.0 / 24);
    add({b, a, a}, 1.0 / 24);
    add({a, b, a}, 1.0 / 24);
    add({a, a, b}, 1.0 / 24);
  }
};

struct Hexa8 {
  static constexpr const char* name = "hexa8";
  static constexpr int num_nodes = 8;
  static constexpr int num_points = 8;
  using Nodes3 = Eigen::Matrix<double, 3, num_nodes>;

  static Vector3 corner(int a) {
    return Vector3((a % 4 == 1 || a % 4 == 2) ? 1 : -1, a % 4 >= 2 ? 1 : -1, a >= 4 ? 1 : -1);
  }
  static Vector3 point(int q) { return corner(q) / std::sqrt(3.0); }
  static double weight(int) { return 1; }
  static Eigen::Matrix<double, num_nodes, 1> values_at(const Vector3& at) {
    Eigen::Matrix<double, num_nodes, 1> v;
    for (int a = 0; a < num_nodes; ++a) {
      v[a] = (Vector3::Ones() + corner(a).cwiseProduct(at)).prod() / 8;
    }
    return v;
  }
  static Nodes3 gradients_at(const Vector3& at) {
    Nodes3 g;
    for (int a = 0; a < num_nodes; ++a) {
      const Vector3 s = corner(a);
      const Vector3 t = Vector3::Ones() + s.cwiseProduct(at);
      g.col(a) = Vector3(s[0] * t[1] * t[2], s[1] * t[0] * t[2], s[2] * t[0] * t[1]) / 8;
    }
    return g;
  }
  static Eigen::Matrix<double, num_nodes, 1> values(int q) { return values_at(point(q)); }
  static Nodes3 gradients(int q) { return gradients_at(point(q)); }
  /// Three Gauss points in each direction.
  template <class Add>
  static void add_rich_points(Add&& add) {
    const double x[3] = {-std::sqrt(0.6), 0, std::sqrt(0.6)}, w[3] = {5.0 / 9, 8.0 / 9, 5.0 / 9};
    for (int k = 0; k < 27; ++k) {
      const int i = k % 3, j = k / 3 % 3, l = k / 9;
      add({x[i], x[j], x[l]}, w[i] * w[j] * w[l]);
    }
  }
};

/// Shape functions of an element at points of its reference shape.
template <class Element>
struct PointTable {
  std::vector<double> weights, shapes, gradients;

  void add(const Vector3& at, double weight) {
    weights.push_back(weight);
    const auto values = Element::values_at(at);
    const auto slopes = Element::gradients_at(at);
    shapes.insert(shapes.end(), values.data(), values.data() + values.size());
    gradients.insert(gradients.end(), slopes.data(), slopes.data() + slopes.size());
  }
  [[nodiscard]] ReferencePoints view() const {
    return {static_cast<std::int32_t>(weights.size()), weights.data(), shapes.data(),
            gradients.data()};
  }
};

template <class Element>
ReferencePoints reference_points() {
  static const PointTable<Element> table = [] {
    PointTable<Element> points;
    for (int q = 0; q < Element::num_points; ++q) points.add(Element::point(q), Element::weight(q));
    return points;
  }();
  return table.view();
}

template <class Element>
ReferencePoints rich_points() {
  static const PointTable<Element> table = [] {
    PointTable<Element> points;
    Element::add_rich_points([&](const Vector3& at, double weight) { points.add(at, weight); });
    return points;
  }();
  return table.view();
}

/// Kernels of one element type for batches of `Lanes`.
///
/// Constants per element: at point q the gradients [q][a][i], then the weights w_q det J. With
/// FromPositions there are none: every kernel derives them from the rest positions.
template <class Element, int Lanes, bool FromPositions>
struct ReferenceKernels {
  using Arguments = KernelArguments<double>;
  using Nodes3 = typename Element::Nodes3;
  static constexpr int n = Element::num_nodes;
  static constexpr int points = Element::num_points;
  static constexpr int per_point = 3 * n + 1;
  static constexpr int num_constants = FromPositions ? 0 : points * per_point;
  static constexpr int num_state = 9 * points;

  struct Point {
    Nodes3 gradients;
    double weight;
  };

  static Nodes3 load(const double* values, int lane) {
    Nodes3 m;
    for (int a = 0; a < n; ++a) {
      for (int i = 0; i < 3; ++i) m(i, a) = values[(3 * a + i) * Lanes + lane];
    }
    return m;
  }

  static Matrix3 jacobian(const Nodes3& positions, int q) {
    return positions * Element::gradients(q).transpose();
  }

  static Point point(const Arguments& args, int q, int lane) {
    if constexpr (FromPositions) {
      const Matrix3 j = jacobian(load(args.positions, lane), q);
      return {j.inverse().transpose() * Element::gradients(q),
              Element::weight(q) * j.determinant()};
    } else {
      Point p;
      const double* c = args.constants + q * per_point * Lanes + lane;
      for (int a = 0; a < n; ++a) {
        for (int i = 0; i < 3; ++i) p.gradients(i, a) = c[(3 * a + i) * Lanes];
      }
      p.weight = c[3 * n * Lanes];
      return p;
    }
  }

  static Matrix3 strain(const Matrix3& h) { return (h + h.transpose() + h.transpose() * h) / 2; }

  static Matrix3 stress(const Arguments& args, const Matrix3& e) {
    return args.parameters[0] * e.trace() * Matrix3::Identity() + 2 * args.parameters[1] * e;
  }

  static Matrix3 stress_change(const Arguments& args, const Matrix3& h, const Matrix3& dh) {
    const Matrix3 f = Matrix3::Identity() + h;
    const Matrix3 de = (f.transpose() * dh + dh.transpose() * f) / 2;
    return dh * stress(args, strain(h)) + f * stress(args, de);
  }

  static void report(const Arguments& args, int lane, double result, const Matrix3& h) {
    if (args.status == nullptr) return;
    if (!std::isfinite(result)) args.status[lane] |= status_not_finite;
    // Saint-Venant Kirchhoff has no such limit; flagged here so that tests can leave a domain.
    if ((Matrix3::Identity() + h).determinant() <= 0) args.status[lane] |= status_outside_domain;
  }

  static void clear(double* output, int lane, int values) {
    for (int k = 0; k < values; ++k) output[k * Lanes + lane] = 0;
  }

  static void add_nodal(double* output, int lane, double scale, const Nodes3& value) {
    for (int a = 0; a < n; ++a) {
      for (int i = 0; i < 3; ++i) output[(3 * a + i) * Lanes + lane] += scale * value(i, a);
    }
  }

  static void constants(const Arguments& args) {
    if constexpr (!FromPositions) {
      for (int lane = 0; lane < Lanes; ++lane) {
        for (int q = 0; q < points; ++q) {
          const Matrix3 j = jacobian(load(args.positions, lane), q);
          const Nodes3 g = j.inverse().transpose() * Element::gradients(q);
          double* c = args.output + q * per_point * Lanes + lane;
          for (int a = 0; a < n; ++a) {
            for (int i = 0; i < 3; ++i) c[(3 * a + i) * Lanes] = g(i, a);
          }
          c[3 * n * Lanes] = Element::weight(q) * j.determinant();
        }
      }
    }
  }

  static void geometry_measures(const Arguments& args) {
    for (int lane = 0; lane < Lanes; ++lane) {
      Eigen::Matrix<double, n, 1> volumes = Eigen::Matrix<double, n, 1>::Zero();
      for (int q = 0; q < points; ++q) {
        const double det = jacobian(load(args.positions, lane), q).determinant();
        volumes += Element::weight(q) * det * Element::values(q);
        args.output[(2 * n + q) * Lanes + lane] = det;
      }
      for (int a = 0; a < n; ++a) {
        args.output[a * Lanes + lane] = volumes[a];
        args.output[(n + a) * Lanes + lane] = volumes[a];
      }
    }
  }

  static void energy(const Arguments& args) {
    for (int lane = 0; lane < Lanes; ++lane) {
      args.output[lane] = 0;
      const Nodes3 u = load(args.displacement, lane);
      for (int q = 0; q < points; ++q) {
        const Point p = point(args, q, lane);
        const Matrix3 h = u * p.gradients.transpose();
        const Matrix3 e = strain(h);
        const double w = p.weight * (args.parameters[0] / 2 * e.trace() * e.trace() +
                                     args.parameters[1] * e.squaredNorm());
        args.output[lane] += w;
        report(args, lane, w, h);
      }
    }
  }

  static void forces(const Arguments& args) {
    for (int lane = 0; lane < Lanes; ++lane) {
      clear(args.output, lane, 3 * n);
      const Nodes3 u = load(args.displacement, lane);
      for (int q = 0; q < points; ++q) {
        const Point p = point(args, q, lane);
        const Matrix3 h = u * p.gradients.transpose();
        const Matrix3 stress1 = (Matrix3::Identity() + h) * stress(args, strain(h));
        add_nodal(args.output, lane, -p.weight, stress1 * p.gradients);
        report(args, lane, stress1.sum(), h);
      }
    }
  }

  static void product(const Arguments& args) {
    for (int lane = 0; lane < Lanes; ++lane) {
      clear(args.output, lane, 3 * n);
      const Nodes3 u = load(args.displacement, lane);
      const Nodes3 v = load(args.direction, lane);
      for (int q = 0; q < points; ++q) {
        const Point p = point(args, q, lane);
        const Matrix3 h = u * p.gradients.transpose();
        const Matrix3 dp = stress_change(args, h, v * p.gradients.transpose());
        add_nodal(args.output, lane, -p.weight, dp * p.gradients);
        report(args, lane, dp.sum(), h);
      }
    }
  }

  // The state is H at every point.
  static void linearize(const Arguments& args) {
    for (int lane = 0; lane < Lanes; ++lane) {
      const Nodes3 u = load(args.displacement, lane);
      for (int q = 0; q < points; ++q) {
        const Matrix3 h = u * point(args, q, lane).gradients.transpose();
        for (int k = 0; k < 9; ++k) args.output[(9 * q + k) * Lanes + lane] = h.data()[k];
        report(args, lane, h.sum(), h);
      }
    }
  }

  static void apply(const Arguments& args) {
    for (int lane = 0; lane < Lanes; ++lane) {
      clear(args.output, lane, 3 * n);
      const Nodes3 v = load(args.direction, lane);
      for (int q = 0; q < points; ++q) {
        const Point p = point(args, q, lane);
        Matrix3 h;
        for (int k = 0; k < 9; ++k) h.data()[k] = args.state[(9 * q + k) * Lanes + lane];
        const Matrix3 dp = stress_change(args, h, v * p.gradients.transpose());
        add_nodal(args.output, lane, -p.weight, dp * p.gradients);
        report(args, lane, dp.sum(), h);
      }
    }
  }

  static void stress_at_points(const Arguments& args) {
    for (int lane = 0; lane < Lanes; ++lane) {
      const Nodes3 u = load(args.displacement, lane);
      for (int q = 0; q < points; ++q) {
        const Matrix3 j = jacobian(load(args.positions, lane), q);
        const Matrix3 h = u * (j.inverse().transpose() * Element::gradients(q)).transpose();
        const Matrix3 e = strain(h);
        const Matrix3 p = (Matrix3::Identity() + h) * stress(args, e);
        double* out = args.output + q * stress_numbers * Lanes + lane;
        for (int i = 0; i < 3; ++i) {
          for (int k = 0; k < 3; ++k) {
            out[(3 * i + k) * Lanes] = h(i, k);
            out[(9 + 3 * i + k) * Lanes] = p(i, k);
          }
        }
        out[18 * Lanes] =
            args.parameters[0] / 2 * e.trace() * e.trace() + args.parameters[1] * e.squaredNorm();
        out[19 * Lanes] = Element::weight(q) * j.determinant();
        report(args, lane, p.sum(), h);
      }
    }
  }

  static void stiffness(const Arguments& args) {
    constexpr int size = 3 * n;
    for (int lane = 0; lane < Lanes; ++lane) {
      const Nodes3 u = load(args.displacement, lane);
      clear(args.output, lane, size * size);
      for (int q = 0; q < points; ++q) {
        const Point p = point(args, q, lane);
        const Matrix3 h = u * p.gradients.transpose();
        report(args, lane, h.sum(), h);
        for (int b = 0; b < n; ++b) {
          for (int j = 0; j < 3; ++j) {
            const Matrix3 dh = Vector3::Unit(j) * p.gradients.col(b).transpose();
            const Nodes3 column = p.weight * stress_change(args, h, dh) * p.gradients;
            for (int row = 0; row < size; ++row) {
              args.output[(row * size + 3 * b + j) * Lanes + lane] += column(row % 3, row / 3);
            }
          }
        }
      }
    }
  }

  static VariantTable<double> make_variant(const char* geometry) {
    return {geometry,
            num_constants,
            num_state,
            FromPositions,
            most_batches_at_once,
            {1, 1, 1},
            each_batch<&constants>,
            each_batch<&geometry_measures>,
            each_batch<&energy>,
            each_batch<&forces>,
            each_batch<&product>,
            each_batch<&linearize>,
            each_batch<&apply>,
            each_batch<&stiffness>,
            each_batch<&stress_at_points>};
  }

  /// @param with_box  adds a variant "box" that computes the same
  static KernelTable<double> table(bool with_box = false) {
    static const char* const parameter_names[] = {"lambda", "mu"};
    static const VariantTable<double> variants[] = {make_variant("general"), make_variant("box")};
    return {kernel_abi_version,
            Lanes,
            "stvk-reference",
            Element::name,
            "",
            "native",
            3,
            n,
            points,
            2,
            parameter_names,
            &kernel::nodal_pass<std::conditional_t<Lanes == 1, double, kernel::Pack<double, Lanes>>,
                                n, 3>,
            with_box ? 2 : 1,
            variants,
            reference_points<Element>(),
            rich_points<Element>()};
  }
};

// Compiled once, in reference_kernels.cpp.
extern template struct ReferenceKernels<Hexa8, 4, false>;
extern template struct ReferenceKernels<Hexa8, 8, false>;
extern template struct ReferenceKernels<Hexa8, 8, true>;
extern template struct ReferenceKernels<Tet4, 1, false>;
extern template struct ReferenceKernels<Tet4, 4, false>;
extern template struct ReferenceKernels<Tet4, 8, false>;
extern template struct ReferenceKernels<Tet4, 8, true>;

}  // namespace elastogen::test
