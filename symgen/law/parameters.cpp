#include "symgen/law/parameters.h"

#include <cln/cln.h>
#include <fmt/format.h>

#include <cmath>

#include "runtime/error.h"
#include "symgen/law/expression.h"
#include "symgen/law/law.h"
#include "symgen/law/names.h"

namespace elastogen::symgen {
namespace {

GiNaC::numeric exact_value_of(double value) {
  return GiNaC::numeric(cln::rational(cln::cl_DF(value)));
}

/// A parameter as a function of `young` and `poisson`.
struct Derived {
  GiNaC::symbol young = GiNaC::symbol("young");
  GiNaC::symbol poisson = GiNaC::symbol("poisson");
  GiNaC::ex expression;

  explicit Derived(const Parameter& parameter)
      : expression(parse_expression(parameter.from_young_poisson,
                                    {{"constants", {{"young", young}, {"poisson", poisson}}}})) {}

  /// @throws std::exception  (GiNaC's) at a pole
  [[nodiscard]] GiNaC::ex at(const GiNaC::ex& young_value, const GiNaC::ex& poisson_value) const {
    return expression.subs(GiNaC::exmap{{young, young_value}, {poisson, poisson_value}}).evalf();
  }
};

/// Names of the parameters that have a pole where Poisson's ratio is at the bound.
std::vector<std::string> unbounded_parameters(const Law& law, const GiNaC::numeric& bound) {
  std::vector<std::string> names;
  for (const Parameter& parameter : law.parameters) {
    if (parameter.from_young_poisson.empty()) continue;
    try {
      (void)Derived(parameter).at(1, bound);
    } catch (const std::exception&) {
      names.push_back(parameter.name);
    }
  }
  return names;
}

void check_poisson(const Law& law, double poisson) {
  if (poisson > -1 && poisson < 0.5) return;
  std::string reason;
  if (!std::isnan(poisson)) {
    const bool is_above = poisson >= 0.5;
    const std::vector<std::string> names =
        unbounded_parameters(law, is_above ? GiNaC::numeric(1, 2) : GiNaC::numeric(-1));
    if (!names.empty()) {
      reason = fmt::format(" ({} {} unbounded at {})", join_names(names),
                           names.size() == 1 ? "is" : "are", is_above ? "0.5" : "-1");
    }
    reason += is_above ? "; give a ratio up to 0.4999" : "; give a ratio from -0.9999";
  }
  throw InputError(
      fmt::format("poisson = {}: must be in (-1, 0.5) for law '{}'{}", poisson, law.name, reason));
}

double derived_value(const Law& law, const Parameter& parameter, double young, double poisson) {
  if (parameter.from_young_poisson.empty()) {
    throw InputError(
        fmt::format("parameter '{}' of law '{}' does not follow from young and "
                    "poisson; give the law's own parameters",
                    parameter.name, law.name));
  }
  try {
    const GiNaC::ex value = Derived(parameter).at(exact_value_of(young), exact_value_of(poisson));
    if (GiNaC::is_a<GiNaC::numeric>(value) && GiNaC::ex_to<GiNaC::numeric>(value).is_real()) {
      return GiNaC::ex_to<GiNaC::numeric>(value).to_double();
    }
  } catch (const std::exception&) {
    // A pole; said below.
  }
  throw InputError(
      fmt::format("parameter '{}' of law '{}', {}, has no real value at young = {}, "
                  "poisson = {}",
                  parameter.name, law.name, parameter.from_young_poisson, young, poisson));
}

/// "in (0, 5]", "> 0", "<= 1".
std::string range_text(const Parameter& parameter) {
  const auto number = [](const GiNaC::numeric& value) {
    return fmt::format("{}", value.to_double());
  };
  if (parameter.minimum && parameter.maximum) {
    return fmt::format("in {}{}, {}{}", parameter.minimum_exclusive ? "(" : "[",
                       number(*parameter.minimum), number(*parameter.maximum),
                       parameter.maximum_exclusive ? ")" : "]");
  }
  if (parameter.minimum) {
    return fmt::format("{} {}",
                       parameter.minimum_exclusive ? ">" : ">=", number(*parameter.minimum));
  }
  return fmt::format("{} {}", parameter.maximum_exclusive ? "<" : "<=", number(*parameter.maximum));
}

bool is_admissible(const Parameter& parameter, const GiNaC::numeric& value) {
  if (parameter.minimum && (value < *parameter.minimum ||
                            (parameter.minimum_exclusive && value == *parameter.minimum))) {
    return false;
  }
  return !(parameter.maximum && (value > *parameter.maximum ||
                                 (parameter.maximum_exclusive && value == *parameter.maximum)));
}

}  // namespace

std::vector<double> parameters_from_young_poisson(const Law& law, double young, double poisson) {
  if (!std::isfinite(young) || young <= 0) {
    throw InputError(
        fmt::format("young = {}: must be a finite number > 0 [Pa] for law '{}'", young, law.name));
  }
  check_poisson(law, poisson);
  std::vector<double> values;
  for (const Parameter& parameter : law.parameters) {
    values.push_back(derived_value(law, parameter, young, poisson));
  }
  check_parameters(law, values);
  return values;
}

void check_parameters(const Law& law, const std::vector<double>& values) {
  if (values.size() != law.parameters.size()) {
    throw InternalError(fmt::format("{} values for the {} parameters of law '{}'", values.size(),
                                    law.parameters.size(), law.name));
  }
  for (std::size_t i = 0; i < values.size(); ++i) {
    const Parameter& parameter = law.parameters[i];
    if (!std::isfinite(values[i])) {
      throw InputError(fmt::format("{} = {}: must be a finite number [{}] for law '{}'",
                                   parameter.name, values[i], parameter.unit, law.name));
    }
    if (!is_admissible(parameter, exact_value_of(values[i]))) {
      throw InputError(fmt::format("{} = {}: must be {} [{}] for law '{}'", parameter.name,
                                   values[i], range_text(parameter), parameter.unit, law.name));
    }
  }
}

}  // namespace elastogen::symgen
