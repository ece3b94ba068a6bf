#include "symgen/law/stability.h"

#include <gtest/gtest.h>

#include <cmath>

#include "temporary_law.h"

namespace elastogen::symgen {
namespace {

TEST(ModuliAtRest, AreThoseOfTheLaw) {
  // docs/laws.md: mu is 4/3 of the shear modulus, lambda the first Lame parameter plus 5/8 of mu.
  const ModuliAtRest stable = moduli_at_rest(shipped_law("stable_neo_hookean"), {4, 10}).value();
  EXPECT_DOUBLE_EQ(stable.mu, 3);
  EXPECT_DOUBLE_EQ(stable.lambda, 7.5);
  EXPECT_TRUE(stable.is_stable());
  // lambda = kappa - 4/3 (c1 + c2), mu = 2 (c1 + c2), nu = (3 kappa - 2 mu)/(2 (3 kappa + mu))
  const ModuliAtRest rubber = moduli_at_rest(shipped_law("mooney_rivlin"), {0.2, 0.1, 10}).value();
  EXPECT_DOUBLE_EQ(rubber.poisson(), (30 - 1.2) / (2 * (30 + 0.6)));
}

TEST(ModuliAtRest, SayWhatIsUnstable) {
  const Law hooke = shipped_law("hooke");
  EXPECT_FALSE(moduli_at_rest(hooke, {1, -1}).value().is_stable());
  EXPECT_FALSE(moduli_at_rest(hooke, {1, 0}).value().is_stable());
  EXPECT_FALSE(moduli_at_rest(hooke, {-0.7, 1}).value().is_stable()) << "3 lambda + 2 mu < 0";
  EXPECT_TRUE(moduli_at_rest(hooke, {-0.6, 1}).value().is_stable());
}

TEST(ModuliAtRest, AreMissingWithoutATangent) {
  EXPECT_FALSE(moduli_at_rest(law_with_term("mu*trE2 + lambda*trE2^(3/2)"), {1, 1}).has_value());
}

TEST(UnstableStretches, AreNoneForSoundRubbers) {
  EXPECT_TRUE(unstable_stretches(shipped_law("mooney_rivlin"), {0.3e6, 0.1e6, 1e9}).empty());
  // Yeoh's own constants for a filled rubber have this shape.
  EXPECT_TRUE(unstable_stretches(shipped_law("yeoh"), {0.5e6, -0.01e6, 0.001e6, 1e9}).empty());
  EXPECT_TRUE(unstable_stretches(shipped_law("neo_hookean"), {1e9, 1e6}).empty());
}

// In pure shear the logarithmic strains are (e, 0, -e). Along the increments u = (1, 0, -1) and
// v = (1, -2, 1), with a = exp(2 e) and b = 1/a, I1 = a + 1 + b changes by 2 (a - b) and
// 2 (a - 2 + b), and its second derivatives are 4 (a + b), 4 (a - b) and 4 (a + 4 + b).
TEST(UnstableStretches, OfYeohInPureShearIsThatOfTheFormula) {
  const double c1 = 1e6, c2 = -0.2e6;
  const auto is_stable = [&](double t) {
    const double a = t * t, b = 1 / a, u = 2 * (a - b), v = 2 * (a - 2 + b);
    const double slope = c1 + 2 * c2 * (a + b - 2), curvature = 2 * c2;
    const double uu = 4 * slope * (a + b) + curvature * u * u;
    const double uv = 4 * slope * (a - b) + curvature * u * v;
    const double vv = 4 * slope * (a + 4 + b) + curvature * v * v;
    return uu > 0 && uu * vv > uv * uv;
  };
  double stable = 1, unstable = 2;
  while (unstable - stable > 1e-9) {
    const double middle = (stable + unstable) / 2;
    (is_stable(middle) ? stable : unstable) = middle;
  }
  const std::vector<UnstableStretch> found =
      unstable_stretches(shipped_law("yeoh"), {c1, c2, 0, 1e9});
  ASSERT_EQ(found.size(), 4U);
  EXPECT_EQ(found[3].mode, "pure shear");
  // Found by halving a step of ln(2)/20 six times.
  EXPECT_NEAR(std::log(found[3].stretch), std::log(stable), std::log(2.0) / 20 / 64);
  EXPECT_EQ(found[1].mode, "uniaxial compression");
  EXPECT_LT(found[1].stretch, 1);
}

TEST(UnstableStretches, EndWithTheLawsDomain) {
  // Gent's logarithm ends at I1 = 3 + 0.1, long before a stretch of 2; up to there it stiffens.
  const Law law = law_with_term("-mu/20*log(1 - 10*(J^(-2/3)*I1 - 3)) + lambda*(J - 1)^2");
  EXPECT_TRUE(unstable_stretches(law, {1e9, 1e6}).empty());
}

}  // namespace
}  // namespace elastogen::symgen
