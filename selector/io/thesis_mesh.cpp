#include "selector/io/thesis_mesh.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <map>
#include <numeric>
#include <optional>
#include <sstream>

#include "runtime/error.h"
#include "selector/io/element_topology.h"
#include "selector/io/mesh_draft.h"
#include "selector/support/files.h"
#include "selector/support/names.h"
#include "symgen/quadrature/quadrature.h"

namespace elastogen::selector {
namespace {

namespace fs = std::filesystem;

using NameTable = std::vector<std::pair<std::string, std::string>>;

const NameTable& laws() {
  static const NameTable table = {{"Hooke", "hooke"}, {"SaintVenant", "stvk"}};
  return table;
}

const NameTable& elements() {
  static const NameTable table = {{"Triangle", "tri3"},   {"Quad", "quad4"}, {"Tetra", "tet4"},
                                  {"Hexa", "hexa8"},      {"Cube", "hexa8"}, {"Prism", "prism6"},
                                  {"Pyramid", "pyramid5"}};
  return table;
}

std::string translated(const NameTable& table, const std::string& name, const char* what) {
  std::vector<std::string> known;
  for (const auto& [theirs, ours] : table) {
    if (theirs == name) return ours;
    known.push_back(theirs);
  }
  throw InputError(fmt::format("{} '{}': must be one of {}{}", what, name, join(known, ", "),
                               did_you_mean(name, known)));
}

/// Words of a file, line by line; comments and empty lines are left out.
class Lines {
 public:
  Lines(const fs::path& file, std::string_view what)
      : file_(file), stream_(read_text_file(file, what)) {}

  /// Reads on to the next line that says something; false at the end.
  bool next() {
    for (std::string line; std::getline(stream_, line);) {
      ++number_;
      std::istringstream text(line.substr(0, line.find('#')));
      words_.clear();
      for (std::string word; text >> word;) words_.push_back(word);
      if (!words_.empty()) return true;
    }
    words_.clear();
    return false;
  }

  /// The next line, which must have so many words or, with `at_least`, more.
  const std::vector<std::string>& expect(const std::string& form, std::size_t count,
                                         bool at_least = false) {
    if (!next()) {
      throw InputError(fmt::format("{}: the file ends after line {}: '{}' must follow",
                                   file_.string(), number_, form));
    }
    if (words_.size() < count || (!at_least && words_.size() > count)) fail_form(form);
    return words_;
  }
  /// A line that starts with a keyword.
  void expect_keyword(const std::string& keyword, const std::string& form, std::size_t count) {
    if (expect(form, count).front() != keyword) fail_form(form);
  }

  template <class Number>
  Number number(std::size_t word, Number minimum) const {
    Number value{};
    const std::string& text = words_[word];
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc() || end != text.data() + text.size() || !(value >= minimum)) {
      fail(fmt::format("'{}' is no {}", text, minimum == 0 ? "number from 0 on" : "number"));
    }
    return value;
  }

  [[nodiscard]] const std::vector<std::string>& words() const { return words_; }
  [[noreturn]] void fail(const std::string& message) const {
    throw InputError(fmt::format("{}:{}: {}", file_.string(), number_, message));
  }

 private:
  [[noreturn]] void fail_form(const std::string& form) const {
    fail(fmt::format("found '{}', must be '{}'", join(words_, " "), form));
  }

  fs::path file_;
  std::istringstream stream_;
  int number_ = 0;
  std::vector<std::string> words_;
};

void read_nodes(const fs::path& file, MeshDraft& draft) {
  Lines lines(file, "mesh");
  std::size_t others = 0;
  while (lines.next()) {
    if (lines.words().front() != "v") {
      ++others;
      continue;
    }
    if (lines.words().size() != 4) lines.fail("a node must be 'v x y z'");
    for (std::size_t c = 1; c <= 3; ++c) {
      draft.coordinates.push_back(lines.number<double>(c, -std::numeric_limits<double>::max()));
    }
    draft.node_numbers.push_back(draft.node_numbers.size());
  }
  if (draft.node_numbers.empty()) {
    throw InputError(fmt::format("{}: it has no nodes: lines 'v x y z'", file.string()));
  }
  if (others > 0) {
    draft.notes.push_back(fmt::format("{}: {} lines are no nodes (v x y z): they were left out",
                                      file.filename().string(), others));
  }
}

std::vector<std::vector<std::int32_t>> read_topology(const fs::path& file, std::size_t num_nodes) {
  Lines lines(file, "mesh");
  lines.expect_keyword("nbElement", "nbElement NUMBER", 2);
  const auto count = lines.number<std::size_t>(1, 0);
  std::vector<std::vector<std::int32_t>> elements;
  for (std::size_t e = 0; e < count; ++e) {
    lines.expect("NUMBER_OF_NODES NODE NODE ...", 2, true);
    if (lines.number<std::size_t>(0, 0) != lines.words().size() - 1) {
      lines.fail(fmt::format("element {} says {} nodes and lists {}", e, lines.words().front(),
                             lines.words().size() - 1));
    }
    std::vector<std::int32_t>& nodes = elements.emplace_back();
    for (std::size_t a = 1; a < lines.words().size(); ++a) {
      nodes.push_back(lines.number<std::int32_t>(a, 0));
      if (static_cast<std::size_t>(nodes.back()) >= num_nodes) {
        lines.fail(fmt::format("element {} has the node {}: nodes are numbered from 0 to {}", e,
                               nodes.back(), num_nodes - 1));
      }
      if (std::count(nodes.begin(), nodes.end(), nodes.back()) > 1) {
        lines.fail(fmt::format("element {} has the node {} twice", e, nodes.back()));
      }
    }
  }
  if (lines.next()) lines.fail(fmt::format("more than the {} elements of nbElement", count));
  return elements;
}

/// Dimension, and the association of each element.
int read_associations(const fs::path& file, std::vector<std::string>& associations) {
  Lines lines(file, "mesh");
  lines.expect_keyword("nbDim", "nbDim 2 or nbDim 3", 2);
  const int dim = lines.number<int>(1, 0);
  if (dim != 2 && dim != 3) lines.fail(fmt::format("nbDim is {}: must be 2 or 3", dim));
  lines.expect_keyword("$ELEM", "$ELEM", 1);
  lines.expect("NUMBER_OF_ELEMENTS", 1);
  const auto count = lines.number<std::size_t>(0, 0);
  if (count != associations.size()) {
    lines.fail(fmt::format("there are {} elements here, and {} in the .element file", count,
                           associations.size()));
  }
  for (std::size_t i = 0; i < count; ++i) {
    lines.expect("ELEMENT Loi Element Decoupage", 4);
    const auto e = lines.number<std::size_t>(0, 0);
    if (e >= count)
      lines.fail(fmt::format("element {}: they are numbered from 0 to {}", e, count - 1));
    if (!associations[e].empty())
      lines.fail(fmt::format("element {} has an association already", e));
    try {
      associations[e] = association_of_led(lines.words()[1], lines.words()[2], lines.words()[3]);
    } catch (const InputError& error) {
      lines.fail(error.what());
    }
  }
  lines.expect_keyword("$ENDELM", "$ENDELM", 1);
  return dim;
}

std::string element_of(const std::string& association) {
  const std::size_t first = association.find('-') + 1;
  return association.substr(first, association.find('-', first) - first);
}

}  // namespace

std::string association_of_led(const std::string& law, const std::string& element,
                               const std::string& split) {
  const std::string ours = translated(laws(), law, "Loi");
  const std::size_t digits = element.find_first_of("0123456789");
  const std::string type = translated(elements(), element.substr(0, digits), "Element");
  const std::vector<std::string> rules = symgen::quadrature_names(type);
  std::string rule = rules.front();
  if (digits != std::string::npos) {
    rule = "q" + element.substr(digits);
    if (!rule.ends_with('I')) {
      throw InputError(fmt::format(
          "Element '{}': a name with a number must end in I, as in Cube8I: 8 Gauss points",
          element));
    }
    rule.pop_back();
    if (std::find(rules.begin(), rules.end(), rule) == rules.end()) {
      throw InputError(fmt::format("Element '{}': {} has the quadratures {}, not {}", element, type,
                                   join(rules, ", "), rule));
    }
  }
  const std::string prefix = "Decoupage";
  if (split == prefix + "Non") return fmt::format("{}-{}-{}-none", ours, type, rule);
  if (split == prefix + "Tout") return fmt::format("{}-{}-{}-lgnd", ours, type, rule);
  std::string letters;
  for (const char letter : std::string("LGND")) {
    if (split.find(letter, prefix.size()) != std::string::npos) letters += letter;
  }
  if (!split.starts_with(prefix) || letters.empty() || split != prefix + letters) {
    throw InputError(
        fmt::format("Decoupage '{}': must be DecoupageNon, DecoupageTout, or Decoupage and letters "
                    "of LGND in this order",
                    split));
  }
  std::transform(letters.begin(), letters.end(), letters.begin(),
                 [](char c) { return static_cast<char>(c - 'A' + 'a'); });
  return fmt::format("{}-{}-{}-{}", ours, type, rule, letters);
}

MeshFile read_thesis_mesh(const fs::path& obj_file) {
  fs::path element_file = obj_file, info_file = obj_file;
  element_file.replace_extension(".element");
  info_file.replace_extension(".info");
  MeshDraft draft;
  read_nodes(obj_file, draft);
  const auto topology = read_topology(element_file, draft.node_numbers.size());
  std::vector<std::string> associations(topology.size());
  draft.dim = read_associations(info_file, associations);
  if (topology.empty()) {
    throw InputError(fmt::format("{}: it has no elements", element_file.string()));
  }
  std::map<std::string, std::size_t> list_of;
  for (std::size_t e = 0; e < topology.size(); ++e) {
    const auto [entry, is_new] = list_of.emplace(associations[e], draft.elements.size());
    if (is_new) {
      draft.elements.push_back(
          {element_of(associations[e]), default_region, associations[e], {}, {}});
    }
    DraftElements& list = draft.elements[entry->second];
    const ElementTopology& type = element_topology(list.element);
    if (topology[e].size() != static_cast<std::size_t>(type.num_nodes)) {
      throw InputError(fmt::format("{}: element {} has {} nodes; {} says {}, which has {}",
                                   element_file.string(), e, topology[e].size(),
                                   info_file.filename().string(), type.element, type.num_nodes));
    }
    list.nodes.insert(list.nodes.end(), topology[e].begin(), topology[e].end());
    list.numbers.push_back(e);
  }
  return finish_mesh(obj_file, std::move(draft));
}

}  // namespace elastogen::selector
