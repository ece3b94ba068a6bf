// Scene files for tests.
#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <string>

#include "../temporary_folder.h"
#include "runtime/error.h"
#include "selector/scene/problem.h"

namespace elastogen::selector {

/// Writes a file into a folder.
inline std::filesystem::path write_file(const TemporaryFolder& folder, const std::string& name,
                                        const std::string& text) {
  const std::filesystem::path file = folder.path() / name;
  std::ofstream(file) << text;
  return file;
}

/// A scene that is right: two cubes of hexahedra, clamped at x = 0. Line numbers matter to tests.
inline const std::string good_scene = R"(gravity = [0, 0, -9.81]
[bar]
length = 2.0
width = 1.0
height = 1.0
cells = [2, 1, 1]
[[bar.section]]
until = 1.0
association = "stvk-hexa8-q8-none"
region = "body"
[material.body]
density = 1000.0
young = 1e6
poisson = 0.3
[[constraint]]
plane = { x = 0.0 }
fixed = ["x", "y", "z"]
)";

/// The text with one piece replaced, which must occur.
inline std::string replaced(std::string text, const std::string& piece, const std::string& by) {
  const std::size_t at = text.find(piece);
  if (at == std::string::npos) throw std::logic_error("the scene has no '" + piece + "'");
  return text.replace(at, piece.size(), by);
}

inline Scene read_text(const std::string& text) {
  const TemporaryFolder folder;
  return read_scene(write_file(folder, "scene.toml", text));
}

/// Laws as shipped.
inline Problem prepare_text(const std::string& text) {
  return prepare(read_text(text), {std::filesystem::path(ELASTOGEN_SOURCE_DIR) / "laws"});
}

/// The message of the InputError that reading and preparing a scene throws, with the file's folder
/// left out; empty if it throws none.
inline std::string error_of(const std::string& text) {
  try {
    (void)prepare_text(text);
  } catch (const InputError& error) {
    const std::string message = error.what();
    const std::size_t at = message.find("scene.toml");
    return at == std::string::npos ? message : message.substr(at);
  }
  return "";
}

/// Adds that the message lacks a piece.
inline void expect_contains(const std::string& message, const std::string& piece) {
  EXPECT_NE(message.find(piece), std::string::npos) << "'" << piece << "' is not in: " << message;
}

}  // namespace elastogen::selector
