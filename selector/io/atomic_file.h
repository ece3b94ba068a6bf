// Files made by other programs that are either whole or absent. Text is written by
// selector/support/files.h.
#pragma once

#include <filesystem>
#include <functional>

namespace elastogen::selector {

/// Lets `write` fill a temporary file beside `path`, then renames it to `path`: a reader, or a kill
/// at any moment, never sees half a file.
///
/// @param write  gets the temporary file's name, which has the same extension as `path`; it may
///               throw, then nothing is left behind
/// @throws WorkError  when the file cannot be written
void write_atomically(const std::filesystem::path& path,
                      const std::function<void(const std::filesystem::path& temporary)>& write);

/// Creates a folder and its parents where they do not exist.
/// @throws WorkError  when that cannot be done, for instance because a file has that name
void create_folder(const std::filesystem::path& folder);

}  // namespace elastogen::selector
