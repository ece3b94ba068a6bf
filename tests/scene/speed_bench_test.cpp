// `bench limits`, `kernels`, `operators`, `scaling`, `peers`, `compare` and `report` by the built
// program. Their times decide nothing.
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

TEST_F(SpeedBench, ScalingTellsOrdersAndSizesApart) {
  const nlohmann::json results =
      measured({"scaling", "stvk-tet4-q1-none", "--elements", "1000", "10000"});
  std::set<std::string> kinds;
  for (const nlohmann::json& record : results["records"]) {
    EXPECT_GT(record["minimum_ns"], 0);
    const bool is_small = record["elements"].get<int>() < 3000;
    kinds.insert(record["order"].get<std::string>() + (is_small ? " small " : " large ") +
                 record["operation"].get<std::string>());
  }
  for (const std::string order : {"natural", "random", "reordered"}) {
    for (const char* what : {" small forces", " large product"}) {
      EXPECT_TRUE(kinds.contains(order + what)) << order << what;
    }
  }
  EXPECT_NE(read_text_file(out() / "speed.html", "page").find("ns per element"), std::string::npos);
}

/// A peer of one's own: a script.
void write_peer(const std::filesystem::path& folder, const std::string& script) {
  std::filesystem::create_directories(folder);
  const std::filesystem::path run = folder / "run";
  write_text_file(run, "#!/bin/sh\n" + script);
  std::filesystem::permissions(run, std::filesystem::perms::owner_all);
}

TEST_F(SpeedBench, PeersAreComparedByTheirResults) {
  const std::filesystem::path own = out() / "own";
  write_peer(own / "refusing", "echo 'refusing: no tetrahedra' >&2; exit 3\n");
  write_peer(own / "failing", "echo 'no compiler' >&2; exit 1\n");
  write_peer(own / "wrong",
             "tr '\\0-\\377' '\\1' < \"$2/displacement.f64\" > \"$2/wrong.plain.product.f64\"\n"
             "echo 'plain product 1e-9 2e-9'\n");
  std::vector<std::string> command = {
      "peers", "stvk-tet4-q1-none", "--elements", "1000",  "--peers",     own.string(), "--rounds",
      "2",     "--seconds",         "0.01",       "--out", out().string()};
  const ProcessResult result = run_process([&] {
    std::vector<std::string> whole = {"env", cache_setting(), program(), "bench"};
    whole.insert(whole.end(), command.begin(), command.end());
    whole.insert(whole.end(), {"--peer", "sparse", "refusing", "failing", "wrong"});
    return whole;
  }());
  ASSERT_EQ(result.exit_status, 0) << result.output;
  EXPECT_NE(result.output.find("refusing: no tetrahedra"), std::string::npos) << result.output;
  EXPECT_NE(result.output.find("warning: the peer failing failed on stvk tet4: no compiler"),
            std::string::npos)
      << result.output;
  EXPECT_NE(result.output.find("wrong plain is left out: its product"), std::string::npos)
      << result.output;
  std::set<std::string> programs;
  const nlohmann::json results =
      nlohmann::json::parse(read_text_file(out() / "speed.json", "results"));
  for (const nlohmann::json& record : results["records"]) {
    const std::string peer = record["peer"];
    programs.insert(peer + " " + record["operation"].get<std::string>());
    EXPECT_EQ(record["ratio"] > 0, record["operation"] != "rebuild");
    EXPECT_LE(record["ratio_least"], record["ratio"]);
    EXPECT_GE(record["ratio_most"], record["ratio"]);
    if (!peer.empty()) {
      EXPECT_LT(record["difference"], 1e-9);
      EXPECT_GT(record["difference"], 0);
    }
  }
  for (const char* kind :
       {" forces", " product", "sparse eigen product", "sparse blocks product"}) {
    EXPECT_TRUE(programs.contains(kind)) << kind;
  }
  EXPECT_FALSE(programs.contains("wrong plain product"));

  const ProcessResult unknown = call({"peers", "--peer", "nobody"});
  EXPECT_EQ(unknown.exit_status, 2);
  EXPECT_NE(unknown.output.find("no peer is named 'nobody'; there are dealii, ffcx"),
            std::string::npos)
      << unknown.output;
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
