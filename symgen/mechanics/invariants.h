// The invariants of the deformation that laws are written in.
#pragma once

#include <ginac/ginac.h>

#include <string>
#include <vector>

namespace elastogen::symgen {

/// `symbol` stands for `value`, which may use the displacement gradient, parameters, and symbols
/// defined before it. Keeping the definitions apart (never expanding them) is what keeps the
/// expression graph small.
struct Definition {
  GiNaC::symbol symbol;
  GiNaC::ex value;
};

/// A scalar that a law may use. With H the displacement gradient, F = I + H, C = F^T F,
/// E = (H + H^T + H^T H)/2 the Green-Lagrange strain, eps = (H + H^T)/2 the small strain:
struct Invariant {
  std::string name;     ///< as written in laws
  std::string formula;  ///< "tr E"
  std::string meaning;
  GiNaC::symbol symbol;
};

/// trE = tr E, trE2 = tr E^2, tr_eps = tr eps, tr_eps2 = tr eps^2, I1 = tr C,
/// I2 = (I1^2 - tr C^2)/2, I3 = det C, J = det F. All are dimensionless and, in two dimensions,
/// those of plane strain (H_33 = 0).
[[nodiscard]] const std::vector<Invariant>& invariants();
[[nodiscard]] std::vector<std::string> invariant_names();

/// @throws InternalError  for an unknown name
[[nodiscard]] const Invariant& find_invariant(const std::string& name);

/// Symbols of the displacement gradient, H[i * dim + j] = dU_i/dX_j, called H00, H01, ...
[[nodiscard]] const std::vector<GiNaC::symbol>& displacement_gradient(int dim);

/// Definitions of strain measures and of all invariants as the books have them, in order of use.
/// Strains are formed from H itself, never as (F^T F - I)/2.
[[nodiscard]] std::vector<Definition> textbook_definitions(int dim);

/// `expression` with all definitions put in, last first.
[[nodiscard]] GiNaC::ex substitute_definitions(const GiNaC::ex& expression,
                                               const std::vector<Definition>& definitions);

/// Those definitions that some expression needs, directly or through others; their order is kept.
[[nodiscard]] std::vector<Definition> needed_definitions(
    const std::vector<GiNaC::ex>& expressions, const std::vector<Definition>& definitions);

/// Green-Lagrange strain E as definitions E00, E01, ... (upper triangle), added to `definitions`;
/// returns E[i * dim + j], symmetric.
[[nodiscard]] std::vector<GiNaC::ex> define_green_lagrange(int dim,
                                                           std::vector<Definition>& definitions);

/// Adds trE, trE2, tr_eps and tr_eps2, for a Green-Lagrange strain E[i * dim + j].
void define_strain_invariants(int dim, const std::vector<GiNaC::ex>& green_lagrange,
                              std::vector<Definition>& definitions);

/// Determinant of entries[i * dim + j]; dim is 2 or 3.
[[nodiscard]] GiNaC::ex determinant(int dim, const std::vector<GiNaC::ex>& entries);

/// An expression in invariants with I3 written as J^2, and with roots and logarithms of powers of J
/// resolved, which J > 0 allows: sqrt(I3) becomes J, log(J^2) becomes 2 log(J).
/// @param j  symbol that stands for J in the result
[[nodiscard]] GiNaC::ex resolve_powers_of_j(const GiNaC::ex& expression, const GiNaC::possymbol& j);

}  // namespace elastogen::symgen
