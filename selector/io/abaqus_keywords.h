// Which keywords of a deck are worth no word when only its mesh is read.
#pragma once

#include <string_view>

namespace elastogen::selector {

/// Titles, requests for output, and cards that say more of one that is named in a note anyway: of a
/// material, a surface interaction, a coupling or a step.
/// @param keyword  in capitals
[[nodiscard]] bool is_left_out_silently(std::string_view keyword);

}  // namespace elastogen::selector
