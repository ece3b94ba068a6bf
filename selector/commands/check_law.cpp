#include "selector/commands/check_law.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <memory>
#include <nlohmann/json.hpp>

#include "symgen/law/check_law.h"
#include "symgen/law/expression_text.h"
#include "symgen/law/names.h"

namespace elastogen::selector {
namespace fs = std::filesystem;
namespace {

using Json = nlohmann::ordered_json;
using symgen::expression_text;

struct CheckLawOptions {
  std::string law;
  bool json = false;
};

/// A file, or a law's name.
fs::path law_file(const std::string& given, const Context& context) {
  std::error_code error;
  if (fs::exists(given, error) || !symgen::is_identifier(given)) return given;
  return symgen::find_law_file(given, context.law_folders());
}

/// "(a + b)*" before a tensor; nothing for 1.
std::string factor_text(const GiNaC::ex& coefficient) {
  if (coefficient.is_equal(1)) return "";
  const std::string text = expression_text(coefficient);
  return (GiNaC::is_a<GiNaC::add>(coefficient) ? "(" + text + ")" : text) + "*";
}

void append(std::string& sum, const std::string& summand) {
  const bool is_negative = summand.starts_with('-');
  if (sum.empty()) {
    sum = summand;
  } else {
    sum += (is_negative ? " - " : " + ") + summand.substr(is_negative ? 1 : 0);
  }
}

/// S, or sigma.
std::string stress_text(const symgen::StressForm& form, bool small_strain) {
  std::string text;
  for (std::size_t u = 0; u < symgen::num_stress_tensors; ++u) {
    const symgen::StressTensor& tensor = symgen::stress_tensors()[u];
    if (tensor.small_strain != small_strain || form.stress[u].is_zero()) continue;
    append(text, factor_text(form.stress[u]) + tensor.name);
  }
  return text;
}

/// dS, or d sigma, for a change dE of the strain.
std::string tangent_text(const symgen::StressForm& form, bool small_strain) {
  const auto change = [](const symgen::StressTensor& tensor) {
    return tensor.small_strain ? "deps" : "dE";
  };
  std::string text;
  for (std::size_t u = 0; u < symgen::num_stress_tensors; ++u) {
    const symgen::StressTensor& tensor = symgen::stress_tensors()[u];
    if (tensor.small_strain != small_strain) continue;
    for (std::size_t v = 0; v < symgen::num_stress_tensors; ++v) {
      if (form.tangent[u][v].is_zero()) continue;
      const symgen::StressTensor& other = symgen::stress_tensors()[v];
      const std::string scalar = other.name == "I"
                                     ? fmt::format("tr({})", change(other))
                                     : fmt::format("({}:{})", other.name, change(other));
      append(text, factor_text(form.tangent[u][v]) + scalar + "*" + tensor.name);
    }
    const GiNaC::ex& coefficient = form.stress[u];
    if (coefficient.is_zero() || tensor.name == "I") continue;
    if (tensor.name == "C^-1") {
      append(text, factor_text((-2 * coefficient).expand()) + "C^-1*dE*C^-1");
    } else {
      append(text, factor_text(tensor.name == "C" ? (2 * coefficient).expand() : coefficient) +
                       change(tensor));
    }
  }
  return text;
}

struct Formula {
  std::string name, text;
};

std::vector<Formula> formulas(const symgen::StressForm& form) {
  std::vector<Formula> all;
  const std::string s = stress_text(form, false), sigma = stress_text(form, true);
  all.push_back({"P", s.empty() ? "sigma" : sigma.empty() ? "F*S" : "F*S + sigma"});
  if (!s.empty()) all.push_back({"S", s});
  if (!sigma.empty()) all.push_back({"sigma", sigma});
  if (!s.empty()) all.push_back({"dS", tangent_text(form, false)});
  if (!sigma.empty()) all.push_back({"dsigma", tangent_text(form, true)});
  return all;
}

/// Moduli at rest, as far as the tangent is finite there.
std::vector<Formula> moduli(const symgen::LawCheck& check) {
  if (check.rest_tangent.empty()) return {};
  const GiNaC::ex &lambda = check.moduli.lambda, &mu = check.moduli.mu;
  std::vector<Formula> all = {{"lambda", expression_text(lambda)},
                              {"mu", expression_text(mu)},
                              {"bulk", expression_text((lambda + 2 * mu / 3).normal())}};
  if (!(lambda + mu).normal().is_zero()) {
    all.push_back(
        {"young", expression_text((mu * (3 * lambda + 2 * mu) / (lambda + mu)).normal())});
    all.push_back({"poisson", expression_text((lambda / (2 * (lambda + mu))).normal())});
  }
  return all;
}

/// A parameter's unit as the file has it, and as it is usually written.
std::string unit_name(const symgen::Parameter& parameter) {
  const std::string usual = symgen::unit_text(parameter.unit);
  return usual == parameter.unit_name ? usual : fmt::format("{} = {}", parameter.unit_name, usual);
}

Json check_json(const symgen::Law& law, const symgen::LawCheck& check) {
  Json properties = Json::array(), stress = Json::object(), rest = Json::object();
  Json parameters = Json::array(), terms = Json::array();
  for (const symgen::Parameter& parameter : law.parameters) {
    parameters.push_back({{"name", parameter.name}, {"unit", symgen::unit_text(parameter.unit)}});
  }
  for (const symgen::LawTerm& term : law.terms) {
    terms.push_back({{"name", term.name}, {"unit", symgen::energy_unit}, {"energy", term.text}});
  }
  for (const symgen::LawProperty& property : check.properties) {
    properties.push_back({{"name", property.name},
                          {"term", property.term.empty() ? Json(nullptr) : Json(property.term)},
                          {"how", symgen::evidence_name(property.evidence)},
                          {"holds", property.holds},
                          {"detail", property.detail}});
  }
  for (const Formula& formula : formulas(check.stress)) stress[formula.name] = formula.text;
  for (const Formula& formula : moduli(check)) rest[formula.name] = formula.text;
  Json tangent = Json::array();
  for (const std::vector<GiNaC::ex>& row : check.rest_tangent) {
    Json texts = Json::array();
    for (const GiNaC::ex& entry : row) texts.push_back(expression_text(entry));
    tangent.push_back(texts);
  }
  Json digits = Json::array();
  for (const symgen::SmallStrainDigits& entry : check.digits) {
    digits.push_back({{"term", entry.term},
                      {"stabilised", entry.stabilised},
                      {"strains", symgen::digit_strains()},
                      {"digits", entry.digits}});
  }
  return {{"law", law.name},          {"file", law.file},       {"holds", check.holds()},
          {"parameters", parameters}, {"terms", terms},         {"properties", properties},
          {"stress", stress},         {"moduli_at_rest", rest}, {"tangent_at_rest", tangent},
          {"digits", digits},         {"notes", check.notes}};
}

/// The 6 x 6 tangent with its distinct entries named.
void print_rest_tangent(const std::vector<std::vector<GiNaC::ex>>& tangent) {
  std::vector<std::string> distinct;
  fmt::print("\ntangent at rest, xx yy zz yz xz xy (shear strains doubled):\n");
  for (const std::vector<GiNaC::ex>& row : tangent) {
    fmt::print(" ");
    for (const GiNaC::ex& entry : row) {
      const std::string text = expression_text(entry);
      const auto known = std::find(distinct.begin(), distinct.end(), text);
      if (text != "0" && known == distinct.end()) distinct.push_back(text);
      const std::size_t index = static_cast<std::size_t>(
          std::find(distinct.begin(), distinct.end(), text) - distinct.begin());
      fmt::print(" {}", text == "0" ? '.' : static_cast<char>('a' + index));
    }
    fmt::print("\n");
  }
  for (std::size_t k = 0; k < distinct.size(); ++k) {
    fmt::print("  {} = {}\n", static_cast<char>('a' + k), distinct[k]);
  }
}

void print_check(const symgen::Law& law, const symgen::LawCheck& check) {
  fmt::print("{} ({})\n", law.title.empty() ? law.name : law.title, law.file);
  for (const symgen::Parameter& parameter : law.parameters) {
    fmt::print("  parameter {} [{}]{}\n", parameter.name, unit_name(parameter),
               parameter.description.empty() ? "" : ": " + parameter.description);
  }
  for (const symgen::LawTerm& term : law.terms) {
    fmt::print("  term {} [{}]: {}\n", term.name, symgen::energy_unit, term.text);
  }
  fmt::print("\nstress, F = I + H, C = F^T*F, E = (C - I)/2:\n");
  for (const Formula& formula : formulas(check.stress)) {
    fmt::print("  {} = {}\n", formula.name, formula.text);
  }
  if (!check.rest_tangent.empty()) {
    print_rest_tangent(check.rest_tangent);
    fmt::print("\nmoduli at rest:\n");
    for (const Formula& formula : moduli(check)) {
      fmt::print("  {} = {}\n", formula.name, formula.text);
    }
  }
  if (!check.digits.empty()) {
    fmt::print("\nright digits of the stress in double precision, at strains of\n  {:<20}", "");
    for (const double strain : symgen::digit_strains()) fmt::print("{:>8}", strain);
    fmt::print("\n");
    for (const symgen::SmallStrainDigits& entry : check.digits) {
      fmt::print("  {:<20}", entry.term);
      for (const int count : entry.digits) fmt::print("{:>8}", count);
      fmt::print("\n");
    }
  }
  fmt::print("\n");
  for (const symgen::LawProperty& property : check.properties) {
    fmt::print("{:<6} {:<26} {:<9} {}{}\n", property.holds ? "holds" : "FAILS", property.name,
               symgen::evidence_name(property.evidence),
               property.term.empty() ? "" : fmt::format("term {}", property.term),
               property.detail.empty()
                   ? std::string()
                   : fmt::format("{}{}", property.term.empty() ? "" : ": ", property.detail));
  }
  for (const std::string& note : check.notes) fmt::print("note: {}\n", note);
}

/// "own.toml:8: term 'shear'", or the file alone for what is of the whole law.
std::string place_of(const symgen::Law& law, const std::string& name) {
  const auto term = std::find_if(law.terms.begin(), law.terms.end(),
                                 [&](const symgen::LawTerm& t) { return t.name == name; });
  return term == law.terms.end() ? law.file
                                 : fmt::format("{}:{}: term '{}'", law.file, term->line, name);
}

int run_check_law(const CheckLawOptions& options, const Context& context) {
  const symgen::Law law = symgen::parse_law(law_file(options.law, context));
  const symgen::LawCheck check = symgen::check_law(law);
  if (options.json) {
    fmt::print("{}\n", check_json(law, check).dump(2));
  } else {
    print_check(law, check);
  }
  std::fflush(stdout);  // before what follows on standard error
  for (const symgen::LawProperty& property : check.properties) {
    if (property.holds) continue;
    fmt::print(stderr, "error: {}: '{}' fails: {}\n", place_of(law, property.term), property.name,
               property.detail);
  }
  return check.holds() ? 0 : 1;
}

}  // namespace

void add_check_law_command(CLI::App& app, Context& context) {
  const auto options = std::make_shared<CheckLawOptions>();
  CLI::App* command = app.add_subcommand("check-law", "What a law has, proved or measured");
  command->footer(
      "Of each term: zero energy and no stress at rest, and that rotations leave it as it is. Of\n"
      "the law: stress and tangent derived in two ways that must agree (in 3D and in plane\n"
      "strain), a symmetric tangent, positive definite at rest for all admissible parameters,\n"
      "and the moduli that the file declares. Prints units, stress and tangent as formulas, the\n"
      "moduli at rest, and how many digits small strains leave.\n"
      "Exit status: 0 all hold, 1 a property fails and is named, 2 the file cannot be read as a "
      "law.\n"
      "Examples:\n"
      "  elastogen check-law my_law.toml\n"
      "  elastogen check-law stvk --json");
  command->add_option("FILE", options->law, "Law file, or the name of a law")->required();
  command->add_flag("--json", options->json, "For programs");
  command->callback([options, &context] {
    context.action = [options, &context] { return run_check_law(*options, context); };
  });
}

}  // namespace elastogen::selector
