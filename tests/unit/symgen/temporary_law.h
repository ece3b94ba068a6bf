// Law files that tests write for themselves.
#pragma once

#include <filesystem>
#include <string>

#include "symgen/law/law.h"

namespace elastogen::symgen {

/// A folder of its own, removed with the object.
class TemporaryFolder {
 public:
  TemporaryFolder();
  ~TemporaryFolder();
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;

  /// Writes a file and returns its path.
  std::filesystem::path write(const std::string& name, const std::string& text) const;
  [[nodiscard]] const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

/// Reads a law from its text as if from "name.toml".
Law law_from_text(const std::string& name, const std::string& text);

/// A law "own" with parameters `mu` and `lambda` and one term that uses both.
Law law_with_term(const std::string& energy);

/// What the InputError says that reading "name.toml" with this text throws; the file is called
/// "name.toml" in it. Fails the test and returns "" if nothing is thrown.
std::string error_of_text(const std::string& name, const std::string& text);

/// A law of the project's own.
Law shipped_law(const std::string& name);

}  // namespace elastogen::symgen
