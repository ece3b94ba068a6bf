#include "selector/scene/sphere_mesh.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>

#include "runtime/error.h"
#include "selector/io/element_topology.h"
#include "selector/io/mesh_faces.h"
#include "selector/scene/cube_cuts.h"
#include "selector/scene/mid_edge_nodes.h"

namespace elastogen::selector {
namespace {

/// The surface of the unit sphere in the first octant, divided into polygons.
struct SurfaceMesh {
  std::vector<Eigen::Vector3d> directions;      ///< of nodes, of length 1
  std::vector<std::vector<std::size_t>> faces;  ///< nodes, counter-clockwise seen from outside
};

/// Nodes by their place in the plane x + y + z = constant, in whole numbers: equal places are one
/// node.
class SurfaceBuilder {
 public:
  std::size_t node(const std::array<long, 3>& place) {
    const auto [entry, is_new] = numbers_.emplace(place, mesh_.directions.size());
    if (is_new) {
      mesh_.directions.push_back(Eigen::Vector3d(static_cast<double>(place[0]),
                                                 static_cast<double>(place[1]),
                                                 static_cast<double>(place[2]))
                                     .normalized());
    }
    return entry->second;
  }
  void add_face(const std::vector<std::array<long, 3>>& places) {
    std::vector<std::size_t>& face = mesh_.faces.emplace_back();
    for (const auto& place : places) face.push_back(node(place));
  }
  [[nodiscard]] const SurfaceMesh& mesh() const { return mesh_; }

 private:
  SurfaceMesh mesh_;
  std::map<std::array<long, 3>, std::size_t> numbers_;
};

SurfaceMesh triangles(int cells) {
  const long n = cells;
  const auto at = [n](long i, long j) { return std::array<long, 3>{n - i - j, i, j}; };
  SurfaceBuilder builder;
  for (long i = 0; i < n; ++i) {
    for (long j = 0; i + j < n; ++j) {
      builder.add_face({at(i, j), at(i + 1, j), at(i, j + 1)});
      if (i + j + 1 < n) builder.add_face({at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)});
    }
  }
  return builder.mesh();
}

/// Three patches: from a corner, along the halves of its two edges, to the middle.
SurfaceMesh quadrilaterals(int cells) {
  const long n = cells;
  SurfaceBuilder builder;
  for (std::size_t corner = 0; corner < 3; ++corner) {
    const auto at = [&](long i, long j) {
      // Bilinear between corner (6, 0, 0), middles of edges (3, 3, 0), (3, 0, 3) and (2, 2, 2).
      std::array<long, 3> place{};
      place[corner] = 6 * (n - i) * (n - j) + 3 * i * (n - j) + 3 * (n - i) * j + 2 * i * j;
      place[(corner + 1) % 3] = 3 * i * (n - j) + 2 * i * j;
      place[(corner + 2) % 3] = 3 * (n - i) * j + 2 * i * j;
      return place;
    };
    for (long i = 0; i < n; ++i) {
      for (long j = 0; j < n; ++j) {
        builder.add_face({at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)});
      }
    }
  }
  return builder.mesh();
}

/// A surface in layers: node s of the surface in layer k is k * size + s.
class Shell {
 public:
  Shell(const SphereDescription& sphere, SurfaceMesh surface)
      : sphere_(sphere), surface_(std::move(surface)) {}

  [[nodiscard]] const SurfaceMesh& surface() const { return surface_; }
  [[nodiscard]] int layers() const { return sphere_.cells[1]; }
  [[nodiscard]] std::int32_t node(int layer, std::size_t s) const {
    return static_cast<std::int32_t>(static_cast<std::size_t>(layer) * surface_.directions.size() +
                                     s);
  }
  [[nodiscard]] double radius(int layer) const {
    return sphere_.inner *
           std::pow(sphere_.outer / sphere_.inner, static_cast<double>(layer) / layers());
  }
  [[nodiscard]] std::vector<std::int32_t> face(int layer, std::size_t number) const {
    std::vector<std::int32_t> nodes;
    for (const std::size_t s : surface_.faces[number]) nodes.push_back(node(layer, s));
    return nodes;
  }

 private:
  const SphereDescription& sphere_;
  SurfaceMesh surface_;
};

void append(Mesh& mesh, const Eigen::Vector3d& position) {
  mesh.positions.insert(mesh.positions.end(), position.data(), position.data() + 3);
}

/// Three tetrahedra of a prism. Each quadrilateral is cut from its lower node of the lower number,
/// whichever prism it is seen from.
std::vector<std::vector<std::int32_t>> cut_prism(const std::vector<std::int32_t>& prism) {
  std::array<std::size_t, 3> order = {0, 1, 2};
  std::sort(order.begin(), order.end(),
            [&](std::size_t a, std::size_t b) { return prism[a] < prism[b]; });
  const auto low = [&](std::size_t k) { return prism[order[k]]; };
  const auto high = [&](std::size_t k) { return prism[3 + order[k]]; };
  std::vector<std::vector<std::int32_t>> tetrahedra = {{low(0), low(1), low(2), high(2)},
                                                       {low(0), low(1), high(2), high(1)},
                                                       {low(0), high(1), high(2), high(0)}};
  const bool turned = (order[0] > order[1]) ^ (order[0] > order[2]) ^ (order[1] > order[2]);
  if (turned) {
    for (auto& nodes : tetrahedra) std::swap(nodes[0], nodes[1]);
  }
  return tetrahedra;
}

/// The elements of the cell over one face, its lower nodes first.
std::vector<std::vector<std::int32_t>> cut_cell(const std::string& element,
                                                std::vector<std::int32_t> cell) {
  if (element == "prism6") return {cell};
  if (element == "tet4") return cut_prism(cell);
  std::vector<std::vector<std::int32_t>> elements;
  for (const std::vector<int>& local : cube_cut(element).elements) {
    std::vector<std::int32_t>& nodes = elements.emplace_back();
    for (const int a : local) nodes.push_back(cell[static_cast<std::size_t>(a)]);
  }
  return elements;
}

/// Makes the elements quadratic, edges between nodes of one radius on the sphere of that radius.
void add_curved_edges(Mesh& mesh, const std::string& element) {
  const auto position = [&](std::int32_t node) {
    return Eigen::Map<Eigen::Vector3d>(mesh.positions.data() + 3 * node);
  };
  for (const MidEdgeNode& edge : add_mid_edge_nodes(mesh, {{0, element}})) {
    const double radius = (position(edge.a).norm() + position(edge.b).norm()) / 2;
    position(edge.node) *= radius / position(edge.node).norm();
  }
}

MeshBoundary boundary_at(const Mesh& mesh, const FaceMatching& matching, const char* name,
                         double radius) {
  const auto is_there = [&](std::int32_t node) {
    const double at = Eigen::Map<const Eigen::Vector3d>(mesh.positions.data() + 3 * node).norm();
    return std::abs(at - radius) < 1e-9 * radius;
  };
  MeshBoundary boundary{name, {}, {}};
  for (std::size_t node = 0; node < mesh.num_nodes(); ++node) {
    const auto number = static_cast<std::int32_t>(node);
    if (is_there(number)) boundary.nodes.push_back(number);
  }
  for (const MeshFace& face : matching.boundary) {
    if (std::all_of(face.nodes.begin(), face.nodes.end(), is_there)) {
      boundary.faces.push_back(face.nodes);
    }
  }
  return boundary;
}

void check_size(const SphereDescription& sphere) {
  const double nodes = 6.0 * sphere.cells[0] * sphere.cells[0] * (sphere.cells[1] + 1.0);
  if (nodes > std::numeric_limits<std::int32_t>::max() / 3.0) {
    throw InputError(
        fmt::format("{}: sphere.cells = [{}]: too many for node numbers of 32 bits: take fewer",
                    sphere.cells_where, fmt::join(sphere.cells, ", ")));
  }
}

}  // namespace

SceneMesh make_sphere(const SphereDescription& sphere) {
  check_size(sphere);
  const std::string& element = sphere.association.element;
  const ElementTopology& topology = element_topology(element);
  const std::string linear(topology.is_quadratic() ? topology.linear : topology.element);
  const bool of_triangles = linear == "prism6" || linear == "tet4";
  if (!of_triangles && linear != "hexa8" && linear != "pyramid5") {
    throw InputError(fmt::format(
        "{}: sphere.association: a sphere cannot be cut into '{}': hexa8, prism6, pyramid5, tet4, "
        "hexa20 and tet10 are possible",
        sphere.association_where, element));
  }
  const Shell shell(sphere,
                    of_triangles ? triangles(sphere.cells[0]) : quadrilaterals(sphere.cells[0]));

  SceneMesh result;
  Mesh& mesh = result.mesh;
  mesh.dim = 3;
  for (int layer = 0; layer <= shell.layers(); ++layer) {
    for (const Eigen::Vector3d& direction : shell.surface().directions) {
      append(mesh, shell.radius(layer) * direction);
    }
  }
  ElementBlock& block = mesh.blocks.emplace_back();
  block.element = linear;
  block.nodes_per_element = element_topology(linear).num_nodes;
  const std::int32_t region = region_number(mesh, sphere.region);
  for (int layer = 0; layer < shell.layers(); ++layer) {
    for (std::size_t f = 0; f < shell.surface().faces.size(); ++f) {
      std::vector<std::int32_t> cell = shell.face(layer, f);
      const std::vector<std::int32_t> upper = shell.face(layer + 1, f);
      cell.insert(cell.end(), upper.begin(), upper.end());
      if (linear == "pyramid5") {
        Eigen::Vector3d centre = Eigen::Vector3d::Zero();
        for (const std::int32_t node : cell) {
          centre += Eigen::Map<const Eigen::Vector3d>(mesh.positions.data() + 3 * node) / 8;
        }
        cell.push_back(static_cast<std::int32_t>(mesh.num_nodes()));
        append(mesh, centre);
      }
      for (const std::vector<std::int32_t>& nodes : cut_cell(linear, cell)) {
        block.nodes.insert(block.nodes.end(), nodes.begin(), nodes.end());
        block.region.push_back(region);
      }
    }
  }
  result.blocks.push_back(
      {"sphere", sphere.association, sphere.association_where, sphere.region, sphere.region_where});
  if (topology.is_quadratic()) add_curved_edges(mesh, element);
  const FaceMatching matching = match_faces(mesh);
  result.boundaries = {boundary_at(mesh, matching, "inner", sphere.inner),
                       boundary_at(mesh, matching, "outer", sphere.outer)};
  return result;
}

}  // namespace elastogen::selector
