#include "selector/commands/explain_thesis.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <nlohmann/json.hpp>

#include "symgen/element/element.h"
#include "symgen/thesis_report.h"

namespace elastogen::selector {
namespace {

using Json = nlohmann::ordered_json;

Json report_json(const symgen::AssociationId& id, const symgen::ThesisReport& report) {
  Json variants = Json::array();
  for (const symgen::ThesisVariant& variant : report.variants) {
    Json fragments = Json::array();
    for (const symgen::ThesisFragment& fragment : variant.fragments) {
      fragments.push_back(
          {{"term", fragment.term}, {"point", fragment.point}, {"constants", fragment.constants}});
    }
    variants.push_back({{"geometry", variant.geometry},
                        {"constants", variant.constants},
                        {"fragments", fragments}});
  }
  Json json = {{"association", id.text()}, {"formulation", "thesis"}, {"variants", variants}};
  if (report.expanded) {
    json["expanded"] = {{"monomials", report.expanded->monomials},
                        {"energy_flops", report.expanded->energy_flops},
                        {"forces_flops", report.expanded->forces_flops},
                        {"product_flops", report.expanded->product_flops}};
  }
  if (report.printed) {
    json["thesis"] = {{"geometry", report.printed->geometry},
                      {"constants", report.printed->constants},
                      {"fragments", report.printed->fragments}};
  }
  return json;
}

void print_report(const symgen::AssociationId& id, const symgen::Law& law,
                  const symgen::ThesisReport& report) {
  fmt::print("{}, formulated as in the thesis of X. Faure (2014)\n", id.text());
  fmt::print(
      "grouped constants that algorithm 6 finds in the energy; per quadrature point with all "
      "splits\n");
  for (const symgen::ThesisVariant& variant : report.variants) {
    fmt::print("\ngeometry {}: {} unsplit\n", variant.geometry, variant.constants);
    for (const symgen::LawTerm& term : law.terms) {
      std::vector<int> counts;
      for (const symgen::ThesisFragment& fragment : variant.fragments) {
        if (fragment.term == term.name) counts.push_back(fragment.constants);
      }
      fmt::print("  term {}: {}\n", term.name, fmt::join(counts, " "));
    }
    if (report.printed && report.printed->geometry == variant.geometry) {
      fmt::print("  the thesis prints {} unsplit, {} in the fragments of all splits\n",
                 report.printed->constants, fmt::join(report.printed->fragments, " "));
    }
  }
  if (report.expanded) {
    fmt::print(
        "\nwritten out in nodal displacements: {} monomials; flops of energy {}, forces {}, "
        "product {}\n",
        report.expanded->monomials, report.expanded->energy_flops, report.expanded->forces_flops,
        report.expanded->product_flops);
  }
}

}  // namespace

int explain_thesis(const symgen::AssociationId& id, const symgen::Law& law, bool json,
                   const Context& context) {
  if (symgen::find_element(id.element).affine && law.polynomial) {
    context.tell("writing out every monomial; a tetrahedron may take half a minute");
  }
  const symgen::ThesisReport report = symgen::thesis_report(id, law);
  if (json) {
    fmt::print("{}\n", report_json(id, report).dump(2));
  } else {
    print_report(id, law, report);
  }
  return 0;
}

}  // namespace elastogen::selector
