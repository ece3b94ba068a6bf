#include "selector/scene/toml_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <sstream>

#include "runtime/error.h"
#include "selector/support/names.h"

namespace elastogen::selector {
namespace {

/// The value as in the file, shortened: what was found.
std::string found_text(const toml::node& node) {
  constexpr std::size_t longest = 60;
  std::ostringstream stream;
  if (node.is_table() || node.is_array_of_tables()) {
    return "(a table)";
  } else if (const toml::array* array = node.as_array()) {
    stream << *array;
  } else {
    node.visit([&](const auto& value) {
      if constexpr (toml::is_floating_point<decltype(value)>) {
        stream << fmt::format("{}", *value);
      } else if constexpr (toml::is_value<decltype(value)>) {
        stream << toml::value{*value};
      }
    });
  }
  std::string text = stream.str();
  if (text.size() > longest) text = text.substr(0, longest) + " ...";
  return text;
}

}  // namespace

bool NumberRange::contains(double value) const {
  return std::isfinite(value) && (minimum_exclusive ? value > minimum : value >= minimum) &&
         (maximum_exclusive ? value < maximum : value <= maximum);
}

std::string NumberRange::text() const {
  if (std::isinf(minimum) && std::isinf(maximum)) return "a finite number";
  if (std::isinf(maximum)) {
    return fmt::format("{} {}", minimum_exclusive ? "greater than" : "at least", minimum);
  }
  if (std::isinf(minimum)) {
    return fmt::format("{} {}", maximum_exclusive ? "less than" : "at most", maximum);
  }
  return fmt::format("in {}{}, {}{}", minimum_exclusive ? '(' : '[', minimum, maximum,
                     maximum_exclusive ? ')' : ']');
}

TomlTable::TomlTable(std::shared_ptr<const toml::table> root, const toml::table& table,
                     std::filesystem::path file, std::string path)
    : root_(std::move(root)), table_(&table), file_(std::move(file)), path_(std::move(path)) {}

TomlTable TomlTable::open(const std::filesystem::path& file) {
  if (!std::filesystem::is_regular_file(file)) {
    throw InputError(
        fmt::format("{}: no such file: give the path of a scene (docs/scene.md)", file.string()));
  }
  try {
    auto root = std::make_shared<const toml::table>(toml::parse_file(file.string()));
    const toml::table& table = *root;
    return {std::move(root), table, file, ""};
  } catch (const toml::parse_error& error) {
    throw InputError(fmt::format("{}:{}: this is no TOML: {}", file.string(),
                                 error.source().begin.line, error.description()));
  }
}

std::string TomlTable::where() const {
  const auto line = table_->source().begin.line;
  return line > 0 ? fmt::format("{}:{}", file_.string(), line) : file_.string();
}

std::string TomlTable::where(std::string_view key) const {
  const toml::node* node = table_->get(key);
  return node ? fmt::format("{}:{}", file_.string(), node->source().begin.line) : where();
}

std::string TomlTable::path_of(std::string_view key) const {
  return path_.empty() ? std::string(key) : fmt::format("{}.{}", path_, key);
}

void TomlTable::allow_only(const std::vector<std::string>& keys) const {
  for (const auto& [key, node] : *table_) {
    const std::string name(key.str());
    if (std::find(keys.begin(), keys.end(), name) != keys.end()) continue;
    throw InputError(fmt::format("{}:{}: unknown key '{}'{}; {} may have: {}", file_.string(),
                                 key.source().begin.line, path_of(name), did_you_mean(name, keys),
                                 path_.empty() ? "a scene" : path_, join(keys, ", ")));
  }
}

bool TomlTable::has(std::string_view key) const { return table_->contains(key); }

std::vector<std::string> TomlTable::keys() const {
  std::vector<std::pair<toml::source_position, std::string>> found;
  for (const auto& [key, node] : *table_) {
    found.emplace_back(key.source().begin, std::string(key.str()));
  }
  std::sort(found.begin(), found.end(),
            [](const auto& a, const auto& b) { return a.first < b.first; });
  std::vector<std::string> names;
  for (auto& [position, name] : found) names.push_back(std::move(name));
  return names;
}

double TomlTable::number(std::string_view key, const NumberRange& range) const {
  return to_number(key, required(key, "a number"), range);
}

int TomlTable::integer(std::string_view key, int minimum) const {
  return to_integer(key, required(key, "an integer"), minimum);
}

bool TomlTable::boolean(std::string_view key) const {
  const toml::node& node = required(key, "true or false");
  const auto* value = node.as_boolean();
  if (!value) fail_at(node, key, "must be true or false");
  return value->get();
}

std::string TomlTable::string(std::string_view key) const {
  const toml::node& node = required(key, "a string");
  const auto* value = node.as_string();
  if (!value || value->get().empty()) fail_at(node, key, "must be a string that is not empty");
  return value->get();
}

std::vector<std::string> TomlTable::strings(std::string_view key) const {
  std::vector<std::string> values;
  for (const toml::node& entry : array(key, 0, "an array of strings")) {
    const auto* value = entry.as_string();
    if (!value || value->get().empty()) {
      fail_at(entry, key, "must be an array of strings that are not empty");
    }
    values.push_back(value->get());
  }
  return values;
}

std::vector<double> TomlTable::numbers(std::string_view key, std::size_t count,
                                       const NumberRange& range) const {
  std::vector<double> values;
  for (const toml::node& entry : array(key, count, "an array of numbers")) {
    values.push_back(to_number(key, entry, range));
  }
  return values;
}

std::vector<int> TomlTable::integers(std::string_view key, std::size_t count, int minimum) const {
  std::vector<int> values;
  for (const toml::node& entry : array(key, count, "an array of integers")) {
    values.push_back(to_integer(key, entry, minimum));
  }
  return values;
}

std::string TomlTable::choice(std::string_view key, const std::vector<std::string>& choices) const {
  const std::string name = string(key);
  if (std::find(choices.begin(), choices.end(), name) == choices.end()) {
    fail(key,
         fmt::format("must be one of: {}{}", join(choices, ", "), did_you_mean(name, choices)));
  }
  return name;
}

std::array<double, 3> TomlTable::vector(std::string_view key, int dim) const {
  const std::vector<double> values = numbers(key, 0, any_number);
  if (values.size() != static_cast<std::size_t>(dim)) {
    fail(key, fmt::format("must have {} components, not {}: the scene is {}",
                          dim == 2 ? "the 2" : "the 3", values.size(),
                          dim == 2 ? "plane, with x and y: its body has no solids" : "in space, with x, y and z"));
  }
  std::array<double, 3> vector{};
  std::copy(values.begin(), values.end(), vector.begin());
  return vector;
}

std::vector<std::vector<double>> TomlTable::rows(std::string_view key, std::size_t count) const {
  std::vector<std::vector<double>> rows;
  for (const toml::node& entry : array(key, 0, "an array of arrays of numbers")) {
    const toml::array* row = entry.as_array();
    if (!row || row->size() != count) {
      fail_at(entry, key, fmt::format("must be an array of {} numbers", count));
    }
    std::vector<double>& values = rows.emplace_back();
    for (const toml::node& number : *row) values.push_back(to_number(key, number, any_number));
  }
  return rows;
}

std::vector<std::vector<int>> TomlTable::integer_rows(std::string_view key,
                                                      std::size_t count) const {
  std::vector<std::vector<int>> rows;
  for (const toml::node& entry : array(key, 0, "an array of arrays of integers")) {
    const toml::array* row = entry.as_array();
    if (!row || row->size() != count) {
      fail_at(entry, key, fmt::format("must be an array of {} integers", count));
    }
    std::vector<int>& values = rows.emplace_back();
    for (const toml::node& number : *row) values.push_back(to_integer(key, number, 0));
  }
  return rows;
}

TomlTable TomlTable::table(std::string_view key) const {
  const toml::node& node = required(key, "a table");
  const toml::table* table = node.as_table();
  if (!table) fail_at(node, key, fmt::format("must be a table, [{}]", path_of(key)));
  return {root_, *table, file_, path_of(key)};
}

std::vector<TomlTable> TomlTable::tables(std::string_view key) const {
  std::vector<TomlTable> found;
  const toml::node* node = table_->get(key);
  if (!node) return found;
  if (!node->is_array_of_tables()) {
    fail_at(*node, key, fmt::format("must be an array of tables, [[{}]]", path_of(key)));
  }
  for (const toml::node& entry : *node->as_array()) {
    const std::string path = fmt::format("{}[{}]", path_of(key), found.size() + 1);
    found.push_back(TomlTable(root_, *entry.as_table(), file_, path));
  }
  return found;
}

std::string TomlTable::text() const {
  std::ostringstream text;
  text << *table_;
  return text.str();
}

void TomlTable::fail(std::string_view key, const std::string& message) const {
  fail_at(required(key, "a value"), key, message);
}

void TomlTable::fail(const std::string& message) const {
  throw InputError(path_.empty() ? fmt::format("{}: {}", where(), message)
                                 : fmt::format("{}: {}: {}", where(), path_, message));
}

const toml::node& TomlTable::required(std::string_view key, std::string_view what) const {
  const toml::node* node = table_->get(key);
  if (!node) fail(fmt::format("the key '{}' is missing: {} is needed", key, what));
  return *node;
}

const toml::array& TomlTable::array(std::string_view key, std::size_t count,
                                    std::string_view what) const {
  const toml::node& node = required(key, what);
  const toml::array* array = node.as_array();
  if (!array) fail_at(node, key, fmt::format("must be {}", what));
  if (count > 0 && array->size() != count) {
    fail_at(node, key, fmt::format("must have {} entries, not {}", count, array->size()));
  }
  return *array;
}

double TomlTable::to_number(std::string_view key, const toml::node& node,
                            const NumberRange& range) const {
  const std::optional<double> value = node.is_number() ? node.value<double>() : std::nullopt;
  if (!value || !range.contains(*value)) {
    fail_at(node, key, fmt::format("must be {}{}", value ? "" : "a number, ", range.text()));
  }
  return *value;
}

int TomlTable::to_integer(std::string_view key, const toml::node& node, int minimum) const {
  const auto* value = node.as_integer();
  constexpr std::int64_t largest = std::numeric_limits<int>::max();
  if (!value || value->get() < minimum || value->get() > largest) {
    fail_at(node, key, fmt::format("must be an integer, at least {}", minimum));
  }
  return static_cast<int>(value->get());
}

void TomlTable::fail_at(const toml::node& node, std::string_view key,
                        const std::string& message) const {
  throw InputError(fmt::format("{}:{}: {} = {}: {}", file_.string(), node.source().begin.line,
                               path_of(key), found_text(node), message));
}

}  // namespace elastogen::selector
