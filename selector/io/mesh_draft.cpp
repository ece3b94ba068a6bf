#include "selector/io/mesh_draft.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>
#include <span>

#include "runtime/error.h"
#include "selector/io/coincident_nodes.h"
#include "selector/io/element_topology.h"
#include "selector/io/mesh_faces.h"
#include "selector/io/mesh_formats.h"
#include "selector/mesh_readers/gmsh_elements.h"

namespace elastogen::selector {
namespace {

using Point = std::array<double, 3>;

Point point_of(const MeshDraft& draft, std::int32_t node) {
  const auto at = 3 * static_cast<std::size_t>(node);
  return {draft.coordinates[at], draft.coordinates[at + 1], draft.coordinates[at + 2]};
}

Point operator-(const Point& a, const Point& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }

double triple(const Point& a, const Point& b, const Point& c) {
  return a[0] * (b[1] * c[2] - b[2] * c[1]) + a[1] * (b[2] * c[0] - b[0] * c[2]) +
         a[2] * (b[0] * c[1] - b[1] * c[0]);
}

/// Volume of an element, or area of a plane one, over that of a cube or square of its size: by the
/// divergence theorem, exact for flat faces. Negative where it is inside out.
double relative_volume(const MeshDraft& draft, const ElementTopology& topology,
                       std::span<const std::int32_t> nodes) {
  const Point origin = point_of(draft, nodes[0]);
  double size = 0;
  for (const std::int32_t node : nodes) {
    for (const double x : point_of(draft, node) - origin) size = std::max(size, std::abs(x));
  }
  if (size == 0) return 0;
  double volume = 0;
  for (const std::vector<int>& face : topology.faces) {
    const auto corner = [&](std::size_t i) {
      return point_of(draft, nodes[static_cast<std::size_t>(face[i])]) - origin;
    };
    if (draft.dim == 2) {
      volume += triple(corner(0), corner(1), {0, 0, 1}) / 2;
    }
    // Of quadratic faces the corners: what is between them does not turn an element inside out.
    const std::size_t corners = num_face_corners(face.size());
    for (std::size_t i = 1; draft.dim == 3 && i + 1 < corners; ++i) {
      volume += triple(corner(0), corner(i), corner(i + 1)) / 6;
    }
  }
  return volume / std::pow(size, draft.dim);
}

// A relative volume that rounding cannot tell from 0.
constexpr double smallest_volume = 1e-12;

std::span<std::int32_t> nodes_of(DraftElements& elements, std::size_t e) {
  const std::size_t count = elements.nodes.size() / elements.numbers.size();
  return {elements.nodes.data() + e * count, count};
}

void mirror(DraftElements& elements) {
  const auto& known = gmsh_elements();
  const auto& order = std::find_if(known.begin(), known.end(), [&](const GmshElement& e) {
                        return e.element == elements.element;
                      })->mirror;
  for (std::size_t e = 0; e < elements.numbers.size(); ++e) {
    const std::span<std::int32_t> nodes = nodes_of(elements, e);
    const std::vector<std::int32_t> before(nodes.begin(), nodes.end());
    for (std::size_t a = 0; a < order.size(); ++a) {
      nodes[a] = before[static_cast<std::size_t>(order[a])];
    }
  }
}

/// A whole list that is inside out follows another convention: it is turned. A single element that
/// differs from its list is wrong.
void orient(const std::filesystem::path& file, MeshDraft& draft, DraftElements& elements) {
  const ElementTopology& topology = element_topology(elements.element);
  std::vector<double> volumes;
  for (std::size_t e = 0; e < elements.numbers.size(); ++e) {
    volumes.push_back(relative_volume(draft, topology, nodes_of(elements, e)));
  }
  const auto inverted = [](double volume) { return volume < -smallest_volume; };
  if (std::all_of(volumes.begin(), volumes.end(), inverted)) {
    mirror(elements);
    // A plane mesh is only seen from its other side.
    if (draft.dim == 3) {
      draft.notes.push_back(
          fmt::format("{}: all {} {} of region '{}' are listed inside out: they were turned",
                      file.filename().string(), volumes.size(), topology.plural, elements.region));
    }
    return;
  }
  const auto bad = std::find_if(volumes.begin(), volumes.end(),
                                [](double volume) { return !(volume > smallest_volume); });
  if (bad == volumes.end()) return;
  const auto first = static_cast<std::size_t>(bad - volumes.begin());
  const auto count = std::count_if(volumes.begin(), volumes.end(),
                                   [](double volume) { return !(volume > smallest_volume); });
  std::vector<std::uint64_t> nodes;
  for (const std::int32_t node : nodes_of(elements, first)) {
    nodes.push_back(draft.node_numbers[static_cast<std::size_t>(node)]);
  }
  throw InputError(fmt::format(
      "{}: element {} ({}, nodes {}) is {}: its {} is {:.3g} of that of a {} of its size; {} of {} "
      "{} in region '{}' are such: repair the mesh",
      file.string(), elements.numbers[first], elements.element, fmt::join(nodes, " "),
      inverted(*bad) ? "inverted" : "degenerate", draft.dim == 3 ? "volume" : "area", *bad,
      draft.dim == 3 ? "cube" : "square", count, volumes.size(), topology.plural, elements.region));
}

void check_coordinates(const std::filesystem::path& file, const MeshDraft& draft) {
  for (std::size_t node = 0; node < draft.node_numbers.size(); ++node) {
    const Point point = point_of(draft, static_cast<std::int32_t>(node));
    for (const double x : point) {
      if (std::isfinite(x)) continue;
      throw InputError(fmt::format("{}: node {} has the coordinate {}: must be finite",
                                   file.string(), draft.node_numbers[node], x));
    }
  }
  if (draft.dim == 3) return;
  // Only nodes of elements count: others are dropped.
  Point low, high;
  low.fill(std::numeric_limits<double>::infinity());
  high.fill(-std::numeric_limits<double>::infinity());
  for (const DraftElements& elements : draft.elements) {
    for (const std::int32_t node : elements.nodes) {
      const Point point = point_of(draft, node);
      for (std::size_t c = 0; c < 3; ++c) {
        low[c] = std::min(low[c], point[c]);
        high[c] = std::max(high[c], point[c]);
      }
    }
  }
  if (high[2] - low[2] > 1e-9 * std::max(high[0] - low[0], high[1] - low[1])) {
    const std::string_view volumes = mesh_format(file).volumes;
    throw InputError(fmt::format(
        "{}: it has triangles and quadrilaterals, but no solid elements, and z goes from {} to {}: "
        "a surface in space cannot be computed; mesh the volume (gmsh: -3), or lay it in the x-y "
        "plane{}{}",
        file.string(), low[2], high[2], volumes.empty() ? "" : "; ", volumes));
  }
}

void check_repeated(const std::filesystem::path& file, MeshDraft& draft) {
  std::map<std::vector<std::int32_t>, std::uint64_t> seen;
  for (DraftElements& elements : draft.elements) {
    for (std::size_t e = 0; e < elements.numbers.size(); ++e) {
      const std::span<std::int32_t> nodes = nodes_of(elements, e);
      std::vector<std::int32_t> key(nodes.begin(), nodes.end());
      std::sort(key.begin(), key.end());
      if (const auto twice = std::adjacent_find(key.begin(), key.end()); twice != key.end()) {
        throw InputError(fmt::format(
            "{}: element {} ({}) has the node {} twice: it is degenerate; repair the mesh",
            file.string(), elements.numbers[e], elements.element,
            draft.node_numbers[static_cast<std::size_t>(*twice)]));
      }
      const auto [first, is_new] = seen.emplace(std::move(key), elements.numbers[e]);
      if (is_new) continue;
      throw InputError(fmt::format("{}: elements {} and {} have the same nodes: remove one",
                                   file.string(), first->second, elements.numbers[e]));
    }
  }
}

/// Joins lists to blocks, in the order of first appearance.
void make_blocks(const MeshDraft& draft, MeshFile& result, MeshNumbers& all_numbers) {
  Mesh& mesh = result.mesh;
  std::map<std::array<std::string, 3>, std::size_t> block_of;
  std::vector<std::vector<std::uint64_t>> numbers;
  for (const DraftElements& elements : draft.elements) {
    const auto [entry, is_new] = block_of.emplace(
        std::array{elements.region, elements.element, elements.association}, mesh.blocks.size());
    auto& names = mesh.region_names;
    auto region = std::find(names.begin(), names.end(), elements.region);
    if (region == names.end()) region = names.insert(names.end(), elements.region);
    if (is_new) {
      ElementBlock block;
      block.element = elements.element;
      block.nodes_per_element = element_topology(elements.element).num_nodes;
      mesh.blocks.push_back(std::move(block));
      numbers.emplace_back();
      result.associations.push_back(elements.association);
    }
    ElementBlock& block = mesh.blocks[entry->second];
    block.nodes.insert(block.nodes.end(), elements.nodes.begin(), elements.nodes.end());
    block.region.insert(block.region.end(), elements.numbers.size(),
                        static_cast<std::int32_t>(region - names.begin()));
    auto& own = numbers[entry->second];
    own.insert(own.end(), elements.numbers.begin(), elements.numbers.end());
  }
  for (const auto& own : numbers) {
    all_numbers.elements.insert(all_numbers.elements.end(), own.begin(), own.end());
  }
}

/// Numbers the nodes that elements have, -1 for others, and sets the positions.
std::vector<std::int32_t> number_nodes(const std::filesystem::path& file, const MeshDraft& draft,
                                       MeshFile& result, MeshNumbers& file_numbers) {
  std::vector<std::int32_t> numbers(draft.node_numbers.size(), -1);
  for (const ElementBlock& block : result.mesh.blocks) {
    for (const std::int32_t node : block.nodes) numbers[static_cast<std::size_t>(node)] = 0;
  }
  std::int32_t next = 0;
  for (std::size_t node = 0; node < numbers.size(); ++node) {
    if (numbers[node] < 0) continue;
    numbers[node] = next++;
    file_numbers.nodes.push_back(draft.node_numbers[node]);
    const Point point = point_of(draft, static_cast<std::int32_t>(node));
    result.mesh.positions.insert(result.mesh.positions.end(), point.begin(),
                                 point.begin() + draft.dim);
  }
  const std::size_t dropped = numbers.size() - static_cast<std::size_t>(next);
  if (dropped > 0) {
    result.notes.push_back(fmt::format("{}: {} nodes belong to no element: they were left out",
                                       file.filename().string(), dropped));
  }
  for (ElementBlock& block : result.mesh.blocks) {
    for (std::int32_t& node : block.nodes) node = numbers[static_cast<std::size_t>(node)];
  }
  return numbers;
}

/// Keeps what lies on the body.
void take_boundaries(const std::filesystem::path& file, const MeshDraft& draft,
                     const std::vector<std::int32_t>& numbers, MeshFile& result) {
  const auto renumber = [&](const std::vector<std::int32_t>& nodes) {
    std::vector<std::int32_t> kept;
    for (const std::int32_t node : nodes) {
      const std::int32_t number = numbers[static_cast<std::size_t>(node)];
      if (number >= 0) kept.push_back(number);
    }
    return kept;
  };
  for (const MeshBoundary& source : draft.boundaries) {
    MeshBoundary boundary{source.name, renumber(source.nodes), {}};
    for (const std::vector<std::int32_t>& face : source.faces) {
      std::vector<std::int32_t> kept = renumber(face);
      if (kept.size() == face.size()) boundary.faces.push_back(std::move(kept));
    }
    std::sort(boundary.nodes.begin(), boundary.nodes.end());
    const std::size_t lost = source.nodes.size() - boundary.nodes.size();
    if (lost > 0) {
      result.notes.push_back(
          fmt::format("{}: boundary '{}': {} of its {} nodes belong to no element: they were left "
                      "out",
                      file.filename().string(), source.name, lost, source.nodes.size()));
    }
    if (!boundary.nodes.empty()) result.boundaries.push_back(std::move(boundary));
  }
}

void check_faces(const std::filesystem::path& file, const MeshFile& mesh) {
  const FaceMatching matching = match_faces(mesh.mesh);
  if (matching.overused.empty()) return;
  const MeshFace& face = matching.overused.front();
  std::size_t element = face.element;
  for (std::size_t b = 0; b < face.block; ++b) element += mesh.mesh.blocks[b].num_elements();
  throw InputError(
      fmt::format("{}: a face of element {} belongs to more than two elements ({} such faces): "
                  "elements overlap",
                  file.string(), mesh.mesh.element_number(element), matching.overused.size()));
}

void note_coincident_nodes(const std::filesystem::path& file, MeshFile& result) {
  const CoincidentNodes found = find_coincident_nodes(result.mesh);
  if (found.count == 0) return;
  result.notes.push_back(fmt::format(
      "{}: {} nodes lie on another node (node {} on node {} first): the body is not joined there; "
      "if it should be, merge them ({})",
      file.filename().string(), found.count, result.mesh.node_number(found.first[1]),
      result.mesh.node_number(found.first[0]), mesh_format(file).merge));
}

}  // namespace

MeshFile finish_mesh(const std::filesystem::path& file, MeshDraft draft) {
  check_coordinates(file, draft);
  for (DraftElements& elements : draft.elements) orient(file, draft, elements);
  check_repeated(file, draft);
  MeshFile result;
  result.mesh.dim = draft.dim;
  result.notes = draft.notes;
  MeshNumbers file_numbers;
  make_blocks(draft, result, file_numbers);
  const std::vector<std::int32_t> numbers = number_nodes(file, draft, result, file_numbers);
  result.mesh.numbers = std::make_shared<const MeshNumbers>(std::move(file_numbers));
  take_boundaries(file, draft, numbers, result);
  check_faces(file, result);
  note_coincident_nodes(file, result);
  return result;
}

}  // namespace elastogen::selector
