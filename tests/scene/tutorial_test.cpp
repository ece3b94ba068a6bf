// docs/ten_minutes.md, done as it says: its files are written and its commands run in a folder.
#include <gtest/gtest.h>

#include <filesystem>
#include <sstream>
#include <string>
#include <vector>

#include "selector/support/files.h"
#include "selector/support/process.h"
#include "temporary_folder.h"

namespace elastogen::selector {
namespace {

/// A fenced block, with the last file that the text before it names in backticks.
struct Block {
  std::string info;  ///< what stands behind the fence: "toml", "sh", "sh fails", or nothing
  std::string file;  ///< "yeoh.toml"
  std::string text;
};

std::vector<Block> blocks_of(const std::string& page) {
  std::vector<Block> blocks;
  std::string file;
  std::istringstream lines(page);
  bool inside = false;
  for (std::string line; std::getline(lines, line);) {
    if (line.starts_with("```")) {
      inside = !inside;
      if (inside) blocks.push_back({line.substr(3), file, ""});
    } else if (inside) {
      blocks.back().text += line + "\n";
    } else {
      for (std::size_t end = line.find(".toml`"); end != std::string::npos;
           end = line.find(".toml`", end + 1)) {
        const std::size_t begin = line.rfind('`', end) + 1;
        file = line.substr(begin, end + 5 - begin);
      }
    }
  }
  return blocks;
}

TEST(TenMinutes, DoWhatTheySay) {
  const TemporaryFolder folder;
  const std::string page =
      read_text_file(std::filesystem::path(ELASTOGEN_SOURCE_DIR) / "docs/ten_minutes.md", "page");
  int commands = 0;
  std::string output;
  for (const Block& block : blocks_of(page)) {
    if (block.info == "toml") {
      write_text_file(folder.path() / block.file, block.text);
    } else if (block.info.starts_with("sh")) {
      const ProcessResult result =
          run_process({"env", "-C", folder.path().string(),
                       "ELASTOGEN_CACHE_DIR=" ELASTOGEN_BINARY_DIR "/scene-test-cache", "sh", "-ec",
                       "PATH=\"" ELASTOGEN_BINARY_DIR "/bin:$PATH\"\n" + block.text});
      EXPECT_EQ(result.exit_status, block.info == "sh fails" ? 1 : 0)
          << block.text << result.output;
      output = result.output;
      ++commands;
    } else {  // what the last command is said to print
      EXPECT_NE(output.find(block.text), std::string::npos) << block.text << output;
    }
  }
  EXPECT_EQ(commands, 4);
  for (const char* file : {"deformed.png", "result.vtu", "summary.json"}) {
    EXPECT_TRUE(std::filesystem::exists(folder.path() / "strip" / file)) << file;
  }
}

}  // namespace
}  // namespace elastogen::selector
