#include <gtest/gtest.h>

#include "runtime/error.h"
#include "selector/jit/compiler.h"
#include "selector/support/files.h"
#include "temporary_folder.h"

namespace elastogen::selector {
namespace {
namespace fs = std::filesystem;

void expect_contains(const std::string& text, const std::string& part) {
  EXPECT_NE(text.find(part), std::string::npos) << "'" << part << "' in: " << text;
}

TEST(FindCompiler, SaysPlainlyThatThereIsNone) {
  const EnvironmentVariable cxx("CXX", std::nullopt);
  const EnvironmentVariable path("PATH", "/nowhere");
  const std::string message = message_of<WorkError>([] { (void)find_compiler(); });
  expect_contains(message, "no C++ compiler");
  expect_contains(message, "install one");
}

TEST(FindCompiler, DoesNotPassOverAWrongCxx) {
  const EnvironmentVariable cxx("CXX", "no-such-compiler -m64");
  const std::string message = message_of<WorkError>([] { (void)find_compiler(); });
  expect_contains(message, "CXX = 'no-such-compiler -m64'");
}

TEST(FindCompiler, TakesCxxWithArgumentsAndPathsWithSpaces) {
  const TemporaryFolder folder;
  const fs::path script = folder.path() / "my compiler";
  write_text_file(script, "#!/bin/sh\necho version 7\n");
  fs::permissions(script, fs::perms::owner_all);
  {
    const EnvironmentVariable cxx("CXX", script.string());
    EXPECT_EQ(find_compiler().command, std::vector<std::string>{script.string()});
    EXPECT_EQ(find_compiler().version, "version 7\n");
  }
  const EnvironmentVariable cxx("CXX", "env c++");
  EXPECT_EQ(find_compiler().command, (std::vector<std::string>{"env", "c++"}));
}

/// The options that choose instructions.
std::vector<std::string> architectures(const Compiler& compiler) {
  std::vector<std::string> found;
  for (const std::string& flag : compiler.flags) {
    if (flag.starts_with("-march=")) found.push_back(flag);
  }
  return found;
}

TEST(FindCompiler, CompilesForThisProcessorOrForTheSetInTheEnvironment) {
  using Options = std::vector<std::string>;
  {
    const EnvironmentVariable unset("ELASTOGEN_INSTRUCTION_SET", std::nullopt);
    EXPECT_EQ(architectures(find_compiler()), Options{"-march=native"});
  }
#if defined(__x86_64__)
  {
    const EnvironmentVariable baseline("ELASTOGEN_INSTRUCTION_SET", "x86_64");
    EXPECT_EQ(architectures(find_compiler()), Options{"-march=x86-64"});
  }
#endif
  const EnvironmentVariable unknown("ELASTOGEN_INSTRUCTION_SET", "sse9");
  const std::string message = message_of<InputError>([] { (void)find_compiler(); });
  expect_contains(message, "ELASTOGEN_INSTRUCTION_SET = 'sse9'");
  expect_contains(message, "here it may be ");
}

class Compilation : public ::testing::Test {
 protected:
  void compile(const std::string& text) {
    write_text_file(folder_.path() / "source.cpp", text);
    compile_shared_library(compiler_, {folder_.path() / "source.cpp"}, folder_.path(),
                           folder_.path() / "library.so", folder_.path() / "compile.log");
  }

  TemporaryFolder folder_;
  Compiler compiler_ = find_compiler();
};

TEST_F(Compilation, MakesALibraryAndKeepsTheLog) {
  compile("extern \"C\" int seven() { return 7; }\n");
  EXPECT_TRUE(fs::exists(folder_.path() / "library.so"));
  expect_contains(read_text_file(folder_.path() / "compile.log", "test"), "source.cpp");
}

TEST_F(Compilation, ShowsTheFirstErrorsAndTheLog) {
  const std::string message =
      message_of<CompilationFailed>([&] { compile("int broken = nothing;\n"); });
  expect_contains(message, "nothing");
  expect_contains(message, (folder_.path() / "compile.log").string());
  EXPECT_FALSE(fs::exists(folder_.path() / "library.so"));
}

TEST_F(Compilation, TellsAnInterruptionFromAnError) {
  compiler_.command = {"sh", "-c", "kill -INT $$"};
  const std::string message = message_of<WorkError>([&] { compile(""); });
  expect_contains(message, "interrupted");
}

}  // namespace
}  // namespace elastogen::selector
