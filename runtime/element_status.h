// What a pass over the elements found wrong.
#pragma once

#include <cstddef>
#include <cstdint>

namespace elastogen {

/// First bad element of a pass (the one of least number), or good.
struct ElementStatus {
  std::uint32_t flags = 0;  ///< bits of KernelStatus; 0: every element is good
  std::size_t element = 0;  ///< number in the mesh, from 0; meaningful if flags != 0

  [[nodiscard]] bool ok() const { return flags == 0; }

  /// Keeps the bad element of smaller number.
  void merge(const ElementStatus& other) {
    if (!other.ok() && (ok() || other.element < element)) *this = other;
  }
};

}  // namespace elastogen
