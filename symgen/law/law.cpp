#include "symgen/law/law.h"

#include <fmt/format.h>
#include <toml++/toml.h>

#include <algorithm>
#include <fstream>
#include <set>
#include <sstream>

#include "runtime/error.h"
#include "symgen/law/expression.h"
#include "symgen/law/generable.h"
#include "symgen/law/names.h"
#include "symgen/law/rest_state.h"
#include "symgen/law/toml_fields.h"
#include "symgen/law/units.h"
#include "symgen/mechanics/invariants.h"

namespace elastogen::symgen {
namespace {

std::string read_text(const std::filesystem::path& file) {
  std::error_code error;
  if (!std::filesystem::is_regular_file(file, error)) {
    throw InputError(fmt::format("law file '{}' does not exist or is no file", file.string()));
  }
  std::ifstream stream(file, std::ios::binary);
  std::ostringstream text;
  text << stream.rdbuf();
  if (!stream) throw InputError(fmt::format("law file '{}' cannot be read", file.string()));
  return text.str();
}

toml::table parse_toml(const std::string& file, const std::string& text) {
  try {
    return toml::parse(text, std::string_view(file));
  } catch (const toml::parse_error& error) {
    fail_at_line(file, error.source(),
                 fmt::format("not valid TOML: {}", std::string(error.description())));
  }
}

/// Calls `parse`, and gives what it complains of the place of `key`.
template <class Parse>
auto at_key(const TomlFields& fields, const std::string& key, const Parse& parse) {
  try {
    return parse();
  } catch (const InputError& error) {
    fields.fail(key, fmt::format("{}: {}", key, error.what()));
  }
}

template <class Named>
std::vector<std::string> names_of(const std::vector<Named>& all) {
  std::vector<std::string> names;
  for (const Named& one : all) names.push_back(one.name);
  return names;
}

std::string read_identifier(const TomlFields& fields, const std::vector<std::string>& taken) {
  const std::string name = fields.required_text("name");
  if (!is_identifier(name)) {
    fields.fail("name", fmt::format("name '{}' is no identifier: use a letter, then "
                                    "letters, digits and '_'",
                                    name));
  }
  if (std::ranges::count(taken, name) > 0) {
    fields.fail("name", fmt::format("name '{}' is taken twice; names must differ", name));
  }
  return name;
}

/// "parameter 'mu'", or "parameter 2" as long as its name is not known to be one.
std::string describe(const std::string& kind, const toml::table& table, std::size_t index) {
  const std::optional<std::string> name = table["name"].value<std::string>();
  return name ? fmt::format("{} '{}'", kind, *name) : fmt::format("{} {}", kind, index + 1);
}

/// An expression at a key, in a unit.
GiNaC::ex read_expression(const TomlFields& fields, const std::string& key,
                          const SymbolGroup& symbols, const std::vector<Quantity>& quantities,
                          const std::string& unit) {
  const std::string text = fields.required_text(key);
  return at_key(fields, key, [&] {
    const GiNaC::ex expression = parse_expression(text, {symbols});
    check_unit(expression, quantities, unit);
    return expression;
  });
}

std::vector<Quantity> quantities_of(const std::vector<Parameter>& parameters) {
  std::vector<Quantity> quantities;
  for (const Parameter& parameter : parameters) {
    quantities.push_back({parameter.symbol, parameter.unit});
  }
  return quantities;
}

GiNaC::ex read_young_poisson_formula(const TomlFields& fields, const Parameter& parameter) {
  const SymbolGroup symbols{"constants",
                            {{"young", young_modulus()}, {"poisson", poisson_ratio()}}};
  return read_expression(fields, "from_young_poisson", symbols,
                         {{young_modulus(), parse_unit("Pa")}}, parameter.unit_name);
}

void read_range(const TomlFields& fields, Parameter& parameter) {
  parameter.minimum = fields.optional_number("minimum");
  parameter.maximum = fields.optional_number("maximum");
  parameter.minimum_exclusive = fields.optional_flag("minimum_exclusive");
  parameter.maximum_exclusive = fields.optional_flag("maximum_exclusive");
  for (const auto& [bound, is_exclusive, key] :
       {std::tuple{parameter.minimum, parameter.minimum_exclusive, "minimum"},
        std::tuple{parameter.maximum, parameter.maximum_exclusive, "maximum"}}) {
    if (is_exclusive && !bound) {
      fields.fail(
          fmt::format("{}_exclusive", key),
          fmt::format("'{0}_exclusive' without '{0}'; give the bound or leave both out", key));
    }
  }
  if (!parameter.minimum || !parameter.maximum) return;
  const bool has_exclusive_bound = parameter.minimum_exclusive || parameter.maximum_exclusive;
  if (*parameter.minimum > *parameter.maximum ||
      (*parameter.minimum == *parameter.maximum && has_exclusive_bound)) {
    fields.fail("maximum", "no value lies between 'minimum' and 'maximum'; mend one of them");
  }
}

Parameter read_parameter(const std::string& file, const toml::table& table, std::size_t index,
                         const std::vector<Parameter>& before) {
  const TomlFields fields(file, table, describe("parameter", table, index),
                          {"name", "unit", "description", "minimum", "maximum", "minimum_exclusive",
                           "maximum_exclusive", "from_young_poisson"});
  Parameter parameter;
  parameter.name = read_identifier(fields, names_of(before));
  for (const std::vector<std::string>& reserved : {invariant_names(), reserved_names()}) {
    if (std::ranges::count(reserved, parameter.name) > 0) {
      fields.fail("name", fmt::format("name '{}' means something else in expressions; no parameter "
                                      "can be called {} or {}",
                                      parameter.name, join_names(invariant_names()),
                                      join_names(reserved_names())));
    }
  }
  parameter.symbol = GiNaC::symbol(parameter.name);
  parameter.unit_name = fields.required_text("unit");
  parameter.unit = at_key(fields, "unit", [&] { return parse_unit(parameter.unit_name); });
  parameter.description = fields.optional_text("description");
  read_range(fields, parameter);
  parameter.from_young_poisson = fields.optional_text("from_young_poisson");
  if (!parameter.from_young_poisson.empty()) {
    parameter.young_poisson_formula = read_young_poisson_formula(fields, parameter);
  }
  return parameter;
}

LawTerm read_term(const std::string& file, const toml::table& table, std::size_t index,
                  const std::vector<LawTerm>& before, const std::vector<SymbolGroup>& symbols,
                  const std::vector<Quantity>& quantities) {
  const TomlFields fields(file, table, describe("term", table, index), {"name", "energy"});
  LawTerm term;
  term.name = read_identifier(fields, names_of(before));
  term.text = fields.required_text("energy");
  term.expression = at_key(fields, "energy", [&] {
    const GiNaC::ex energy = parse_expression(term.text, symbols);
    check_generable(energy);
    check_unit(energy, quantities, energy_unit);
    return energy;
  });
  if (term.expression.normal().is_zero()) {
    fields.fail("energy", "the energy is zero for every deformation; remove the term");
  }
  const toml::node* energy = table.get("energy");
  term.line = static_cast<int>(energy->source().begin.line);
  return term;
}

/// [moduli], if the file has it.
std::optional<DeclaredModuli> read_moduli(const TomlFields& law_fields, const std::string& file,
                                          const toml::table& root, const SymbolGroup& parameters,
                                          const std::vector<Quantity>& quantities) {
  const toml::node* node = root.get("moduli");
  if (node == nullptr) return std::nullopt;
  if (!node->is_table()) {
    law_fields.fail("moduli", "'moduli' must be written as a table [moduli] with lambda and mu");
  }
  const TomlFields fields(file, *node->as_table(), "moduli", {"lambda", "mu"});
  const auto modulus = [&](const std::string& key) {
    return read_expression(fields, key, parameters, quantities, "Pa");
  };
  return DeclaredModuli{modulus("lambda"), modulus("mu")};
}

/// Each term must vanish at rest with its first derivative, by itself: a sum of terms may be split.
void check_rest_state(const Law& law) {
  for (const LawTerm& term : law.terms) {
    const RestState rest = rest_state(term.expression);
    for (const std::string& fault : {energy_fault(rest), stress_fault(rest)}) {
      if (fault.empty()) continue;
      throw InputError(fmt::format("{}:{}: term '{}': {}", law.file, term.line, term.name, fault));
    }
  }
}

void check_all_parameters_used(const std::string& file, const Law& law,
                               const std::vector<const toml::table*>& tables) {
  for (std::size_t i = 0; i < law.parameters.size(); ++i) {
    const Parameter& parameter = law.parameters[i];
    if (std::none_of(law.terms.begin(), law.terms.end(),
                     [&](const LawTerm& term) { return term.expression.has(parameter.symbol); })) {
      fail_at_line(
          file, tables[i]->source(),
          fmt::format("parameter '{}' is used by no term; use it or remove it", parameter.name));
    }
  }
}

/// Names and energies, without spaces; nothing else reaches the kernels.
std::string canonical_text(const Law& law) {
  std::string text = fmt::format("law {}\n", law.name);
  for (const Parameter& parameter : law.parameters) {
    text += fmt::format("parameter {}\n", parameter.name);
  }
  for (const LawTerm& term : law.terms) {
    text += fmt::format("term {} = {}\n", term.name, without_spaces(term.text));
  }
  return text;
}

}  // namespace

Law parse_law(const std::filesystem::path& path) {
  const std::string file = path.string();
  const toml::table root = parse_toml(file, read_text(path));
  const TomlFields fields(
      file, root, "law",
      {"name", "title", "source", "small_strain", "moduli", "parameter", "term"});
  Law law;
  law.file = file;
  law.name = read_identifier(fields, {});
  if (law.name != path.stem().string()) {
    fields.fail("name", fmt::format("name '{}' differs from the file's, '{}'; give both the same",
                                    law.name, path.stem().string()));
  }
  law.title = fields.optional_text("title");
  law.source = fields.optional_text("source");
  law.small_strain = fields.optional_flag("small_strain");

  const std::vector<const toml::table*> parameter_tables = fields.required_tables("parameter");
  SymbolGroup parameter_symbols{"parameters", {}};
  for (std::size_t i = 0; i < parameter_tables.size(); ++i) {
    law.parameters.push_back(read_parameter(file, *parameter_tables[i], i, law.parameters));
    parameter_symbols.symbols.emplace_back(law.parameters[i].name, law.parameters[i].symbol);
  }
  const std::vector<Quantity> quantities = quantities_of(law.parameters);
  law.moduli = read_moduli(fields, file, root, parameter_symbols, quantities);
  SymbolGroup invariant_symbols{"invariants", {}};
  for (const Invariant& invariant : invariants()) {
    invariant_symbols.symbols.emplace_back(invariant.name, invariant.symbol);
  }
  const std::vector<const toml::table*> term_tables = fields.required_tables("term");
  for (std::size_t i = 0; i < term_tables.size(); ++i) {
    law.terms.push_back(read_term(file, *term_tables[i], i, law.terms,
                                  {parameter_symbols, invariant_symbols}, quantities));
  }
  check_all_parameters_used(file, law, parameter_tables);
  law.polynomial = std::all_of(law.terms.begin(), law.terms.end(), [](const LawTerm& term) {
    return is_polynomial_in_gradient(term.expression);
  });
  law.text = canonical_text(law);
  return law;
}

Law read_law(const std::filesystem::path& file) {
  Law law = parse_law(file);
  check_rest_state(law);
  return law;
}

std::filesystem::path find_law_file(const std::string& name,
                                    const std::vector<std::filesystem::path>& folders) {
  std::vector<std::string> searched;
  for (const std::filesystem::path& folder : folders) {
    const std::filesystem::path file = folder / (name + ".toml");
    std::error_code error;
    // A name with a separator would leave the folder.
    if (is_identifier(name) && std::filesystem::is_regular_file(file, error)) return file;
    searched.push_back(folder.string());
  }
  const std::vector<std::string> known = law_names(folders);
  throw InputError(fmt::format("unknown law '{}'{}; laws are {} (files NAME.toml in {})", name,
                               suggestion(name, known), join_names(known), join_names(searched)));
}

std::vector<std::string> law_names(const std::vector<std::filesystem::path>& folders) {
  std::set<std::string> names;
  for (const std::filesystem::path& folder : folders) {
    std::error_code error;
    for (const auto& entry : std::filesystem::directory_iterator(folder, error)) {
      if (entry.path().extension() == ".toml") names.insert(entry.path().stem().string());
    }
  }
  return {names.begin(), names.end()};
}

}  // namespace elastogen::symgen
