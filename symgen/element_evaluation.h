// One element's operations by numbers, on any arithmetic; exactly, again and again.
#pragma once

#include <cln/cln.h>

#include <memory>
#include <vector>

#include "runtime/kernel_abi.h"
#include "symgen/dag/evaluate.h"
#include "symgen/pipeline.h"

namespace elastogen::symgen {

/// Results of one element; indices as in Evaluation.
template <class Number>
struct ElementResults {
  Number energy;
  std::vector<Number> forces, product;  ///< product empty without a direction
  std::vector<Number> stiffness;        ///< empty unless asked for
  std::vector<Number> stress;
  bool inside_domain = true;  ///< all margins of the law's domain are positive
};

/// Cauchy stress of every point [Pa], as [g][i * 3 + j], from what the operation `stress` gives:
/// sigma = P F^T / det F with F = I + H; P itself where the law is for small strain. None, an empty
/// list, where det F = 0.
template <class Arithmetic>
[[nodiscard]] std::vector<std::vector<typename Arithmetic::Number>> cauchy_stress(
    const std::vector<typename Arithmetic::Number>& stress, bool small_strain,
    const Arithmetic& arithmetic) {
  using Number = typename Arithmetic::Number;
  const Number zero = arithmetic.from_exact(ExactNumber(0));
  const Number one = arithmetic.from_exact(ExactNumber(1));
  const Number minus_one = arithmetic.from_exact(ExactNumber(-1));
  std::vector<std::vector<Number>> cauchy;
  for (std::size_t first = 0; first < stress.size(); first += stress_numbers) {
    std::vector<Number>& sigma = cauchy.emplace_back();
    const auto first_piola = [&](std::size_t i, std::size_t j) {
      return stress[first + 9 + i * 3 + j];
    };
    const auto deformation = [&](std::size_t i, std::size_t j) {
      const Number& entry = stress[first + i * 3 + j];
      return i == j ? arithmetic.add(one, entry) : entry;
    };
    Number determinant = zero;
    for (std::size_t j = 0; j < 3; ++j) {
      const std::size_t k = (j + 1) % 3, l = (j + 2) % 3;
      const Number minor =
          arithmetic.add(arithmetic.multiply(deformation(1, k), deformation(2, l)),
                         arithmetic.multiply(
                             minus_one, arithmetic.multiply(deformation(1, l), deformation(2, k))));
      determinant = arithmetic.add(determinant, arithmetic.multiply(deformation(0, j), minor));
    }
    if (!small_strain && determinant == zero) continue;
    for (std::size_t i = 0; i < 3; ++i) {
      for (std::size_t j = 0; j < 3; ++j) {
        if (small_strain) {
          sigma.push_back(first_piola(i, j));
          continue;
        }
        Number sum = zero;
        for (std::size_t k = 0; k < 3; ++k) {
          sum = arithmetic.add(sum, arithmetic.multiply(first_piola(i, k), deformation(j, k)));
        }
        sigma.push_back(arithmetic.multiply(sum, arithmetic.power(determinant, cln::cl_RA(-1))));
      }
    }
  }
  return cauchy;
}

/// The exact element of an association: the textbook form of its law, before all passes, walked in
/// CLN numbers. Made once, evaluated for many inputs.
class ExactElement {
 public:
  ExactElement(const AssociationId& id, const Law& law, Derivation derivation);
  ~ExactElement();
  ExactElement(ExactElement&&) noexcept;
  ExactElement& operator=(ExactElement&&) noexcept;

  /// @param digits  decimal; the textbook form loses twice those of the strain
  /// @throws OutsideDomain  where the law is not defined
  /// @throws InputError     inputs that are not finite
  [[nodiscard]] ElementResults<cln::cl_R> evaluate(const ElementCase& input, unsigned digits,
                                                   bool with_stiffness) const;

 private:
  struct Data;
  std::unique_ptr<Data> data_;
};

}  // namespace elastogen::symgen
