#include "selector/scene/dynamics_table.h"

#include <fmt/format.h>

#include <string>
#include <vector>

namespace elastogen::selector {
namespace {

constexpr std::array<IntegrationScheme, 3> schemes = {IntegrationScheme::implicit_euler,
                                                      IntegrationScheme::symplectic_euler,
                                                      IntegrationScheme::central_differences};

IntegrationScheme read_scheme(const TomlTable& table) {
  std::vector<std::string> names;
  for (const IntegrationScheme scheme : schemes) names.emplace_back(scheme_name(scheme));
  const std::string chosen = table.choice("scheme", names);
  std::size_t number = 0;
  while (names[number] != chosen) ++number;
  return schemes[number];
}

RestCriterion read_rest(const TomlTable& table) {
  table.allow_only({"energy_per_node", "period", "after"});
  RestCriterion rest{table.number("energy_per_node", positive_number),
                     table.number("period", positive_number), 0};
  if (table.has("after")) rest.after = table.number("after", not_negative);
  return rest;
}

/// Keys of the linear systems, which explicit schemes do not have.
void read_implicit_keys(const TomlTable& table, IntegratorOptions& options) {
  const NumberRange tolerance{0, 1, true, true};
  for (const char* key : {"linear_tolerance", "newton_iterations", "newton_tolerance"}) {
    if (table.has(key) && is_explicit(options.scheme)) {
      table.fail(key, fmt::format("is for implicit_euler; {} solves no systems",
                                  scheme_name(options.scheme)));
    }
  }
  if (table.has("linear_tolerance")) {
    options.linear_tolerance = table.number("linear_tolerance", tolerance);
  }
  if (table.has("newton_iterations")) {
    options.newton_iterations = table.integer("newton_iterations", 1);
  }
  if (!table.has("newton_tolerance")) return;
  options.newton_tolerance = table.number("newton_tolerance", tolerance);
  if (options.newton_iterations == 1) {
    table.fail("newton_tolerance",
               "goes with newton_iterations = 2 or more; one iteration is the linearised step");
  }
}

}  // namespace

bool is_explicit(IntegrationScheme scheme) { return scheme != IntegrationScheme::implicit_euler; }

DynamicsDescription read_dynamics(const TomlTable& table, int dim) {
  table.allow_only({"scheme", "step", "end", "damping", "velocity", "spin", "rest",
                    "linear_tolerance", "newton_iterations", "newton_tolerance"});
  DynamicsDescription dynamics;
  dynamics.options.scheme = read_scheme(table);
  dynamics.step_where = table.where("step");
  if (table.has("step") || !is_explicit(dynamics.options.scheme)) {
    dynamics.step = table.number("step", positive_number);
  }
  dynamics.end = table.number("end", positive_number);
  if (dynamics.step && *dynamics.step > dynamics.end) {
    table.fail("step", fmt::format("must not be longer than the motion, end = {}", dynamics.end));
  }
  if (table.has("damping")) dynamics.options.damping = table.number("damping", not_negative);
  if (table.has("velocity")) dynamics.velocity = table.vector("velocity", dim);
  if (table.has("spin")) {
    dynamics.spin = dim == 3 ? table.vector("spin", 3)
                             : std::array<double, 3>{0, 0, table.number("spin", any_number)};
  }
  if (table.has("rest")) dynamics.rest = read_rest(table.table("rest"));
  read_implicit_keys(table, dynamics.options);
  return dynamics;
}

}  // namespace elastogen::selector
