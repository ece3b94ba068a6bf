#include "runtime/surface_loads.h"

#include <fmt/format.h>

#include <array>
#include <cmath>

#include "runtime/error.h"

namespace elastogen {
namespace {

using Point = std::array<double, 3>;

/// A quadrature point of a face: its shape functions, and the area vector that it stands for.
struct FacePoint {
  std::array<double, 4> shape{};
  Point area{};  ///< weight times outward normal times area per reference area [m^2]
};

Point cross(const Point& a, const Point& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

Point scaled(const Point& a, double factor) {
  return {factor * a[0], factor * a[1], factor * a[2]};
}

Point difference(const Point& a, const Point& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }

double norm(const Point& a) { return std::sqrt(a[0] * a[0] + a[1] * a[1] + a[2] * a[2]); }

std::vector<Point> corners_of(const Mesh& mesh, const SurfaceFace& face) {
  const auto dim = static_cast<std::size_t>(mesh.dim);
  const bool fits = dim == 2 ? face.size() == 2 : face.size() == 3 || face.size() == 4;
  if (!fits) {
    throw InputError(fmt::format("surface face with {} nodes: must have {}", face.size(),
                                 dim == 2 ? "2 in a plane mesh" : "3 or 4"));
  }
  std::vector<Point> corners;
  for (const std::int32_t node : face) {
    if (node < 0 || static_cast<std::size_t>(node) >= mesh.num_nodes()) {
      throw InputError(fmt::format("surface face with node {}: outside the mesh; must be below {}",
                                   node, mesh.num_nodes()));
    }
    Point& corner = corners.emplace_back();
    for (std::size_t i = 0; i < dim; ++i) {
      corner[i] = mesh.positions[static_cast<std::size_t>(node) * dim + i];
    }
  }
  return corners;
}

/// 2 x 2 Gauss points of a bilinear quadrilateral: exact for the shape functions times the area
/// vector, which are polynomials of degree 2 in each coordinate.
std::vector<FacePoint> quadrilateral_points(const std::vector<Point>& x) {
  const double gauss = 1 / std::sqrt(3.0);
  std::vector<FacePoint> points;
  for (const double xi : {-gauss, gauss}) {
    for (const double eta : {-gauss, gauss}) {
      FacePoint point;
      point.shape = {(1 - xi) * (1 - eta) / 4, (1 + xi) * (1 - eta) / 4, (1 + xi) * (1 + eta) / 4,
                     (1 - xi) * (1 + eta) / 4};
      Point along_xi{}, along_eta{};
      for (std::size_t i = 0; i < 3; ++i) {
        along_xi[i] = ((1 - eta) * (x[1][i] - x[0][i]) + (1 + eta) * (x[2][i] - x[3][i])) / 4;
        along_eta[i] = ((1 - xi) * (x[3][i] - x[0][i]) + (1 + xi) * (x[2][i] - x[1][i])) / 4;
      }
      point.area = cross(along_xi, along_eta);
      points.push_back(point);
    }
  }
  return points;
}

std::vector<FacePoint> points_of(const Mesh& mesh, const SurfaceFace& face) {
  const std::vector<Point> x = corners_of(mesh, face);
  if (x.size() == 4) return quadrilateral_points(x);
  // The area vector is constant and the shape functions are linear: one point is exact.
  if (x.size() == 3) {
    const Point area = scaled(cross(difference(x[1], x[0]), difference(x[2], x[0])), 0.5);
    return {{{1.0 / 3, 1.0 / 3, 1.0 / 3, 0}, area}};
  }
  return {{{0.5, 0.5, 0, 0}, cross(difference(x[1], x[0]), {0, 0, 1})}};
}

/// f_a += sum over quadrature points of N_a force(area vector).
template <class Force>
void add_forces(const Mesh& mesh, std::span<const SurfaceFace> faces, VectorRef f,
                const Force& force) {
  const auto dim = static_cast<std::size_t>(mesh.dim);
  for (const SurfaceFace& face : faces) {
    for (const FacePoint& point : points_of(mesh, face)) {
      const Point total = force(point.area);
      for (std::size_t a = 0; a < face.size(); ++a) {
        for (std::size_t i = 0; i < dim; ++i) {
          f[static_cast<Eigen::Index>(static_cast<std::size_t>(face[a]) * dim + i)] +=
              point.shape[a] * total[i];
        }
      }
    }
  }
}

}  // namespace

void add_pressure(const Mesh& mesh, std::span<const SurfaceFace> faces, double pressure,
                  VectorRef f) {
  if (!std::isfinite(pressure)) {
    throw InputError(fmt::format("pressure {}: must be finite", pressure));
  }
  add_forces(mesh, faces, f, [&](const Point& area) { return scaled(area, -pressure); });
}

void add_traction(const Mesh& mesh, std::span<const SurfaceFace> faces,
                  std::span<const double> traction, VectorRef f) {
  if (traction.size() != static_cast<std::size_t>(mesh.dim)) {
    throw InputError(fmt::format("traction: {} components; must be {}", traction.size(), mesh.dim));
  }
  Point vector{};
  for (std::size_t i = 0; i < traction.size(); ++i) {
    if (!std::isfinite(traction[i])) {
      throw InputError(fmt::format("traction: component {}; must be finite", traction[i]));
    }
    vector[i] = traction[i];
  }
  add_forces(mesh, faces, f, [&](const Point& area) { return scaled(vector, norm(area)); });
}

double surface_area(const Mesh& mesh, std::span<const SurfaceFace> faces) {
  double area = 0;
  for (const SurfaceFace& face : faces) {
    for (const FacePoint& point : points_of(mesh, face)) area += norm(point.area);
  }
  return area;
}

}  // namespace elastogen
