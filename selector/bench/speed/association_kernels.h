// Kernels of one association in one precision, with their operation counts.
#pragma once

#include <string>

#include "selector/bench/speed/measure_speed.h"

namespace elastogen::selector {

struct AssociationKernels {
  symgen::AssociationId id;
  symgen::GeneratedAssociation generated;  ///< counts of operations
  std::vector<double> parameters;
  LoadedKernels in_double;
  LoadedKernels in_single;  ///< where single precision is asked for

  /// @throws InternalError  for an operation that there is not
  [[nodiscard]] const symgen::OperationReport& report(const std::string& geometry,
                                                      const std::string& operation) const;
};

/// All operations. Parameters are those of a rubber-like solid: Young's modulus 1 MPa, Poisson's
/// ratio 0.3, or 1 each where the law does not follow from them.
[[nodiscard]] AssociationKernels load_kernels(const symgen::AssociationId& id,
                                              const SpeedOptions& options);

}  // namespace elastogen::selector
