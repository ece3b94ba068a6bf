#include "symgen/law/parameters.h"

#include <fmt/format.h>

#include <cmath>
#include <limits>
#include <optional>

#include "runtime/error.h"
#include "symgen/dag/evaluate.h"
#include "symgen/law/law.h"
#include "symgen/law/names.h"

namespace elastogen::symgen {
namespace {

GiNaC::numeric exact_number(double value) { return GiNaC::numeric(exact_value(value)); }

/// A parameter as it follows from Young's modulus and Poisson's ratio.
/// @return  nothing where it has no real value
std::optional<GiNaC::numeric> derived_number(const Parameter& parameter,
                                             const GiNaC::numeric& young,
                                             const GiNaC::numeric& poisson) {
  try {
    const GiNaC::ex value =
        parameter.young_poisson_formula
            .subs(GiNaC::exmap{{young_modulus(), young}, {poisson_ratio(), poisson}})
            .evalf();
    if (GiNaC::is_a<GiNaC::numeric>(value) && GiNaC::ex_to<GiNaC::numeric>(value).is_real()) {
      return GiNaC::ex_to<GiNaC::numeric>(value);
    }
  } catch (const std::exception&) {  // GiNaC's, at a pole
  }
  return std::nullopt;
}

/// Names of the parameters that have a pole where Poisson's ratio is at the bound.
std::vector<std::string> unbounded_parameters(const Law& law, const GiNaC::numeric& bound) {
  std::vector<std::string> names;
  for (const Parameter& parameter : law.parameters) {
    if (!parameter.from_young_poisson.empty() && !derived_number(parameter, 1, bound)) {
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
  const std::optional<GiNaC::numeric> value =
      derived_number(parameter, exact_number(young), exact_number(poisson));
  if (!value) {
    throw InputError(
        fmt::format("parameter '{}' of law '{}', {}, has no real value at young = {}, "
                    "poisson = {}",
                    parameter.name, law.name, parameter.from_young_poisson, young, poisson));
  }
  const double rounded = value->to_double();
  if (!std::isnormal(rounded) && !value->is_zero()) {
    throw InputError(fmt::format(
        "young = {}, poisson = {}: parameter '{}' of law '{}' is too {} for double "
        "precision, whose numbers keep their digits from {:.3g} to {:.3g}",
        young, poisson, parameter.name, law.name, std::isfinite(rounded) ? "small" : "large",
        std::numeric_limits<double>::min(), std::numeric_limits<double>::max()));
  }
  return rounded;
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

}  // namespace

const GiNaC::symbol& young_modulus() {
  static const GiNaC::symbol symbol("young");
  return symbol;
}

const GiNaC::symbol& poisson_ratio() {
  static const GiNaC::symbol symbol("poisson");
  return symbol;
}

bool is_admissible(const Parameter& parameter, const GiNaC::numeric& value) {
  if (parameter.minimum && (value < *parameter.minimum ||
                            (parameter.minimum_exclusive && value == *parameter.minimum))) {
    return false;
  }
  return !(parameter.maximum && (value > *parameter.maximum ||
                                 (parameter.maximum_exclusive && value == *parameter.maximum)));
}

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
    const auto fail = [&](const std::string& what) {
      throw InputError(fmt::format("{} = {}: must be {} [{}] for law '{}'", parameter.name,
                                   values[i], what, parameter.unit_name, law.name));
    };
    if (!std::isfinite(values[i])) fail("a finite number");
    if (!is_admissible(parameter, exact_number(values[i]))) fail(range_text(parameter));
    if (std::fpclassify(values[i]) == FP_SUBNORMAL) {
      fail(fmt::format("0 or at least {:.3g} in size, where double precision has all its digits",
                       std::numeric_limits<double>::min()));
    }
  }
}

}  // namespace elastogen::symgen
