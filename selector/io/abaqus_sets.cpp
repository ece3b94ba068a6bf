#include "selector/io/abaqus_sets.h"

#include <fmt/format.h>

#include <algorithm>

#include "selector/support/names.h"

namespace elastogen::selector {

DeckSet& AbaqusSets::get(const std::string& name, const DeckPlace& place) {
  const auto [entry, is_new] = index_.emplace(in_capitals(name), sets_.size());
  if (is_new) sets_.push_back({name, false, place, {}});
  return sets_[entry->second];
}

const DeckSet& AbaqusSets::find(const std::string& name, const DeckPlace& place) const {
  const auto found = index_.find(in_capitals(without_quotes(name)));
  if (found != index_.end()) return sets_[found->second];
  std::vector<std::string> names;
  for (const DeckSet& set : sets_) names.push_back(set.name);
  place.fail(fmt::format("there is no *{} '{}'{}", keyword_, name, did_you_mean(name, names)));
}

void AbaqusSets::add(const DeckCard& card, std::uint64_t number, const DeckPlace& place) {
  const std::string* name = card.find(keyword_);
  if (name == nullptr) return;
  get(*name, card.place).members.push_back({number, number, 1, "", false, place});
}

void AbaqusSets::take(const DeckCard& card) {
  DeckSet& set = get(card.get(keyword_), card.place);
  set.internal = set.internal || card.find("INTERNAL") != nullptr;
  if (keyword_ == "NSET" && card.find("ELSET") != nullptr) {
    set.members.push_back({0, 0, 1, card.get("ELSET"), true, card.place});
  }
  const bool is_range = card.find("GENERATE") != nullptr;
  for (const DeckLine& line : card.lines) {
    const std::vector<std::string_view> fields = line.fields();
    if (is_range) {
      if (fields.size() < 2 || fields.size() > 3) {
        line.place.fail("GENERATE needs lines of a first number, a last one and a step");
      }
      const std::uint64_t step = fields.size() == 3 ? line.integer(fields[2]) : 1;
      if (step == 0) line.place.fail("GENERATE needs a step of 1 or more");
      set.members.push_back(
          {line.integer(fields[0]), line.integer(fields[1]), step, "", false, line.place});
      continue;
    }
    for (const std::string_view field : fields) {
      if (field.empty()) continue;
      SetMember member{0, 0, 1, "", false, line.place};
      if (is_number(field)) {
        member.first = member.last = line.integer(field);
      } else {
        member.set = field;
      }
      set.members.push_back(std::move(member));
    }
  }
}

std::set<std::uint64_t> AbaqusSets::numbers_of(const DeckSet& set,
                                               const std::vector<std::uint64_t>& existing,
                                               const NodesOfElements& nodes_of_elements,
                                               std::size_t depth) const {
  std::set<std::uint64_t> numbers;
  for (const SetMember& member : set.members) {
    if (member.of_elements) {
      numbers.merge(nodes_of_elements(member));
      continue;
    }
    if (!member.set.empty()) {
      if (depth > sets_.size()) {
        member.place.fail(fmt::format("*{} '{}' has itself among its members", keyword_, set.name));
      }
      numbers.merge(
          numbers_of(find(member.set, member.place), existing, nodes_of_elements, depth + 1));
      continue;
    }
    auto entry = std::lower_bound(existing.begin(), existing.end(), member.first);
    if (member.first == member.last && (entry == existing.end() || *entry != member.first)) {
      member.place.fail(fmt::format("*{} '{}' has the {} {}, which the deck does not define",
                                    keyword_, set.name, keyword_ == "NSET" ? "node" : "element",
                                    member.first));
    }
    for (; entry != existing.end() && *entry <= member.last; ++entry) {
      if ((*entry - member.first) % member.step == 0) numbers.insert(numbers.end(), *entry);
    }
  }
  return numbers;
}

}  // namespace elastogen::selector
