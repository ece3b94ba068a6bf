#include "runtime/surface_loads.h"

#include <fmt/format.h>

#include <cmath>

#include "runtime/error.h"
#include "runtime/face_points.h"

namespace elastogen {
namespace {

using Point = FacePosition;

Point scaled(const Point& a, double factor) {
  return {factor * a[0], factor * a[1], factor * a[2]};
}

double norm(const Point& a) { return std::sqrt(a[0] * a[0] + a[1] * a[1] + a[2] * a[2]); }

std::vector<Point> positions_of(const Mesh& mesh, const SurfaceFace& face) {
  const auto dim = static_cast<std::size_t>(mesh.dim);
  const std::size_t count = face.size();
  const bool fits = dim == 2 ? count == 2 : count == 3 || count == 4 || count == 6 || count == 8;
  if (!fits) {
    throw InputError(fmt::format("surface face with {} nodes: must have {}", face.size(),
                                 dim == 2 ? "2 in a plane mesh" : "3, 4, 6 or 8"));
  }
  std::vector<Point> positions;
  for (const std::int32_t node : face) {
    if (node < 0 || static_cast<std::size_t>(node) >= mesh.num_nodes()) {
      throw InputError(fmt::format("surface face with node {}: outside the mesh; must be below {}",
                                   node, mesh.num_nodes()));
    }
    Point& position = positions.emplace_back();
    for (std::size_t i = 0; i < dim; ++i) {
      position[i] = mesh.positions[static_cast<std::size_t>(node) * dim + i];
    }
  }
  return positions;
}

std::vector<FacePoint> points_of(const Mesh& mesh, const SurfaceFace& face) {
  return face_points(positions_of(mesh, face));
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
