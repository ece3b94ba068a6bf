// Names in messages: the nearest known one, and lists.
#pragma once

#include <string>
#include <vector>

namespace elastogen::symgen {

/// "; did you mean 'hexa8'?" for the known name that needs the fewest edits, if these are few
/// enough to be a slip (insertions, deletions, replacements, swapped neighbours); else nothing.
/// Equally near names: the first in `known`.
[[nodiscard]] std::string suggestion(const std::string& name,
                                     const std::vector<std::string>& known);

/// "a, b, c"; "none" for an empty list.
[[nodiscard]] std::string join_names(const std::vector<std::string>& names);

/// A letter, then letters, digits and underscores (ASCII).
[[nodiscard]] bool is_identifier(const std::string& name);

}  // namespace elastogen::symgen
