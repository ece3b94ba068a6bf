#include "symgen/law/characters.h"

#include <fmt/format.h>

#include <utility>

namespace elastogen::symgen {

std::string character_at(const std::string& text, std::size_t begin) {
  const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(text[i]); };
  const unsigned char lead = byte(begin);
  const std::size_t size = lead < 0x80 ? 1 : lead >= 0xF0 ? 4 : lead >= 0xE0 ? 3 : 2;
  std::size_t end = begin + 1;
  while (end < text.size() && end < begin + size && (byte(end) & 0xC0U) == 0x80) ++end;
  const bool is_printable = lead >= 0xC2 ? end == begin + size : lead >= 0x20 && lead < 0x7F;
  return is_printable ? text.substr(begin, size) : fmt::format("\\x{:02x}", lead);
}

std::string in_ascii(const std::string& character) {
  using Spelling = std::pair<const char*, const char*>;
  static constexpr Spelling spellings[] = {
      {"α", "alpha"}, {"β", "beta"}, {"γ", "gamma"}, {"δ", "delta"}, {"ε", "epsilon"},
      {"ζ", "zeta"},  {"η", "eta"},  {"θ", "theta"}, {"κ", "kappa"}, {"λ", "lambda"},
      {"µ", "mu"},    {"μ", "mu"},   {"ν", "nu"},    {"ξ", "xi"},    {"ρ", "rho"},
      {"σ", "sigma"}, {"τ", "tau"},  {"φ", "phi"},   {"χ", "chi"},   {"ψ", "psi"},
      {"ω", "omega"}, {"²", "^2"},   {"³", "^3"},    {"√", "sqrt"},  {"·", "*"},
      {"×", "*"},     {"÷", "/"},    {"−", "-"},     {"–", "-"}};
  for (const auto& [letter, ascii] : spellings) {
    if (character == letter) return fmt::format("; write {} for it", ascii);
  }
  return "";
}

}  // namespace elastogen::symgen
