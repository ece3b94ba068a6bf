#include "selector/support/names.h"

#include <fmt/format.h>
#include <fnmatch.h>

#include "symgen/law/names.h"

namespace elastogen::selector {

bool matches_glob(const std::string& pattern, const std::string& text) {
  return fnmatch(pattern.c_str(), text.c_str(), 0) == 0;
}

std::string did_you_mean(std::string_view name, const std::vector<std::string>& known) {
  return symgen::suggestion(std::string(name), known);
}

std::string join(const std::vector<std::string>& names, std::string_view separator) {
  return fmt::format("{}", fmt::join(names, separator));
}

}  // namespace elastogen::selector
