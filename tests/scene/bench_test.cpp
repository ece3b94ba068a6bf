// elastogen bench by the built program.
#include <gtest/gtest.h>

#include <map>
#include <sstream>
#include <string>
#include <vector>

#include "run_fixture.h"

namespace elastogen::selector {
namespace {

class WorkPrecision : public Run {
 protected:
  [[nodiscard]] ProcessResult bench(std::vector<std::string> arguments) const {
    std::vector<std::string> command = {"env", cache_setting(), program(), "bench",
                                        "work-precision"};
    command.insert(command.end(), arguments.begin(), arguments.end());
    command.insert(command.end(), {"--out", (out() / "bench").string()});
    return run_process(command);
  }
  [[nodiscard]] std::string written(const std::string& name) const {
    return read_text_file(out() / "bench" / name, "result");
  }
};

TEST_F(WorkPrecision, MeasuresShowsAndGoesOn) {
  const std::vector<std::string> call = {"--problem", "sphere",   "bar_dynamics", "--element",
                                         "hexa8-q8",  "prism6-*", "--quick",      "--no-calculix",
                                         "--runs",    "1"};
  const ProcessResult first = bench(call);
  ASSERT_EQ(first.exit_status, 0) << first.output;
  EXPECT_NE(first.output.find("12 points measured, 0 known"), std::string::npos) << first.output;

  // Errors fall as meshes become finer, by about the square of the cells' size.
  std::istringstream table(written("work_precision.csv"));
  std::string line, field;
  std::getline(table, line);
  std::map<std::string, std::vector<double>> errors;
  while (std::getline(table, line)) {
    std::vector<std::string> fields;
    std::istringstream row(line);
    while (std::getline(row, field, ',')) fields.push_back(field);
    errors[fields[0] + fields[2]].push_back(std::stod(fields[12]));
  }
  EXPECT_EQ(errors.size(), 6u);
  for (const auto& [series, values] : errors) {
    ASSERT_EQ(values.size(), 2u) << series;
    EXPECT_GT(values[0] / values[1], 2.5) << series;
    EXPECT_LT(values[0] / values[1], 6) << series;
  }
  const std::string page = written("work_precision.html");
  for (const char* piece : {"<svg", "hooke-hexa8-q8-none", "Thick sphere", "Bar that starts"}) {
    EXPECT_NE(page.find(piece), std::string::npos) << piece;
  }
  // A point's scene is a scene.
  const ProcessResult again = bench(call);
  EXPECT_NE(again.output.find("0 points measured, 12 known"), std::string::npos) << again.output;
  const auto scene =
      out() / "bench/scenes/sphere_hooke-hexa8-q8-none_4x4_cholesky_cg_double_1e-08.toml";
  EXPECT_EQ(run_scene(scene).exit_status, 0);
}

TEST_F(WorkPrecision, ExplainsWrongCalls) {
  const ProcessResult nothing_named = run_process({"env", cache_setting(), program(), "bench"});
  EXPECT_EQ(nothing_named.exit_status, 2);
  EXPECT_NE(nothing_named.output.find("say what to do: limits, kernels, operators, scaling, peers, "
                                      "compare, report, work-precision"),
            std::string::npos)
      << nothing_named.output;
  const ProcessResult unknown = bench({"--problem", "bendin"});
  EXPECT_EQ(unknown.exit_status, 2);
  EXPECT_NE(unknown.output.find("did you mean 'bending'?"), std::string::npos) << unknown.output;
  const ProcessResult rubber = bench({"--law", "yeoh"});
  EXPECT_EQ(rubber.exit_status, 2);
  EXPECT_NE(rubber.output.find("young and poisson"), std::string::npos) << rubber.output;
  const ProcessResult nothing = bench({"--element", "hexa9*"});
  EXPECT_EQ(nothing.exit_status, 2);
  EXPECT_NE(nothing.output.find("matches no element"), std::string::npos) << nothing.output;
  EXPECT_FALSE(std::filesystem::exists(out())) << "nothing is written";
}

}  // namespace
}  // namespace elastogen::selector
