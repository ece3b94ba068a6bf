// Folder of compiled kernels, by content.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <string_view>

namespace elastogen::selector {

/// ELASTOGEN_CACHE_DIR, else $XDG_CACHE_HOME/elastogen, else ~/.cache/elastogen, else (no home) a
/// folder of the user's own below the system's temporary one, closed to others.
[[nodiscard]] std::filesystem::path default_cache_folder();

/// A folder that vanishes with the object unless it was published.
class WorkFolder {
 public:
  /// Makes a new folder below `parent`, which is made too when missing.
  /// @throws WorkError  when it cannot be made; says how to move the cache
  explicit WorkFolder(const std::filesystem::path& parent);
  ~WorkFolder();
  WorkFolder(WorkFolder&& other) noexcept;
  WorkFolder& operator=(WorkFolder&&) = delete;

  [[nodiscard]] const std::filesystem::path& path() const { return path_; }

  /// Renames the folder to `entry` in one step. Where another process was first, its entry stays
  /// (same name, same content) and this one is dropped.
  void publish(const std::filesystem::path& entry);

  /// Leaves the folder where it is, for the user to look at.
  void keep() { owned_ = false; }

 private:
  std::filesystem::path path_;
  bool owned_ = true;
};

/// Removes work folders below `parent` that a killed process left more than a day ago.
void remove_stale_work_folders(const std::filesystem::path& parent);

}  // namespace elastogen::selector
