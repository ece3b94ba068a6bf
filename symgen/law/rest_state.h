// A term of a law at rest (H = 0).
#pragma once

#include <ginac/ginac.h>

#include <string>
#include <vector>

namespace elastogen::symgen {

/// Energy density and first Piola-Kirchhoff stress at H = 0, symbolic in the parameters.
struct RestState {
  bool finite = true;  ///< false: the term or its derivative has a pole at rest; the rest is unset
  GiNaC::ex energy;
  std::vector<GiNaC::ex> stress;  ///< [i * 3 + j] = dW/dH_ij
};

/// By the chain rule over the invariants, whose own gradients at rest are derived from their
/// definitions.
[[nodiscard]] RestState rest_state(const GiNaC::ex& term);

/// What is wrong with a term's energy or stress at rest, with the remedy; "" if it is zero.
[[nodiscard]] std::string energy_fault(const RestState& rest);
[[nodiscard]] std::string stress_fault(const RestState& rest);

/// Tangent dP/dH at H = 0, [(i * 3 + j) * 9 + k * 3 + l] = d2W/(dH_ij dH_kl), by the chain rule;
/// empty where it is not finite.
[[nodiscard]] std::vector<GiNaC::ex> rest_tangent(const GiNaC::ex& term);

/// True if the term is a polynomial in the displacement gradient: a polynomial in the invariants,
/// once roots and logarithms of powers of J are resolved and quotients cancelled.
[[nodiscard]] bool is_polynomial_in_gradient(const GiNaC::ex& term);

}  // namespace elastogen::symgen
