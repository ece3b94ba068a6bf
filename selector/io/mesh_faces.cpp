#include "selector/io/mesh_faces.h"

#include <algorithm>
#include <array>
#include <map>
#include <numeric>

#include "selector/io/element_topology.h"

namespace elastogen::selector {
namespace {

/// A face's nodes in ascending order after -1 for each that it has fewer than four.
using FaceKey = std::array<std::int32_t, 4>;

FaceKey key_of(const std::vector<std::int32_t>& nodes) {
  FaceKey key;
  key.fill(-1);
  std::copy(nodes.begin(), nodes.end(), key.begin());
  std::sort(key.begin(), key.end());
  return key;
}

std::vector<MeshFace> all_faces(const Mesh& mesh) {
  std::vector<MeshFace> faces;
  for (std::size_t b = 0; b < mesh.blocks.size(); ++b) {
    const ElementBlock& block = mesh.blocks[b];
    const ElementTopology& topology = element_topology(block.element);
    for (std::size_t e = 0; e < block.num_elements(); ++e) {
      const auto element_nodes = block.element_nodes(e);
      for (std::size_t f = 0; f < topology.faces.size(); ++f) {
        MeshFace face{b, e, f, {}};
        for (const int local : topology.faces[f]) {
          face.nodes.push_back(element_nodes[static_cast<std::size_t>(local)]);
        }
        faces.push_back(std::move(face));
      }
    }
  }
  return faces;
}

/// Boundary triangles by their nodes.
std::map<FaceKey, std::size_t> triangles_of(const std::vector<MeshFace>& boundary) {
  std::map<FaceKey, std::size_t> triangles;
  for (std::size_t i = 0; i < boundary.size(); ++i) {
    if (boundary[i].nodes.size() == 3) triangles.emplace(key_of(boundary[i].nodes), i);
  }
  return triangles;
}

/// The boundary triangles on the nodes of a boundary quadrilateral: two where it is split along
/// one of its diagonals by its neighbours.
std::vector<std::size_t> triangles_on(const MeshFace& quadrilateral,
                                      const std::map<FaceKey, std::size_t>& triangles) {
  std::vector<std::size_t> found;
  for (std::size_t left_out = 0; left_out < 4; ++left_out) {
    std::vector<std::int32_t> three = quadrilateral.nodes;
    three.erase(three.begin() + static_cast<std::ptrdiff_t>(left_out));
    const auto triangle = triangles.find(key_of(three));
    if (triangle != triangles.end()) found.push_back(triangle->second);
  }
  return found;
}

}  // namespace

FaceMatching match_faces(const Mesh& mesh) {
  std::vector<MeshFace> faces = all_faces(mesh);
  std::vector<FaceKey> keys;
  keys.reserve(faces.size());
  for (const MeshFace& face : faces) keys.push_back(key_of(face.nodes));
  std::vector<std::size_t> order(faces.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return keys[a] < keys[b]; });

  std::vector<std::size_t> single, repeated;
  for (std::size_t first = 0; first < order.size();) {
    std::size_t last = first + 1;
    while (last < order.size() && keys[order[last]] == keys[order[first]]) ++last;
    if (last - first == 1) single.push_back(order[first]);
    if (last - first > 2) repeated.push_back(order[first]);
    first = last;
  }
  std::sort(single.begin(), single.end());
  std::sort(repeated.begin(), repeated.end());

  FaceMatching matching;
  for (const std::size_t i : single) matching.boundary.push_back(std::move(faces[i]));
  for (const std::size_t i : repeated) matching.overused.push_back(std::move(faces[i]));
  const auto triangles = triangles_of(matching.boundary);
  for (std::size_t i = 0; i < matching.boundary.size(); ++i) {
    const MeshFace& face = matching.boundary[i];
    if (face.nodes.size() == 4 && triangles_on(face, triangles).size() == 2) {
      matching.split_quadrilaterals.push_back(i);
    }
  }
  return matching;
}

std::vector<std::size_t> surface_faces(const FaceMatching& matching) {
  std::vector<bool> inside(matching.boundary.size(), false);
  const auto triangles = triangles_of(matching.boundary);
  for (const std::size_t i : matching.split_quadrilaterals) {
    inside[i] = true;
    for (const std::size_t t : triangles_on(matching.boundary[i], triangles)) inside[t] = true;
  }
  std::vector<std::size_t> surface;
  for (std::size_t i = 0; i < inside.size(); ++i) {
    if (!inside[i]) surface.push_back(i);
  }
  return surface;
}

}  // namespace elastogen::selector
