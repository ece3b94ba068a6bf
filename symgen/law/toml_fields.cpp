#include "symgen/law/toml_fields.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "runtime/error.h"
#include "symgen/law/expression.h"
#include "symgen/law/names.h"

namespace elastogen::symgen {
namespace {

std::string type_name(const toml::node& node) {
  switch (node.type()) {
    case toml::node_type::string:
      return "a string";
    case toml::node_type::integer:
    case toml::node_type::floating_point:
      return "a number";
    case toml::node_type::boolean:
      return "true or false";
    case toml::node_type::array:
      return "an array";
    case toml::node_type::table:
      return "a table";
    default:
      return "a date or time";
  }
}

}  // namespace

void fail_at_line(const std::string& file, const toml::source_region& where,
                  const std::string& message) {
  if (where.begin.line == 0) throw InputError(fmt::format("{}: {}", file, message));
  throw InputError(fmt::format("{}:{}: {}", file, where.begin.line, message));
}

TomlFields::TomlFields(const std::string& file, const toml::table& table, std::string what,
                       const std::vector<std::string>& allowed)
    : file_(file), table_(table), what_(std::move(what)) {
  for (const auto& [key, node] : table_) {
    const std::string name(key.str());
    if (std::find(allowed.begin(), allowed.end(), name) == allowed.end()) {
      fail_at_line(file_, key.source(),
                   fmt::format("{}: unknown key '{}'{}; allowed are {}", what_, name,
                               suggestion(name, allowed), join_names(allowed)));
    }
  }
}

std::string TomlFields::required_text(const std::string& key) const {
  if (!table_.contains(key)) {
    fail(key, fmt::format("key '{0}' is missing; add {0} = \"...\"", key));
  }
  return optional_text(key);
}

std::string TomlFields::optional_text(const std::string& key) const {
  const toml::node* node = table_.get(key);
  if (node == nullptr) return "";
  const toml::value<std::string>* text = node->as_string();
  if (text == nullptr)
    fail(key, fmt::format("'{}' is {}, must be a string", key, type_name(*node)));
  if (text->get().find_first_not_of(" \t\r\n") == std::string::npos) {
    fail(key, fmt::format("'{}' is empty", key));
  }
  return text->get();
}

std::optional<GiNaC::numeric> TomlFields::optional_number(const std::string& key) const {
  const toml::node* node = table_.get(key);
  if (node == nullptr) return std::nullopt;
  if (const toml::value<std::int64_t>* integer = node->as_integer()) {
    return exact_decimal(fmt::format("{}", integer->get()));
  }
  const toml::value<double>* number = node->as_floating_point();
  if (number == nullptr) {
    fail(key, fmt::format("'{}' is {}, must be a number", key, type_name(*node)));
  }
  if (!std::isfinite(number->get())) {
    fail(key,
         fmt::format("'{}' is {}, must be finite; leave it out for no bound", key, number->get()));
  }
  // The shortest text that reads back as the same double is what was written.
  return exact_decimal(fmt::format("{}", number->get()));
}

bool TomlFields::optional_flag(const std::string& key) const {
  const toml::node* node = table_.get(key);
  if (node == nullptr) return false;
  const toml::value<bool>* flag = node->as_boolean();
  if (flag == nullptr) {
    fail(key, fmt::format("'{}' is {}, must be true or false", key, type_name(*node)));
  }
  return flag->get();
}

std::vector<const toml::table*> TomlFields::required_tables(const std::string& key) const {
  const toml::node* node = table_.get(key);
  if (node == nullptr) {
    fail(key, fmt::format("there is no [[{0}]]; add at least one", key));
  }
  const toml::array* array = node->as_array();
  if (array == nullptr || array->empty() || !array->is_homogeneous<toml::table>()) {
    fail(key, fmt::format("'{0}' must be written as tables [[{0}]], at least one", key));
  }
  std::vector<const toml::table*> tables;
  for (const toml::node& element : *array) tables.push_back(element.as_table());
  return tables;
}

void TomlFields::fail(const std::string& key, const std::string& message) const {
  const toml::node* node = table_.get(key);
  fail_at_line(file_, node == nullptr ? table_.source() : node->source(),
               fmt::format("{}: {}", what_, message));
}

}  // namespace elastogen::symgen
