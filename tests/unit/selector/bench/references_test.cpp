// The exact solutions that errors are measured against.
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>

#include "runtime/error.h"
#include "selector/bench/bar_motion_problem.h"
#include "selector/bench/radial_sphere.h"
#include "symgen/law/parameters.h"

namespace elastogen::selector {
namespace {

symgen::Law law(const std::string& name) {
  return symgen::read_law(std::filesystem::path(ELASTOGEN_SOURCE_DIR) / "laws" / (name + ".toml"));
}

RadialSphere sphere(const std::string& name, double pressure) {
  const symgen::Law l = law(name);
  return RadialSphere(l, {1, 2, pressure, symgen::parameters_from_young_poisson(l, 1e6, 0.3)});
}

/// Timoshenko & Goodier, Theory of elasticity, 3rd ed., section 136.
double lame(double pressure, double r) {
  return pressure / (1e6 * 7) * (0.4 * r + 1.3 * 8 / (2 * r * r));
}

TEST(RadialSphere, IsLamesForTheLinearLaw) {
  const RadialSphere exact = sphere("hooke", 1e4);
  for (const double r : {1.0, 1.2, 1.7, 2.0}) {
    EXPECT_NEAR(exact.displacement(r) / lame(1e4, r), 1, 1e-11) << r;
  }
}

TEST(RadialSphere, IsLamesAtSmallStrainForEveryLaw) {
  for (const char* name : {"stvk", "neo_hookean", "stable_neo_hookean"}) {
    const RadialSphere exact = sphere(name, 1);
    for (const double r : {1.0, 1.5, 2.0}) {
      EXPECT_NEAR(exact.displacement(r) / lame(1, r), 1, 1e-5) << name << ' ' << r;
    }
  }
}

TEST(RadialSphere, BalancesTheStressOfANonlinearLawAtLargeStrain) {
  // Neo-Hooke by hand: P_r = mu (s - 1/s) + lambda log(J) / s, with s = dr/dR and J = s (r/R)^2;
  // R^2 P_r grows by 2 R P_t, and P_r = -p inside, 0 outside.
  const RadialSphere exact = sphere("neo_hookean", 4e5);
  const double mu = 1e6 / 2.6, lambda = 1e6 * 0.3 / (1.3 * 0.4), h = 1e-4;
  const auto slope = [&](double r) {
    return (exact.displacement(r + h) - exact.displacement(r - h)) / (2 * h);
  };
  const auto stress = [&](double r, bool radial) {
    const double along = 1 + slope(r), around = 1 + exact.displacement(r) / r;
    const double s = radial ? along : around;
    return mu * (s - 1 / s) + lambda * std::log(along * around * around) / s;
  };
  EXPECT_GT(exact.displacement(1), 0.3);
  for (const double r : {1.1, 1.5, 1.9}) {
    const double change =
        ((r + h) * (r + h) * stress(r + h, true) - (r - h) * (r - h) * stress(r - h, true)) /
        (2 * h);
    EXPECT_NEAR(change, 2 * r * stress(r, false), 5) << r;  // of about 1e5 Pa
  }
  EXPECT_NEAR(stress(1 + h, true), -4e5, 2e2);
  EXPECT_NEAR(stress(2 - h, true), 0, 2e2);
}

TEST(RadialSphere, SaysThatThereIsNoEquilibrium) {
  EXPECT_THROW((void)sphere("neo_hookean", 1e8), WorkError);
}

TEST(HangingBar, StartsByFallingFreelyAndSwingsToTwiceItsRest) {
  const HangingBar bar = {8, 31.6, 0.1};
  EXPECT_NEAR(bar.end_displacement(0), 0, 1e-9);
  // Until the wave from the clamp is there.
  for (const double time : {0.05, 0.1, 0.25}) {
    EXPECT_NEAR(bar.end_displacement(time), 0.05 * time * time, 1e-9) << time;
  }
  const double rest = 0.1 * 64 / (2 * 31.6 * 31.6);
  EXPECT_NEAR(bar.end_displacement(bar.period() / 2), 2 * rest, 1e-9);
  EXPECT_NEAR(bar.end_displacement(bar.period()), 0, 1e-9);
}

}  // namespace
}  // namespace elastogen::selector
