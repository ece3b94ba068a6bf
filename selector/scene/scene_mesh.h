// From a scene's bar, sphere, hand-written elements or mesh file to a checked mesh.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "runtime/mesh.h"
#include "selector/io/mesh_file.h"
#include "selector/scene/scene.h"

namespace elastogen::selector {

/// A mesh with what belongs to its blocks and sections.
struct SceneMesh {
  /// What the elements of one block are computed with.
  struct Block {
    std::string path;  ///< "bar.section[1]"
    symgen::AssociationId association;
    std::string association_where;  ///< in the scene file
    std::string region;
    std::string region_where;  ///< in the scene file
  };

  Mesh mesh;                      ///< one block for each section of a bar or block of a mesh
  std::vector<Block> blocks;      ///< as mesh.blocks
  std::vector<double> section_x;  ///< grid planes of a bar; else empty
  std::vector<std::vector<std::int32_t>> section_nodes;  ///< their nodes
  std::size_t split_quadrilaterals = 0;                  ///< quadrilaterals that meet two triangles
  std::size_t unequal_faces = 0;         ///< both sides of faces of unequal nodes between corners
  std::vector<MeshBoundary> boundaries;  ///< of a sphere or a mesh file
  std::vector<std::string> notes;        ///< what was left out or mended in a mesh file
  std::string boundary_advice;           ///< what a boundary is in the mesh file; so is the next
  std::string merge_advice;              ///< how nodes that lie on each other become one
};

/// Number of a region in mesh.region_names, added where it is new.
[[nodiscard]] std::int32_t region_number(Mesh& mesh, const std::string& name);

/// The mesh of any kind.
[[nodiscard]] SceneMesh make_mesh(const Scene& scene);

}  // namespace elastogen::selector
