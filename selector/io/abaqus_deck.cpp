#include "selector/io/abaqus_deck.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>

#include "runtime/error.h"
#include "selector/support/files.h"

namespace elastogen::selector {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view blanks = " \t\r";
// Decks that include decks: more can only be a circle.
constexpr int deepest_include = 16;

std::string_view trimmed(std::string_view text) {
  const std::size_t first = text.find_first_not_of(blanks);
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(blanks) - first + 1);
}

/// "Solid  Section" as "SOLID SECTION".
std::string keyword_of(std::string_view text) {
  std::string keyword;
  for (const char c : in_capitals(trimmed(text))) {
    const bool is_blank = c == ' ' || c == '\t';
    if (!is_blank) keyword += c;
    if (is_blank && keyword.back() != ' ') keyword += ' ';
  }
  return keyword;
}

/// The next comma that is not within quotes, or the end. A quote that nothing closes is a character
/// as others.
std::size_t field_end(std::string_view text, std::size_t from) {
  for (std::size_t at = from; at < text.size(); ++at) {
    if (text[at] == ',') return at;
    if (text[at] != '"') continue;
    const std::size_t closing = text.find('"', at + 1);
    if (closing != std::string_view::npos) at = closing;
  }
  return text.size();
}

std::vector<std::string_view> split(std::string_view text) {
  std::vector<std::string_view> fields;
  for (std::size_t from = 0; from <= text.size();) {
    const std::size_t to = field_end(text, from);
    fields.push_back(trimmed(text.substr(from, to - from)));
    from = to + 1;
  }
  while (!fields.empty() && fields.back().empty()) fields.pop_back();
  return fields;
}

class Reader {
 public:
  explicit Reader(const fs::path& main) : folder_(main.parent_path()) { read(main, 0); }
  [[nodiscard]] AbaqusDeck take() { return std::move(deck_); }

 private:
  void read(const fs::path& file, int depth) {
    deck_.files.push_back(std::make_unique<const fs::path>(file));
    const fs::path* name = deck_.files.back().get();
    deck_.texts.push_back(std::make_unique<const std::string>(read_text_file(file, "mesh file")));
    const std::string_view text = *deck_.texts.back();
    std::size_t line = 0;
    std::string keyword_line;  // as far as read: it goes on where it ends with a comma
    DeckPlace keyword_place;
    for (std::size_t from = 0; from < text.size();) {
      const std::size_t to = std::min(text.find('\n', from), text.size());
      const std::string_view content = trimmed(text.substr(from, to - from));
      from = to + 1;
      ++line;
      if (content.empty() || content.starts_with("**")) continue;
      const DeckPlace place{name, line};
      if (keyword_line.empty() && content.front() != '*') {
        if (deck_.cards.empty()) {
          place.fail(
              "data before the first keyword, as *NODE: this is no deck of Abaqus or "
              "CalculiX");
        }
        deck_.cards.back().lines.push_back({content, place});
        continue;
      }
      if (keyword_line.empty()) keyword_place = place;
      keyword_line += content;
      if (content.back() == ',') continue;
      add_keyword(keyword_line, keyword_place, depth);
      keyword_line.clear();
    }
    if (!keyword_line.empty()) add_keyword(keyword_line, keyword_place, depth);
  }

  void add_keyword(std::string_view text, const DeckPlace& place, int depth) {
    const std::vector<std::string_view> fields = split(text.substr(1));
    if (fields.empty()) place.fail("a line with '*' needs a keyword, as *NODE");
    DeckCard card{keyword_of(fields.front()), {}, {}, place};
    for (std::size_t i = 1; i < fields.size(); ++i) {
      const std::size_t equals = std::min(fields[i].find('='), fields[i].size());
      const std::string_view value = fields[i].substr(std::min(equals + 1, fields[i].size()));
      card.parameters.emplace_back(keyword_of(fields[i].substr(0, equals)),
                                   without_quotes(trimmed(value)));
    }
    if (card.keyword == "INCLUDE") {
      include(card, depth + 1);
    } else {
      deck_.cards.push_back(std::move(card));
    }
  }

  /// Its lines stand where the card is, which may be among the data of another.
  void include(const DeckCard& card, int depth) {
    const fs::path file = folder_ / card.get("INPUT");
    std::error_code error;
    if (!fs::is_regular_file(file, error)) {
      card.place.fail(fmt::format("*INCLUDE: there is no file '{}'", file.string()));
    }
    if (depth > deepest_include) {
      card.place.fail(fmt::format("*INCLUDE: '{}' includes itself", file.string()));
    }
    read(file, depth);
  }

  fs::path folder_;
  AbaqusDeck deck_;
};

}  // namespace

void DeckPlace::fail(const std::string& message) const {
  throw InputError(fmt::format("{}:{}: {}", file->string(), line, message));
}

std::vector<std::string_view> DeckLine::fields() const {
  std::vector<std::string_view> fields = split(text);
  for (std::string_view& field : fields) {
    if (const std::string_view label = without_quotes(field); !is_number(label)) field = label;
  }
  return fields;
}

std::uint64_t DeckLine::integer(std::string_view field) const {
  std::uint64_t value = 0;
  const auto [end, error] = std::from_chars(field.data(), field.data() + field.size(), value);
  if (error != std::errc() || end != field.data() + field.size()) {
    place.fail(fmt::format("'{}' must be a whole number, 0 or greater", field));
  }
  return value;
}

double DeckLine::real(std::string_view field) const {
  if (field.empty()) return 0;
  std::string text(field.front() == '+' ? field.substr(1) : field);
  for (char& c : text) {
    if (c == 'd' || c == 'D') c = 'e';
  }
  double value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size()) {
    place.fail(fmt::format("'{}' must be a number", field));
  }
  return value;
}

const std::string* DeckCard::find(std::string_view parameter) const {
  const auto found = std::find_if(parameters.begin(), parameters.end(),
                                  [&](const auto& entry) { return entry.first == parameter; });
  return found == parameters.end() ? nullptr : &found->second;
}

const std::string& DeckCard::get(std::string_view parameter) const {
  const std::string* value = find(parameter);
  if (value == nullptr || value->empty()) {
    place.fail(fmt::format("*{} needs the parameter {}=", keyword, parameter));
  }
  return *value;
}

std::string in_capitals(std::string_view text) {
  std::string capitals(text);
  for (char& c : capitals) {
    if (c >= 'a' && c <= 'z') c = static_cast<char>(c - 'a' + 'A');
  }
  return capitals;
}

std::string_view without_quotes(std::string_view text) {
  const bool is_quoted = text.size() >= 2 && text.front() == '"' && text.back() == '"';
  return is_quoted ? text.substr(1, text.size() - 2) : text;
}

bool is_number(std::string_view field) {
  return !field.empty() && field.find_first_not_of("0123456789") == std::string_view::npos;
}

AbaqusDeck read_abaqus_deck(const fs::path& file) { return Reader(file).take(); }

}  // namespace elastogen::selector
