#include "selector/certify/certificate_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "runtime/error.h"

namespace elastogen::selector {
namespace {

using Json = nlohmann::ordered_json;

const char* precision_name(const Certificate& certificate) {
  return certificate.single_precision ? "float" : "double";
}

const char* group_name(bool well_posed) { return well_posed ? "well_posed" : "conditioned"; }

/// Rows of `width` numbers; what JSON has no numbers for becomes text.
Json rows(const std::vector<double>& values, std::size_t width) {
  Json array = Json::array();
  for (std::size_t first = 0; first < values.size(); first += width) {
    Json row = Json::array();
    for (std::size_t k = first; k < first + width; ++k) row.push_back(values[k]);
    array.push_back(row);
  }
  return array;
}

Json case_json(const symgen::ElementCase& input, const Certificate& certificate) {
  const auto id = symgen::AssociationId::parse(certificate.association);
  const auto dim = static_cast<std::size_t>(symgen::find_element(id.element).dim);
  Json parameters = Json::object();
  for (std::size_t p = 0; p < input.parameters.size(); ++p) {
    parameters[certificate.parameter_names[p]] = input.parameters[p];
  }
  return {{"rest_positions", rows(input.rest_positions, dim)},
          {"parameters", parameters},
          {"displacement", rows(input.displacement, dim)},
          {"direction", rows(input.direction, dim)}};
}

/// The family in which an operation is worst.
const FamilyRecord& worst_family(const Certificate& certificate, std::size_t operation,
                                 bool well_posed) {
  const FamilyRecord* worst = nullptr;
  double largest = -1;
  for (const FamilyRecord& family : certificate.families) {
    if (family.well_posed != well_posed) continue;
    const ErrorRecord& errors = family.errors[operation];
    const double error = well_posed ? errors.worst : errors.relative;
    if (error > largest) {
      largest = error;
      worst = &family;
    }
  }
  return *worst;
}

Json family_json(const FamilyRecord& family) {
  Json entry = {{"family", family.family},
                {"well_posed", family.well_posed},
                {"cases", family.num_cases},
                {"flagged", family.flagged},
                {"violations", family.violations}};
  if (!family.first_violation.empty()) entry["first_violation"] = family.first_violation;
  for (std::size_t o = 0; o < num_operations; ++o) {
    const ErrorRecord& errors = family.errors[o];
    if (errors.num_errors == 0) continue;
    entry[operation_name(o)] = {{"worst", errors.worst},
                                {"median", errors.median},
                                {"condition", errors.condition},
                                {"relative", errors.relative}};
  }
  return entry;
}

std::string figure(double value) {
  if (!std::isfinite(value)) return "inf";
  return value < 99.95 ? fmt::format("{:.1f}", value) : fmt::format("{:.3g}", value);
}

int flagged_cases(const Certificate& certificate) {
  int sum = 0;
  for (const FamilyRecord& family : certificate.families) sum += family.flagged;
  return sum;
}

/// White where nothing is wrong, towards red at the bound.
std::string colour(double error, double bound) {
  const double share = std::clamp(std::log2(1 + error) / std::log2(1 + bound), 0.0, 1.0);
  const auto channel = [&](double at_bound) {
    return static_cast<int>(std::lround(255 + share * (at_bound - 255)));
  };
  return fmt::format("rgb({},{},{})", channel(250), channel(150), channel(110));
}

std::string html_text(const std::string& text) {
  std::string result;
  for (const char c : text) {
    result += c == '<' ? "&lt;" : c == '>' ? "&gt;" : c == '&' ? "&amp;" : std::string(1, c);
  }
  return result;
}

std::string certificate_html(const Certificate& certificate) {
  std::string text = fmt::format(
      "<details><summary><b>{}</b> {}: {}</summary>\n<table><tr><th>inputs</th><th>cases</th>"
      "<th>flagged</th>",
      html_text(certificate.association), precision_name(certificate),
      certificate.violations() == 0
          ? "no violation"
          : fmt::format("<span class=bad>{} violations</span>", certificate.violations()));
  for (std::size_t o = 0; o < num_operations; ++o) {
    text += fmt::format("<th>{}</th>", operation_name(o));
  }
  text += "<th>condition of forces</th></tr>\n";
  for (const FamilyRecord& family : certificate.families) {
    text += fmt::format("<tr><td>{}</td><td>{}</td><td>{}</td>", html_text(family.family),
                        family.num_cases, family.flagged);
    for (std::size_t o = 0; o < num_operations; ++o) {
      const ErrorRecord& errors = family.errors[o];
      if (errors.num_errors == 0) {
        text += "<td>–</td>";
        continue;
      }
      const double error = family.well_posed ? errors.worst : errors.relative;
      text += fmt::format(
          "<td style=\"background:{}\" title=\"worst {:.3g}, median {:.3g}, "
          "condition {:.3g}\">{}</td>",
          colour(error, error_bound(o, family.well_posed)), errors.worst, errors.median,
          errors.condition, figure(error));
    }
    text += fmt::format("<td>{:.1e}</td></tr>\n", family.errors[1].condition);
  }
  return text + "</table></details>\n";
}

/// The worst figure of each association and operation, a line each.
std::string overview_html(const std::vector<Certificate>& certificates) {
  std::string text =
      "<table><tr><th rowspan=2>association</th><th rowspan=2></th><th colspan=5>well-posed</th>"
      "<th colspan=5>conditioned</th><th rowspan=2>violations</th></tr>\n<tr>";
  for (int group = 0; group < 2; ++group) {
    for (std::size_t o = 0; o < num_operations; ++o) {
      text += fmt::format("<th>{}</th>", operation_name(o));
    }
  }
  text += "</tr>\n";
  for (const Certificate& certificate : certificates) {
    text += fmt::format("<tr><td>{}</td><td>{}</td>", html_text(certificate.association),
                        precision_name(certificate));
    for (const bool well_posed : {true, false}) {
      for (std::size_t o = 0; o < num_operations; ++o) {
        const double worst = certificate.worst(o, well_posed);
        text += fmt::format("<td style=\"background:{}\">{}</td>",
                            colour(worst, error_bound(o, well_posed)), figure(worst));
      }
    }
    text += fmt::format("<td>{}</td></tr>\n", certificate.violations());
  }
  return text + "</table>\n";
}

constexpr const char* explanation =
    "Compiled kernels on SIMD packs against the textbook form of the law in 60 decimal digits, "
    "on the same inputs rounded to the kernel's scalar. Errors are in units of the scalar's "
    "epsilon (2.2e-16, 1.2e-7): of the energy relative to |W|, of forces to the largest force, "
    "of the product to max |K| max |V|, of the stiffness to max |K|, of the first "
    "Piola-Kirchhoff stress P to max |P| over the points. Well-posed are "
    "well-shaped elements without rotation at strains from 1e-12 to 0.5: there errors are bounded "
    "by "
    "50 (the energy's by 200) as they are. Conditioned are all other inputs: rotations, "
    "translations, sizes from 1e-9 to 1e9 m, moduli from 1e-3 to 1e12 Pa, aspect ratios to 1e4, "
    "slivers, nu to 0.5 and -1, equal stretches, strains to 10, det F to 0 and below; there "
    "errors are given over 1 + the condition of the case, which is what a change of every nodal "
    "difference and parameter by one unit in its last place does to the exact result (the "
    "greatest of four trials), and bounded by 200. A result that is neither within its bound "
    "nor flagged by the element's status (not finite, outside the law's domain) is a violation. "
    "Errors below 1024 of the scalar's smallest normal numbers do not count.";

}  // namespace

Json certificates_json(const std::vector<Certificate>& certificates,
                       const CertifyOptions& options) {
  Json list = Json::array();
  for (const Certificate& certificate : certificates) {
    Json entry = {{"association", certificate.association},
                  {"precision", precision_name(certificate)},
                  {"violations", certificate.violations()}};
    for (const bool well_posed : {true, false}) {
      Json group = Json::object();
      for (std::size_t o = 0; o < num_operations; ++o) {
        const FamilyRecord& family = worst_family(certificate, o, well_posed);
        group[operation_name(o)] = {{"worst", certificate.worst(o, well_posed)},
                                    {"family", family.family}};
        if (family.errors[o].worst_case) {
          group[operation_name(o)]["input"] = case_json(*family.errors[o].worst_case, certificate);
        }
      }
      entry[group_name(well_posed)] = group;
    }
    Json families = Json::array();
    for (const FamilyRecord& family : certificate.families) families.push_back(family_json(family));
    entry["families"] = families;
    list.push_back(std::move(entry));
  }
  return {{"cases_per_family", options.cases}, {"seed", options.seed}, {"certificates", list}};
}

Json figures_alone(Json certificates) {
  for (Json& certificate : certificates["certificates"]) {
    certificate.erase("families");
    for (const bool well_posed : {true, false}) {
      for (auto& [operation, figures] : certificate[group_name(well_posed)].items()) {
        figures.erase("input");
      }
    }
  }
  return certificates;
}

std::string certificates_table(const std::vector<Certificate>& certificates) {
  std::string text = fmt::format("{:<32} {:<7}{:^50} {:^50}\n{:<40}", "", "", "well-posed",
                                 "over 1 + condition", "association, errors in epsilon");
  for (int group = 0; group < 2; ++group) {
    for (std::size_t o = 0; o < num_operations; ++o)
      text += fmt::format("{:>10}", operation_name(o));
  }
  text += fmt::format("{:>10}{:>11}\n", "flagged", "violations");
  for (const Certificate& certificate : certificates) {
    text += fmt::format("{:<32} {:<7}", certificate.association, precision_name(certificate));
    for (const bool well_posed : {true, false}) {
      for (std::size_t o = 0; o < num_operations; ++o) {
        text += fmt::format("{:>10}", figure(certificate.worst(o, well_posed)));
      }
    }
    text += fmt::format("{:>10}{:>11}\n", flagged_cases(certificate), certificate.violations());
  }
  return text;
}

std::string certificates_markdown(const std::vector<Certificate>& certificates,
                                  const CertifyOptions& options) {
  std::string text = fmt::format(
      "# How wrong kernels are\n\n{}\n\nMade by `elastogen certify --shipped --out docs` with {} "
      "cases of each kind of input, seed {}.\n",
      explanation, options.cases, options.seed);
  for (const bool single : {false, true}) {
    text += fmt::format(
        "\n## {}\n\n| association | well-posed: energy | forces | product | stiffness | stress | "
        "conditioned: energy | forces | product | stiffness | stress | violations |\n| --- | --- | "
        "--- | --- | --- | --- | --- | --- | --- | --- | --- | --- |\n",
        single ? "Float" : "Double");
    for (const Certificate& certificate : certificates) {
      if (certificate.single_precision != single) continue;
      text += "| " + certificate.association;
      for (const bool well_posed : {true, false}) {
        for (std::size_t o = 0; o < num_operations; ++o) {
          text += " | " + figure(certificate.worst(o, well_posed));
        }
      }
      text += fmt::format(" | {} |\n", certificate.violations());
    }
  }
  return text;
}

std::string certificates_html(const std::vector<Certificate>& certificates,
                              const CertifyOptions& options) {
  std::string text = fmt::format(
      "<!doctype html><html lang=en><meta charset=utf-8><title>How wrong kernels are</title>\n"
      "<style>body{{font:15px sans-serif;max-width:66em;margin:2em auto;padding:0 1em}}"
      "td,th{{padding:2px "
      "9px;text-align:right}}td:first-child,th:first-child{{text-align:left;white-space:nowrap}}"
      "table{{border-collapse:collapse;margin:.5em 0 1.5em}}td{{border:1px solid #ddd}}"
      "summary{{cursor:pointer;padding:3px 0}}.bad{{color:#b00;font-weight:bold}}</style>\n"
      "<h1>How wrong kernels are</h1><p>{}</p><p>{} cases of each kind, seed {}. Below the "
      "overview each association unfolds by kind of input; a figure under the mouse shows its "
      "median and condition.</p>\n{}",
      html_text(explanation), options.cases, options.seed, overview_html(certificates));
  for (const Certificate& certificate : certificates) text += certificate_html(certificate);
  return text + "</html>\n";
}

std::vector<std::string> worse_than(const nlohmann::json& baseline,
                                    const std::string& baseline_name,
                                    const std::vector<Certificate>& certificates, double slack) {
  constexpr double smallest = 4;
  std::vector<std::string> worse;
  try {
    for (const Certificate& certificate : certificates) {
      const auto& list = baseline.at("certificates");
      const auto found = std::find_if(list.begin(), list.end(), [&](const nlohmann::json& entry) {
        return entry.at("association") == certificate.association &&
               entry.at("precision") == precision_name(certificate);
      });
      const std::string name =
          fmt::format("{} in {}", certificate.association, precision_name(certificate));
      if (found == list.end()) {
        throw InputError(fmt::format("{} holds nothing about {}", baseline_name, name));
      }
      if (certificate.violations() > found->at("violations").get<int>()) {
        worse.push_back(fmt::format("{}: {} violations, were {}", name, certificate.violations(),
                                    found->at("violations").get<int>()));
      }
      for (const bool well_posed : {true, false}) {
        for (std::size_t o = 0; o < num_operations; ++o) {
          const nlohmann::json& figures = found->at(group_name(well_posed));
          if (!figures.contains(operation_name(o))) continue;
          const double before = figures.at(operation_name(o)).at("worst");
          const double now = certificate.worst(o, well_posed);
          if (now <= slack * std::max(before, smallest)) continue;
          worse.push_back(fmt::format("{}: {} ({}) is off by {} epsilon, was {}", name,
                                      operation_name(o), well_posed ? "well-posed" : "conditioned",
                                      figure(now), figure(before)));
        }
      }
    }
  } catch (const nlohmann::json::exception& error) {
    throw InputError(fmt::format("{} is no certificate file: {}", baseline_name, error.what()));
  }
  return worse;
}

}  // namespace elastogen::selector
