#include "selector/scene/start.h"

#include <algorithm>
#include <limits>
#include <random>

namespace elastogen::selector {
namespace {

struct Range {
  double low = std::numeric_limits<double>::infinity();
  double high = -low;
};

std::vector<Range> box_of(const Mesh& mesh) {
  const auto dim = static_cast<std::size_t>(mesh.dim);
  std::vector<Range> box(dim);
  for (std::size_t k = 0; k < mesh.positions.size(); ++k) {
    box[k % dim].low = std::min(box[k % dim].low, mesh.positions[k]);
    box[k % dim].high = std::max(box[k % dim].high, mesh.positions[k]);
  }
  return box;
}

}  // namespace

const std::vector<std::string>& start_names() {
  static const std::vector<std::string> names = {"rest", "inverted", "flattened", "scrambled"};
  return names;
}

Vector start_displacement(const Mesh& mesh, Start start) {
  const auto dim = static_cast<std::size_t>(mesh.dim);
  const std::vector<Range> box = box_of(mesh);
  std::mt19937 generator(1);
  Vector u = Vector::Zero(static_cast<Eigen::Index>(mesh.positions.size()));
  for (std::size_t k = 0; k < mesh.positions.size(); ++k) {
    const double x = mesh.positions[k];
    const Range& range = box[k % dim];
    const double from_centre = x - (range.low + range.high) / 2;
    double& value = u[static_cast<Eigen::Index>(k)];
    if (start == Start::inverted && k % dim == 0) value = -2 * from_centre;
    if (start == Start::flattened && k % dim == 0) value = -from_centre;
    if (start == Start::scrambled) {
      value = std::uniform_real_distribution<double>(range.low, range.high)(generator) - x;
    }
  }
  return u;
}

}  // namespace elastogen::selector
