#include "runtime/face_points.h"

#include <fmt/format.h>

#include <cmath>
#include <span>

#include "runtime/error.h"

namespace elastogen {
namespace {

FacePosition cross(const FacePosition& a, const FacePosition& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

FacePosition difference(const FacePosition& a, const FacePosition& b) {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}

FacePosition scaled(const FacePosition& a, double factor) {
  return {factor * a[0], factor * a[1], factor * a[2]};
}

/// Shape functions and their slopes along both reference coordinates, [node].
struct ShapeValues {
  std::array<double, most_face_nodes> value{}, along_xi{}, along_eta{};
};

/// A reference point and its weight.
struct ReferencePoint {
  double xi, eta, weight;
};

constexpr std::array<std::array<double, 2>, 4> square = {{{-1, -1}, {1, -1}, {1, 1}, {-1, 1}}};

ShapeValues bilinear(const ReferencePoint& p) {
  ShapeValues shape;
  for (std::size_t a = 0; a < 4; ++a) {
    const double u = 1 + square[a][0] * p.xi, v = 1 + square[a][1] * p.eta;
    shape.value[a] = u * v / 4;
    shape.along_xi[a] = square[a][0] * v / 4;
    shape.along_eta[a] = u * square[a][1] / 4;
  }
  return shape;
}

/// Nodes in the middle of edges: (1 - xi^2)(1 +- eta) / 2 and turned; half of each is taken from
/// the bilinear functions of the corners beside it.
ShapeValues serendipity(const ReferencePoint& p) {
  ShapeValues shape = bilinear(p);
  for (std::size_t edge = 0; edge < 4; ++edge) {
    const std::size_t node = 4 + edge, next = (edge + 1) % 4;
    const bool lies_along_xi = edge % 2 == 0;
    const double along = lies_along_xi ? p.xi : p.eta;
    const double side = square[edge][lies_along_xi ? 1 : 0];
    const double across = 1 + side * (lies_along_xi ? p.eta : p.xi);
    const double bubble = 1 - along * along;
    shape.value[node] = bubble * across / 2;
    (lies_along_xi ? shape.along_xi : shape.along_eta)[node] = -along * across;
    (lies_along_xi ? shape.along_eta : shape.along_xi)[node] = bubble * side / 2;
    for (const std::size_t corner : {edge, next}) {
      shape.value[corner] -= shape.value[node] / 2;
      shape.along_xi[corner] -= shape.along_xi[node] / 2;
      shape.along_eta[corner] -= shape.along_eta[node] / 2;
    }
  }
  return shape;
}

/// With barycentric coordinates L: L (2 L - 1) at corners, 4 L L' in the middle of edges.
ShapeValues quadratic_triangle(const ReferencePoint& p) {
  const std::array<double, 3> l = {1 - p.xi - p.eta, p.xi, p.eta};
  constexpr std::array<double, 3> l_xi = {-1, 1, 0}, l_eta = {-1, 0, 1};
  ShapeValues shape;
  for (std::size_t a = 0; a < 3; ++a) {
    const std::size_t b = (a + 1) % 3;
    shape.value[a] = l[a] * (2 * l[a] - 1);
    shape.along_xi[a] = (4 * l[a] - 1) * l_xi[a];
    shape.along_eta[a] = (4 * l[a] - 1) * l_eta[a];
    shape.value[3 + a] = 4 * l[a] * l[b];
    shape.along_xi[3 + a] = 4 * (l_xi[a] * l[b] + l[a] * l_xi[b]);
    shape.along_eta[3 + a] = 4 * (l_eta[a] * l[b] + l[a] * l_eta[b]);
  }
  return shape;
}

std::vector<ReferencePoint> gauss_square(std::span<const std::array<double, 2>> line) {
  std::vector<ReferencePoint> points;
  for (const auto& [xi, weight_xi] : line) {
    for (const auto& [eta, weight_eta] : line) points.push_back({xi, eta, weight_xi * weight_eta});
  }
  return points;
}

/// Radon, Zur mechanischen Kubatur, Monatsh. Math. 52, 1948: degree 5.
std::vector<ReferencePoint> radon_triangle() {
  const double root = std::sqrt(15.0);
  std::vector<ReferencePoint> points = {{1.0 / 3, 1.0 / 3, 9.0 / 80}};
  for (const double sign : {-1.0, 1.0}) {
    const double common = (6 + sign * root) / 21, apart = 1 - 2 * common;
    const double weight = (155 + sign * root) / 2400;
    points.push_back({common, common, weight});
    points.push_back({apart, common, weight});
    points.push_back({common, apart, weight});
  }
  return points;
}

template <class Shape>
std::vector<FacePoint> mapped(const std::vector<FacePosition>& nodes, const Shape& shape_at,
                              const std::vector<ReferencePoint>& rule) {
  std::vector<FacePoint> points;
  for (const ReferencePoint& reference : rule) {
    const ShapeValues shape = shape_at(reference);
    FacePosition along_xi{}, along_eta{};
    for (std::size_t a = 0; a < nodes.size(); ++a) {
      for (std::size_t i = 0; i < 3; ++i) {
        along_xi[i] += shape.along_xi[a] * (nodes[a][i] - nodes[0][i]);
        along_eta[i] += shape.along_eta[a] * (nodes[a][i] - nodes[0][i]);
      }
    }
    points.push_back({shape.value, scaled(cross(along_xi, along_eta), reference.weight)});
  }
  return points;
}

}  // namespace

std::vector<FacePoint> face_points(const std::vector<FacePosition>& nodes) {
  const double two = 1 / std::sqrt(3.0), three = std::sqrt(0.6);
  switch (nodes.size()) {
    case 2:
      return {{{0.5, 0.5}, cross(difference(nodes[1], nodes[0]), {0, 0, 1})}};
    case 3: {
      const FacePosition area =
          scaled(cross(difference(nodes[1], nodes[0]), difference(nodes[2], nodes[0])), 0.5);
      return {{{1.0 / 3, 1.0 / 3, 1.0 / 3}, area}};
    }
    case 4:
      return mapped(nodes, bilinear,
                    gauss_square(std::array<std::array<double, 2>, 2>{{{-two, 1}, {two, 1}}}));
    case 6:
      return mapped(nodes, quadratic_triangle, radon_triangle());
    case 8:
      return mapped(nodes, serendipity,
                    gauss_square(std::array<std::array<double, 2>, 3>{
                        {{-three, 5.0 / 9}, {0, 8.0 / 9}, {three, 5.0 / 9}}}));
    default:
      throw InternalError(fmt::format("no rule for a face of {} nodes", nodes.size()));
  }
}

}  // namespace elastogen
