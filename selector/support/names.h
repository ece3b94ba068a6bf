// Names that users type: globs, the nearest known name, lists in messages.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace elastogen::selector {

/// Shell glob; `*` crosses '-' ("stvk-*").
[[nodiscard]] bool matches_glob(const std::string& pattern, const std::string& text);

/// "; did you mean 'hexa8'?" where a known name is a slip of the finger away, else nothing.
[[nodiscard]] std::string did_you_mean(std::string_view name,
                                       const std::vector<std::string>& known);

/// "a, b, c"
[[nodiscard]] std::string join(const std::vector<std::string>& names, std::string_view separator);

}  // namespace elastogen::selector
