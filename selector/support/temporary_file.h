// Names of files that are being written, and what becomes of them when a process is killed.
#pragma once

#include <filesystem>
#include <string>

namespace elastogen::selector {

/// ".NAME.elastogen-PID." + `ending` beside a file: hidden, apart from those of other processes,
/// and on the same file system, as renaming needs.
/// @param name    of the file, or its stem
/// @param ending  "png" or "gnuplot" for pictures, "XXXXXX" for mkostemp: what
///                `remove_left_temporaries` knows
[[nodiscard]] std::filesystem::path temporary_beside(const std::filesystem::path& file,
                                                     const std::string& name,
                                                     const std::string& ending);

/// Removes the files directly in `folder`, which need not exist, that have such a name with the
/// number of a process that is gone: a killed run left them. Files of processes that live, of other
/// users, and with any other name stay.
void remove_left_temporaries(const std::filesystem::path& folder);

}  // namespace elastogen::selector
