// A folder of generated kernel sources and its manifest.
#pragma once

#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <string>

#include "symgen/law/law.h"
#include "symgen/pipeline.h"

namespace elastogen::selector {

/// Sources of one association, by file name.
using SourceFiles = std::map<std::string, std::string>;

/// The files of an association for the target "cpu":
///   ID.h           kernel templates
///   ID_f64.cpp     tables of all operations, packs of doubles
///   ID_f32.cpp     ... of floats
///   ID_tables.h    declarations of the functions that return the tables
/// with ID as an identifier (stvk_hexa8_q8_none).
[[nodiscard]] SourceFiles cpu_files(const symgen::GeneratedAssociation& generated,
                                    const symgen::Law& law);

/// ... for the target "opencl": ID.cl, a program that includes opencl/prelude.cl.
[[nodiscard]] SourceFiles opencl_files(const symgen::GeneratedAssociation& generated);

/// What the sources were made for, as the manifest tells it.
struct KernelTarget {
  std::string name;  ///< "cpu", "opencl"
  std::string profile;
};

/// The folder that `generate` writes to. Its `manifest.json` holds for each association and
/// target, sorted, the hash of what was asked for, the hashes of its files, and what its kernels
/// cost; no dates, no paths, so equal content is equal bytes. Associations that are in it already
/// stay. Kernels are always generated anew, in a fraction of a second, and compared with what is
/// there: so neither an edited file nor another generator is ever taken for up to date.
class KernelFolder {
 public:
  /// Reads the folder's manifest, if there is one.
  /// @throws InputError  when the manifest is not one of ours
  explicit KernelFolder(std::filesystem::path folder);

  /// Writes files that differ from what is there, then the manifest; equal ones keep their time
  /// stamp. Returns whether any differed.
  bool write(const symgen::GeneratedAssociation& generated, const KernelTarget& target,
             const SourceFiles& files);

 private:
  /// Returns whether the file was not there, or another.
  bool write_if_changed(const std::string& file, const std::string& text) const;

  std::filesystem::path folder_;
  nlohmann::json manifest_;
};

}  // namespace elastogen::selector
