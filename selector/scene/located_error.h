// Adds the place in a scene file to errors of parts that know nothing of scene files.
#pragma once

#include <fmt/format.h>

#include <string>
#include <utility>

#include "runtime/error.h"

namespace elastogen::selector {

/// Calls `work` and puts "scene.toml:14: mesh.block[2]: " before the message of an InputError.
template <class Work>
decltype(auto) with_location(const std::string& where, const std::string& object, Work&& work) {
  try {
    return std::forward<Work>(work)();
  } catch (const InputError& error) {
    throw InputError(fmt::format("{}: {}: {}", where, object, error.what()));
  }
}

}  // namespace elastogen::selector
