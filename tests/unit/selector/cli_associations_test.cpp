#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "runtime/error.h"
#include "selector/commands/associations.h"
#include "temporary_folder.h"

namespace elastogen::selector {
namespace {

const std::vector<std::filesystem::path>& law_folders() {
  static const std::vector<std::filesystem::path> folders = {ELASTOGEN_SOURCE_DIR "/laws"};
  return folders;
}

std::vector<std::string> found(const AssociationFilter& filter) {
  std::vector<std::string> texts;
  for (const symgen::AssociationId& id : find_associations(filter, law_folders())) {
    texts.push_back(id.text());
  }
  return texts;
}

TEST(FindAssociations, ListsEachOnceAndExactOnlyForPolynomialLaws) {
  const std::vector<std::string> all = found({});
  EXPECT_EQ(std::set<std::string>(all.begin(), all.end()).size(), all.size());
  const auto exists = [&](const std::string& id) {
    return std::find(all.begin(), all.end(), id) != all.end();
  };
  EXPECT_TRUE(exists("stvk-hexa8-q8-lgnd"));
  EXPECT_TRUE(exists("hooke-tet4-exact-none"));
  EXPECT_TRUE(exists("neo_hookean-tet4-q1-auto"));
  EXPECT_FALSE(exists("neo_hookean-tet4-exact-none"));
}

TEST(FindAssociations, IntersectsPatternsAndParts) {
  AssociationFilter filter;
  filter.patterns = {"*-hexa8-*"};
  filter.laws = {"stvk", "h*"};
  filter.quadratures = {"q8"};
  filter.splits = {"none"};
  EXPECT_EQ(found(filter), (std::vector<std::string>{"hooke-hexa8-q8-none", "stvk-hexa8-q8-none"}));
}

std::string refusal(const AssociationFilter& filter) {
  return message_of<InputError>([&] { (void)found(filter); });
}

void expect_mentions(const std::string& message, const std::vector<std::string>& words) {
  for (const std::string& word : words) {
    EXPECT_NE(message.find(word), std::string::npos) << "'" << word << "' in: " << message;
  }
}

TEST(FindAssociations, NamesTheNearestForAnUnknownPart) {
  AssociationFilter element;
  element.elements = {"hexa9"};
  expect_mentions(refusal(element), {"unknown element 'hexa9'", "did you mean 'hexa8'", "tet4"});
  AssociationFilter law;
  law.laws = {"stkv"};
  expect_mentions(refusal(law), {"unknown law 'stkv'", "did you mean 'stvk'"});
}

TEST(FindAssociations, SaysWhichPartOfAPatternMatchesNothing) {
  AssociationFilter filter;
  filter.patterns = {"stvk-hexa8-q9-none"};
  expect_mentions(refusal(filter), {"unknown quadrature of hexa8 'q9'", "q8", "q27"});
  filter.patterns = {"stvk-*-q8-lnd?"};
  expect_mentions(refusal(filter), {"unknown split 'lnd?'"});
  filter.patterns = {"hexa"};
  expect_mentions(refusal(filter), {"no association matches 'hexa'", "stvk-hexa8-q8-none"});
  // Each part exists, together they do not: the law is not polynomial.
  filter.patterns = {"neo_hookean-tet4-exact-none"};
  expect_mentions(refusal(filter), {"neo_hookean-tet4-exact-none", "polynomial"});
}

}  // namespace
}  // namespace elastogen::selector
