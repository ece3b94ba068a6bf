#include <nlohmann/json.hpp>

#include "program.h"

namespace elastogen::selector {
namespace {

using CommandLine = ProgramTest;

TEST_F(CommandLine, WithoutCommandNamesThem) {
  expect_error(2, {}, {"no command", "list", "explain", "generate", "evaluate", "run"});
}

TEST_F(CommandLine, SuggestsTheNearestCommandAndOption) {
  expect_error(2, {"explian", "x"}, {"unknown command 'explian'", "did you mean 'explain'"});
  expect_error(2, {"list", "--jsno"}, {"unknown option '--jsno'", "did you mean '--json'"});
  expect_error(2, {"explain", "hooke-tet4-q1-none", "more"}, {"unknown argument 'more'"});
}

TEST_F(CommandLine, RefusesValuesThatAreNotOffered) {
  expect_error(2, {"explain"}, {"ASSOCIATION"});
  expect_error(2, {"list", "--profile", "cray"}, {"cray", "x86-dram"});
  expect_error(2, {"list", "--grouping", "best"}, {"best", "{minimum-cut,algorithm6}"});
  expect_error(2, {"list", "--threads", "-1"}, {"--threads"});
  expect_error(2, {"explain", "hooke-tet4-q1-none", "--operation", "forces"}, {"--dot"});
}

TEST_F(CommandLine, HelpAndVersionAreNoErrors) {
  const ProcessResult help = elastogen({"--help"});
  EXPECT_EQ(help.exit_status, 0);
  EXPECT_NE(help.output.find("Examples:"), std::string::npos);
  EXPECT_EQ(elastogen({"evaluate", "--help"}).exit_status, 0);
  EXPECT_EQ(elastogen({"--version"}).output.substr(0, 10), "elastogen ");
}

TEST_F(CommandLine, RefusesUnknownParts) {
  for (const std::string command : {"explain", "generate"}) {
    expect_error(2, {command, "stvc-tet4-q1-none"}, {"unknown law 'stvc'", "stvk"});
    expect_error(2, {command, "stvk-tett4-q1-none"}, {"'tett4'", "did you mean 'tet4'"});
    expect_error(2, {command, "stvk-tet4-q2-none"}, {"'q2'", "q4"});
    expect_error(2, {command, "stvk-tet4-q1-gl"}, {"'gl'"});
    expect_error(2, {command, "stvk-tet4"}, {"'stvk-tet4'", "stvk-hexa8-q8-none"});
    expect_error(2, {command, "neo_hookean-tet4-exact-none"}, {"polynomial"});
  }
}

TEST_F(CommandLine, GeneratesNothingWhenOnePatternIsWrong) {
  expect_error(2, {"generate", "hooke-tet4-q1-none", "stvk-tet5-*-none", "--out", "kernels"},
               {"unknown element 'tet5'"});
}

TEST_F(CommandLine, FailsWhereItCannotWrite) {
  write("file", "");
  expect_error(2, {"generate", "hooke-tet4-q1-none", "--out", "file"}, {"'file'", "folder"});
  expect_error(1, {"generate", "hooke-tet4-q1-none", "--out", "file/below"}, {"cannot write"});
}

TEST_F(CommandLine, RefusesALawFolderThatDoesNotExist) {
  expect_error(2, {"list", "--laws", "nowhere"}, {"--laws 'nowhere'", "not a folder"});
  expect_error(2, {"list"}, {"ELASTOGEN_LAWS folder 'nowhere'"}, {"ELASTOGEN_LAWS=nowhere"});
}

TEST_F(CommandLine, ListsIdsAsAJsonArray) {
  const ProcessResult result = elastogen({"list", "stvk-hexa8-*", "--split", "none", "--json"});
  ASSERT_EQ(result.exit_status, 0) << result.output;
  EXPECT_EQ(nlohmann::json::parse(result.output),
            (nlohmann::json{"stvk-hexa8-q8-none", "stvk-hexa8-q27-none"}));
}

/// These keys are what other programs read.
TEST_F(CommandLine, ExplainsAsJson) {
  const ProcessResult result = elastogen({"explain", "stvk-hexa8-q8-none", "--json"});
  ASSERT_EQ(result.exit_status, 0) << result.output;
  const nlohmann::json json = nlohmann::json::parse(result.output);
  EXPECT_EQ(json["association"], "stvk-hexa8-q8-none");
  EXPECT_EQ(json["law"]["terms"], (nlohmann::json{"lambda/2*trE^2", "mu*trE2"}));
  EXPECT_EQ(json["law"]["parameters"][1]["name"], "mu");
  EXPECT_EQ(json["element"]["coordinates"], (nlohmann::json{"xi", "eta", "mu"}));
  EXPECT_EQ(json["element"]["reference_nodes"].size(), 8U);
  EXPECT_EQ(json["element"]["reference_nodes"][1], (nlohmann::json{1.0, -1.0, -1.0}));
  EXPECT_EQ(json["element"]["shape_functions"].size(), 8U);
  EXPECT_EQ(json["quadrature"]["points"][0][0], "-0.5773502691896257645091487805019574556476");
  EXPECT_EQ(json["quadrature"]["weights"][7], "1.000000000000000000000000000000000000000");
  for (const char* operation :
       {"energy", "forces", "product", "stiffness", "constants", "stress"}) {
    for (const char* count : {"flops", "constants", "state", "bytes_read", "bytes_written",
                              "fragments", "code_bytes"}) {
      EXPECT_TRUE(json["operations"][operation][count].is_number_integer())
          << operation << ' ' << count;
    }
  }
}

TEST_F(CommandLine, LeavesOutWhatALawDoesNotSay) {
  write("laws/plain.toml",
        "name = \"plain\"\n[[parameter]]\nname = \"mu\"\nunit = \"Pa\"\n"
        "[[term]]\nname = \"shear\"\nenergy = \"mu*trE2\"\n");
  const ProcessResult result = elastogen({"--laws", "laws", "explain", "plain-tet4-q1-none"});
  EXPECT_NE(result.output.find("law         plain\n"), std::string::npos) << result.output;
  EXPECT_NE(result.output.find("parameter mu [Pa]\n"), std::string::npos) << result.output;
}

TEST_F(CommandLine, FailsWhereItsOutputIsLost) {
  const ProcessResult result =
      run_process({"sh", "-c", "'" ELASTOGEN_BINARY_DIR "/bin/elastogen' list > /dev/full"});
  EXPECT_EQ(result.exit_status, 1) << result.output;
  EXPECT_NE(result.output.find("error: "), std::string::npos) << result.output;
}

TEST_F(CommandLine, GeneratesOnceAndThenIsUpToDate) {
  const std::vector<std::string> call = {"generate", "hooke-tet4-q1-none", "--out", "kernels"};
  const ProcessResult first = elastogen(call);
  ASSERT_EQ(first.exit_status, 0) << first.output;
  EXPECT_NE(first.output.find("generated   hooke-tet4-q1-none"), std::string::npos);
  const ProcessResult second = elastogen(call);
  EXPECT_NE(second.output.find("up to date  hooke-tet4-q1-none"), std::string::npos);
  EXPECT_TRUE(std::filesystem::exists(folder() / "kernels" / "hooke_tet4_q1_none.h"));
}

}  // namespace
}  // namespace elastogen::selector
