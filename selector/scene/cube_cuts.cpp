#include "selector/scene/cube_cuts.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "runtime/error.h"
#include "selector/io/element_topology.h"

namespace elastogen::selector {
namespace {

/// The corner at (i, j, k), each 0 or 1.
int corner(int i, int j, int k) {
  constexpr int ring[2][2] = {{0, 1}, {3, 2}};  // [j][i]
  return ring[j][i] + 4 * k;
}

/// One tetrahedron for each way from corner 0 to corner 6 along the edges.
CubeCut cut_into_tetrahedra() {
  CubeCut cut;
  std::vector<int> axes = {0, 1, 2};
  do {
    int at[3] = {0, 0, 0};
    std::vector<int> nodes = {corner(0, 0, 0)};
    for (const int axis : axes) {
      at[axis] = 1;
      nodes.push_back(corner(at[0], at[1], at[2]));
    }
    // An odd order of the axes turns the tetrahedron inside out.
    const bool odd = (axes[0] > axes[1]) ^ (axes[0] > axes[2]) ^ (axes[1] > axes[2]);
    if (odd) std::swap(nodes[1], nodes[2]);
    cut.elements.push_back(nodes);
  } while (std::next_permutation(axes.begin(), axes.end()));
  return cut;
}

/// One pyramid on each face; a base is counter-clockwise seen from the apex, that is from inside.
CubeCut cut_into_pyramids() {
  CubeCut cut;
  cut.uses_centre = true;
  for (std::vector<int> base : element_topology("hexa8").faces) {
    std::reverse(base.begin(), base.end());
    base.push_back(cube_centre);
    cut.elements.push_back(base);
  }
  return cut;
}

}  // namespace

const CubeCut& cube_cut(const std::string& element) {
  static const std::map<std::string, CubeCut> cuts = {
      {"tri3", {{{0, 1, 2}, {0, 2, 3}}, false}},
      {"quad4", {{{0, 1, 2, 3}}, false}},
      {"hexa8", {{{0, 1, 2, 3, 4, 5, 6, 7}}, false}},
      {"prism6", {{{0, 1, 2, 4, 5, 6}, {0, 2, 3, 4, 6, 7}}, false}},
      {"pyramid5", cut_into_pyramids()},
      {"tet4", cut_into_tetrahedra()},
  };
  const ElementTopology& topology = element_topology(element);
  const auto cut = cuts.find(std::string(topology.is_quadratic() ? topology.linear : element));
  if (cut == cuts.end()) {
    throw InputError(
        fmt::format("the cells of a bar cannot be cut into '{}': tri3 and quad4 in the plane, and "
                    "hexa8, prism6, "
                    "pyramid5, tet4, hexa20 and tet10 are possible",
                    element));
  }
  return cut->second;
}

}  // namespace elastogen::selector
