// Elements in general position for tests: distorted rest shapes and displacements of a given size.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "symgen/law/law.h"
#include "symgen/pipeline.h"

namespace elastogen::test {

struct SampleOptions {
  double strain = 0.1;       ///< size of the nodal displacements over the element's size
  double distortion = 0.15;  ///< of the reference shape, in units of its coordinates
  bool box = false;          ///< an axis-aligned box instead of a distorted shape
  bool straight = false;     ///< quadratic elements: straight edges, their nodes in the middle
  std::uint32_t seed = 1;
};

/// Parameters of E = 1000 Pa, nu = 0.3, or of a rubber of that kind.
[[nodiscard]] std::vector<double> sample_parameters(const symgen::Law& law);

/// Rest positions, displacement, direction, and sample parameters.
[[nodiscard]] symgen::ElementCase sample_case(const symgen::AssociationId& id,
                                              const symgen::Law& law, const SampleOptions& options);

/// Positions of a sample turned by `angle` about an axis through (1, 2, 3), in the plane about the
/// origin, and shifted, as a displacement.
void make_rigid_motion(symgen::ElementCase& sample, int dim, double angle);

/// A shipped law, or one of the tests' own.
[[nodiscard]] symgen::Law law_named(const std::string& name);

/// Every law x element x quadrature, unsplit.
[[nodiscard]] std::vector<std::string> unsplit_associations();

/// Those of them whose kernels are compiled for the tests: a covering sample, or in the catalogue
/// all.
[[nodiscard]] std::vector<std::string> unsplit_tested();

/// Those of them whose graphs are walked again and again in exact numbers: not of 20 points and
/// more, which repeat what fewer points show; in the catalogue all.
[[nodiscard]] std::vector<std::string> unsplit_walked();

/// Those of quadratic elements among them: a few, since they are large.
[[nodiscard]] std::vector<std::string> quadratic_associations();

/// Puts the nodes in the middle of a quadratic element's edges back there; positions [a * dim + i].
void straighten_edges(const symgen::Element& element, std::vector<double>& positions);

/// "stvk_hexa8_q8_none", for names of parametrised tests.
[[nodiscard]] std::string test_name(const std::string& association);

}  // namespace elastogen::test
