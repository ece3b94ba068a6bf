// A shared library that was compiled on the fly.
#pragma once

#include <filesystem>
#include <memory>
#include <stdexcept>
#include <string>

namespace elastogen::selector {

/// A library could not be loaded or is not what its name says.
class BadLibrary : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Loaded as long as the object or a copy lives.
class SharedLibrary {
 public:
  SharedLibrary() = default;
  /// @throws BadLibrary
  explicit SharedLibrary(const std::filesystem::path& file);

  /// Address of a function.
  /// @throws BadLibrary  where there is none of that name
  template <class Function>
  [[nodiscard]] Function function(const std::string& name) const {
    return reinterpret_cast<Function>(symbol(name));
  }

 private:
  [[nodiscard]] void* symbol(const std::string& name) const;

  std::shared_ptr<void> handle_;
};

}  // namespace elastogen::selector
