// Scenes that are wrong: `run` says where and what, and writes nothing.
#include "program.h"

namespace elastogen::selector {
namespace {

class Scene : public ProgramTest {
 protected:
  /// Replaces a part of a right scene and expects `run` to refuse the result.
  void expect_scene_error(const std::string& part, const std::string& replacement,
                          const std::vector<std::string>& words) const {
    std::string text = right_scene;
    const std::size_t position = text.find(part);
    ASSERT_NE(position, std::string::npos) << part;
    text.replace(position, part.size(), replacement);
    write("scene.toml", text);
    expect_error(2, {"run", "scene.toml", "--out", "results"}, words);
  }

  static constexpr const char* right_scene = R"(gravity = [0.0, 0.0, -9.81]
[mesh]
nodes = [[0,0,0], [1,0,0], [1,1,0], [0,1,0], [0,0,1], [1,0,1], [1,1,1], [0,1,1]]
[[mesh.block]]
association = "hooke-hexa8-q8-none"
region = "steel"
elements = [[0, 1, 2, 3, 4, 5, 6, 7]]
[material.steel]
density = 7800.0
young = 2e11
poisson = 0.3
[[constraint]]
plane = { x = 0.0 }
fixed = ["x", "y", "z"]
)";
};

TEST_F(Scene, ThatIsRightRuns) {
  write("scene.toml", right_scene);
  const ProcessResult result = elastogen({"run", "scene.toml", "--out", "results"});
  EXPECT_EQ(result.exit_status, 0) << result.output;
  EXPECT_TRUE(std::filesystem::exists(folder() / "results" / "summary.json"));
}

TEST_F(Scene, WithAnUnknownLaw) {
  expect_scene_error("hooke-hexa8", "hoke-hexa8",
                     {"scene.toml:", "'hoke'", "did you mean 'hooke'"});
}

TEST_F(Scene, WithAnUnknownElement) {
  expect_scene_error("hooke-hexa8", "hooke-hexa9",
                     {"scene.toml:", "'hexa9'", "did you mean 'hexa8'"});
}

TEST_F(Scene, WithAnUnknownKey) {
  expect_scene_error("poisson = 0.3", "poison = 0.3",
                     {"scene.toml:11", "poison", "did you mean 'poisson'"});
}

TEST_F(Scene, WithAPoissonRatioOutsideItsRange) {
  expect_scene_error("poisson = 0.3", "poisson = 0.5", {"scene.toml:11", "0.5", "(-1, 0.5)"});
}

TEST_F(Scene, WithANegativeDensity) {
  expect_scene_error("density = 7800.0", "density = -1.0", {"scene.toml:9", "density", "-1"});
}

TEST_F(Scene, WithAnInvertedElement) {
  expect_scene_error("[0, 1, 2, 3, 4, 5, 6, 7]", "[4, 5, 6, 7, 0, 1, 2, 3]",
                     {"scene.toml", "element 0", "inverted"});
}

TEST_F(Scene, WithARegionWithoutMaterial) {
  expect_scene_error("region = \"steel\"", "region = \"stel\"",
                     {"scene.toml:", "'stel'", "material", "did you mean 'steel'"});
}

TEST_F(Scene, WithNothingFixed) {
  expect_scene_error("fixed = [\"x\", \"y\", \"z\"]", "fixed = [\"x\"]", {"scene.toml", "rigid"});
}

TEST_F(Scene, ThatDoesNotExist) {
  expect_error(2, {"run", "nowhere.toml", "--out", "results"}, {"nowhere.toml"});
}

TEST_F(Scene, OnAMachineWithoutACompiler) {
  write("scene.toml", right_scene);
  expect_error(1, {"run", "scene.toml", "--out", "results"}, {"no C++ compiler"},
               {"-u", "CXX", "PATH=/nowhere"});
}

}  // namespace
}  // namespace elastogen::selector
