// An association in the thesis's formulation, beside the thesis's own numbers.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "symgen/pipeline.h"

namespace elastogen::symgen {

/// Grouped constants of one fragment of the energy: one law term at one quadrature point.
struct ThesisFragment {
  std::string term;
  int point = 0;
  int constants = 0;
};

struct ThesisVariant {
  std::string geometry;
  int constants = 0;                      ///< of the whole energy, unsplit (table 3.5)
  std::vector<ThesisFragment> fragments;  ///< with all splits (tables 3.6 and 3.7)
};

/// Operations of the energy as a polynomial with every monomial written out, and of its
/// derivatives.
struct ExpandedCost {
  long monomials = 0;
  long energy_flops = 0, forces_flops = 0, product_flops = 0;
};

/// What the thesis prints for the same law and element.
/// Source: X. Faure, thesis, Lyon 2014, tables 3.4 to 3.7.
struct ThesisNumbers {
  std::string geometry;        ///< the variant they belong to
  int constants = 0;           ///< unsplit
  std::vector<int> fragments;  ///< with all splits
};

struct ThesisReport {
  std::vector<ThesisVariant> variants;
  std::optional<ExpandedCost> expanded;  ///< affine elements with laws polynomial in H
  std::optional<ThesisNumbers> printed;  ///< laws hooke and stvk
};

/// Takes seconds for a tetrahedron with Saint-Venant Kirchhoff: a million operations are written
/// out.
[[nodiscard]] ThesisReport thesis_report(const AssociationId& id, const Law& law);

}  // namespace elastogen::symgen
