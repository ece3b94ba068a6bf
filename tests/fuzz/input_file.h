// Fuzzed bytes as a file, for readers that take a path.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>

namespace elastogen::fuzz {

/// A file of that name in a folder of this process, holding the bytes; overwritten by each call.
[[nodiscard]] std::filesystem::path input_file(const char* name, const std::uint8_t* data,
                                               std::size_t size);

}  // namespace elastogen::fuzz
