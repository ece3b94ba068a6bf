// Expression graphs by the bytes' choices: passes keep the values of every root.
#include <cmath>
#include <cstdint>
#include <cstdlib>

#include "symgen/passes/factor.h"
#include "symgen/passes/group_stages.h"
#include "symgen/passes/share_pairs.h"
#include "tests/unit/dag/random_graph.h"

namespace elastogen::symgen {
namespace {

/// Sums of numbers of either sign may cancel: rounding is relative to what they were made of.
void expect_same(const RandomGraph& original, const Graph& changed) {
  const std::vector<double> expected = values_of(original.graph, original);
  const std::vector<double> found = values_of(changed, original);
  for (std::size_t k = 0; k < expected.size(); ++k) {
    const double size = std::abs(expected[k]);
    // Beyond, intermediate values have overflowed or cancel too much to be compared.
    if (!std::isfinite(expected[k]) || size > 1e6 || size < 1e-6) continue;
    if (!(std::abs(found[k] - expected[k]) <= 1e-3 * size)) std::abort();
  }
}

}  // namespace
}  // namespace elastogen::symgen

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace elastogen::symgen;
  std::size_t next = 0;
  const auto byte = [&]() -> std::size_t { return next < size ? data[next++] : 0; };
  const RandomGraph graph = make_graph(
      [&](std::size_t bound) { return (bound > 256 ? 256 * byte() + byte() : byte()) % bound; },
      24);
  const Graph factored = factor(graph.graph);
  expect_same(graph, factored);
  const Graph grouped = group_stages(factored);
  expect_same(graph, grouped);
  expect_same(graph, share_pairs(grouped, Stage::state));
  return 0;
}
