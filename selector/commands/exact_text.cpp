#include "selector/commands/exact_text.h"

#include <cln/cln.h>

#include "runtime/error.h"
#include "symgen/dag/decimal.h"
#include "symgen/law/working_precision.h"

namespace elastogen::selector {

std::string decimal_text(const GiNaC::ex& number, int digits) {
  const symgen::WorkingPrecision precision(digits +
                                           20);  // guard digits: rounding below is then right
  const GiNaC::ex value = number.evalf();
  if (!GiNaC::is_a<GiNaC::numeric>(value) || !GiNaC::ex_to<GiNaC::numeric>(value).is_real()) {
    throw InternalError("decimal_text was given something that is no real number");
  }
  // An exact rational stays exact; evalf would round it first.
  const bool exact = GiNaC::is_a<GiNaC::numeric>(number);
  const cln::cl_N general = GiNaC::ex_to<GiNaC::numeric>(exact ? number : value).to_cl_N();
  return symgen::decimal_text(cln::the<cln::cl_R>(general), digits);
}

}  // namespace elastogen::selector
