#include "selector/io/abaqus_elements.h"

#include <algorithm>
#include <charconv>
#include <set>

#include "selector/io/element_topology.h"

namespace elastogen::selector {
namespace {

/// Types are a family's name, a number and letters.
struct Family {
  std::string_view prefix;
  int dim;
};

// Longer names come before those that they begin with.
constexpr Family families[] = {{"C3D", 3},   {"CPE", 2}, {"CPS", 2}, {"CAX", 2},
                               {"SFM3D", 2}, {"M3D", 2}, {"R3D", 2}, {"STRI", 2},
                               {"S", 2},     {"T2D", 1}, {"T3D", 1}, {"B", 1}};

struct OwnElement {
  int dim, num_nodes;
  std::string_view element;
};

constexpr OwnElement own_elements[] = {{3, 4, "tet4"},  {3, 5, "pyramid5"}, {3, 6, "prism6"},
                                       {3, 8, "hexa8"}, {3, 10, "tet10"},   {3, 20, "hexa20"},
                                       {2, 3, "tri3"},  {2, 4, "quad4"}};

/// What the number after a family's name says.
int num_nodes_of(std::string_view prefix, int number) {
  if (prefix == "B") return number % 10 == 2 ? 3 : 2;  // B31, B32, B33: the order of the curve
  if (prefix == "STRI" && number == 65) return 6;
  return number;
}

/// Corners of S1, S2, ..., counted from 1.
std::vector<std::vector<int>> face_corners(std::string_view linear) {
  if (linear == "tet4") return {{1, 2, 3}, {1, 4, 2}, {2, 4, 3}, {3, 4, 1}};
  if (linear == "pyramid5") return {{1, 2, 3, 4}, {1, 5, 2}, {2, 5, 3}, {3, 5, 4}, {4, 5, 1}};
  if (linear == "prism6") {
    return {{1, 2, 3}, {4, 6, 5}, {1, 4, 5, 2}, {2, 5, 6, 3}, {3, 6, 4, 1}};
  }
  if (linear == "hexa8") {
    return {{1, 2, 3, 4}, {5, 8, 7, 6}, {1, 5, 6, 2}, {2, 6, 7, 3}, {3, 7, 8, 4}, {4, 8, 5, 1}};
  }
  if (linear == "tri3") return {{1, 2}, {2, 3}, {3, 1}};
  return {{1, 2}, {2, 3}, {3, 4}, {4, 1}};
}

}  // namespace

std::optional<AbaqusElement> find_abaqus_element(std::string_view type) {
  for (const Family& family : families) {
    if (!type.starts_with(family.prefix)) continue;
    int number = 0;
    const std::string_view rest = type.substr(family.prefix.size());
    const auto [end, error] = std::from_chars(rest.data(), rest.data() + rest.size(), number);
    if (error != std::errc() || number < 2 || number > 100) continue;
    AbaqusElement found{family.dim, num_nodes_of(family.prefix, number), {}};
    for (const OwnElement& own : own_elements) {
      if (is_solid_or_plane(type) && own.dim == found.dim && own.num_nodes == found.num_nodes) {
        found.element = own.element;
      }
    }
    return found;
  }
  return std::nullopt;
}

bool is_solid_or_plane(std::string_view type) {
  return type.starts_with("C3D") || type.starts_with("CPE") || type.starts_with("CPS");
}

std::vector<std::vector<int>> abaqus_faces(std::string_view element) {
  const ElementTopology& topology = element_topology(std::string(element));
  std::vector<std::vector<int>> faces;
  for (const std::vector<int>& corners :
       face_corners(topology.is_quadratic() ? topology.linear : topology.element)) {
    std::set<int> wanted;
    for (const int corner : corners) wanted.insert(corner - 1);
    faces.push_back(*std::find_if(
        topology.faces.begin(), topology.faces.end(), [&](const std::vector<int>& face) {
          const auto count = static_cast<std::ptrdiff_t>(
              topology.dim == 2 ? face.size() : num_face_corners(face.size()));
          return std::set<int>(face.begin(), face.begin() + count) == wanted;
        }));
  }
  return faces;
}

}  // namespace elastogen::selector
