// Stress and tangent of a term as formulas in tensors, by the chain rule over the invariants.
#pragma once

#include <ginac/ginac.h>

#include <array>
#include <string>
#include <vector>

namespace elastogen::symgen {

/// A symmetric tensor that stresses are written in. Those of the second Piola-Kirchhoff stress S
/// go with dE, those of the small-strain stress sigma with d eps.
struct StressTensor {
  std::string name;   ///< "I", "E", "C", "C^-1"; "eps"
  bool small_strain;  ///< of sigma, else of S
};

inline constexpr std::size_t num_stress_tensors = 6;

/// I, E, C, C^-1 of S, then I, eps of sigma.
[[nodiscard]] const std::array<StressTensor, num_stress_tensors>& stress_tensors();

/// With T_u the tensors above:
///   S = sum of stress[u] T_u over the first four, sigma = the same over the last two,
///   P = F S + sigma (first Piola-Kirchhoff), dP = dH S + F dS + d sigma,
///   dT-part of u = sum_v tangent[u][v] (T_v : dE) T_u + stress[u] dT_u,
/// dE standing for d eps where v is of the small strain; dI = 0, dC = 2 dE,
/// d C^-1 = -2 C^-1 dE C^-1.
struct StressForm {
  std::vector<GiNaC::ex> stress;                ///< [u], over invariants (J in place of I3) [Pa]
  std::vector<std::vector<GiNaC::ex>> tangent;  ///< [u][v], symmetric [Pa]
};

/// @param term  over parameters and invariants
/// Source: derivatives of invariants, Bonet & Wood, Nonlinear Continuum Mechanics, 2nd ed.,
/// section 6.4.
[[nodiscard]] StressForm stress_form(const GiNaC::ex& term);

}  // namespace elastogen::symgen
