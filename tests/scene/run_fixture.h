// Runs of whole scenes by the built program.
#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string>
#include <vector>

#include "selector/support/files.h"
#include "selector/support/process.h"
#include "temporary_folder.h"

namespace elastogen::selector {

/// The text with one piece replaced, which must occur.
inline std::string replaced_once(std::string text, const std::string& piece,
                                 const std::string& by) {
  const std::size_t at = text.find(piece);
  if (at == std::string::npos) throw std::logic_error("there is no '" + piece + "'");
  return text.replace(at, piece.size(), by);
}

/// Runs scenes in a folder of the test's own; compiled kernels are shared between the tests.
class Run : public testing::Test {
 protected:
  [[nodiscard]] ProcessResult run_scene(const std::filesystem::path& scene,
                                        const std::vector<std::string>& more = {}) const {
    std::vector<std::string> command = {"env",          cache_setting(), program(),     "run",
                                        scene.string(), "--out",         out().string()};
    command.insert(command.end(), more.begin(), more.end());
    return run_process(command);
  }

  [[nodiscard]] std::filesystem::path write(const std::string& text) const {
    write_text_file(folder_.path() / "scene.toml", text);
    return folder_.path() / "scene.toml";
  }

  [[nodiscard]] nlohmann::json summary() const {
    return nlohmann::json::parse(read_text_file(out() / "summary.json", "summary"));
  }

  static std::filesystem::path shipped(const std::string& name) {
    return std::filesystem::path(ELASTOGEN_SOURCE_DIR) / "scenes" / (name + ".toml");
  }
  static std::string cache_setting() {
    return "ELASTOGEN_CACHE_DIR=" ELASTOGEN_BINARY_DIR "/scene-test-cache";
  }
  static std::string program() { return ELASTOGEN_BINARY_DIR "/bin/elastogen"; }
  [[nodiscard]] std::filesystem::path out() const { return folder_.path() / "out"; }

 private:
  TemporaryFolder folder_;
};

}  // namespace elastogen::selector
