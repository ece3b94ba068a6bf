#include "selector/io/si_prefix.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace elastogen::selector {

SiPrefix si_prefix(double magnitude) {
  constexpr std::array<const char*, 9> symbols = {"p", "n", "µ", "m", "", "k", "M", "G", "T"};
  constexpr int none = 4;
  if (!std::isfinite(magnitude) || magnitude == 0) return {};
  // Rounded up a little: 999.9999999 is 1 of the next.
  const int thousands =
      static_cast<int>(std::floor(std::log10(std::abs(magnitude)) / 3 + 1e-10)) + none;
  const int chosen = std::clamp(thousands, 0, static_cast<int>(symbols.size()) - 1);
  return {symbols[static_cast<std::size_t>(chosen)], std::pow(10.0, 3.0 * (none - chosen))};
}

}  // namespace elastogen::selector
