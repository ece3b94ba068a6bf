// Characters beyond ASCII, as messages name them.
#pragma once

#include <string>

namespace elastogen::symgen {

/// The whole character that begins at a byte of a UTF-8 text; "\x07" for a control character and
/// for a byte that begins none.
[[nodiscard]] std::string character_at(const std::string& text, std::size_t begin);

/// "; write mu for it" for a character that has a usual spelling in ASCII (Greek letters, raised
/// digits, signs); else nothing.
[[nodiscard]] std::string in_ascii(const std::string& character);

}  // namespace elastogen::symgen
