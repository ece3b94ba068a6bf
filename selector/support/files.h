// Whole files: read, and written so that a reader never sees half of one.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace elastogen::selector {

/// @param what  what the file is to the user ("input"), for the message
/// @throws InputError  when it cannot be read
[[nodiscard]] std::string read_text_file(const std::filesystem::path& file, std::string_view what);

/// Writes beside the file (temporary_file.h) and renames; folders are made as needed.
/// @throws WorkError  when it cannot be written (full, read-only ...)
void write_text_file(const std::filesystem::path& file, std::string_view text);

}  // namespace elastogen::selector
