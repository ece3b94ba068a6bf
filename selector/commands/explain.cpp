#include "selector/commands/explain.h"

#include <fmt/format.h>

#include <memory>
#include <nlohmann/json.hpp>

#include "runtime/error.h"
#include "selector/commands/exact_text.h"
#include "selector/commands/explain_thesis.h"
#include "selector/support/files.h"
#include "symgen/element/element.h"
#include "symgen/law/expression_text.h"
#include "symgen/quadrature/quadrature.h"

namespace elastogen::selector {
namespace {

using Json = nlohmann::ordered_json;

constexpr int decimal_digits = 40;

struct ExplainOptions {
  std::string association;
  std::string dot_file;
  std::string operation = "forces";
  std::string formulation = "gradient";
  bool json = false;
  bool stages = false;
};

/// Everything that explains an association, before any of it is printed.
struct Explanation {
  const symgen::Law& law;
  const symgen::Element& element;
  const symgen::Quadrature& quadrature;
  symgen::GeneratedAssociation generated;
  symgen::GeneratedAssociation other;  ///< derived the other way, for comparison
  symgen::GenerateOptions options;
};

std::string derivation_name(symgen::Derivation derivation) {
  return derivation == symgen::Derivation::ginac ? "ginac" : "dag";
}

symgen::Derivation other_derivation(symgen::Derivation derivation) {
  return derivation == symgen::Derivation::ginac ? symgen::Derivation::dag
                                                 : symgen::Derivation::ginac;
}

/// "(-1, -1, -1) (1, -1, -1) ...": reference coordinates.
std::string node_order_text(const symgen::Element& element) {
  std::string text;
  for (const std::vector<GiNaC::ex>& node : element.nodes) {
    std::vector<std::string> coordinates;
    for (const GiNaC::ex& x : node) coordinates.push_back(symgen::expression_text(x));
    text += fmt::format("{}({})", text.empty() ? "" : " ", fmt::join(coordinates, ", "));
  }
  return text;
}

Json decimals(const std::vector<GiNaC::ex>& numbers) {
  Json array = Json::array();
  for (const GiNaC::ex& number : numbers) array.push_back(decimal_text(number, decimal_digits));
  return array;
}

Json decimals(const std::vector<std::vector<GiNaC::ex>>& rows) {
  Json array = Json::array();
  for (const std::vector<GiNaC::ex>& row : rows) array.push_back(decimals(row));
  return array;
}

/// For what a double holds exactly, or nearly so.
Json numbers(const std::vector<GiNaC::ex>& values) {
  Json array = Json::array();
  for (const GiNaC::ex& value : values) {
    array.push_back(GiNaC::ex_to<GiNaC::numeric>(value.evalf()).to_double());
  }
  return array;
}

Json law_json(const symgen::Law& law) {
  Json terms = Json::array();
  for (const symgen::LawTerm& term : law.terms) terms.push_back(term.text);
  Json parameters = Json::array();
  for (const symgen::Parameter& parameter : law.parameters) {
    parameters.push_back({{"name", parameter.name},
                          {"unit", parameter.unit_name},
                          {"description", parameter.description},
                          {"from_young_poisson", parameter.from_young_poisson}});
  }
  return {{"name", law.name},
          {"title", law.title},
          {"source", law.source},
          {"terms", terms},
          {"parameters", parameters}};
}

/// @param other  the same variant, derived the other way
Json operations_json(const symgen::VariantReport& variant, const symgen::VariantReport& other) {
  Json operations = Json::object();
  for (std::size_t k = 0; k < variant.operations.size(); ++k) {
    const symgen::OperationReport& operation = variant.operations[k];
    operations[operation.name] = {
        {"flops", operation.flops},           {"flops_other_derivation", other.operations[k].flops},
        {"constants", operation.constants},   {"state", operation.state},
        {"bytes_read", operation.bytes_read}, {"bytes_written", operation.bytes_written},
        {"fragments", operation.fragments},   {"code_bytes", operation.code_bytes}};
  }
  return operations;
}

Json variant_json(const symgen::VariantReport& variant, const symgen::VariantReport& other) {
  return {{"geometry", variant.geometry},
          {"constants", variant.num_constants},
          {"constants_algorithm6", variant.constants_algorithm6},
          {"state", variant.num_state},
          {"reads_positions", variant.reads_positions},
          {"operations", operations_json(variant, other)}};
}

/// The keys of the first five lines are a contract with other programs; `operations` are those
/// of the general geometry.
Json explanation_json(const Explanation& explanation) {
  const symgen::GeneratedAssociation& generated = explanation.generated;
  Json coordinates = Json::array();
  for (const GiNaC::symbol& coordinate : explanation.element.coordinates) {
    coordinates.push_back(coordinate.get_name());
  }
  Json nodes = Json::array();
  for (const std::vector<GiNaC::ex>& node : explanation.element.nodes) {
    nodes.push_back(numbers(node));
  }
  Json shape_functions = Json::array();
  for (const GiNaC::ex& function : explanation.element.shape_functions) {
    shape_functions.push_back(symgen::expression_text(function));
  }
  Json variants = Json::array();
  const std::vector<symgen::VariantReport>& others = explanation.other.variants;
  for (std::size_t k = 0; k < generated.variants.size(); ++k) {
    variants.push_back(variant_json(generated.variants[k], others[k]));
  }
  return {{"association", generated.id.text()},
          {"law", law_json(explanation.law)},
          {"element",
           {{"name", explanation.element.name},
            {"coordinates", coordinates},
            {"reference_nodes", nodes},
            {"shape_functions", shape_functions}}},
          {"quadrature",
           {{"name", explanation.quadrature.name},
            {"points", decimals(explanation.quadrature.points)},
            {"weights", decimals(explanation.quadrature.weights)}}},
          {"operations", operations_json(generated.variants.front(), others.front())},
          {"split", {{"chosen", generated.chosen_split}, {"reason", generated.split_reason}}},
          {"profile", explanation.options.profile},
          {"derivation", derivation_name(explanation.options.derivation)},
          {"hash", generated.hash},
          {"variants", variants}};
}

void print_variant(const symgen::VariantReport& variant, const symgen::VariantReport& other,
                   const std::string& other_name) {
  fmt::print("\ngeometry {}: {} constants ({} bytes) per element; algorithm 6 would store {}\n",
             variant.geometry, variant.num_constants, 8 * variant.num_constants,
             variant.constants_algorithm6);
  fmt::print("  state of the two-stage product: {} numbers; rest positions are {} after setup\n",
             variant.num_state, variant.reads_positions ? "read" : "not read");
  fmt::print("  {:<12}{:>9}{:>13}{:>11}{:>7}{:>12}{:>15}{:>11}{:>12}\n", "operation", "flops",
             "by " + other_name, "constants", "state", "bytes read", "bytes written", "fragments",
             "code bytes");
  for (std::size_t k = 0; k < variant.operations.size(); ++k) {
    const symgen::OperationReport& operation = variant.operations[k];
    fmt::print("  {:<12}{:>9}{:>13}{:>11}{:>7}{:>12}{:>15}{:>11}{:>12}\n", operation.name,
               operation.flops, other.operations[k].flops, operation.constants, operation.state,
               operation.bytes_read, operation.bytes_written, operation.fragments,
               operation.code_bytes);
  }
}

/// What a law file need not say is left out, with the marks around it.
std::string if_given(const std::string& before, const std::string& text, const char* after = "") {
  return text.empty() ? "" : before + text + after;
}

void print_explanation(const Explanation& explanation) {
  const symgen::Law& law = explanation.law;
  const symgen::GeneratedAssociation& generated = explanation.generated;
  fmt::print("{}\n", generated.id.text());
  fmt::print("  law         {}{}\n", law.title.empty() ? law.name : law.title,
             if_given(" (", law.source, ")"));
  for (const symgen::LawTerm& term : law.terms) {
    fmt::print("              term {}: {}\n", term.name, term.text);
  }
  for (const symgen::Parameter& parameter : law.parameters) {
    fmt::print("              parameter {} [{}]{}\n", parameter.name, parameter.unit_name,
               if_given(": ", parameter.description));
  }
  fmt::print("  element     {}, {} nodes\n", explanation.element.name,
             explanation.element.num_nodes());
  fmt::print("              in the order {}\n", node_order_text(explanation.element));
  fmt::print("  quadrature  {}, {} point{}\n", explanation.quadrature.name,
             explanation.quadrature.num_points(),
             explanation.quadrature.num_points() == 1 ? "" : "s");
  fmt::print("  split       {}: {}\n", generated.chosen_split, generated.split_reason);
  fmt::print("  profile     {}\n", explanation.options.profile);
  const std::string other_name = derivation_name(other_derivation(explanation.options.derivation));
  fmt::print("  derived     by {}; beside it what --derive {} would cost\n",
             derivation_name(explanation.options.derivation), other_name);
  fmt::print("  generated   in {:.3f} s, {} bytes of source, hash {}\n", generated.seconds,
             generated.header.size(), generated.hash);
  for (std::size_t k = 0; k < generated.variants.size(); ++k) {
    print_variant(generated.variants[k], explanation.other.variants[k], other_name);
  }
  fmt::print(
      "\nper element, double precision; a fused multiply-add counts 2 flops, a division or a "
      "function 1\n");
}

int write_graph(const ExplainOptions& options, const symgen::AssociationId& id,
                const symgen::Law& law, const Context& context) {
  const std::string graph = symgen::dot_graph(id, law, context.generate, options.operation);
  if (options.dot_file == "-") {
    fmt::print("{}", graph);
  } else {
    write_text_file(options.dot_file, graph);
    context.tell("wrote " + options.dot_file + "; draw it with: dot -Tsvg " + options.dot_file +
                 " -o graph.svg");
  }
  return 0;
}

/// What each stage of the pipeline made of the graph.
void print_stages(const symgen::GeneratedAssociation& generated) {
  for (const symgen::VariantReport& variant : generated.variants) {
    fmt::print("\ngeometry {}\n  {:<27}{:>9}{:>11}\n", variant.geometry, "stage", "nodes", "ms");
    for (const symgen::StageRecord& record : variant.stages) {
      fmt::print("  {:<27}{:>9}{:>11.2f}\n", record.stage, record.nodes, 1e3 * record.seconds);
    }
  }
}

int run_explain(const ExplainOptions& options, const Context& context) {
  const auto id = symgen::AssociationId::parse(options.association);
  const symgen::Law law = read_law_of(id, context);
  if (!options.dot_file.empty()) return write_graph(options, id, law, context);
  if (options.formulation == "thesis" && options.stages) {
    throw InputError("--stages: the thesis's formulation goes through none of the stages");
  }
  if (options.formulation == "thesis") return explain_thesis(id, law, options.json, context);

  symgen::GenerateOptions other = context.generate;
  other.derivation = other_derivation(other.derivation);
  const Explanation explanation = {law,
                                   symgen::find_element(id.element),
                                   symgen::find_quadrature(id.element, id.quadrature),
                                   symgen::generate_association(id, law, context.generate),
                                   symgen::generate_association(id, law, other),
                                   context.generate};
  if (options.json) {
    fmt::print("{}\n", explanation_json(explanation).dump(2));
  } else {
    print_explanation(explanation);
    if (options.stages) print_stages(explanation.generated);
  }
  return 0;
}

}  // namespace

void add_explain_command(CLI::App& app, Context& context) {
  const auto options = std::make_shared<ExplainOptions>();
  CLI::App* command = app.add_subcommand("explain", "What one association costs, and why");
  command->footer(
      "Examples:\n"
      "  elastogen explain stvk-hexa8-q8-auto\n"
      "  elastogen explain hooke-prism6-q6-none --formulation thesis\n"
      "  elastogen explain hooke-tet4-q1-none --dot - --operation energy | dot -Tsvg -o graph.svg");
  command->add_option("ASSOCIATION", options->association, "law-element-quadrature-split")
      ->required();
  CLI::Option* json = command->add_flag("--json", options->json, "For programs; exact numbers");
  command
      ->add_flag("--stages", options->stages,
                 "Size of the expression graph and time after each stage (docs/generator.md)")
      ->excludes(json);
  CLI::Option* dot = command
                         ->add_option("--dot", options->dot_file,
                                      "Write the expression graph in Graphviz's language; - is "
                                      "standard output")
                         ->type_name("FILE")
                         ->excludes(json);
  command->add_option("--operation", options->operation, "Operation whose graph is written")
      ->check(CLI::IsMember({"energy", "forces", "product", "linearize", "apply", "stress"}))
      ->needs(dot)
      ->capture_default_str();
  command
      ->add_option("--formulation", options->formulation,
                   "gradient: what is generated. thesis: constants by algorithm 6 from the energy "
                   "alone, the energy written out in nodal displacements; beside the thesis's "
                   "tables 3.4 to 3.7")
      ->check(CLI::IsMember({"gradient", "thesis"}))
      ->excludes(dot)
      ->capture_default_str();
  command->callback([options, &context] {
    context.action = [options, &context] { return run_explain(*options, context); };
  });
}

}  // namespace elastogen::selector
