// Prefixes of units, for labels.
#pragma once

#include <string>

namespace elastogen::selector {

/// A number in the prefixed unit is the number in the unit times `factor`.
struct SiPrefix {
  std::string symbol;  ///< "k", "M"; empty: none
  double factor = 1;
};

/// The prefix from pico to tera with which a magnitude is from 1 to 1000; none for 0 and what is
/// not finite.
[[nodiscard]] SiPrefix si_prefix(double magnitude);

}  // namespace elastogen::selector
