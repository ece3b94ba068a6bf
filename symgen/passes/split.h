// Splitting an association's equations into fragments.
#pragma once

#include <string>
#include <vector>

namespace elastogen::symgen {

/// Any subset of {law term, Gauss point, node, dimension}. Source: thesis section 3.5.1.
struct Split {
  bool law_term = false, gauss_point = false, node = false, dimension = false;

  /// @throws InputError  unless text is "none" or letters of "lgnd" in that order
  [[nodiscard]] static Split parse(const std::string& text);
  [[nodiscard]] std::string text() const;
};

/// All 16, from `none` to `lgnd`.
[[nodiscard]] const std::vector<Split>& all_splits();

/// Law terms and Gauss points whose energies one fragment adds up. Splitting by l and g applies to
/// every operation, since energy is a sum.
struct EnergyPart {
  struct Summand {
    int term, point;
  };
  std::vector<Summand> summands;
};
[[nodiscard]] std::vector<EnergyPart> energy_parts(const Split& split, int num_terms,
                                                   int num_points);

/// Rows a * dim + i of the outputs that one fragment writes. Splitting by n and d partitions the
/// rows of forces, product and stiffness; the direction is never split.
[[nodiscard]] std::vector<std::vector<int>> row_parts(const Split& split, int num_nodes, int dim);

}  // namespace elastogen::symgen
