// Input decks as Abaqus and CalculiX read them, down to keywords with their parameters and data
// lines; what they mean is abaqus_mesh's.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace elastogen::selector {

/// A line of one of a deck's files.
struct DeckPlace {
  const std::filesystem::path* file = nullptr;
  std::size_t line = 0;

  /// @throws InputError  "model.inp:12: " and the message
  [[noreturn]] void fail(const std::string& message) const;
};

struct DeckLine {
  std::string_view text;
  DeckPlace place;

  /// What stands between commas, without blanks around; empty ones at the end are left out.
  /// Labels come without their quotes, in which commas may be, but for those of digits only: "12"
  /// is a label, 12 a number.
  [[nodiscard]] std::vector<std::string_view> fields() const;
  /// @throws InputError  for a field that is no such number
  [[nodiscard]] std::uint64_t integer(std::string_view field) const;
  /// Blank is 0; exponents may be Fortran's (1.5D-3).
  [[nodiscard]] double real(std::string_view field) const;
};

/// A keyword with its parameters and the data lines that follow.
struct DeckCard {
  std::string keyword;                                          ///< "SOLID SECTION"
  std::vector<std::pair<std::string, std::string>> parameters;  ///< names in capitals
  std::vector<DeckLine> lines;
  DeckPlace place;

  /// Null where the card does not have it.
  [[nodiscard]] const std::string* find(std::string_view parameter) const;
  /// @throws InputError  where the card does not have it
  [[nodiscard]] const std::string& get(std::string_view parameter) const;
};

/// The cards of a deck, with those of the files that it includes. Comments are left out.
struct AbaqusDeck {
  std::vector<std::unique_ptr<const std::string>> texts;  ///< that lines refer to
  std::vector<std::unique_ptr<const std::filesystem::path>> files;
  std::vector<DeckCard> cards;
};

/// Keywords, parameters and labels are the same in small letters and in capitals.
[[nodiscard]] std::string in_capitals(std::string_view text);

/// Without the quotes around it, if any.
[[nodiscard]] std::string_view without_quotes(std::string_view text);

/// Labels of sets begin with a letter or are quoted.
[[nodiscard]] bool is_number(std::string_view field);

/// @throws InputError  a file that cannot be read; one that includes itself; data before the first
///                     keyword
[[nodiscard]] AbaqusDeck read_abaqus_deck(const std::filesystem::path& file);

}  // namespace elastogen::selector
