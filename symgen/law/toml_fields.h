// Checked access to the fields of a TOML table: every error has file and line.
#pragma once

#include <ginac/ginac.h>
#include <toml++/toml.h>

#include <optional>
#include <string>
#include <vector>

namespace elastogen::symgen {

/// One table of a TOML file. The file's name and the table must outlive it.
class TomlFields {
 public:
  /// @param what     what the table is, for messages: "law", "parameter 'mu'"
  /// @param allowed  the keys that it may have
  /// @throws InputError  for another key, with the nearest allowed one
  TomlFields(const std::string& file, const toml::table& table, std::string what,
             const std::vector<std::string>& allowed);

  /// The text of a key. @throws InputError  if it is missing, no string, or blank
  [[nodiscard]] std::string required_text(const std::string& key) const;
  /// The same; "" if the key is missing.
  [[nodiscard]] std::string optional_text(const std::string& key) const;
  /// A number as written (0.1 is 1/10). @throws InputError  if it is no finite number
  [[nodiscard]] std::optional<GiNaC::numeric> optional_number(const std::string& key) const;
  /// false if the key is missing. @throws InputError  if it is neither true nor false
  [[nodiscard]] bool optional_flag(const std::string& key) const;
  /// The tables [[key]]. @throws InputError  if there is none, or the key is something else
  [[nodiscard]] std::vector<const toml::table*> required_tables(const std::string& key) const;

  /// Throws InputError "file:line: message", with the line of the key, or of the table if the key
  /// is missing.
  [[noreturn]] void fail(const std::string& key, const std::string& message) const;

 private:
  const std::string& file_;
  const toml::table& table_;
  std::string what_;
};

/// Throws InputError "file:line: message"; "file: message" where the line is unknown.
[[noreturn]] void fail_at_line(const std::string& file, const toml::source_region& where,
                               const std::string& message);

}  // namespace elastogen::symgen
