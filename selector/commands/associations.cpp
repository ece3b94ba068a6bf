#include "selector/commands/associations.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <sstream>

#include "runtime/error.h"
#include "selector/support/names.h"
#include "symgen/element/element.h"
#include "symgen/law/law.h"
#include "symgen/quadrature/quadrature.h"

namespace elastogen::selector {
namespace fs = std::filesystem;
namespace {

bool admits(const std::vector<std::string>& patterns, const std::string& name) {
  return patterns.empty() || std::any_of(patterns.begin(), patterns.end(),
                                         [&](const auto& p) { return matches_glob(p, name); });
}

/// All quadratures of all elements, each once.
std::vector<std::string> all_quadrature_names() {
  std::vector<std::string> names;
  for (const std::string& element : symgen::element_names()) {
    for (const std::string& name : symgen::quadrature_names(element)) {
      if (std::find(names.begin(), names.end(), name) == names.end()) names.push_back(name);
    }
  }
  return names;
}

/// @throws InputError  unless the name, or glob, is or matches one of the known
void check_part(const std::string& kind, const std::string& name,
                const std::vector<std::string>& known) {
  const bool found =
      std::any_of(known.begin(), known.end(), [&](const auto& k) { return matches_glob(name, k); });
  if (found) return;
  throw InputError(fmt::format("unknown {} '{}'{} (there are: {})", kind, name,
                               did_you_mean(name, known), join(known, ", ")));
}

struct KnownNames {
  std::vector<std::string> laws, elements, quadratures, splits;
};

/// Law x element x its quadratures x splits, whether or not the law can have the quadrature.
std::vector<symgen::AssociationId> all_combinations(const KnownNames& known) {
  std::vector<symgen::AssociationId> ids;
  for (const std::string& law : known.laws) {
    for (const std::string& element : known.elements) {
      for (const std::string& quadrature : symgen::quadrature_names(element)) {
        for (const std::string& split : known.splits) {
          ids.push_back({law, element, quadrature, split});
        }
      }
    }
  }
  return ids;
}

/// Tells which combinations exist. A law is read, once, only when that decides it.
class Existence {
 public:
  explicit Existence(const std::vector<fs::path>& law_folders) : law_folders_(law_folders) {}

  bool operator()(const symgen::AssociationId& id) {
    if (!symgen::find_quadrature(id.element, id.quadrature).polynomial_laws_only) return true;
    const auto known = polynomial_.find(id.law);
    if (known != polynomial_.end()) return known->second;
    const symgen::Law law = symgen::read_law(symgen::find_law_file(id.law, law_folders_));
    return polynomial_[id.law] = law.polynomial;
  }

 private:
  const std::vector<fs::path>& law_folders_;
  std::map<std::string, bool> polynomial_;
};

/// Says which part of a pattern that matched nothing is to blame, as far as that can be told.
[[noreturn]] void throw_no_match(const std::string& pattern, const KnownNames& known) {
  std::vector<std::string> parts;
  std::istringstream stream(pattern);
  for (std::string part; std::getline(stream, part, '-');) parts.push_back(part);
  if (parts.size() == 4) {
    check_part("law", parts[0], known.laws);
    check_part("element", parts[1], known.elements);
    const bool one_element =
        std::find(known.elements.begin(), known.elements.end(), parts[1]) != known.elements.end();
    if (one_element) {
      check_part("quadrature of " + parts[1], parts[2], symgen::quadrature_names(parts[1]));
    }
    check_part("quadrature", parts[2], known.quadratures);
    check_part("split", parts[3], known.splits);
  }
  throw InputError(
      fmt::format("no association matches '{}'; ids read law-element-quadrature-split, as in "
                  "stvk-hexa8-q8-none; `elastogen list` shows them all",
                  pattern));
}

void check_pattern(const std::string& pattern, const std::vector<symgen::AssociationId>& all,
                   const KnownNames& known, Existence& exists) {
  bool matched = false;
  for (const symgen::AssociationId& id : all) {
    if (!matches_glob(pattern, id.text())) continue;
    if (exists(id)) return;
    matched = true;
  }
  if (!matched) throw_no_match(pattern, known);
  throw InputError(fmt::format(
      "no association matches '{}': quadrature 'exact' integrates analytically, which needs an "
      "energy that is polynomial in the displacement gradient; take another quadrature",
      pattern));
}

}  // namespace

std::vector<symgen::AssociationId> find_associations(const AssociationFilter& filter,
                                                     const std::vector<fs::path>& law_folders) {
  const KnownNames known = {symgen::law_names(law_folders), symgen::element_names(),
                            all_quadrature_names(), symgen::split_names()};
  for (const std::string& name : filter.laws) check_part("law", name, known.laws);
  for (const std::string& name : filter.elements) check_part("element", name, known.elements);
  for (const std::string& name : filter.quadratures) {
    check_part("quadrature", name, known.quadratures);
  }
  for (const std::string& name : filter.splits) check_part("split", name, known.splits);

  const std::vector<symgen::AssociationId> all = all_combinations(known);
  Existence exists(law_folders);
  for (const std::string& pattern : filter.patterns) check_pattern(pattern, all, known, exists);
  std::vector<symgen::AssociationId> found;
  for (const symgen::AssociationId& id : all) {
    const bool wanted = admits(filter.laws, id.law) && admits(filter.elements, id.element) &&
                        admits(filter.quadratures, id.quadrature) &&
                        admits(filter.splits, id.split) && admits(filter.patterns, id.text());
    if (wanted && exists(id)) found.push_back(id);
  }
  return found;
}

}  // namespace elastogen::selector
