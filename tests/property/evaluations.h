// Comparing what two walks of an association's graphs give for one element.
#pragma once

#include "symgen/pipeline.h"

namespace elastogen::test {

/// Expects the status "ok" and results that differ from the exact ones by no more than `rounding`
/// times the energy, the largest force, the largest entry of the stiffness, and the largest of the
/// numbers of one kind that `stress` gives.
void expect_agrees(const symgen::Evaluation& found, const symgen::Evaluation& exact,
                   double rounding);

}  // namespace elastogen::test
