// Elements that share one rest shape share one set of grouped constants.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace elastogen {

/// Two rest shapes are one where nodes, seen from node 0, differ by at most this part of the
/// element's largest extent: what rounding does to equal cells of a large mesh. Their results
/// differ by about as much, relative to the element's largest.
inline constexpr double congruence_tolerance = 1e-12;

/// More shapes than this are no longer worth looking for.
inline constexpr std::size_t most_shapes = 64;

/// Elements batched by rest shape. Indices are places in the list that they were found in.
struct CongruentElements {
  std::vector<std::size_t> order;   ///< [batch * lanes + lane], full batches of one shape each
  std::vector<std::int32_t> shape;  ///< [batch]
  std::vector<std::size_t> others;  ///< elements in no such batch, in their order
};

/// Finds elements that are translations of each other. Where they do not fill most batches all are
/// among the others.
/// @param positions  [element * values + k]: of the nodes from node 0
/// @param values     numbers per element
[[nodiscard]] CongruentElements find_congruent_elements(std::span<const double> positions,
                                                        std::size_t values, std::size_t lanes);

/// Places of `count` elements in `count / lanes` full batches: lane l takes its elements from the
/// l-th part, so that the lanes of a batch share few nodes and an addition seldom waits for the one
/// before it. Calls `place(element)` in the order of batches and lanes.
template <class Place>
void interleave_lanes(std::size_t count, std::size_t lanes, Place&& place) {
  const std::size_t batches = count / lanes;
  for (std::size_t b = 0; b < batches; ++b) {
    for (std::size_t l = 0; l < lanes; ++l) place(l * batches + b);
  }
}

}  // namespace elastogen
