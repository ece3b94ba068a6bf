// What linkers see: builds for different instruction sets share no symbol, and only they have
// instructions that an old processor lacks.
#include <gtest/gtest.h>

#include <map>

#include "built_sets.h"
#include "library_members.h"

namespace elastogen::test {
namespace {

/// How many instructions of AVX and later, and which vectors, by set.
struct VectorCode {
  std::size_t of_avx = 0, of_32_bytes = 0, of_64_bytes = 0;
};
std::map<std::string, VectorCode> vector_code(const std::string& library) {
  std::map<std::string, VectorCode> code;
  for_each_line({"objdump", "-d", "--no-show-raw-insn"}, library,
                [&code](const std::string& member, const std::string& line) {
                  VectorCode& found = code[set_of(member)];
                  if (line.find(":\tv") != std::string::npos) ++found.of_avx;
                  if (line.find("%ymm") != std::string::npos) ++found.of_32_bytes;
                  if (line.find("%zmm") != std::string::npos) ++found.of_64_bytes;
                });
  return code;
}

bool has_program(const char* name) { return selector::find_program(name).has_value(); }

TEST(DefaultKernels, OfDifferentInstructionSetsShareNoSymbol) {
  if (!has_program("nm")) GTEST_SKIP() << "nm is not installed";
  const auto symbols = defined_symbols(DEFAULT_KERNELS);
  for (const std::string& set : built_sets()) ASSERT_TRUE(symbols.contains(set)) << set;
  for (const auto& [set, names] : symbols) {
    EXPECT_GE(names.size(), 8U) << set;  // a function for each table
  }
  expect_disjoint(symbols);
}

TEST(DefaultKernels, HaveTheVectorsOfTheirInstructionSet) {
  if (!has_program("objdump")) GTEST_SKIP() << "objdump is not installed";
  const auto by_set = vector_code(DEFAULT_KERNELS);
  EXPECT_EQ(by_set.size(), built_sets().size() + (is_chosen() ? 1 : 0));  // sources that choose
  for (const auto& [set, code] : by_set) {
    if (set == "x86_64") {
      EXPECT_EQ(code.of_avx, 0U);
    } else if (set == "avx2") {
      EXPECT_GT(code.of_32_bytes, 1000U);
      EXPECT_EQ(code.of_64_bytes, 0U);
    } else if (set == "avx512") {
      EXPECT_GT(code.of_64_bytes, 1000U);
    }
  }
}

TEST(PortableCode, HasNoInstructionsOfAvx) {
#if !defined(__x86_64__)
  GTEST_SKIP() << "for x86-64";
#endif
  if (std::string(CXX_FLAGS).find("-m") != std::string::npos) {
    GTEST_SKIP() << "everything is compiled with " << CXX_FLAGS;
  }
  if (!has_program("objdump")) GTEST_SKIP() << "objdump is not installed";
  EXPECT_EQ(vector_code(DEFAULT_KERNELS)[""].of_avx, 0U) << "the sources that choose";
  EXPECT_EQ(vector_code(RUNTIME)[""].of_avx, 0U) << "the runtime";
}

}  // namespace
}  // namespace elastogen::test
