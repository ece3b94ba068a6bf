// `bench limits`, `kernels`, `operators`, `compare` and `report` by the built program. Their times
// decide nothing.
#include <gtest/gtest.h>

#include <set>
#include <string>
#include <vector>

#include "run_fixture.h"

namespace elastogen::selector {
namespace {

class SpeedBench : public Run {
 protected:
  [[nodiscard]] ProcessResult call(const std::vector<std::string>& arguments) const {
    std::vector<std::string> command = {"env", cache_setting(), program(), "--quiet", "--threads",
                                        "2",   "bench"};
    command.insert(command.end(), arguments.begin(), arguments.end());
    return run_process(command);
  }
  [[nodiscard]] nlohmann::json measured(std::vector<std::string> arguments) const {
    arguments.insert(arguments.end(), {"--seconds", "0.01", "--out", out().string()});
    const ProcessResult result = call(arguments);
    EXPECT_EQ(result.exit_status, 0) << result.output;
    return nlohmann::json::parse(read_text_file(out() / "speed.json", "results"));
  }
};

TEST_F(SpeedBench, KernelsAreMeasuredInEveryVariantAndPrecision) {
  const nlohmann::json results = measured({"kernels", "stvk-quad4-q4-none"});
  std::set<std::string> kinds;
  for (const nlohmann::json& record : results["records"]) {
    EXPECT_GT(record["minimum_ns"], 0);
    EXPECT_GE(record["median_ns"], record["minimum_ns"]);
    EXPECT_GT(record["of_peak"], 0);
    EXPECT_LT(record["of_peak"], 1);
    kinds.insert(record["geometry"].get<std::string>() + " " +
                 record["precision"].get<std::string>() + " " +
                 record["operation"].get<std::string>());
  }
  for (const char* kind : {"general double forces", "box double product", "box single energy",
                           "general single stiffness", "general double apply"}) {
    EXPECT_TRUE(kinds.contains(kind)) << kind;
  }
  const std::string page = read_text_file(out() / "speed.html", "page");
  EXPECT_NE(page.find("<svg"), std::string::npos);
  EXPECT_TRUE(std::filesystem::exists(out() / "speed.sqlite"));
}

TEST_F(SpeedBench, OperatorsPutStrategiesSideBySideAndShareConstants) {
  const nlohmann::json results = measured({"operators", "stvk-tet4-q1-none", "--elements", "1000"});
  std::set<std::string> kinds;
  double distorted = 0, box_shaped = 0;
  for (const nlohmann::json& record : results["records"]) {
    kinds.insert(record["operation"].get<std::string>() + " " +
                 record["strategy"].get<std::string>());
    if (record["operation"] != "forces" || record["threads"] != 1) continue;
    (record["mesh"] == "distorted" ? distorted : box_shaped) = record["stored_bytes"];
  }
  for (const char* kind : {"forces ", "energy ", "product recompute", "product two-stage",
                           "rebuild two-stage", "product assembled", "rebuild assembled"}) {
    EXPECT_TRUE(kinds.contains(kind)) << kind;
  }
  EXPECT_GT(distorted, 90);
  EXPECT_LT(box_shaped, distorted / 2);
}

TEST_F(SpeedBench, CompareTellsWhatChanged) {
  (void)measured({"kernels", "stvk-tri3-q1-none", "--precision", "double"});
  const std::string file = (out() / "speed.json").string();
  const ProcessResult same = call({"compare", file, file});
  EXPECT_EQ(same.exit_status, 0) << same.output;
  EXPECT_NE(same.output.find("0 changed beyond noise"), std::string::npos) << same.output;

  nlohmann::json results = nlohmann::json::parse(read_text_file(file, "results"));
  for (const char* time : {"minimum_ns", "median_ns"}) {
    results["records"][0][time] = 1e3 * results["records"][0][time].get<double>();
  }
  const std::string slower = (out() / "slower.json").string();
  write_text_file(slower, results.dump());
  const ProcessResult changed = call({"compare", file, slower});
  EXPECT_NE(changed.output.find("1000.000 x"), std::string::npos) << changed.output;
  EXPECT_NE(changed.output.find("1 changed beyond noise"), std::string::npos) << changed.output;

  const ProcessResult wrong = call({"compare", file, (out() / "speed.html").string()});
  EXPECT_EQ(wrong.exit_status, 2);
  EXPECT_NE(wrong.output.find("speed.html: is no file that"), std::string::npos) << wrong.output;

  const std::string page = (out() / "both.html").string();
  EXPECT_EQ(call({"report", file, slower, "--out", page}).exit_status, 0);
  EXPECT_NE(read_text_file(page, "page").find("stvk-tri3-q1-none"), std::string::npos);
}

TEST_F(SpeedBench, LimitsArePositive) {
  const ProcessResult result = call({"limits", "--json"});
  ASSERT_EQ(result.exit_status, 0) << result.output;
  const nlohmann::json limits = nlohmann::json::parse(result.output)["limits"];
  ASSERT_EQ(limits["multiply_add"].size(), 4U);  // two precisions, one and two threads
  for (const nlohmann::json& peak : limits["multiply_add"]) EXPECT_GT(peak["gigaflops"], 0.1);
  for (const nlohmann::json& triad : limits["triad"]) {
    EXPECT_GT(triad["gigabytes_per_second"], 0.1);
  }
}

}  // namespace
}  // namespace elastogen::selector
