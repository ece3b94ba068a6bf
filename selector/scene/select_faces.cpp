#include "selector/scene/select_faces.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "runtime/error.h"
#include "selector/io/mesh_faces.h"
#include "selector/scene/select_nodes.h"

namespace elastogen::selector {
namespace {

using FaceKey = std::vector<std::int32_t>;  // nodes, ascending

FaceKey key_of(const std::vector<std::int32_t>& nodes) {
  FaceKey key = nodes;
  std::sort(key.begin(), key.end());
  return key;
}

std::vector<SurfaceFace> faces_of_boundary(const SceneMesh& mesh, const NodeSelection& selection,
                                           const FaceMatching& matching) {
  const MeshBoundary& boundary = find_boundary(mesh, selection);
  std::map<FaceKey, const MeshFace*> outer;
  for (const MeshFace& face : matching.boundary) outer.emplace(key_of(face.nodes), &face);
  std::map<FaceKey, SurfaceFace> found;  // each once, also where the file repeats it
  std::size_t inside = 0;
  for (const SurfaceFace& face : boundary.faces) {
    const auto match = outer.find(key_of(face));
    if (match == outer.end()) {
      ++inside;
    } else {
      found.emplace(match->first, match->second->nodes);
    }
  }
  if (inside > 0) {
    throw InputError(fmt::format(
        "{}: {}: {} of its {} faces are not on the surface: inside the body, or of no element; "
        "a pressure or traction needs faces of one element each",
        selection.where, selection.description, inside, boundary.faces.size()));
  }
  if (found.empty()) {
    throw InputError(fmt::format(
        "{}: {} has {} nodes, but no {}: a pressure or traction needs a group of {}",
        selection.where, selection.description, boundary.nodes.size(),
        mesh.mesh.dim == 3 ? "faces" : "edges", mesh.mesh.dim == 3 ? "surfaces" : "curves"));
  }
  std::vector<SurfaceFace> faces;
  for (auto& [key, face] : found) faces.push_back(std::move(face));
  return faces;
}

std::vector<SurfaceFace> faces_of_nodes(const SceneMesh& mesh, const NodeSelection& selection,
                                        const FaceMatching& matching) {
  const std::vector<std::int32_t> nodes = select_nodes(mesh, selection);
  std::vector<SurfaceFace> faces;
  for (const std::size_t i : surface_faces(matching)) {
    const SurfaceFace& face = matching.boundary[i].nodes;
    const bool inside = std::all_of(face.begin(), face.end(), [&](std::int32_t node) {
      return std::binary_search(nodes.begin(), nodes.end(), node);
    });
    if (inside) faces.push_back(face);
  }
  if (faces.empty()) {
    throw InputError(
        fmt::format("{}: {} has {} nodes, but no face of the surface has all of its nodes there",
                    selection.where, selection.description, nodes.size()));
  }
  return faces;
}

}  // namespace

std::vector<SurfaceFace> select_faces(const SceneMesh& mesh, const NodeSelection& selection) {
  const FaceMatching matching = match_faces(mesh.mesh);
  return selection.boundary.empty() ? faces_of_nodes(mesh, selection, matching)
                                    : faces_of_boundary(mesh, selection, matching);
}

}  // namespace elastogen::selector
