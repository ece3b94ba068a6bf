// How far numbers of many digits are apart.
#pragma once

#include <ginac/ginac.h>

namespace elastogen::symgen {

/// |value - reference| / |reference|, or the absolute value where the reference is 0.
inline double relative_error(const GiNaC::numeric& value, const GiNaC::numeric& reference) {
  const GiNaC::numeric scale = reference.is_zero() ? GiNaC::numeric(1) : GiNaC::abs(reference);
  return (GiNaC::abs(value - reference) / scale).to_double();
}

}  // namespace elastogen::symgen
