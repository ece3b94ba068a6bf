#include "selector/io/gmsh_mesh.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <set>
#include <unordered_map>

#include "runtime/error.h"
#include "selector/io/gmsh_elements.h"
#include "selector/io/mesh_draft.h"

namespace elastogen::selector {
namespace {

namespace fs = std::filesystem;

/// Where a file's format puts the names of elements.
struct Format {
  bool groups_are_entities = false;  ///< medit's references, which gmsh makes entities of
  bool is_vtk = false;               ///< see GmshElement::order_from_vtk
};

Format format_of(const fs::path& file) {
  return {file.extension() == ".mesh", file.extension() == ".vtk"};
}

std::string group_name(const RawGroup& group) {
  return group.name.empty() ? std::to_string(group.number) : group.name;
}

/// Names of the groups that elements are in.
std::vector<std::string> names_of(const RawMesh& raw, const RawElements& elements,
                                  const Format& format) {
  std::vector<std::string> names;
  for (const std::int32_t group : elements.groups) {
    names.push_back(group_name(raw.groups[static_cast<std::size_t>(group)]));
  }
  if (format.groups_are_entities) names.push_back(std::to_string(elements.entity));
  return names;
}

/// Highest dimension of an element; solid or plane.
int dimension_of(const fs::path& file, const RawMesh& raw) {
  int dim = -1;
  std::size_t count = 0;
  for (const RawElements& elements : raw.elements) {
    dim = std::max(dim, static_cast<int>(elements.dim));
    count += elements.tags.size();
  }
  if (count == 0) {
    throw InputError(fmt::format(
        "{}: it has {} nodes and no elements: mesh it and save the mesh (gmsh: -3, and physical "
        "groups for all that is to be saved)",
        file.string(), raw.node_tags.size()));
  }
  if (dim < 2) {
    throw InputError(fmt::format(
        "{}: it has only {}: a body is made of solids, or of triangles and quadrilaterals in the "
        "x-y plane",
        file.string(), dim == 1 ? "lines" : "points"));
  }
  return dim;
}

void check_types(const fs::path& file, const RawMesh& raw, int dim) {
  std::map<std::string, std::size_t> unknown;
  for (const RawElements& elements : raw.elements) {
    if (elements.dim != dim || find_gmsh_element(elements.type) != nullptr) continue;
    unknown[elements.type_name] += elements.tags.size();
  }
  if (unknown.empty()) return;
  std::vector<std::string> found, known;
  for (const auto& [name, count] : unknown) {
    found.push_back(fmt::format("{} of type '{}'", count, name));
  }
  for (const GmshElement& element : gmsh_elements()) known.emplace_back(element.element);
  throw InputError(fmt::format(
      "{}: elements that cannot be computed: {}; these can: {}; mesh with elements of first order "
      "(gmsh: Mesh.ElementOrder = 1), or tetrahedra and hexahedra of second order without nodes "
      "inside of faces (Mesh.ElementOrder = 2, Mesh.SecondOrderIncomplete = 1)",
      file.string(), fmt::join(found, ", "), fmt::join(known, ", ")));
}

/// The draft's boundary of a name, made where it is new.
MeshBoundary& boundary_of(MeshDraft& draft, const std::string& name) {
  auto& boundaries = draft.boundaries;
  const auto found = std::find_if(boundaries.begin(), boundaries.end(),
                                  [&](const MeshBoundary& b) { return b.name == name; });
  if (found != boundaries.end()) return *found;
  boundaries.push_back({name, {}, {}});
  return boundaries.back();
}

/// Builds a draft from one record.
class Drafter {
 public:
  Drafter(const fs::path& file, const RawMesh& raw)
      : file_(file), raw_(raw), format_(format_of(file)) {
    draft_.dim = dimension_of(file, raw);
    draft_.node_numbers = raw.node_tags;
    draft_.coordinates = raw.coordinates;
    for (std::size_t i = 0; i < raw.node_tags.size(); ++i) {
      node_of_tag_.emplace(raw.node_tags[i], static_cast<std::int32_t>(i));
    }
    for (const std::string& warning : raw.warnings) {
      draft_.notes.push_back(fmt::format("{}: gmsh: {}", file.filename().string(), warning));
    }
  }

  MeshDraft build() {
    check_types(file_, raw_, draft_.dim);
    for (const RawElements& elements : raw_.elements) {
      if (elements.dim == draft_.dim) {
        add_body(elements);
      } else {
        add_boundary(elements);
      }
    }
    sort_boundaries();
    return std::move(draft_);
  }

 private:
  [[nodiscard]] std::int32_t node(std::uint64_t tag, std::uint64_t element) const {
    const auto found = node_of_tag_.find(tag);
    if (found == node_of_tag_.end()) {
      throw InputError(fmt::format("{}: element {} has the node {}, which the file does not define",
                                   file_.string(), element, tag));
    }
    return found->second;
  }

  /// Nodes of one element, in gmsh's order.
  [[nodiscard]] std::vector<std::int32_t> nodes_of(const RawElements& elements,
                                                   std::size_t e) const {
    const auto count = static_cast<std::size_t>(elements.nodes_per_element);
    std::vector<std::int32_t> nodes;
    for (std::size_t a = 0; a < count; ++a) {
      nodes.push_back(node(elements.nodes[e * count + a], elements.tags[e]));
    }
    return nodes;
  }

  void add_body(const RawElements& raw) {
    std::vector<std::string> names = names_of(raw_, raw, format_);
    if (names.size() > 1) {
      throw InputError(fmt::format(
          "{}: element {} is in the groups '{}' and '{}': a region has one material, so it may be "
          "in one group only",
          file_.string(), raw.tags.front(), names[0], names[1]));
    }
    if (names.empty()) names = {default_region};
    const GmshElement& type = *find_gmsh_element(raw.type);
    const std::vector<int>& order =
        format_.is_vtk && !type.order_from_vtk.empty() ? type.order_from_vtk : type.order;
    DraftElements elements{std::string(type.element), names.front(), "", {}, raw.tags};
    for (std::size_t e = 0; e < raw.tags.size(); ++e) {
      const std::vector<std::int32_t> nodes = nodes_of(raw, e);
      for (const int a : order) elements.nodes.push_back(nodes[static_cast<std::size_t>(a)]);
    }
    draft_.elements.push_back(std::move(elements));
  }

  void add_boundary(const RawElements& raw) {
    // References of medit's edges and vertices have no meaning beside those of faces.
    if (format_.groups_are_entities && raw.dim != draft_.dim - 1) return;
    for (const std::string& name : names_of(raw_, raw, format_)) {
      MeshBoundary& boundary = boundary_of(draft_, name);
      for (std::size_t e = 0; e < raw.tags.size(); ++e) {
        const std::vector<std::int32_t> nodes = nodes_of(raw, e);
        boundary.nodes.insert(boundary.nodes.end(), nodes.begin(), nodes.end());
        if (raw.dim == draft_.dim - 1) boundary.faces.push_back(nodes);
      }
    }
  }

  void sort_boundaries() {
    for (MeshBoundary& boundary : draft_.boundaries) {
      const std::set<std::int32_t> distinct(boundary.nodes.begin(), boundary.nodes.end());
      boundary.nodes.assign(distinct.begin(), distinct.end());
    }
  }

  const fs::path& file_;
  const RawMesh& raw_;
  Format format_;
  MeshDraft draft_;
  std::unordered_map<std::uint64_t, std::int32_t> node_of_tag_;
};

}  // namespace

MeshFile make_gmsh_mesh(const fs::path& file, const RawMesh& raw) {
  return finish_mesh(file, Drafter(file, raw).build());
}

}  // namespace elastogen::selector
