#include "symgen/emit/content_hash.h"

#include <fmt/format.h>

#include <cstdint>

namespace elastogen::symgen {
namespace {

__extension__ using Uint128 = unsigned __int128;

constexpr Uint128 offset_basis = (Uint128{0x6c62272e07bb0142} << 64) | 0x62b821756295c58d;
constexpr Uint128 prime = (Uint128{0x0000000001000000} << 64) | 0x000000000000013b;

void add_byte(Uint128& hash, unsigned char byte) { hash = (hash ^ byte) * prime; }

}  // namespace

std::string content_hash(const std::vector<std::string_view>& parts) {
  Uint128 hash = offset_basis;
  for (const std::string_view part : parts) {
    for (std::uint64_t length = part.size(), i = 0; i < 8; ++i, length >>= 8) {
      add_byte(hash, static_cast<unsigned char>(length & 0xff));
    }
    for (const char c : part) add_byte(hash, static_cast<unsigned char>(c));
  }
  return fmt::format("{:016x}{:016x}", static_cast<std::uint64_t>(hash >> 64),
                     static_cast<std::uint64_t>(hash));
}

}  // namespace elastogen::symgen
