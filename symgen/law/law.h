// Constitutive laws from files: a strain-energy density as a sum of named terms.
#pragma once

#include <ginac/ginac.h>

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "symgen/law/parameters.h"

namespace elastogen::symgen {

/// What every term's energy must come out in: energy per rest volume.
inline constexpr const char* energy_unit = "J/m^3";

/// One term of the energy, stress-free at rest by itself.
struct LawTerm {
  std::string name;      ///< an identifier
  std::string text;      ///< as written in the file
  int line = 0;          ///< of the energy in the file
  GiNaC::ex expression;  ///< over parameters' symbols and the invariants' symbols (invariants.h)
};

/// Lame parameters at rest as the file declares them, over the parameters' symbols [Pa].
struct DeclaredModuli {
  GiNaC::ex lambda, mu;
};

struct Law {
  std::string name;  ///< "stvk": the id, and the file's stem
  std::string title;
  std::string source;  ///< book or paper, and equation
  std::string file;    ///< as opened
  /// Canonical text of everything that the kernels depend on: the law's, parameters' and terms'
  /// names in order and the energies without spaces. To be hashed: titles, comments, units,
  /// descriptions and ranges may change without the kernels being made anew.
  std::string text;
  std::vector<Parameter> parameters;
  std::vector<LawTerm> terms;
  /// The file says that the law is for small displacements only: not objective, and meant so.
  bool small_strain = false;
  std::optional<DeclaredModuli> moduli;
  bool polynomial = false;  ///< the energy is a polynomial in the displacement gradient (proved)
};

/// Reads a law file (TOML, docs/laws.md): everything but what is proved of a law.
/// @throws InputError  with file, line, what was found and what is allowed
[[nodiscard]] Law parse_law(const std::filesystem::path& file);

/// As `parse_law`; every term is proved to have zero energy and zero stress at rest.
/// @throws InputError  with file, line, what was found and what is allowed
[[nodiscard]] Law read_law(const std::filesystem::path& file);

/// The file of a law: takes a name ("stvk") and the folders to look in, in order, and returns the
/// first `FOLDER/NAME.toml` that exists.
/// @throws InputError  when there is none; names the known laws, the nearest, and the folders
[[nodiscard]] std::filesystem::path find_law_file(
    const std::string& name, const std::vector<std::filesystem::path>& folders);

/// Names of all laws found in the folders, sorted; a name in two folders counts once.
[[nodiscard]] std::vector<std::string> law_names(const std::vector<std::filesystem::path>& folders);

}  // namespace elastogen::symgen
