// Generated text of two small associations, kept under version control to be read in review.
//
// After a wanted change: ELASTOGEN_UPDATE_GOLDEN=1 build/bin/golden_tests, then look at the diff.
#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>
#include <sstream>

#include "symgen/pipeline.h"

namespace elastogen::symgen {
namespace {

/// The hash follows every change of the generator's sources: it is not compared.
std::string without_hash(std::string text, const std::string& hash) {
  for (std::size_t at = text.find(hash); at != std::string::npos; at = text.find(hash)) {
    text.replace(at, hash.size(), "HASH");
  }
  return text;
}

void expect_golden(const std::string& file, const std::string& text) {
  const std::string path = std::string(ELASTOGEN_GOLDEN_DIR) + "/" + file;
  if (std::getenv("ELASTOGEN_UPDATE_GOLDEN") != nullptr) std::ofstream(path) << text;
  std::ifstream stream(path);
  ASSERT_TRUE(stream) << path;
  std::ostringstream kept;
  kept << stream.rdbuf();
  EXPECT_EQ(text, kept.str());
}

class Golden : public ::testing::TestWithParam<const char*> {};

TEST_P(Golden, GeneratedTextIsAsKept) {
  const AssociationId id = AssociationId::parse(GetParam());
  const Law law = read_law(std::string(ELASTOGEN_SOURCE_DIR) + "/laws/" + id.law + ".toml");
  const GeneratedAssociation generated = generate_association(id, law, {});
  expect_golden(id.identifier() + ".h", without_hash(generated.header, generated.hash));
  expect_golden(id.identifier() + ".cl", without_hash(generated.opencl, generated.hash));
  const Instantiation what{false, true, {"energy", "forces", "product", "stress"}};
  expect_golden(id.identifier() + "_f64.cpp", registration_source(id, law, what));
}

INSTANTIATE_TEST_SUITE_P(Small, Golden,
                         ::testing::Values("hooke-tet4-q1-none", "neo_hookean-tet4-q1-lg"),
                         [](const auto& info) {
                           std::string name = info.param;
                           for (char& c : name) c = c == '-' ? '_' : c;
                           return name;
                         });

}  // namespace
}  // namespace elastogen::symgen
