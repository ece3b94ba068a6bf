// Which associations exist, and which of them a user means.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "symgen/pipeline.h"

namespace elastogen::selector {

/// What each part of an id may be; empty: anything. Names and globs may be mixed.
struct AssociationFilter {
  std::vector<std::string> patterns;  ///< of the whole id: "stvk-*-q8-*"
  std::vector<std::string> laws, elements, quadratures, splits;
};

/// All associations that a filter admits, in the order laws (by name), elements, quadratures
/// (coarsest first), splits (`none`, `auto`, then by letters). Reads law files only where it
/// matters whether a law is polynomial.
/// @throws InputError  when a plain name exists nowhere, when a pattern matches nothing (says
///                     which part of it), or for errors in a law file
[[nodiscard]] std::vector<symgen::AssociationId> find_associations(
    const AssociationFilter& filter, const std::vector<std::filesystem::path>& law_folders);

}  // namespace elastogen::selector
