#include "runtime/congruent_elements.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace elastogen {
namespace {

// Elements whose batches stand together: their nodes fit in a cache.
constexpr std::size_t block_size = 4096;

constexpr std::int32_t no_shape = -1;

/// Known shapes, by an element that has each.
class ShapeTable {
 public:
  ShapeTable(std::span<const double> positions, std::size_t values)
      : positions_(positions), values_(values) {}

  /// The element's shape, a new one where there is room for it.
  std::int32_t find(std::size_t element) {
    // Neighbours often have the shapes that were found last, in turn.
    for (std::size_t k = 0; k < shapes_.size(); ++k) {
      const std::size_t shape = (last_ + k) % shapes_.size();
      if (!is_equal(element, shapes_[shape])) continue;
      last_ = shape;
      return static_cast<std::int32_t>(shape);
    }
    if (shapes_.size() == most_shapes) return no_shape;
    shapes_.push_back({element, congruence_tolerance * extent(element)});
    last_ = shapes_.size() - 1;
    return static_cast<std::int32_t>(last_);
  }

  [[nodiscard]] std::size_t size() const { return shapes_.size(); }

 private:
  struct Shape {
    std::size_t element;
    double tolerance;
  };

  [[nodiscard]] std::span<const double> of(std::size_t element) const {
    return positions_.subspan(element * values_, values_);
  }
  [[nodiscard]] double extent(std::size_t element) const {
    double largest = 0;
    for (const double x : of(element)) largest = std::max(largest, std::abs(x));
    return largest;
  }
  [[nodiscard]] bool is_equal(std::size_t element, const Shape& shape) const {
    const std::span<const double> a = of(element), b = of(shape.element);
    for (std::size_t k = 0; k < values_; ++k) {
      if (!(std::abs(a[k] - b[k]) <= shape.tolerance)) return false;
    }
    return true;
  }

  std::span<const double> positions_;
  std::size_t values_;
  std::vector<Shape> shapes_;
  std::size_t last_ = 0;
};

/// Every element's shape; empty as soon as most elements turn out to have shapes of their own.
std::vector<std::int32_t> shapes_of(std::span<const double> positions, std::size_t values,
                                    std::size_t& num_shapes) {
  const std::size_t count = positions.size() / values;
  ShapeTable table(positions, values);
  std::vector<std::int32_t> shapes(count);
  std::size_t without = 0;
  for (std::size_t e = 0; e < count; ++e) {
    shapes[e] = table.find(e);
    if (shapes[e] == no_shape) ++without;
    if (without > most_shapes && 2 * without > e) return {};
  }
  num_shapes = table.size();
  return shapes;
}

/// Shapes that fill no batch leave no gap.
void number_by_appearance(std::vector<std::int32_t>& shapes) {
  std::vector<std::int32_t> number(most_shapes, no_shape);
  std::int32_t next = 0;
  for (std::int32_t& shape : shapes) {
    std::int32_t& known = number[static_cast<std::size_t>(shape)];
    if (known == no_shape) known = next++;
    shape = known;
  }
}

}  // namespace

CongruentElements find_congruent_elements(std::span<const double> positions, std::size_t values,
                                          std::size_t lanes) {
  const std::size_t count = positions.size() / values;
  CongruentElements result;
  result.others.resize(count);
  std::iota(result.others.begin(), result.others.end(), std::size_t{0});
  std::size_t num_shapes = 0;
  const std::vector<std::int32_t> shapes = shapes_of(positions, values, num_shapes);
  if (shapes.empty()) return result;

  // Full batches block by block; what is left of a block waits for the next.
  std::vector<std::vector<std::size_t>> waiting(num_shapes);
  CongruentElements found;
  for (std::size_t begin = 0; begin < count; begin += block_size) {
    const std::size_t end = std::min(begin + block_size, count);
    for (std::size_t e = begin; e < end; ++e) {
      if (shapes[e] == no_shape) {
        found.others.push_back(e);
      } else {
        waiting[static_cast<std::size_t>(shapes[e])].push_back(e);
      }
    }
    for (std::size_t s = 0; s < num_shapes; ++s) {
      std::vector<std::size_t>& elements = waiting[s];
      const std::size_t full = elements.size() / lanes * lanes;
      interleave_lanes(full, lanes, [&](std::size_t k) { found.order.push_back(elements[k]); });
      found.shape.insert(found.shape.end(), full / lanes, static_cast<std::int32_t>(s));
      elements.erase(elements.begin(), elements.begin() + static_cast<std::ptrdiff_t>(full));
    }
  }
  for (const std::vector<std::size_t>& elements : waiting) {
    found.others.insert(found.others.end(), elements.begin(), elements.end());
  }
  std::sort(found.others.begin(), found.others.end());
  number_by_appearance(found.shape);
  return found.order.size() >= found.others.size() ? found : result;
}

}  // namespace elastogen
