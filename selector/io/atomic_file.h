// Files made by other programs that are either whole or absent. Text is written by
// selector/support/files.h.
#pragma once

#include <filesystem>
#include <functional>

namespace elastogen::selector {

/// Lets `write` fill a temporary file beside `path`, then renames it to `path`: a reader, or a kill
/// at any moment, never sees half a file.
///
/// @param path   has an extension
/// @param write  gets the temporary file's name, which has the same extension as `path`; it may
///               throw, then nothing is left behind. After a kill `remove_left_temporaries`
///               (selector/support/temporary_file.h) tidies up
/// @throws WorkError  when the file cannot be written
void write_atomically(const std::filesystem::path& path,
                      const std::function<void(const std::filesystem::path& temporary)>& write);

/// Finds out, before long work, whether its results could be written into the folder, which need
/// not exist yet. Changes nothing.
/// @throws InputError  if a file has its name
/// @throws WorkError   if it is there and nothing can be written into it
void check_can_be_written(const std::filesystem::path& folder);

/// Creates a folder and its parents where they do not exist.
/// @throws WorkError  when that cannot be done, for instance because a file has that name
void create_folder(const std::filesystem::path& folder);

}  // namespace elastogen::selector
