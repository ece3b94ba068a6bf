// The choice among builds, for processors of every kind.
#include <gtest/gtest.h>

#include <set>

#include "runtime/kernel_selection.h"
#include "temporary_folder.h"

namespace elastogen {
namespace {

using selector::message_of;
using Sets = std::vector<std::string>;

const Sets all = {"x86_64", "avx2", "avx512"};

/// The choice on a processor that has `sets`.
std::string choose(const Sets& built, const std::string& wanted,
                   const std::set<std::string>& sets) {
  return choose_instruction_set("stvk-tet4-q1-none", built, wanted,
                                [&sets](const std::string& set) { return sets.contains(set); });
}

std::string error_of(const Sets& built, const std::string& wanted,
                     const std::set<std::string>& sets) {
  return message_of<InputError>([&] { (void)choose(built, wanted, sets); });
}

TEST(ChooseInstructionSet, TakesTheBestThatTheProcessorHas) {
  EXPECT_EQ(choose(all, "", {"x86_64"}), "x86_64");
  EXPECT_EQ(choose(all, "", {"x86_64", "avx2"}), "avx2");
  EXPECT_EQ(choose(all, "", {"x86_64", "avx2", "avx512"}), "avx512");
  EXPECT_EQ(choose({"x86_64", "avx2"}, "", {"x86_64", "avx2", "avx512"}), "avx2");
  EXPECT_EQ(choose({"native"}, "", {"native"}), "native");
}

TEST(ChooseInstructionSet, TakesTheOneThatIsWanted) {
  for (const std::string& set : all) {
    EXPECT_EQ(choose(all, set, {"x86_64", "avx2", "avx512"}), set);
  }
}

TEST(ChooseInstructionSet, RefusesWhatIsUnknown) {
  EXPECT_EQ(error_of(all, "sse9", {"x86_64", "avx2"}),
            "ELASTOGEN_INSTRUCTION_SET = 'sse9' in the environment: kernels of stvk-tet4-q1-none: "
            "no such instruction set is known; here it may be x86_64, avx2, or unset for the best "
            "of these");
}

TEST(ChooseInstructionSet, RefusesWhatTheProcessorDoesNotHave) {
  EXPECT_EQ(error_of(all, "avx512", {"x86_64", "avx2"}),
            "ELASTOGEN_INSTRUCTION_SET = 'avx512' in the environment: kernels of "
            "stvk-tet4-q1-none: this processor or its operating system does not have it; here it "
            "may be x86_64, avx2, or unset for the best of these");
}

TEST(ChooseInstructionSet, RefusesWhatIsNotCompiled) {
  EXPECT_EQ(error_of({"x86_64"}, "avx2", {"x86_64", "avx2"}),
            "ELASTOGEN_INSTRUCTION_SET = 'avx2' in the environment: kernels of stvk-tet4-q1-none: "
            "they are not compiled for it (CMake: ELASTOGEN_KERNEL_INSTRUCTION_SETS); here it may "
            "be x86_64, or unset for the best of these");
}

TEST(ChooseInstructionSet, SaysThatNoneFits) {
  const std::string expected =
      "kernels of stvk-tet4-q1-none are compiled for avx2, avx512, which this processor or its "
      "operating system does not have; compile them for x86_64, too (CMake: "
      "ELASTOGEN_KERNEL_INSTRUCTION_SETS)";
  EXPECT_EQ(error_of({"avx2", "avx512"}, "", {"x86_64"}), expected);
  EXPECT_EQ(error_of({"avx2", "avx512"}, "avx2", {"x86_64"}), expected);
}

TEST(ProcessorSupports, WhatIsBelow) {
  EXPECT_TRUE(processor_supports("native"));
  EXPECT_FALSE(processor_supports("sse9"));
#if defined(__x86_64__)
  EXPECT_TRUE(processor_supports("x86_64"));
  EXPECT_TRUE(processor_supports("avx2") || !processor_supports("avx512"));
#else
  EXPECT_FALSE(processor_supports("x86_64"));
#endif
}

}  // namespace
}  // namespace elastogen
