// The node sets and element sets of a deck.
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "selector/io/abaqus_deck.h"

namespace elastogen::selector {

/// Members as the deck lists them: numbers from `first` to `last`, or another set.
struct SetMember {
  std::uint64_t first = 0, last = 0, step = 1;
  std::string set;           ///< empty: the numbers
  bool of_elements = false;  ///< a node set's: the nodes of the element set `set`
  DeckPlace place;
};

struct DeckSet {
  std::string name;       ///< as first spelled
  bool internal = false;  ///< made by Abaqus/CAE for its own use
  DeckPlace place;        ///< of its first card
  std::vector<SetMember> members;
};

/// Sets of one kind, in the order of the deck. Their members are looked up when all of it is read,
/// since a set may come before what it holds.
class AbaqusSets {
 public:
  /// @param keyword  "NSET" or "ELSET"
  explicit AbaqusSets(std::string keyword) : keyword_(std::move(keyword)) {}

  /// Takes a card *NSET or *ELSET.
  void take(const DeckCard& card);
  /// Adds to the set that the card's parameter of our keyword names, if any.
  void add(const DeckCard& card, std::uint64_t number, const DeckPlace& place);

  [[nodiscard]] const std::vector<DeckSet>& all() const { return sets_; }
  /// @throws InputError  for a name that there is not
  [[nodiscard]] const DeckSet& find(const std::string& name, const DeckPlace& place) const;

  /// Nodes of an element set.
  using NodesOfElements = std::function<std::set<std::uint64_t>(const SetMember&)>;
  /// Numbers of a set; of a range those that there are.
  /// @param existing  all numbers that the deck defines, ascending
  /// @throws InputError  a member that there is not; a set within itself
  [[nodiscard]] std::set<std::uint64_t> numbers_of(const DeckSet& set,
                                                   const std::vector<std::uint64_t>& existing,
                                                   const NodesOfElements& nodes_of_elements = {},
                                                   std::size_t depth = 0) const;

 private:
  DeckSet& get(const std::string& name, const DeckPlace& place);

  std::string keyword_;
  std::map<std::string, std::size_t> index_;  // by name in capitals
  std::vector<DeckSet> sets_;
};

}  // namespace elastogen::selector
