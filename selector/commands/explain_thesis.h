// `explain --formulation thesis`: an association as the thesis formulates it, beside its tables.
#pragma once

#include "selector/commands/command.h"

namespace elastogen::selector {

/// Prints grouped constants of the energy, whole and split by law term and quadrature point, and
/// for affine elements what writing out every monomial costs. Returns the exit status.
int explain_thesis(const symgen::AssociationId& id, const symgen::Law& law, bool json,
                   const Context& context);

}  // namespace elastogen::selector
