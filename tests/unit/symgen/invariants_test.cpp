#include "symgen/mechanics/invariants.h"

#include <gtest/gtest.h>

#include "runtime/error.h"

namespace elastogen::symgen {
namespace {

using GiNaC::ex;
using GiNaC::matrix;

/// The invariant as its formula has it, by matrices, for a gradient extended to three dimensions.
ex by_matrices(const std::string& name, int dim) {
  matrix gradient(3, 3), identity(3, 3);
  for (unsigned i = 0; i < 3; ++i) identity(i, i) = 1;
  for (int i = 0; i < dim; ++i) {
    for (int j = 0; j < dim; ++j) {
      gradient(static_cast<unsigned>(i), static_cast<unsigned>(j)) =
          displacement_gradient(dim)[static_cast<std::size_t>(i * dim + j)];
    }
  }
  const matrix f = gradient.add(identity);
  const matrix c = f.transpose().mul(f);
  const matrix strain = c.sub(identity).mul_scalar(GiNaC::numeric(1, 2));
  const matrix small = gradient.add(gradient.transpose()).mul_scalar(GiNaC::numeric(1, 2));
  if (name == "trE") return strain.trace();
  if (name == "trE2") return strain.mul(strain).trace();
  if (name == "tr_eps") return small.trace();
  if (name == "tr_eps2") return small.mul(small).trace();
  if (name == "I1") return c.trace();
  if (name == "I2") return (GiNaC::pow(c.trace(), 2) - c.mul(c).trace()) / 2;
  if (name == "I3") return c.determinant();
  if (name == "J") return f.determinant();
  throw InternalError("no formula for " + name);
}

TEST(Invariants, AreTheirFormulasInTwoAndThreeDimensions) {
  for (const int dim : {2, 3}) {
    const std::vector<Definition> definitions = textbook_definitions(dim);
    for (const Invariant& invariant : invariants()) {
      const ex difference =
          substitute_definitions(invariant.symbol, definitions) - by_matrices(invariant.name, dim);
      EXPECT_TRUE(difference.expand().is_zero()) << invariant.name << " in " << dim << "D";
    }
  }
}

TEST(Invariants, HaveNoOtherNamesOrDimensions) {
  EXPECT_THROW((void)find_invariant("I9"), InternalError);
  EXPECT_THROW((void)displacement_gradient(4), InternalError);
}

TEST(NeededDefinitions, KeepsOrderAndDropsTheRest) {
  const std::vector<Definition> all = textbook_definitions(3);
  const std::vector<Definition> needed = needed_definitions({find_invariant("trE").symbol}, all);
  std::vector<std::string> names;
  for (const Definition& definition : needed) names.push_back(definition.symbol.get_name());
  EXPECT_EQ(names, (std::vector<std::string>{"E00", "E11", "E22", "trE"}));
}

TEST(ResolvePowersOfJ, UsesThatJIsPositive) {
  const GiNaC::possymbol j("J");
  const ex i3 = find_invariant("I3").symbol, volume = find_invariant("J").symbol;
  EXPECT_TRUE(resolve_powers_of_j(GiNaC::sqrt(i3), j).is_equal(j));
  EXPECT_TRUE(resolve_powers_of_j(GiNaC::log(i3), j).is_equal(2 * GiNaC::log(j)));
  EXPECT_TRUE(resolve_powers_of_j(GiNaC::pow(GiNaC::log(volume), 2), j)
                  .is_equal(GiNaC::pow(GiNaC::log(j), 2)));
}

}  // namespace
}  // namespace elastogen::symgen
