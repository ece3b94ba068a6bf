// Inputs that kernels are certified with: well-shaped elements at every strain, and all that hurts.
#pragma once

#include <cstdint>
#include <functional>
#include <random>
#include <string>
#include <vector>

#include "symgen/element/element.h"
#include "symgen/law/law.h"
#include "symgen/pipeline.h"
#include "symgen/quadrature/quadrature.h"

namespace elastogen::selector {

/// One element's geometry in numbers.
class ReferenceShape {
 public:
  ReferenceShape(const symgen::Element& element, const symgen::Quadrature& quadrature);

  int dim;
  int num_nodes;
  std::vector<double> nodes;  ///< [a * dim + i]: reference coordinates

  /// Smallest Jacobian determinant dX/dxi over the quadrature points.
  /// @param positions  [a * dim + i]
  [[nodiscard]] double smallest_determinant(const std::vector<double>& positions) const;

 private:
  std::vector<std::vector<double>> slopes_;  // [point][a * dim + j] = dLambda_a/dxi_j
};

/// What a family's cases are made from.
struct CaseContext {
  const ReferenceShape& shape;
  const symgen::Law& law;
  bool single_precision;
  std::mt19937& generator;
};

/// Decimal digits of the exact evaluation that most families need: the textbook form loses twice
/// those of the strain, 24 of them at 1e-12.
inline constexpr unsigned usual_digits = 60;

/// Inputs of one kind.
struct CaseFamily {
  std::string name;  ///< "strain 1e-06"
  /// Well-shaped elements without rotation: errors are bounded as they are. In other families they
  /// are bounded relative to the condition of the case.
  bool well_posed;
  unsigned digits;  ///< decimal, of the exact evaluation
  std::function<symgen::ElementCase(const CaseContext&)> make;
};

/// In the order of reports; the first are well-posed.
[[nodiscard]] const std::vector<CaseFamily>& case_families();

/// The inputs as a kernel sees them: rounded to its scalar.
[[nodiscard]] symgen::ElementCase rounded(symgen::ElementCase input, bool single_precision);

/// The inputs with every difference of nodal positions and displacements changed at random by up
/// to one unit in the last place of the scalar, and every parameter likewise.
[[nodiscard]] symgen::ElementCase perturbed(const symgen::ElementCase& input, int dim,
                                            bool single_precision, std::mt19937& generator);

/// Whether all numbers of a case are finite.
[[nodiscard]] bool is_finite(const symgen::ElementCase& input);

}  // namespace elastogen::selector
