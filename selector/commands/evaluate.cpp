#include "selector/commands/evaluate.h"

#include <fmt/format.h>

#include <cmath>
#include <cstdlib>
#include <iostream>
#include <iterator>
#include <memory>
#include <nlohmann/json.hpp>

#include "runtime/error.h"
#include "selector/commands/evaluation.h"
#include "selector/commands/evaluation_case.h"
#include "selector/support/files.h"
#include "symgen/element_evaluation.h"

namespace elastogen::selector {
namespace {

using Json = nlohmann::ordered_json;

struct EvaluateOptions {
  std::string association;
  std::string input;
  std::string scalar = "double";
  std::string geometry = "general";
};

/// JSON values of the results, with null for what is not finite.
struct Results {
  Json energy;
  std::vector<Json> forces, product, stiffness, stress;
  std::vector<std::vector<Json>> cauchy;  ///< of each point; empty where there is none
  std::string status;
  bool finite = true;
};

Json number_value(double number, bool& finite) {
  if (std::isfinite(number)) return number;
  finite = false;
  return nullptr;
}

/// @param as_text  keep the digits that a double would lose
Json text_value(const std::string& text, bool as_text, bool& finite) {
  const Json number = number_value(std::strtod(text.c_str(), nullptr), finite);
  return as_text && !number.is_null() ? Json(text) : number;
}

Results from_kernels(const KernelEvaluation& evaluation, bool small_strain) {
  Results results;
  const auto convert = [&](const std::vector<double>& numbers) {
    std::vector<Json> values;
    for (const double number : numbers) values.push_back(number_value(number, results.finite));
    return values;
  };
  results.energy = number_value(evaluation.energy, results.finite);
  results.forces = convert(evaluation.forces);
  results.product = convert(evaluation.product);
  results.stiffness = convert(evaluation.stiffness);
  results.stress = convert(evaluation.stress);
  for (const std::vector<double>& sigma :
       symgen::cauchy_stress(evaluation.stress, small_strain, symgen::DoubleArithmetic{})) {
    results.cauchy.push_back(convert(sigma));
  }
  results.status = status_text(evaluation.status);
  return results;
}

/// Outside a law's domain exact arithmetic has no results at all: nulls take their places.
Results from_graph(const symgen::Evaluation& evaluation, const symgen::ElementCase& input,
                   std::size_t num_points, bool as_text) {
  Results results;
  const auto convert = [&](const std::vector<std::string>& texts, std::size_t count) {
    if (texts.empty()) return std::vector<Json>(count, nullptr);
    std::vector<Json> values;
    for (const std::string& text : texts) {
      values.push_back(text_value(text, as_text, results.finite));
    }
    return values;
  };
  const std::size_t size = input.displacement.size();
  if (!evaluation.energy.empty()) {
    results.energy = text_value(evaluation.energy, as_text, results.finite);
  }
  results.forces = convert(evaluation.forces, size);
  results.product = convert(evaluation.product, input.direction.size());
  results.stiffness = convert(evaluation.stiffness, size * size);
  results.stress = convert(evaluation.stress, stress_numbers * num_points);
  results.cauchy.resize(num_points);
  for (std::size_t g = 0; g < evaluation.cauchy.size(); ++g) {
    results.cauchy[g] = convert(evaluation.cauchy[g], 0);
  }
  results.status = evaluation.status;
  return results;
}

/// Values in rows of `width`.
Json rows(const std::vector<Json>& values, std::size_t width) {
  Json array = Json::array();
  for (std::size_t first = 0; first < values.size(); first += width) {
    array.push_back(std::vector<Json>(values.begin() + static_cast<std::ptrdiff_t>(first),
                                      values.begin() + static_cast<std::ptrdiff_t>(first + width)));
  }
  return array;
}

/// What the operation `stress` gives at a point, and the Cauchy stress.
Json point_json(const Results& results, std::size_t g) {
  const auto tensor = [&](std::size_t first) {
    const auto begin =
        results.stress.begin() + static_cast<std::ptrdiff_t>(g * stress_numbers + first);
    return rows({begin, begin + 9}, 3);
  };
  const std::vector<Json>& sigma = results.cauchy[g];
  return {{"H", tensor(0)},
          {"P", tensor(9)},
          {"cauchy", sigma.empty() ? Json(nullptr) : rows(sigma, 3)},
          {"W", results.stress[g * stress_numbers + 18]},
          {"volume", results.stress[g * stress_numbers + 19]}};
}

Json results_json(const Results& results, int dim) {
  const auto width = static_cast<std::size_t>(dim);
  Json output;
  output["energy"] = results.energy;
  output["forces"] = rows(results.forces, width);
  if (!results.product.empty()) output["product"] = rows(results.product, width);
  output["stiffness"] = rows(results.stiffness, results.forces.size());
  output["stress"] = Json::array();
  for (std::size_t g = 0; g < results.cauchy.size(); ++g) {
    output["stress"].push_back(point_json(results, g));
  }
  const bool unmentioned = !results.finite && results.status == "ok";
  output["status"] = unmentioned ? status_text(status_not_finite) : results.status;
  return output;
}

template <class Scalar>
Results compile_and_evaluate(const symgen::AssociationId& id, const symgen::Law& law, bool simd,
                             const std::string& geometry, const symgen::ElementCase& input,
                             const Context& context) {
  KernelRequest request{id, law, {}};
  request.what.single_precision = std::is_same_v<Scalar, float>;
  request.what.simd = simd;
  request.what.operations = {"energy", "forces", "product", "stiffness", "stress"};
  KernelLoader loader(context.loader_options());
  const std::vector<LoadedKernels> kernels = loader.load({request});
  return from_kernels(evaluate_kernels(kernels.front().table<Scalar>(), geometry, input),
                      law.small_strain);
}

Results compute(const EvaluateOptions& options, const symgen::AssociationId& id,
                const symgen::Law& law, const symgen::ElementCase& input, const Context& context) {
  const std::string& scalar = options.scalar;
  if (scalar == "dag" || scalar == "cln") {
    const bool cln = scalar == "cln";
    const auto kind = cln ? symgen::GraphScalar::cln : symgen::GraphScalar::dag_double;
    const auto num_points =
        static_cast<std::size_t>(symgen::find_quadrature(id.element, id.quadrature).num_points());
    return from_graph(symgen::evaluate_graph(id, law, input, kind, context.generate), input,
                      num_points, cln);
  }
  if (scalar == "float") {
    return compile_and_evaluate<float>(id, law, false, options.geometry, input, context);
  }
  return compile_and_evaluate<double>(id, law, scalar == "simd", options.geometry, input, context);
}

int run_evaluate(const EvaluateOptions& options, const Context& context) {
  const auto id = symgen::AssociationId::parse(options.association);
  const symgen::Law law = read_law_of(id, context);
  const symgen::Element& element = symgen::find_element(id.element);
  const bool from_stdin = options.input == "-";
  const std::string source = from_stdin ? "standard input" : options.input;
  const std::string text = from_stdin ? std::string(std::istreambuf_iterator<char>(std::cin), {})
                                      : read_text_file(options.input, "input");
  const symgen::ElementCase input = read_evaluation_case(text, source, law, element);
  check_rest_shape(input, source, element, symgen::find_quadrature(id.element, id.quadrature));
  if (options.geometry != "general") {
    if (options.scalar == "dag" || options.scalar == "cln") {
      throw InputError(
          fmt::format("--geometry {}: --scalar {} evaluates the graph, which knows "
                      "only the general geometry; take double, float or simd",
                      options.geometry, options.scalar));
    }
    check_rest_shape_is(options.geometry, input, source, element);
  }
  fmt::print("{}\n", results_json(compute(options, id, law, input, context), element.dim).dump(2));
  return 0;
}

}  // namespace

void add_evaluate_command(CLI::App& app, Context& context) {
  const auto options = std::make_shared<EvaluateOptions>();
  CLI::App* command = app.add_subcommand("evaluate", "One element by numbers: JSON in, JSON out");
  command->footer(
      "Input:  {\"rest_positions\": [[x, y, z], ...], \"parameters\": {\"young\": 1e5, "
      "\"poisson\": "
      "0.3},\n"
      "         \"displacement\": [[...]], \"direction\": [[...]]}   metres; direction may be "
      "absent\n"
      "Output: {\"energy\": J, \"forces\": [[N]] = -dW/dU, \"product\": [[N]] = (dforces/dU) "
      "direction,\n"
      "         \"stiffness\": [[N/m]] = d2W/dU2, node-major,\n"
      "         \"stress\": [{\"H\": [[3 x 3]] = dU/dX, \"P\": [[Pa]] = dW/dH, \"cauchy\": "
      "[[Pa]] = P F^T / det F (null\n"
      "           where det F = 0; P itself of a law for small strain), \"W\": J/m^3, "
      "\"volume\": m^dim}, ...] at each\n"
      "           point of the quadrature, as tensors in space also in plane strain,\n"
      "         \"status\": \"ok\" or what is wrong}\n"
      "A result that is not finite is null, and the status says so; the exit status is 0 then "
      "too.\n"
      "Examples:\n"
      "  elastogen evaluate stvk-hexa8-q8-none --input case.json\n"
      "  elastogen evaluate stvk-hexa8-q8-none --input - --scalar cln < case.json");
  command->add_option("ASSOCIATION", options->association, "law-element-quadrature-split")
      ->required();
  command->add_option("--input", options->input, "The case; - is standard input")
      ->type_name("FILE")
      ->required();
  command
      ->add_option("--scalar", options->scalar,
                   "double, float: compiled, one element at a time; simd: doubles in all lanes; "
                   "dag, cln: without compiling, the kernel's statements in doubles or the "
                   "law's graph in 40 digits")
      ->check(CLI::IsMember({"double", "float", "simd", "dag", "cln"}))
      ->capture_default_str();
  command
      ->add_option(
          "--geometry", options->geometry,
          "Variant of the compiled kernels; box: axis-aligned hexahedra only; affine: tet10 "
          "with straight edges only")
      ->check(CLI::IsMember({"general", "affine", "box"}))
      ->capture_default_str();
  command->callback([options, &context] {
    context.action = [options, &context] { return run_evaluate(*options, context); };
  });
}

}  // namespace elastogen::selector
