#include "selector/certify/certificate.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "selector/commands/evaluation.h"
#include "symgen/quadrature/quadrature.h"

namespace elastogen::selector {
namespace {

using cln::cl_R;
using symgen::ElementCase;

constexpr int condition_trials = 4;
constexpr int slow_cases = 3;       // of families that need many more digits
constexpr int stiffness_every = 8;  // exact stiffness takes as many products as there are columns

/// The first Piola-Kirchhoff stress of all points, of what the operation gives.
template <class Number>
std::vector<Number> first_piola_of(const std::vector<Number>& stress) {
  std::vector<Number> entries;
  for (std::size_t first = 0; first < stress.size(); first += stress_numbers) {
    const auto begin = stress.begin() + static_cast<std::ptrdiff_t>(first + 9);
    entries.insert(entries.end(), begin, begin + 9);
  }
  return entries;
}

/// Values of the operations in one list each.
template <class Number, class Results>
std::array<std::vector<Number>, num_operations> in_lists(const Results& results) {
  return {std::vector<Number>{results.energy}, results.forces, results.product, results.stiffness,
          first_piola_of<Number>(results.stress)};
}

double largest(const std::vector<double>& values) {
  double result = 0;
  for (const double value : values) result = std::max(result, std::abs(value));
  return result;
}

/// A CLN number as a double; beyond double's range infinity, below it 0.
double to_double(const cl_R& value) {
  if (cln::zerop(value)) return 0;
  const cln::cl_F f = cln::cl_float(value, cln::float_format(40));  // of any exponent
  const auto exponent = static_cast<long>(cln::float_exponent(f));
  if (exponent > 1020) return std::numeric_limits<double>::infinity();
  if (exponent < -1020) return 0;
  return cln::double_approx(value);
}

double largest(const std::vector<cl_R>& values) {
  double result = 0;
  for (const cl_R& value : values) result = std::max(result, std::abs(to_double(value)));
  return result;
}

/// max |a - b|
double distance(const std::vector<cl_R>& a, const std::vector<cl_R>& b) {
  double result = 0;
  for (std::size_t k = 0; k < a.size(); ++k) {
    result = std::max(result, std::abs(to_double(a[k] - b[k])));
  }
  return result;
}

double distance(const std::vector<cl_R>& a, const std::vector<double>& b) {
  double result = 0;
  for (std::size_t k = 0; k < a.size(); ++k) {
    if (!std::isfinite(b[k])) return std::numeric_limits<double>::infinity();
    result = std::max(result, std::abs(to_double(a[k] - symgen::exact_value(b[k]))));
  }
  return result;
}

/// Largest extent of nodal positions along an axis.
double largest_extent(const std::vector<double>& positions, int dim) {
  double size = 0;
  for (std::size_t k = 0; k < positions.size(); ++k) {
    const double first = positions[k % static_cast<std::size_t>(dim)];
    size = std::max(size, std::abs(positions[k] - first));
  }
  return size;
}

double median(std::vector<double> values) {
  if (values.empty()) return 0;
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

/// One family's cases on one association's kernels.
template <class Scalar>
class FamilyRun {
 public:
  FamilyRun(const KernelTable<Scalar>& table, const symgen::ExactElement& exact, int dim)
      : table_(table), exact_(exact), dim_(dim) {}

  FamilyRecord run(const CaseFamily& family, const CaseContext& context, int cases) {
    FamilyRecord record;
    record.family = family.name;
    record.well_posed = family.well_posed;
    digits_ = family.digits;
    std::array<std::vector<double>, num_operations> all;
    const bool is_slow = digits_ > usual_digits;
    for (int k = 0; k < (is_slow ? std::min(cases, slow_cases) : cases); ++k) {
      const ElementCase input = rounded(family.make(context), single_precision);
      ++record.num_cases;
      add(input, k % stiffness_every == 0 && !is_slow, context.generator, record, all);
    }
    for (std::size_t o = 0; o < num_operations; ++o) record.errors[o].median = median(all[o]);
    return record;
  }

 private:
  static constexpr bool single_precision = std::is_same_v<Scalar, float>;
  static constexpr double epsilon = std::numeric_limits<Scalar>::epsilon();
  static constexpr double underflow = underflow_units * std::numeric_limits<Scalar>::min();

  template <class ExactAt, class Moved>
  [[nodiscard]] static bool some_inside(const ExactAt& exact_at, const Moved& moved) {
    constexpr int trials = 10;
    for (int trial = 0; trial < trials; ++trial) {
      try {
        (void)exact_at(moved());
        return true;
      } catch (const symgen::OutsideDomain&) {
      }
    }
    return false;
  }

  void violate(FamilyRecord& record, const std::string& what) {
    ++record.violations;
    if (record.first_violation.empty()) record.first_violation = what;
  }

  void add(const ElementCase& input, bool with_stiffness, std::mt19937& generator,
           FamilyRecord& record, std::array<std::vector<double>, num_operations>& all) {
    const KernelEvaluation found = evaluate_kernels(table_, "general", input);
    if (found.status != status_ok) {
      ++record.flagged;
      return;
    }
    if (!is_finite(input)) {
      violate(record, "results without a flag for an input that is not finite");
      return;
    }
    std::array<std::vector<cl_R>, num_operations> expected;
    std::array<double, num_operations> condition{};
    const auto exact_at = [&](const ElementCase& at) {
      return in_lists<cl_R>(exact_.evaluate(at, digits_, with_stiffness));
    };
    const auto moved = [&] { return perturbed(input, dim_, single_precision, generator); };
    try {
      expected = exact_at(input);
    } catch (const symgen::OutsideDomain&) {
      // On the boundary of the domain rounding of the inputs decides on which side they are.
      if (!some_inside(exact_at, moved)) {
        violate(record, "results without a flag outside the law's domain");
      }
      return;
    }
    scale_ = {std::abs(to_double(expected[0][0])), largest(expected[1]),
              largest(found.stiffness) * largest(input.direction), largest(expected[3]),
              largest(expected[4])};
    const double size = largest_extent(input.rest_positions, dim_);
    const double stiffness = largest(found.stiffness);
    const double noise = std::pow(10.0, 10.0 - digits_) * stiffness;
    const std::array<double, num_operations> unseen = {
        underflow + noise * size * size, underflow + noise * size,
        underflow + noise * largest(input.direction), underflow + noise,
        underflow + noise / std::pow(size, dim_ - 2)};
    for (int trial = 0; trial < condition_trials; ++trial) {
      try {
        const auto there = exact_at(moved());
        for (std::size_t o = 0; o < num_operations; ++o) {
          condition[o] = std::max(condition[o], in_units(o, distance(expected[o], there[o])));
        }
      } catch (const symgen::OutsideDomain&) {
        condition.fill(std::numeric_limits<double>::infinity());
      }
    }
    const auto values = in_lists<double>(found);
    std::string beyond;  // the first operation beyond its bound
    for (std::size_t o = 0; o < num_operations; ++o) {
      if (expected[o].empty()) continue;
      const double error = in_units(o, std::max(0.0, distance(expected[o], values[o]) - unseen[o]));
      ErrorRecord& errors = record.errors[o];
      ++errors.num_errors;
      all[o].push_back(error);
      const double relative = error / (1 + condition[o]);
      errors.worst = std::max(errors.worst, error);
      errors.condition = std::max(errors.condition, condition[o]);
      if (!errors.worst_case || relative > errors.relative) {
        errors.relative = relative;
        errors.worst_case = input;
      }
      if ((record.well_posed ? error : relative) > error_bound(o, record.well_posed) &&
          beyond.empty()) {
        beyond = fmt::format("{} off by {:.3g} epsilon at a condition of {:.3g}", operation_name(o),
                             error, condition[o]);
      }
    }
    if (!beyond.empty()) violate(record, beyond);
  }

  /// A difference over what it is relative to, in epsilon.
  [[nodiscard]] double in_units(std::size_t operation, double difference) const {
    if (difference == 0) return 0;
    return difference / scale_[operation] / epsilon;
  }

  const KernelTable<Scalar>& table_;
  const symgen::ExactElement& exact_;
  int dim_;
  unsigned digits_ = 0;
  std::array<double, num_operations> scale_{};
};

}  // namespace

const char* operation_name(std::size_t operation) {
  static constexpr const char* names[num_operations] = {"energy", "forces", "product", "stiffness",
                                                        "stress"};
  return names[operation];
}

double error_bound(std::size_t operation, bool well_posed) {
  return well_posed && operation != 0 ? 50 : 200;
}

int Certificate::violations() const {
  int sum = 0;
  for (const FamilyRecord& family : families) sum += family.violations;
  return sum;
}

double Certificate::worst(std::size_t operation, bool well_posed) const {
  double result = 0;
  for (const FamilyRecord& family : families) {
    if (family.well_posed != well_posed) continue;
    const ErrorRecord& errors = family.errors[operation];
    result = std::max(result, well_posed ? errors.worst : errors.relative);
  }
  return result;
}

template <class Scalar>
Certificate certify(const symgen::AssociationId& id, const symgen::Law& law,
                    const KernelTable<Scalar>& table, const symgen::ExactElement& exact,
                    const CertifyOptions& options) {
  const ReferenceShape shape(symgen::find_element(id.element),
                             symgen::find_quadrature(id.element, id.quadrature));
  Certificate certificate{id.text(), std::is_same_v<Scalar, float>, {}, {}};
  for (const symgen::Parameter& parameter : law.parameters) {
    certificate.parameter_names.push_back(parameter.name);
  }
  FamilyRun<Scalar> run(table, exact, shape.dim);
  std::uint32_t number = 0;
  for (const CaseFamily& family : case_families()) {
    // Each family has numbers of its own: more cases of one leave the others as they are.
    std::seed_seq seeds{options.seed, number++};
    std::mt19937 generator(seeds);
    const CaseContext context{shape, law, certificate.single_precision, generator};
    certificate.families.push_back(run.run(family, context, options.cases));
  }
  return certificate;
}

template Certificate certify(const symgen::AssociationId&, const symgen::Law&,
                             const KernelTable<float>&, const symgen::ExactElement&,
                             const CertifyOptions&);
template Certificate certify(const symgen::AssociationId&, const symgen::Law&,
                             const KernelTable<double>&, const symgen::ExactElement&,
                             const CertifyOptions&);

}  // namespace elastogen::selector
