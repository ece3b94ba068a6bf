// The generator's version; a change of what it emits for the same input needs a new one.
#pragma once

namespace elastogen::symgen {

inline constexpr const char* generator_version = "0.1.0";

}  // namespace elastogen::symgen
