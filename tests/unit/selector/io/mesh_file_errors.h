// What reading a mesh file says is wrong.
#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <string>
#include <vector>

#include "runtime/error.h"
#include "selector/io/mesh_file.h"

namespace elastogen::selector {

/// The message of the InputError that reading throws; empty if it throws none.
inline std::string error_of_file(const std::filesystem::path& file,
                                 const MeshFileOptions& options = {}) {
  try {
    (void)read_mesh_file(file, options);
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

inline void expect_words(const std::string& message, const std::vector<std::string>& words) {
  for (const std::string& word : words) {
    EXPECT_NE(message.find(word), std::string::npos) << "'" << word << "' is not in: " << message;
  }
}

}  // namespace elastogen::selector
