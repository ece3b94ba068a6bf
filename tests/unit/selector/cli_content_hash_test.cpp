#include <gtest/gtest.h>

#include <set>

#include "symgen/emit/content_hash.h"

namespace elastogen::symgen {
namespace {

TEST(ContentHash, DependsOnWhereThePartsEnd) {
  const std::set<std::string> hashes = {content_hash({"ab", "c"}), content_hash({"a", "bc"}),
                                        content_hash({"abc"}), content_hash({"abc", ""})};
  EXPECT_EQ(hashes.size(), 4U);
}

TEST(ContentHash, IsTheSameOnEveryMachine) {
  // Manifests hold these: a change would call every generated file outdated.
  EXPECT_EQ(content_hash({}), "6c62272e07bb014262b821756295c58d");  // the offset basis
  EXPECT_EQ(content_hash({"elastogen"}), "9e42a3eba69161d4c431fceea4395c46");
}

}  // namespace
}  // namespace elastogen::symgen
