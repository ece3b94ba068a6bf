#include "selector/io/mesh_faces.h"

#include <algorithm>
#include <array>
#include <map>
#include <numeric>

#include "selector/io/element_topology.h"

namespace elastogen::selector {
namespace {

/// A face's nodes in ascending order after -1 for each that it has fewer than eight.
using FaceKey = std::array<std::int32_t, 8>;

FaceKey key_of(const std::vector<std::int32_t>& nodes) {
  FaceKey key;
  key.fill(-1);
  std::copy(nodes.begin(), nodes.end(), key.begin());
  std::sort(key.begin(), key.end());
  return key;
}

std::vector<std::int32_t> corners_of(const MeshFace& face) {
  const auto corners = static_cast<std::ptrdiff_t>(num_face_corners(face.nodes.size()));
  return {face.nodes.begin(), face.nodes.begin() + corners};
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

/// Boundary triangles by their corners.
std::map<FaceKey, std::size_t> triangles_of(const std::vector<MeshFace>& boundary) {
  std::map<FaceKey, std::size_t> triangles;
  for (std::size_t i = 0; i < boundary.size(); ++i) {
    const std::vector<std::int32_t> corners = corners_of(boundary[i]);
    if (corners.size() == 3) triangles.emplace(key_of(corners), i);
  }
  return triangles;
}

/// The boundary triangles on the corners of a boundary face: two where it is a quadrilateral that
/// its neighbours split along one of its diagonals.
std::vector<std::size_t> triangles_on(const MeshFace& face,
                                      const std::map<FaceKey, std::size_t>& triangles) {
  std::vector<std::size_t> found;
  const std::vector<std::int32_t> corners = corners_of(face);
  if (corners.size() != 4) return found;
  for (std::size_t left_out = 0; left_out < 4; ++left_out) {
    std::vector<std::int32_t> three = corners;
    three.erase(three.begin() + static_cast<std::ptrdiff_t>(left_out));
    const auto triangle = triangles.find(key_of(three));
    if (triangle != triangles.end()) found.push_back(triangle->second);
  }
  return found;
}

/// Boundary faces that have their corners in common with one of other nodes in the middle of its
/// edges, or of none.
std::vector<std::size_t> unequal_faces(const std::vector<MeshFace>& boundary) {
  std::map<FaceKey, std::vector<std::size_t>> by_corners;
  for (std::size_t i = 0; i < boundary.size(); ++i) {
    if (boundary[i].nodes.size() > 2) by_corners[key_of(corners_of(boundary[i]))].push_back(i);
  }
  std::vector<std::size_t> unequal;
  for (const auto& [key, faces] : by_corners) {
    if (faces.size() > 1) unequal.insert(unequal.end(), faces.begin(), faces.end());
  }
  std::sort(unequal.begin(), unequal.end());
  return unequal;
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
    if (triangles_on(matching.boundary[i], triangles).size() == 2) {
      matching.split_quadrilaterals.push_back(i);
    }
  }
  matching.unequal = unequal_faces(matching.boundary);
  return matching;
}

std::vector<std::size_t> surface_faces(const FaceMatching& matching) {
  std::vector<bool> inside(matching.boundary.size(), false);
  for (const std::size_t i : matching.unequal) inside[i] = true;
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
