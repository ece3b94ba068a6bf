#include "selector/scene/bar_mesh.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>
#include <span>

#include "runtime/error.h"
#include "selector/io/element_topology.h"
#include "selector/io/mesh_faces.h"
#include "selector/scene/cube_cuts.h"
#include "selector/scene/located_error.h"
#include "selector/scene/mid_edge_nodes.h"

namespace elastogen::selector {
namespace {

/// First cell layer after a section.
int end_layer(const BarDescription& bar, const SectionDescription& section) {
  const double layers = section.until * bar.cells[0];
  const double nearest = std::round(layers);
  if (std::abs(layers - nearest) > 1e-9 * bar.cells[0] || nearest < 1) {
    throw InputError(fmt::format(
        "{}: {}.until = {}: the section ends inside a cell, after {:.6g} of the bar's {} cells "
        "along x: take a number of cells that is divisible, or until = {:.6g}",
        section.until_where, section.path, section.until, layers, bar.cells[0],
        std::max(nearest, 1.0) / bar.cells[0]));
  }
  return static_cast<int>(nearest);
}

/// Node numbers of a bar's grid: plane 0, centres of layer 0, plane 1, ...
class BarGrid {
 public:
  BarGrid(const BarDescription& bar, const std::vector<bool>& layer_has_centres)
      : cells_(bar.cells), layer_has_centres_(layer_has_centres) {
    std::size_t next = 0;
    for (int i = 0; i <= cells_[0]; ++i) {
      plane_start_.push_back(next);
      next += plane_size();
      if (i < cells_[0] && layer_has_centres_[static_cast<std::size_t>(i)]) {
        next += static_cast<std::size_t>(cells_[1]) * static_cast<std::size_t>(cells_[2]);
      }
    }
    num_nodes_ = next;
  }

  [[nodiscard]] std::size_t num_nodes() const { return num_nodes_; }
  [[nodiscard]] std::size_t plane_size() const {
    return static_cast<std::size_t>(cells_[1] + 1) * static_cast<std::size_t>(cells_[2] + 1);
  }
  [[nodiscard]] std::size_t grid_node(int i, int j, int k) const {
    return plane_start_[static_cast<std::size_t>(i)] +
           static_cast<std::size_t>(j) * static_cast<std::size_t>(cells_[2] + 1) +
           static_cast<std::size_t>(k);
  }
  [[nodiscard]] std::size_t centre_node(int i, int j, int k) const {
    return plane_start_[static_cast<std::size_t>(i)] + plane_size() +
           static_cast<std::size_t>(j) * static_cast<std::size_t>(cells_[2]) +
           static_cast<std::size_t>(k);
  }
  /// Corners in hexa8 order, then the centre (which exists only in layers that have centres); in
  /// the plane, corners in quad4 order.
  [[nodiscard]] std::vector<std::int32_t> cell_nodes(int i, int j, int k) const {
    std::vector<std::size_t> nodes;
    const int last = cells_[2] == 0 ? k : k + 1;
    for (int level = k; level <= last; ++level) {
      nodes.insert(nodes.end(), {grid_node(i, j, level), grid_node(i + 1, j, level),
                                 grid_node(i + 1, j + 1, level), grid_node(i, j + 1, level)});
    }
    nodes.push_back(centre_node(i, j, k));
    return {nodes.begin(), nodes.end()};
  }

 private:
  std::array<int, 3> cells_;
  std::vector<bool> layer_has_centres_;
  std::vector<std::size_t> plane_start_;
  std::size_t num_nodes_ = 0;
};

/// Coordinates in halves of cells, so that centres have whole numbers, too.
void set_position(const BarDescription& bar, std::array<int, 3> halves, std::size_t node,
                  Mesh& mesh) {
  const auto dim = static_cast<std::size_t>(mesh.dim);
  for (std::size_t c = 0; c < dim; ++c) {
    mesh.positions[dim * node + c] = bar.size[c] * halves[c] / (2.0 * bar.cells[c]);
  }
}

void set_positions(const BarDescription& bar, const BarGrid& grid,
                   const std::vector<bool>& layer_has_centres, Mesh& mesh) {
  mesh.positions.resize(static_cast<std::size_t>(mesh.dim) * grid.num_nodes());
  const auto& [nx, ny, nz] = bar.cells;
  for (int i = 0; i <= nx; ++i) {
    for (int j = 0; j <= ny; ++j) {
      for (int k = 0; k <= nz; ++k) {
        set_position(bar, {2 * i, 2 * j, 2 * k}, grid.grid_node(i, j, k), mesh);
      }
    }
    if (i == nx || !layer_has_centres[static_cast<std::size_t>(i)]) continue;
    for (int j = 0; j < ny; ++j) {
      for (int k = 0; k < nz; ++k) {
        set_position(bar, {2 * i + 1, 2 * j + 1, 2 * k + 1}, grid.centre_node(i, j, k), mesh);
      }
    }
  }
}

/// Cells [first, last) along x, cut into one block; of quadratic elements, those of their corners.
ElementBlock cut_layers(const BarDescription& bar, const BarGrid& grid, const std::string& element,
                        int first, int last, std::int32_t region) {
  const CubeCut& cut = cube_cut(element);
  const ElementTopology& topology = element_topology(element);
  ElementBlock block;
  block.element = topology.is_quadratic() ? topology.linear : topology.element;
  block.nodes_per_element = topology.num_corners();
  for (int i = first; i < last; ++i) {
    for (int j = 0; j < bar.cells[1]; ++j) {
      for (int k = 0; k < std::max(bar.cells[2], 1); ++k) {
        const std::vector<std::int32_t> cell = grid.cell_nodes(i, j, k);
        for (const std::vector<int>& nodes : cut.elements) {
          for (const int node : nodes) block.nodes.push_back(cell[static_cast<std::size_t>(node)]);
          block.region.push_back(region);
        }
      }
    }
  }
  return block;
}

/// Whether the middle of an element's nodes lies in the box.
bool is_inside(const Mesh& mesh, std::span<const std::int32_t> nodes,
               const InclusionDescription& inclusion) {
  const auto dim = static_cast<std::size_t>(mesh.dim);
  for (std::size_t i = 0; i < dim; ++i) {
    double middle = 0;
    for (const std::int32_t node : nodes) {
      middle += mesh.positions[static_cast<std::size_t>(node) * dim + i];
    }
    middle /= static_cast<double>(nodes.size());
    if (middle < inclusion.box.minimum[i] || middle > inclusion.box.maximum[i]) return false;
  }
  return true;
}

/// Moves the elements of an inclusion from the blocks that there are to blocks of their own.
/// @throws InputError  when there are none
void take_out(const InclusionDescription& inclusion, SceneMesh& result) {
  Mesh& mesh = result.mesh;
  const std::int32_t region = region_number(mesh, inclusion.region);
  const std::size_t num_blocks = mesh.blocks.size();
  for (std::size_t b = 0; b < num_blocks; ++b) {
    ElementBlock outside = mesh.blocks[b], inside = mesh.blocks[b];
    for (ElementBlock* part : {&outside, &inside}) {
      part->nodes.clear();
      part->region.clear();
    }
    for (std::size_t e = 0; e < mesh.blocks[b].num_elements(); ++e) {
      const std::span<const std::int32_t> nodes = mesh.blocks[b].element_nodes(e);
      const bool is_in = is_inside(mesh, nodes, inclusion);
      ElementBlock& part = is_in ? inside : outside;
      part.nodes.insert(part.nodes.end(), nodes.begin(), nodes.end());
      part.region.push_back(is_in ? region : mesh.blocks[b].region[e]);
    }
    if (inside.num_elements() == 0) continue;
    SceneMesh::Block description = result.blocks[b];
    description.path = inclusion.path;
    description.region = inclusion.region;
    description.region_where = inclusion.region_where;
    if (outside.num_elements() == 0) {
      mesh.blocks[b] = std::move(inside);
      result.blocks[b] = std::move(description);
    } else {
      mesh.blocks[b] = std::move(outside);
      mesh.blocks.push_back(std::move(inside));
      result.blocks.push_back(std::move(description));
    }
  }
  const bool is_empty =
      std::none_of(result.blocks.begin(), result.blocks.end(),
                   [&](const SceneMesh::Block& block) { return block.path == inclusion.path; });
  if (is_empty) {
    throw InputError(
        fmt::format("{}: {}.box holds no element: take one that the middle of an element lies in",
                    inclusion.box.where, inclusion.path));
  }
}

/// Turns the blocks of quadratic elements into such, and numbers all nodes plane by plane again.
void make_quadratic(const std::vector<SceneMesh::Block>& blocks, Mesh& mesh) {
  std::vector<QuadraticBlock> quadratic;
  for (std::size_t b = 0; b < blocks.size(); ++b) {
    const std::string& element = blocks[b].association.element;
    if (element_topology(element).is_quadratic()) quadratic.push_back({b, element});
  }
  if (quadratic.empty()) return;
  add_mid_edge_nodes(mesh, quadratic);

  const auto dim = static_cast<std::size_t>(mesh.dim);
  const auto position = [&](std::size_t node) {
    return std::span<const double>(&mesh.positions[dim * node], dim);
  };
  std::vector<std::size_t> order(mesh.num_nodes());
  std::iota(order.begin(), order.end(), std::size_t{0});
  // Coordinates of one plane are equal to the last bit: each is made in one way.
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return std::ranges::lexicographical_compare(position(a), position(b));
  });
  std::vector<std::int32_t> number(order.size());
  std::vector<double> positions;
  for (std::size_t n = 0; n < order.size(); ++n) {
    number[order[n]] = static_cast<std::int32_t>(n);
    positions.insert(positions.end(), position(order[n]).begin(), position(order[n]).end());
  }
  for (ElementBlock& block : mesh.blocks) {
    for (std::int32_t& node : block.nodes) node = number[static_cast<std::size_t>(node)];
  }
  mesh.positions = std::move(positions);
}

/// The planes between layers of cells, and the nodes on each.
void set_sections(const BarDescription& bar, SceneMesh& result) {
  const Mesh& mesh = result.mesh;
  const auto dim = static_cast<std::size_t>(mesh.dim);
  const int nx = bar.cells[0];
  for (int i = 0; i <= nx; ++i) result.section_x.push_back(bar.size[0] * i / nx);
  result.section_nodes.resize(result.section_x.size());
  for (std::size_t n = 0; n < mesh.num_nodes(); ++n) {
    const double layers = mesh.positions[dim * n] / bar.size[0] * nx;
    const double nearest = std::round(layers);
    // Other nodes are at least a quarter of a cell away.
    if (std::abs(layers - nearest) > 0.1) continue;
    result.section_nodes[static_cast<std::size_t>(nearest)].push_back(static_cast<std::int32_t>(n));
  }
}

/// A number that the runtime can still count with.
void check_size(const BarDescription& bar) {
  // Grid nodes and centres; of quadratic elements a node on each of the seven edges and diagonals
  // that start from a grid node.
  const bool quadratic =
      std::any_of(bar.sections.begin(), bar.sections.end(), [](const SectionDescription& section) {
        return element_topology(section.association.element).is_quadratic();
      });
  double nodes = quadratic ? 8 : 2;
  for (const int cells : bar.cells) nodes *= cells + 1.0;
  constexpr double most = std::numeric_limits<std::int32_t>::max() / 3.0;
  if (nodes > most) {
    throw InputError(fmt::format(
        "{}: bar.cells = [{}]: too many for node numbers of 32 bits: take fewer", bar.cells_where,
        fmt::join(std::span(bar.cells).first(bar.cells[2] > 0 ? 3 : 2), ", ")));
  }
}

}  // namespace

SceneMesh make_bar(const BarDescription& bar) {
  check_size(bar);
  std::vector<bool> layer_has_centres;
  std::vector<int> ends;
  for (const SectionDescription& section : bar.sections) {
    const CubeCut& cut =
        with_location(section.association_where, section.path + ".association",
                      [&]() -> const CubeCut& { return cube_cut(section.association.element); });
    ends.push_back(end_layer(bar, section));
    layer_has_centres.resize(static_cast<std::size_t>(ends.back()), cut.uses_centre);
  }

  const BarGrid grid(bar, layer_has_centres);
  SceneMesh result;
  result.mesh.dim = bar.cells[2] > 0 ? 3 : 2;
  set_positions(bar, grid, layer_has_centres, result.mesh);
  int first = 0;
  for (std::size_t s = 0; s < bar.sections.size(); ++s) {
    const SectionDescription& section = bar.sections[s];
    const std::int32_t region = region_number(result.mesh, section.region);
    result.mesh.blocks.push_back(
        cut_layers(bar, grid, section.association.element, first, ends[s], region));
    result.blocks.push_back({section.path, section.association, section.association_where,
                             section.region, section.region_where});
    first = ends[s];
  }
  for (const InclusionDescription& inclusion : bar.inclusions) take_out(inclusion, result);
  make_quadratic(result.blocks, result.mesh);
  set_sections(bar, result);
  const FaceMatching matching = match_faces(result.mesh);
  result.split_quadrilaterals = matching.split_quadrilaterals.size();
  result.unequal_faces = matching.unequal.size();
  return result;
}

}  // namespace elastogen::selector
