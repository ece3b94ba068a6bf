// From what a mesh file holds to elements with regions, and boundaries.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "selector/io/mesh_draft.h"
#include "selector/mesh_readers/raw_mesh.h"

namespace elastogen::selector {

/// Elements of the highest dimension become the body, others boundaries under the names of their
/// groups. A region is the group of its elements, and of several the one that the scene names.
///
/// @param regions  that the scene names
/// @throws InputError  no body; elements of a kind that cannot be computed, or in several groups of
///                     which the scene names none, or more than one
[[nodiscard]] MeshDraft make_draft(const std::filesystem::path& file, const RawMesh& raw,
                                   const std::vector<std::string>& regions);

}  // namespace elastogen::selector
