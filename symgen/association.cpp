// Association ids: spelling and parsing.
#include <fmt/format.h>

#include <algorithm>

#include "runtime/error.h"
#include "symgen/law/names.h"
#include "symgen/passes/profile.h"
#include "symgen/passes/split.h"
#include "symgen/pipeline.h"

namespace elastogen::symgen {

const std::vector<std::string>& split_names() {
  static const std::vector<std::string> names = [] {
    std::vector<std::string> result{"none", "auto"};
    for (const Split& split : all_splits()) {
      if (split.text() != "none") result.push_back(split.text());
    }
    return result;
  }();
  return names;
}

const std::vector<std::string>& profile_names() {
  static const std::vector<std::string> names = [] {
    std::vector<std::string> result;
    for (const Profile& profile : profiles()) result.push_back(profile.name);
    return result;
  }();
  return names;
}

AssociationId AssociationId::parse(const std::string& text) {
  std::vector<std::string> parts;
  for (std::size_t from = 0; from <= text.size();) {
    const std::size_t to = std::min(text.find('-', from), text.size());
    parts.push_back(text.substr(from, to - from));
    from = to + 1;
  }
  if (parts.size() != 4) {
    throw InputError(
        fmt::format("association '{}': must be LAW-ELEMENT-QUADRATURE-SPLIT, for example "
                    "stvk-hexa8-q8-none; `elastogen list` shows all",
                    text));
  }
  AssociationId id{parts[0], parts[1], parts[2], parts[3]};
  if (!is_identifier(id.law)) {
    throw InputError(fmt::format(
        "association '{}': law '{}' is no identifier (a letter, then letters, digits, _)", text,
        id.law));
  }
  try {
    (void)find_quadrature(find_element(id.element).name, id.quadrature);
    const std::vector<std::string>& splits = split_names();
    if (std::find(splits.begin(), splits.end(), id.split) == splits.end()) {
      throw InputError(fmt::format("unknown split '{}'{}: allowed are {}", id.split,
                                   suggestion(id.split, splits), join_names(splits)));
    }
  } catch (const InputError& error) {
    throw InputError(fmt::format("association '{}': {}", text, error.what()));
  }
  return id;
}

std::string AssociationId::text() const {
  return fmt::format("{}-{}-{}-{}", law, element, quadrature, split);
}

std::string AssociationId::identifier() const {
  return fmt::format("{}_{}_{}_{}", law, element, quadrature, split);
}

}  // namespace elastogen::symgen
