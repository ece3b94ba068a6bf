#include "symgen/passes/split.h"

#include <fmt/format.h>

#include "runtime/error.h"

namespace elastogen::symgen {

Split Split::parse(const std::string& text) {
  for (const Split& split : all_splits()) {
    if (split.text() == text) return split;
  }
  throw InputError(fmt::format(
      "split '{}': allowed are none, auto, or letters of 'lgnd' in that order (l law term, g Gauss "
      "point, n node, d dimension)",
      text));
}

std::string Split::text() const {
  std::string letters;
  if (law_term) letters += 'l';
  if (gauss_point) letters += 'g';
  if (node) letters += 'n';
  if (dimension) letters += 'd';
  return letters.empty() ? "none" : letters;
}

const std::vector<Split>& all_splits() {
  static const std::vector<Split> splits = [] {
    std::vector<Split> result;
    for (int bits = 0; bits < 16; ++bits) {
      result.push_back({(bits & 1) != 0, (bits & 2) != 0, (bits & 4) != 0, (bits & 8) != 0});
    }
    return result;
  }();
  return splits;
}

std::vector<EnergyPart> energy_parts(const Split& split, int num_terms, int num_points) {
  const int term_parts = split.law_term ? num_terms : 1;
  const int point_parts = split.gauss_point ? num_points : 1;
  std::vector<EnergyPart> parts(static_cast<std::size_t>(term_parts * point_parts));
  for (int g = 0; g < num_points; ++g) {
    for (int l = 0; l < num_terms; ++l) {
      const int part = (split.law_term ? l : 0) * point_parts + (split.gauss_point ? g : 0);
      parts[part].summands.push_back({l, g});
    }
  }
  return parts;
}

std::vector<std::vector<int>> row_parts(const Split& split, int num_nodes, int dim) {
  const int dimension_parts = split.dimension ? dim : 1;
  std::vector<std::vector<int>> parts(
      static_cast<std::size_t>((split.node ? num_nodes : 1) * dimension_parts));
  for (int a = 0; a < num_nodes; ++a) {
    for (int i = 0; i < dim; ++i) {
      const int part = (split.node ? a : 0) * dimension_parts + (split.dimension ? i : 0);
      parts[part].push_back(a * dim + i);
    }
  }
  return parts;
}

}  // namespace elastogen::symgen
