// A term of a law at rest (H = 0).
#pragma once

#include <ginac/ginac.h>

#include <vector>

namespace elastogen::symgen {

/// Energy density and first Piola-Kirchhoff stress at H = 0, symbolic in the parameters.
struct RestState {
  GiNaC::ex energy;
  std::vector<GiNaC::ex> stress;  ///< [i * 3 + j] = dW/dH_ij
};

/// By the chain rule over the invariants, whose own gradients at rest are derived from their
/// definitions.
/// @throws std::exception  (GiNaC's) where the term or its derivative has a pole at rest
[[nodiscard]] RestState rest_state(const GiNaC::ex& term);

/// True if the term is a polynomial in the displacement gradient: a polynomial in the invariants,
/// once roots and logarithms of powers of J are resolved and quotients cancelled.
[[nodiscard]] bool is_polynomial_in_gradient(const GiNaC::ex& term);

}  // namespace elastogen::symgen
