#include "selector/commands/evaluation_case.h"

#include <fmt/format.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <numeric>
#include <optional>

#include "runtime/error.h"
#include "runtime/mesh.h"
#include "runtime/rest_geometry.h"
#include "selector/support/names.h"

namespace elastogen::selector {
namespace {

nlohmann::json parse_json(const std::string& text, const std::string& source) {
  try {
    return nlohmann::json::parse(text);
  } catch (const nlohmann::json::exception& error) {  // also numbers out of range
    // "[json.exception.parse_error.101] parse error at line 3, column 5: ...": from "line" on.
    const std::string message = error.what();
    const std::size_t line = message.find("line ");
    throw InputError(fmt::format("{} is not valid JSON: {}", source,
                                 line == std::string::npos ? message : message.substr(line)));
  }
}

void check_keys(const nlohmann::json& object, const std::string& where,
                const std::vector<std::string>& allowed) {
  if (!object.is_object()) {
    throw InputError(fmt::format("{}: found {}; it must be an object with the keys {}", where,
                                 object.type_name(), join(allowed, ", ")));
  }
  for (const auto& [key, value] : object.items()) {
    if (std::find(allowed.begin(), allowed.end(), key) == allowed.end()) {
      throw InputError(fmt::format("{}: unknown key '{}'{} (allowed: {})", where, key,
                                   did_you_mean(key, allowed), join(allowed, ", ")));
    }
  }
}

double read_number(const nlohmann::json& value, const std::string& where) {
  if (!value.is_number()) {
    throw InputError(fmt::format("{}: found {} ({}); it must be a number", where, value.type_name(),
                                 value.dump()));
  }
  const auto number = value.get<double>();
  if (!std::isfinite(number)) {
    throw InputError(fmt::format("{}: the number is too large for double precision", where));
  }
  return number;
}

/// A row of `dim` numbers for each node, as one vector.
std::vector<double> read_rows(const nlohmann::json& input, const std::string& source,
                              const std::string& key, const symgen::Element& element) {
  if (!input.contains(key)) {
    throw InputError(
        fmt::format("{}: the key '{}' is missing: a row of {} numbers [m] for each "
                    "of the {} nodes of '{}'",
                    source, key, element.dim, element.num_nodes(), element.name));
  }
  const nlohmann::json& rows = input[key];
  const auto num_nodes = static_cast<std::size_t>(element.num_nodes());
  const auto dim = static_cast<std::size_t>(element.dim);
  const std::string where = source + ": " + key;
  if (!rows.is_array() || rows.size() != num_nodes) {
    const std::string found =
        rows.is_array() ? fmt::format("{} rows", rows.size()) : std::string(rows.type_name());
    throw InputError(fmt::format("{}: found {}; '{}' has {} nodes and needs as many rows", where,
                                 found, element.name, num_nodes));
  }
  std::vector<double> values;
  for (std::size_t a = 0; a < num_nodes; ++a) {
    const std::string row_name = fmt::format("{}[{}]", where, a);
    if (!rows[a].is_array() || rows[a].size() != dim) {
      throw InputError(fmt::format("{}: found {}; '{}' needs {} coordinates for each node",
                                   row_name, rows[a].dump(), element.name, dim));
    }
    for (std::size_t i = 0; i < dim; ++i) {
      values.push_back(read_number(rows[a][i], fmt::format("{}[{}]", row_name, i)));
    }
  }
  return values;
}

std::vector<double> read_parameters(const nlohmann::json& input, const std::string& source,
                                    const symgen::Law& law) {
  std::vector<std::string> names;
  bool all_follow = !law.parameters.empty();
  for (const symgen::Parameter& parameter : law.parameters) {
    names.push_back(parameter.name);
    all_follow = all_follow && !parameter.from_young_poisson.empty();
  }
  const std::string either = all_follow ? ", or young and poisson" : "";
  if (!input.contains("parameters")) {
    throw InputError(fmt::format("{}: the key 'parameters' is missing: an object with {}{}", source,
                                 join(names, ", "), either));
  }
  const nlohmann::json& object = input["parameters"];
  const std::string where = source + ": parameters";
  const bool by_young =
      all_follow && object.is_object() && (object.contains("young") || object.contains("poisson"));
  std::vector<std::string> allowed = by_young ? std::vector<std::string>{} : names;
  if (all_follow) allowed.insert(allowed.end(), {"young", "poisson"});
  check_keys(object, where, allowed);

  const auto value_of = [&](const std::string& name) {
    if (!object.contains(name)) {
      throw InputError(fmt::format("{}: '{}' is missing; law '{}' needs {}{}", where, name,
                                   law.name, join(names, ", "), either));
    }
    return read_number(object[name], where + "." + name);
  };
  try {
    std::vector<double> values;
    if (by_young) {
      values = symgen::parameters_from_young_poisson(law, value_of("young"), value_of("poisson"));
    } else {
      for (const std::string& name : names) values.push_back(value_of(name));
    }
    symgen::check_parameters(law, values);
    return values;
  } catch (const InputError& error) {
    const std::string message = error.what();
    if (message.starts_with(source)) throw;
    throw InputError(where + ": " + message);
  }
}

/// Jacobian determinant dX/dxi of the rest shape at a point of the rule.
double jacobian_determinant(const symgen::ElementCase& input, const symgen::Element& element,
                            const std::vector<GiNaC::ex>& point) {
  const int dim = element.dim;
  GiNaC::exmap at_point;
  for (int j = 0; j < dim; ++j) at_point[element.coordinates[j]] = point[j];
  Eigen::MatrixXd jacobian = Eigen::MatrixXd::Zero(dim, dim);
  for (int a = 0; a < element.num_nodes(); ++a) {
    for (int j = 0; j < dim; ++j) {
      const GiNaC::ex derivative =
          element.shape_functions[a].diff(element.coordinates[j]).subs(at_point).evalf();
      const double slope = GiNaC::ex_to<GiNaC::numeric>(derivative).to_double();
      for (int i = 0; i < dim; ++i) jacobian(i, j) += slope * input.rest_positions[a * dim + i];
    }
  }
  return jacobian.determinant();
}

}  // namespace

symgen::ElementCase read_evaluation_case(const std::string& text, const std::string& source,
                                         const symgen::Law& law, const symgen::Element& element) {
  const nlohmann::json input = parse_json(text, source);
  check_keys(input, source, {"rest_positions", "parameters", "displacement", "direction"});
  symgen::ElementCase result;
  result.rest_positions = read_rows(input, source, "rest_positions", element);
  result.parameters = read_parameters(input, source, law);
  result.displacement = read_rows(input, source, "displacement", element);
  if (input.contains("direction")) {
    result.direction = read_rows(input, source, "direction", element);
  }
  return result;
}

void check_rest_shape(const symgen::ElementCase& input, const std::string& source,
                      const symgen::Element& element, const symgen::Quadrature& quadrature) {
  const std::vector<double>& x = input.rest_positions;
  const auto dim = static_cast<std::size_t>(element.dim);
  double extent = 0;
  for (std::size_t k = 0; k < x.size(); ++k) {
    extent = std::max(extent, std::abs(x[k] - x[k % dim]));
  }
  const double smallest = 1e-12 * std::pow(extent, element.dim);
  for (int g = 0; g < quadrature.num_points(); ++g) {
    const double determinant =
        jacobian_determinant(input, element, quadrature.points[static_cast<std::size_t>(g)]);
    if (determinant > smallest) continue;
    throw InputError(fmt::format(
        "{}: rest_positions: the element is {}: its Jacobian determinant at quadrature point {} "
        "of {} is {:.6g}, must be greater than {:.2g}; list the nodes in the order of '{}' "
        "(elastogen explain shows it)",
        source, determinant < -smallest ? "inverted" : "degenerate", g + 1, quadrature.num_points(),
        determinant, smallest, element.name));
  }
}

void check_rest_shape_is(const std::string& geometry, const symgen::ElementCase& input,
                         const std::string& source, const symgen::Element& element) {
  Mesh mesh;
  mesh.dim = element.dim;
  mesh.positions = input.rest_positions;
  ElementBlock block;
  block.element = element.name;
  block.nodes_per_element = element.num_nodes();
  block.nodes.resize(static_cast<std::size_t>(element.num_nodes()));
  std::iota(block.nodes.begin(), block.nodes.end(), 0);
  block.region = {0};
  const std::optional<std::vector<int>> order = node_order_for(geometry, mesh, block, 0);
  if (order && std::is_sorted(order->begin(), order->end())) return;
  const char* fault = "the element is no axis-aligned box";
  if (order) fault = "the box's nodes are not in an order along the axes, the least corner first";
  if (geometry == "affine") fault = "the element is no tet10 with straight edges";
  throw InputError(
      fmt::format("{}: rest_positions: {}, which --geometry {} needs; take --geometry general",
                  source, fault, geometry));
}

}  // namespace elastogen::selector
