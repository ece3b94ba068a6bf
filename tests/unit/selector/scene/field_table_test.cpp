// [output] fields, stress_at, nodal and picture: what they choose, and what is generated for them.
#include "selector/scene/field_table.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "selector/scene/simulation.h"
#include "temporary_scene.h"

namespace elastogen::selector {
namespace {

const std::string dynamics = "[dynamics]\nscheme = \"central_differences\"\nend = 1\n";

std::vector<std::string> names_of(const FieldSettings& settings) {
  std::vector<std::string> names;
  for (const OutputField* field : settings.fields) names.emplace_back(field->name);
  return names;
}

FieldSettings fields_of(const std::string& text) {
  return read_text(good_scene + text).output.fields;
}

bool calls(const std::string& text, const std::string& operation) {
  const Scene scene = read_text(good_scene + text);
  const Problem problem = prepare(scene, {std::filesystem::path(ELASTOGEN_SOURCE_DIR) / "laws"});
  const std::vector<std::string> operations =
      operations_of(scene, problem, TangentProduct::recompute);
  return std::find(operations.begin(), operations.end(), operation) != operations.end();
}

TEST(FieldTable, ShowsStressUnlessNothingIsShown) {
  const std::vector<std::string> usual = {"displacement", "velocity",       "internal_forces",
                                          "reactions",    "energy_density", "cauchy_stress",
                                          "von_mises"};
  EXPECT_EQ(names_of(fields_of("")), usual);
  EXPECT_EQ(names_of(fields_of("[output]\nwrite = [\"vtu\"]\n")), usual);
  EXPECT_FALSE(fields_of("[output]\nwrite = []\n").has_points());
  const FieldSettings settings = fields_of("");
  ASSERT_TRUE(settings.picture.has_value());
  EXPECT_EQ(settings.picture->field->name, "von_mises");
  EXPECT_TRUE(settings.at_probes);
  EXPECT_FALSE(fields_of(dynamics).at_probes) << "a row of a history would cost a pass";
  EXPECT_TRUE(fields_of(dynamics + "[output]\nfields = [\"von_mises\"]\n").at_probes);
}

TEST(FieldTable, ReadsWhatIsChosen) {
  const FieldSettings settings = fields_of(
      "[output]\nfields = [\"logarithmic_strain\", \"displacement\"]\nstress_at = [\"nodes\", "
      "\"points\"]\nnodal = [\"projection\"]\npicture = \"logarithmic_strain.YZ\"\n");
  EXPECT_EQ(names_of(settings), (std::vector<std::string>{"displacement", "logarithmic_strain"}));
  EXPECT_FALSE(settings.at_elements);
  EXPECT_TRUE(settings.at_nodes);
  EXPECT_TRUE(settings.at_points);
  EXPECT_EQ(settings.nodal, std::vector{NodalMethod::projection});
  ASSERT_TRUE(settings.picture.has_value());
  EXPECT_EQ(settings.picture->component, 4);
}

TEST(FieldTable, GeneratesStressOnlyWhereItIsShown) {
  EXPECT_TRUE(calls("", "stress"));
  EXPECT_TRUE(calls(dynamics, "stress"));
  EXPECT_FALSE(calls("[output]\nwrite = []\n", "stress"));
  EXPECT_FALSE(calls("[output]\nfields = []\n", "stress"));
  EXPECT_FALSE(calls("[output]\nfields = [\"displacement\"]\n", "stress"));
  EXPECT_TRUE(
      calls("[[probe]]\nname = \"end\"\nplane = { x = 2.0 }\n[output]\nwrite = []\n"
            "fields = [\"von_mises\"]\n",
            "stress"));
  // Elements' energies are those of the operation `energy`.
  const std::string energies =
      "[output]\nwrite = [\"vtu\"]\nfields = [\"energy_density\"]\n"
      "stress_at = [\"elements\"]\n";
  EXPECT_FALSE(calls(energies, "stress"));
  EXPECT_TRUE(calls(dynamics + energies, "energy"));
}

TEST(FieldTable, StressIsInTheForcesPrecision) {
  const auto divided = divide_operations({"forces", "product", "stress"}, Precision::mixed);
  EXPECT_EQ(divided.in_double, (std::vector<std::string>{"forces", "stress"}));
}

TEST(FieldTable, ExplainsMistakes) {
  const auto expect_error = [](const std::string& output, const std::string& piece) {
    expect_contains(error_of(good_scene + "[output]\n" + output), piece);
  };
  expect_error("fields = [\"von_mieses\"]",
               "'von_mieses' is no field; did you mean 'von_mises'?; there are displacement");
  expect_error("stress_at = [\"nods\"]", "'nods' is none of elements, nodes, points");
  expect_error("stress_at = []", "needs one place or more");
  expect_error("nodal = [\"mean\"]", "'mean' is none of average, projection");
  expect_error("nodal = [\"average\"]\nstress_at = [\"elements\"]", "stress_at does not name");
  expect_error("nodal = [\"average\"]\nfields = []", "of which no field is written");
  expect_error("picture = \"von_mises.XX\"", "has no components");
  expect_error("picture = \"cauchy_stress\"", "needs one of its components: 'cauchy_stress.XX'");
  expect_error("picture = \"volume_ratio\"", "must be one of the fields");
  expect_error("picture = \"displacement\"", "deformed.png shows");
  expect_error("picture = \"von_mises\"\nwrite = [\"vtu\"]", "not among what is to be written");
}

}  // namespace
}  // namespace elastogen::selector
