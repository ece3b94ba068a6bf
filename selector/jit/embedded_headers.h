// The headers that generated code includes, as text inside this program: on-the-fly compilation
// needs no installed copy, and cannot meet one of another version.
#pragma once

#include <span>
#include <string_view>

namespace elastogen::selector {

struct EmbeddedHeader {
  std::string_view path;  ///< as included: "runtime/kernel_abi.h"
  std::string_view text;
};

/// All of them; made by CMake from runtime/ (cmake/EmbedHeaders.cmake).
[[nodiscard]] std::span<const EmbeddedHeader> embedded_headers();

}  // namespace elastogen::selector
