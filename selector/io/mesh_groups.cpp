#include "selector/io/mesh_groups.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <set>
#include <unordered_map>

#include "runtime/error.h"
#include "selector/io/abaqus_elements.h"
#include "selector/io/element_topology.h"
#include "selector/io/mesh_formats.h"

namespace elastogen::selector {
namespace {

namespace fs = std::filesystem;

/// Names of the groups that elements are in, each once.
std::vector<std::string> names_of(const RawMesh& raw, const RawElements& elements) {
  std::vector<std::string> names;
  for (const std::int32_t index : elements.groups) {
    const RawGroup& group = raw.groups[static_cast<std::size_t>(index)];
    const std::string name = group.name.empty() ? std::to_string(group.number) : group.name;
    if (std::find(names.begin(), names.end(), name) == names.end()) names.push_back(name);
  }
  return names;
}

/// Highest dimension of an element; solid or plane.
int dimension_of(const fs::path& file, const RawMesh& raw) {
  int dim = -1;
  std::size_t count = 0;
  for (const RawElements& elements : raw.elements) {
    if (elements.numbers.empty()) continue;
    dim = std::max(dim, static_cast<int>(elements.dim));
    count += elements.numbers.size();
  }
  const std::string_view volumes = mesh_format(file).volumes;
  if (count == 0) {
    throw InputError(
        fmt::format("{}: it has {} nodes and no elements: mesh it and save the mesh{}{}",
                    file.string(), raw.node_numbers.size(), volumes.empty() ? "" : "; ", volumes));
  }
  if (dim < 2) {
    throw InputError(fmt::format(
        "{}: it has only {}: a body is made of solids, or of triangles and quadrilaterals in the "
        "x-y plane{}{}",
        file.string(), dim == 1 ? "lines" : "points", volumes.empty() ? "" : "; ", volumes));
  }
  return dim;
}

/// What makes elements of these kinds such as can be computed.
std::string remedy_for_types(MeshReader reader, int dim,
                             const std::map<std::string, std::size_t>& types) {
  std::vector<std::string> known;
  for (const ElementTopology& topology : element_topologies()) {
    if (topology.dim == dim) known.emplace_back(topology.element);
  }
  const std::string these = fmt::format("these can: {}; ", fmt::join(known, ", "));
  if (reader != MeshReader::abaqus) {
    return these +
           "mesh with elements of first order (gmsh: Mesh.ElementOrder = 1), or tetrahedra and "
           "hexahedra of second order without nodes inside of faces (Mesh.ElementOrder = 2, "
           "Mesh.SecondOrderIncomplete = 1)";
  }
  const auto is_of_our_family = [](const auto& type) { return is_solid_or_plane(type.first); };
  std::vector<std::string> remedies;
  if (!std::all_of(types.begin(), types.end(), is_of_our_family)) {
    remedies.emplace_back(
        "shells, membranes, beams and axisymmetric elements are not computed; use solid (C3D) or "
        "plane (CPE, CPS) elements");
  }
  if (std::any_of(types.begin(), types.end(), is_of_our_family)) {
    remedies.push_back(these + (dim == 3 ? "use elements of first order, or C3D10 or C3D20"
                                         : "use elements of first order"));
  }
  return fmt::format("{}", fmt::join(remedies, "; "));
}

void check_types(const fs::path& file, const RawMesh& raw, int dim) {
  std::map<std::string, std::size_t> unknown;
  for (const RawElements& elements : raw.elements) {
    if (elements.dim != dim || !elements.element.empty()) continue;
    unknown[elements.type_name] += elements.numbers.size();
  }
  if (unknown.empty()) return;
  std::vector<std::string> found;
  for (const auto& [name, count] : unknown) {
    found.push_back(fmt::format("{} of type '{}'", count, name));
  }
  throw InputError(fmt::format("{}: elements that cannot be computed: {}; {}", file.string(),
                               fmt::join(found, ", "),
                               remedy_for_types(mesh_format(file).reader, dim, unknown)));
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
  Drafter(const fs::path& file, const RawMesh& raw, const std::vector<std::string>& regions)
      : file_(file), raw_(raw), regions_(regions) {
    draft_.dim = dimension_of(file, raw);
    draft_.node_numbers = raw.node_numbers;
    draft_.coordinates = raw.coordinates;
    for (std::size_t i = 0; i < raw.node_numbers.size(); ++i) {
      node_of_number_.emplace(raw.node_numbers[i], static_cast<std::int32_t>(i));
    }
    for (const std::string& note : raw.notes) {
      draft_.notes.push_back(fmt::format("{}: {}", file.filename().string(), note));
    }
  }

  MeshDraft build() {
    check_types(file_, raw_, draft_.dim);
    for (const RawElements& elements : raw_.elements) {
      if (elements.numbers.empty()) continue;
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
  [[nodiscard]] std::int32_t node(std::uint64_t number, std::uint64_t element) const {
    const auto found = node_of_number_.find(number);
    if (found == node_of_number_.end()) {
      throw InputError(fmt::format("{}: element {} has the node {}, which the file does not define",
                                   file_.string(), element, number));
    }
    return found->second;
  }

  [[nodiscard]] std::vector<std::int32_t> nodes_of(const RawElements& elements,
                                                   std::size_t e) const {
    const auto count = static_cast<std::size_t>(elements.nodes_per_element);
    std::vector<std::int32_t> nodes;
    for (std::size_t a = 0; a < count; ++a) {
      nodes.push_back(node(elements.nodes[e * count + a], elements.numbers[e]));
    }
    return nodes;
  }

  [[nodiscard]] std::string region_of(const RawElements& raw) const {
    const std::vector<std::string> names = names_of(raw_, raw);
    if (names.empty()) return default_region;
    if (names.size() == 1) return names.front();
    std::vector<std::string> wanted;
    for (const std::string& name : names) {
      if (std::find(regions_.begin(), regions_.end(), name) != regions_.end()) {
        wanted.push_back(name);
      }
    }
    if (wanted.size() == 1) return wanted.front();
    const std::string which = wanted.empty() ? "names none" : "names more than one";
    const std::vector<std::string>& listed = wanted.empty() ? names : wanted;
    throw InputError(fmt::format(
        "{}: element {} is in the groups '{}', of which the scene {}: a region has one material, "
        "so give one of them to a material, by its name or in its 'regions', and no other",
        file_.string(), raw.numbers.front(), fmt::join(listed, "' and '"), which));
  }

  void add_body(const RawElements& raw) {
    DraftElements elements{raw.element, region_of(raw), "", {}, raw.numbers};
    for (std::size_t e = 0; e < raw.numbers.size(); ++e) {
      const std::vector<std::int32_t> nodes = nodes_of(raw, e);
      elements.nodes.insert(elements.nodes.end(), nodes.begin(), nodes.end());
    }
    draft_.elements.push_back(std::move(elements));
  }

  void add_boundary(const RawElements& raw) {
    for (const std::string& name : names_of(raw_, raw)) {
      MeshBoundary& boundary = boundary_of(draft_, name);
      for (std::size_t e = 0; e < raw.numbers.size(); ++e) {
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
  const std::vector<std::string>& regions_;
  MeshDraft draft_;
  std::unordered_map<std::uint64_t, std::int32_t> node_of_number_;
};

}  // namespace

MeshDraft make_draft(const fs::path& file, const RawMesh& raw,
                     const std::vector<std::string>& regions) {
  return Drafter(file, raw, regions).build();
}

}  // namespace elastogen::selector
