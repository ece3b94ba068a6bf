#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <array>
#include <fstream>

#include "../scene/temporary_scene.h"
#include "selector/io/colours.h"
#include "selector/io/curve_picture.h"
#include "selector/io/deformed_picture.h"
#include "selector/io/gnuplot.h"
#include "selector/io/projection.h"
#include "selector/io/si_prefix.h"
#include "selector/scene/scene_mesh.h"

namespace elastogen::selector {
namespace {

/// Width and height in a PNG file's header; zeros if the file is no PNG.
std::array<int, 2> png_size(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  std::array<unsigned char, 24> header{};
  stream.read(reinterpret_cast<char*>(header.data()), header.size());
  const std::array<unsigned char, 8> signature = {0x89, 'P', 'N', 'G', 0x0d, 0x0a, 0x1a, 0x0a};
  if (!stream || !std::equal(signature.begin(), signature.end(), header.begin())) return {};
  const auto number = [&](std::size_t at) {
    return header[at] << 24 | header[at + 1] << 16 | header[at + 2] << 8 | header[at + 3];
  };
  return {number(16), number(20)};
}

TEST(Pictures, DeformedBodyAndCurveAreDrawn) {
  if (!have_gnuplot()) GTEST_SKIP() << "gnuplot is not installed";
  const TemporaryFolder folder;
  const SceneMesh bar = make_mesh(read_text(good_scene));
  std::vector<double> displacement(bar.mesh.positions.size(), 0.0);
  for (std::size_t i = 2; i < displacement.size(); i += 3) {
    displacement[i] = -0.1 * bar.mesh.positions[i - 2];
  }
  draw_deformed(folder.path() / "it's.png", bar.mesh, displacement,
                displacement_colours(bar.mesh, displacement), "it's a \"title\"\nof two");
  EXPECT_EQ(png_size(folder.path() / "it's.png")[0], 1500);

  const DeflectionCurve curve = mean_of_sections(bar.section_x, bar.section_nodes, displacement, 3);
  draw_curve(folder.path() / "curve.png", curve, NamedCurve{"reference", curve}, "title");
  EXPECT_EQ(png_size(folder.path() / "curve.png"), (std::array<int, 2>{1000, 900}));
  draw_curve(folder.path() / "alone.png", curve, std::nullopt, "title");
  EXPECT_EQ(png_size(folder.path() / "alone.png"), (std::array<int, 2>{1000, 600}));

  const auto entries = std::distance(std::filesystem::directory_iterator(folder.path()), {});
  EXPECT_EQ(entries, 3) << "temporary files are left behind";
}

TEST(Pictures, PrefixesKeepMagnitudesBetweenOneAndAThousand) {
  for (const auto& [value, symbol] : std::vector<std::pair<double, std::string>>{
           {1, ""}, {999, ""}, {1000, "k"}, {-4.3e5, "k"}, {2e6, "M"}, {0.008, "m"}, {3e-6, "µ"}}) {
    const SiPrefix prefix = si_prefix(value);
    EXPECT_EQ(prefix.symbol, symbol) << value;
    EXPECT_GE(std::abs(value) * prefix.factor, 1 - 1e-9);
    EXPECT_LT(std::abs(value) * prefix.factor, 1000);
  }
  // What labels round to 1000 is 1 of the next.
  EXPECT_EQ(si_prefix(999.9999999).symbol, "k");
  EXPECT_EQ(si_prefix(999.99999).symbol, "");
  EXPECT_EQ(si_prefix(0).symbol, "");
  EXPECT_EQ(si_prefix(1e20).symbol, "T");
}

TEST(Pictures, WrongCommandsAreReported) {
  if (!have_gnuplot()) GTEST_SKIP() << "gnuplot is not installed";
  const TemporaryFolder folder;
  EXPECT_THROW(draw_png(folder.path() / "a.png", 100, 100, "no such command\n"), WorkError);
  EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
}

TEST(Pictures, ProjectionKeepsLengthsAndHandedness) {
  const Projection projection = Projection::from_angles(0.7, 0.3);
  EXPECT_NEAR(projection.right.cross(projection.up).dot(projection.to_eye), 1, 1e-15);
  EXPECT_NEAR(projection.right.norm(), 1, 1e-15);
  EXPECT_NEAR(projection.right.dot(projection.up), 0, 1e-15);
  EXPECT_GT(projection({0, 0, 1})[1], 0) << "z points up";
  EXPECT_GT(projection({1, 0, 0})[0], 0) << "x points right";
}

TEST(Pictures, ColoursGetLighter) {
  const auto lightness = [](const Colour& c) { return 0.3 * c[0] + 0.6 * c[1] + 0.1 * c[2]; };
  for (int i = 0; i < 20; ++i) {
    EXPECT_LT(lightness(sequential_colour(i / 20.0)), lightness(sequential_colour((i + 1) / 20.0)));
  }
  EXPECT_EQ(rgb_text({1, 0.5, 0}), "#ff8000");
}

}  // namespace
}  // namespace elastogen::selector
