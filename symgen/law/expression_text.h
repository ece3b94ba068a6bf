// Expressions as text that is the same in every run.
#pragma once

#include <ginac/ginac.h>

#include <string>

namespace elastogen::symgen {

/// An expression in the syntax of law files, without expanding it. Operands of sums and products
/// are ordered by their text: GiNaC's own order may change from run to run.
[[nodiscard]] std::string expression_text(const GiNaC::ex& expression);

}  // namespace elastogen::symgen
