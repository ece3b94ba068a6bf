// What the cache of compiled kernels is keyed by beside its inputs: all of the generator's files.
#include <gtest/gtest.h>

#include "selector/support/files.h"
#include "selector/support/process.h"
#include "symgen/pipeline.h"
#include "temporary_folder.h"

namespace elastogen::selector {
namespace {
namespace fs = std::filesystem;

class GeneratorFingerprint : public ::testing::Test {
 protected:
  GeneratorFingerprint() { fs::copy(generator(), copy(), fs::copy_options::recursive); }

  static fs::path generator() { return fs::path(ELASTOGEN_SOURCE_DIR) / "symgen"; }
  [[nodiscard]] fs::path copy() const { return folder_.path() / "symgen"; }

  /// What the build writes for a generator in that folder.
  [[nodiscard]] std::string fingerprint_of(const fs::path& folder) const {
    const fs::path source = folder_.path() / "fingerprint.cpp";
    const ProcessResult result =
        run_process({CMAKE_PROGRAM, "-DFOLDER=" + folder.string(), "-DOUTPUT=" + source.string(),
                     "-P", ELASTOGEN_SOURCE_DIR "/cmake/GeneratorFingerprint.cmake"});
    EXPECT_EQ(result.exit_status, 0) << result.output;
    const std::string text = read_text_file(source, "source");
    const std::size_t begin = text.rfind("return \"") + 8;
    return text.substr(begin, text.find('"', begin) - begin);
  }

  void append_to(const std::string& file) const {
    const fs::path path = copy() / file;
    const std::string before = fs::exists(path) ? read_text_file(path, "source") : "";
    write_text_file(path, before + "\n");
  }

 private:
  TemporaryFolder folder_;
};

TEST_F(GeneratorFingerprint, IsThatOfTheSourcesThatWereCompiled) {
  EXPECT_EQ(symgen::generator_fingerprint().size(), 64U);
  EXPECT_EQ(fingerprint_of(generator()), symgen::generator_fingerprint());
  EXPECT_EQ(fingerprint_of(copy()), symgen::generator_fingerprint());  // wherever they lie
}

TEST_F(GeneratorFingerprint, FollowsHeadersAndSourcesWhetherListedOrNot) {
  std::string before = fingerprint_of(copy());
  for (const char* file : {"pipeline.cpp", "pipeline.h", "passes/cost.h", "passes/a_new_one.h"}) {
    append_to(file);
    const std::string after = fingerprint_of(copy());
    EXPECT_NE(after, before) << file;
    before = after;
  }
}

}  // namespace
}  // namespace elastogen::selector
