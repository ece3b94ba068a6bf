// Content hash for cache keys and manifests.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace elastogen::symgen {

/// 32 hexadecimal digits: 128-bit FNV-1a of the parts, each preceded by its length, so that
/// {"ab", "c"} and {"a", "bc"} differ. Names content; it is no defence against forgery.
/// Source: Fowler, Noll, Vo, The FNV non-cryptographic hash algorithm (IETF draft), 128-bit values.
[[nodiscard]] std::string content_hash(const std::vector<std::string_view>& parts);

}  // namespace elastogen::symgen
