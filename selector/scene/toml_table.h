// Checked reading of TOML: every access says what is allowed, every error where it is.
#pragma once

#include <toml++/toml.h>

#include <array>
#include <filesystem>
#include <initializer_list>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace elastogen::selector {

/// Numbers that a key may take.
struct NumberRange {
  double minimum = -std::numeric_limits<double>::infinity();
  double maximum = std::numeric_limits<double>::infinity();
  bool minimum_exclusive = false;
  bool maximum_exclusive = false;

  [[nodiscard]] bool contains(double value) const;
  [[nodiscard]] std::string text() const;  ///< "in (-1, 0.5)", "greater than 0", ...
};

inline constexpr double no_limit = std::numeric_limits<double>::infinity();
inline constexpr NumberRange any_number{};
inline constexpr NumberRange positive_number{0, no_limit, true, false};
inline constexpr NumberRange not_negative{0, no_limit, false, false};

/// A table of a TOML file with the file's name and its own path in it ("material.steel").
/// Accessors throw InputError as "scene.toml:14: material.steel.density = -1: must be ...".
/// Copies share the parsed file.
class TomlTable {
 public:
  /// Parses a file.
  /// @throws InputError  when it is missing or is no TOML
  [[nodiscard]] static TomlTable open(const std::filesystem::path& file);

  [[nodiscard]] const std::filesystem::path& file() const { return file_; }
  [[nodiscard]] const std::string& path() const { return path_; }

  /// "scene.toml:14": the line of a key's value, or of the table itself.
  [[nodiscard]] std::string where() const;
  [[nodiscard]] std::string where(std::string_view key) const;
  /// "material.steel.density"
  [[nodiscard]] std::string path_of(std::string_view key) const;

  /// @throws InputError  for the first key that is not in the list; names the nearest
  void allow_only(const std::vector<std::string>& keys) const;

  [[nodiscard]] bool has(std::string_view key) const;
  [[nodiscard]] std::vector<std::string> keys() const;  ///< in the order of the file

  /// Required values.
  [[nodiscard]] double number(std::string_view key, const NumberRange& range) const;
  [[nodiscard]] int integer(std::string_view key, int minimum) const;
  [[nodiscard]] bool boolean(std::string_view key) const;
  [[nodiscard]] std::string string(std::string_view key) const;
  [[nodiscard]] std::vector<std::string> strings(std::string_view key) const;
  [[nodiscard]] std::vector<double> numbers(std::string_view key, std::size_t count,
                                            const NumberRange& range) const;
  [[nodiscard]] std::vector<int> integers(std::string_view key, std::size_t count,
                                          int minimum) const;
  /// One of the names listed.
  [[nodiscard]] std::string choice(std::string_view key,
                                   const std::vector<std::string>& choices) const;
  /// A vector of space (dim 3) or of the plane (dim 2), whose last component is 0.
  [[nodiscard]] std::array<double, 3> vector(std::string_view key, int dim) const;
  /// Rows of numbers: `count` each, or any number of them where 0.
  [[nodiscard]] std::vector<std::vector<double>> rows(std::string_view key,
                                                      std::size_t count) const;
  [[nodiscard]] std::vector<std::vector<int>> integer_rows(std::string_view key,
                                                           std::size_t count) const;

  /// A table inside; required.
  [[nodiscard]] TomlTable table(std::string_view key) const;
  /// An array of tables inside ([[key]]); empty when absent.
  [[nodiscard]] std::vector<TomlTable> tables(std::string_view key) const;

  /// The table as text that does not depend on the file's spaces, comments and order of keys.
  [[nodiscard]] std::string text() const;

  /// Throws InputError "file:line: path.key = found: message".
  [[noreturn]] void fail(std::string_view key, const std::string& message) const;
  /// Throws InputError "file:line: path: message".
  [[noreturn]] void fail(const std::string& message) const;

 private:
  TomlTable(std::shared_ptr<const toml::table> root, const toml::table& table,
            std::filesystem::path file, std::string path);

  [[nodiscard]] const toml::node& required(std::string_view key, std::string_view what) const;
  [[nodiscard]] const toml::array& array(std::string_view key, std::size_t count,
                                         std::string_view what) const;
  [[nodiscard]] double to_number(std::string_view key, const toml::node& node,
                                 const NumberRange& range) const;
  [[nodiscard]] int to_integer(std::string_view key, const toml::node& node, int minimum) const;
  [[noreturn]] void fail_at(const toml::node& node, std::string_view key,
                            const std::string& message) const;

  std::shared_ptr<const toml::table> root_;  // keeps table_ alive
  const toml::table* table_;
  std::filesystem::path file_;
  std::string path_;
};

}  // namespace elastogen::selector
