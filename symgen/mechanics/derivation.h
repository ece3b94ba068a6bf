// Who takes the derivatives that are emitted.
#pragma once

namespace elastogen::symgen {

/// Two full paths from the energy to forces and product; they agree to rounding.
enum class Derivation {
  dag,    ///< on the expression graph: reverse mode for forces, forward mode for the product
  ginac,  ///< by GiNaC, from the element's energy in nodal displacements
};

}  // namespace elastogen::symgen
