#include "runtime/mesh_order.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <utility>

namespace elastogen {
namespace {

constexpr int bits = 21;  // of each coordinate: three fit into 64

struct BoundingBox {
  std::array<double, 3> low{};
  double size = 0;  ///< of the longest edge
};

BoundingBox bounding_box(const Mesh& mesh) {
  BoundingBox box;
  const auto dim = static_cast<std::size_t>(mesh.dim);
  for (std::size_t i = 0; i < dim && !mesh.positions.empty(); ++i) {
    double low = std::numeric_limits<double>::infinity(), high = -low;
    for (std::size_t k = i; k < mesh.positions.size(); k += dim) {
      low = std::min(low, mesh.positions[k]);
      high = std::max(high, mesh.positions[k]);
    }
    box.low[i] = low;
    box.size = std::max(box.size, high - low);
  }
  return box;
}

/// Two zero bits behind every bit of the lower 21.
std::uint64_t spread(std::uint64_t x) {
  x = (x | x << 32) & 0x001f00000000ffff;
  x = (x | x << 16) & 0x001f0000ff0000ff;
  x = (x | x << 8) & 0x100f00f00f00f00f;
  x = (x | x << 4) & 0x10c30c30c30c30c3;
  return (x | x << 2) & 0x1249249249249249;
}

/// Place on the curve of an element's centre.
std::uint64_t place(const Mesh& mesh, std::span<const std::int32_t> nodes, const BoundingBox& box) {
  const auto dim = static_cast<std::size_t>(mesh.dim);
  std::uint64_t code = 0;
  for (std::size_t i = 0; i < dim; ++i) {
    double centre = 0;
    for (const std::int32_t node : nodes) {
      centre += mesh.positions[dim * static_cast<std::size_t>(node) + i];
    }
    centre /= static_cast<double>(nodes.size());
    const double part = box.size > 0 ? (centre - box.low[i]) / box.size : 0;
    constexpr double last = (1 << bits) - 1;
    code |= spread(static_cast<std::uint64_t>(std::clamp(part, 0.0, 1.0) * last)) << i;
  }
  return code;
}

}  // namespace

bool is_scattered(const Mesh& mesh, std::span<const ModelPart> parts) {
  // A cache of 256 KiB in lines of 64 bytes, each of which has one place.
  constexpr std::size_t num_lines = 4096;
  constexpr std::size_t numbers_per_line = 8;
  std::vector<std::size_t> line_at(num_lines, static_cast<std::size_t>(-1));
  std::size_t num_reads = 0;
  for (const ModelPart& part : parts) {
    const ElementBlock& block = mesh.blocks[part.block];
    for (const std::int32_t e : part.elements) {
      for (const std::int32_t node : block.element_nodes(static_cast<std::size_t>(e))) {
        const std::size_t line =
            static_cast<std::size_t>(node) * static_cast<std::size_t>(mesh.dim) / numbers_per_line;
        if (line_at[line % num_lines] == line) continue;
        line_at[line % num_lines] = line;
        ++num_reads;
      }
    }
  }
  return num_reads > 2 * mesh.num_nodes();
}

std::vector<ModelPart> along_curve(const Mesh& mesh, std::span<const ModelPart> parts) {
  const BoundingBox box = bounding_box(mesh);
  std::vector<ModelPart> result(parts.begin(), parts.end());
  std::vector<std::pair<std::uint64_t, std::int32_t>> places;
  for (ModelPart& part : result) {
    const ElementBlock& block = mesh.blocks[part.block];
    places.clear();
    for (const std::int32_t e : part.elements) {
      places.emplace_back(place(mesh, block.element_nodes(static_cast<std::size_t>(e)), box), e);
    }
    std::sort(places.begin(), places.end());
    std::transform(places.begin(), places.end(), part.elements.begin(),
                   [](const auto& placed) { return placed.second; });
  }
  return result;
}

}  // namespace elastogen
