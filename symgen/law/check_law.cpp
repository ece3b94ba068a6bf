#include "symgen/law/check_law.h"

#include <cln/cln.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <random>

#include "symgen/dag/evaluate.h"
#include "symgen/law/expression_text.h"
#include "symgen/law/reference_state.h"
#include "symgen/law/rest_state.h"
#include "symgen/law/working_precision.h"
#include "symgen/mechanics/density_graph.h"

namespace elastogen::symgen {
namespace {

using GiNaC::ex;
using GiNaC::matrix;
using GiNaC::numeric;

constexpr int digits = 60;      // of measurements
constexpr double same = 1e-40;  // relative difference that rounding explains
constexpr int num_deformations = 4;

using Random = std::mt19937;

/// Entries are multiples of size/1000; only the leading dim x dim block is filled.
matrix random_gradient(const numeric& size, int dim, Random& generator) {
  std::uniform_int_distribution<int> entry(-1000, 1000);
  matrix result(3, 3);
  for (int i = 0; i < dim; ++i) {
    for (int j = 0; j < dim; ++j) {
      result(static_cast<unsigned>(i), static_cast<unsigned>(j)) =
          size * numeric(entry(generator), 1000);
    }
  }
  return result;
}

/// The rotation of an integer quaternion: rational, hence exact.
matrix rotation(const numeric& w, const numeric& x, const numeric& y, const numeric& z) {
  const numeric n = w * w + x * x + y * y + z * z;
  const matrix q{{1 - 2 * (y * y + z * z) / n, 2 * (x * y - w * z) / n, 2 * (x * z + w * y) / n},
                 {2 * (x * y + w * z) / n, 1 - 2 * (x * x + z * z) / n, 2 * (y * z - w * x) / n},
                 {2 * (x * z - w * y) / n, 2 * (y * z + w * x) / n, 1 - 2 * (x * x + y * y) / n}};
  return q;
}

matrix identity() { return GiNaC::ex_to<matrix>(GiNaC::unit_matrix(3)); }

numeric size_of(const matrix& m) {
  numeric largest = 0;
  for (unsigned c = 0; c < 9; ++c) {
    largest = std::max(largest, numeric(GiNaC::abs(GiNaC::ex_to<numeric>(m(c / 3, c % 3)))));
  }
  return largest;
}

double relative(const numeric& difference, const numeric& scale) {
  return scale.is_zero() ? GiNaC::abs(difference).to_double()
                         : (GiNaC::abs(difference) / GiNaC::abs(scale)).to_double();
}

cln::cl_R cln_value(const ex& number) {
  return cln::the<cln::cl_R>(GiNaC::ex_to<numeric>(number.evalf()).to_cl_N());
}

ex energy_of(const Law& law) {
  ex sum = 0;
  for (const LawTerm& term : law.terms) sum += term.expression;
  return sum;
}

class Check {
 public:
  explicit Check(const Law& law)
      : law_(law), precision_(digits), samples_(admissible_samples(law)) {
    result_.stress = stress_form(energy_of(law));
  }

  LawCheck run() {
    for (const LawTerm& term : law_.terms) check_term(term);
    note_moduli_undeclared();
    if (samples_.empty()) {
      add("admissible parameters", "", Evidence::measured, false,
          "no values within all ranges were found; widen 'minimum' ... 'maximum'");
    }
    if (!find_rest_tangent()) {
      // Where a term is not even stress-free, that is what its author has to mend.
      if (!result_.holds()) return std::move(result_);
      add("positive definite at rest", "", Evidence::proved, false,
          "the tangent is not finite at rest, where every run starts: write the energy so that its "
          "second derivatives exist there (no roots of what vanishes at rest)");
      return std::move(result_);
    }
    check_positive_definite();
    check_moduli();
    if (samples_.empty() || !result_.holds()) return std::move(result_);
    check_derivatives();
    measure_digits();
    return std::move(result_);
  }

 private:
  void add(const char* name, const std::string& term, Evidence evidence, bool holds,
           std::string detail) {
    result_.properties.push_back({name, term, evidence, holds, std::move(detail)});
  }

  void check_term(const LawTerm& term) {
    const RestState rest = rest_state(term.expression);
    for (const auto& [name, fault] : {std::pair{"zero energy at rest", energy_fault(rest)},
                                      std::pair{"stress-free at rest", stress_fault(rest)}}) {
      add(name, term.name, Evidence::proved, fault.empty(), fault);
    }
    const bool is_objective = !term.expression.has(find_invariant("tr_eps").symbol) &&
                              !term.expression.has(find_invariant("tr_eps2").symbol);
    if (is_objective) {
      add("objective", term.name, Evidence::proved, true, "written in invariants of C alone");
    } else {
      measure_objectivity(term);
    }
  }

  /// Energy before and after a rotation, with the same parameters.
  void measure_objectivity(const LawTerm& term) {
    Random generator(2);
    const std::vector<matrix> rotations = {rotation(3, 1, 0, 0), rotation(5, 1, 2, -1),
                                           rotation(1, 2, -3, 1)};
    double change = 0;
    for (const matrix& q : rotations) {
      const matrix before = random_gradient(numeric(1, 10), 3, generator);
      const matrix after = q.mul(identity().add(before)).sub(identity());
      if (samples_.empty()) break;
      const auto w0 = reference_energy(term.expression, before, samples_.front().values);
      const auto w1 = reference_energy(term.expression, after, samples_.front().values);
      if (!w0 || !w1) continue;
      change = std::max(change, relative(*w1 - *w0, *w0));
    }
    const std::string found = fmt::format(
        "a rotation changes the energy {:.3g}-fold: tr_eps and tr_eps2 see rotations", change);
    if (change < same) {
      add("objective", term.name, Evidence::measured, true, "rotations leave the energy as it is");
    } else if (law_.small_strain) {
      add("objective", term.name, Evidence::stated, true,
          found + "; small_strain = true says so: for small displacements and rotations only");
    } else {
      add("objective", term.name, Evidence::measured, false,
          found +
              "; write the law in trE and trE2, or say that it is for small displacements "
              "only: small_strain = true");
    }
  }

  void note_moduli_undeclared() {
    if (!law_.moduli && !follows_from_young_poisson(law_)) {
      result_.notes.push_back(
          "the file declares no moduli to compare with: give every parameter a "
          "from_young_poisson, or add [moduli] with lambda and mu");
    }
    const bool is_small =
        std::any_of(result_.properties.begin(), result_.properties.end(),
                    [](const LawProperty& p) { return p.evidence == Evidence::stated; });
    if (law_.small_strain && !is_small) {
      result_.notes.push_back("small_strain = true is needless: every term is objective");
    }
  }

  /// The 6 x 6 tangent on symmetric strains; false where it is not finite.
  bool find_rest_tangent() {
    const std::vector<ex> tangent = rest_tangent_of(law_);
    if (tangent.empty()) return false;
    result_.moduli = moduli_of(tangent);
    static constexpr int pairs[6][2] = {{0, 0}, {1, 1}, {2, 2}, {1, 2}, {0, 2}, {0, 1}};
    for (const auto& [i, j] : pairs) {
      std::vector<ex> row;
      for (const auto& [k, l] : pairs) {
        const auto entry = [&](int a, int b, int c, int d) {
          return tangent[static_cast<std::size_t>((a * 3 + b) * 9 + c * 3 + d)];
        };
        row.push_back(
            ((entry(i, j, k, l) + entry(i, j, l, k) + entry(j, i, k, l) + entry(j, i, l, k)) / 4)
                .normal());
      }
      result_.rest_tangent.push_back(std::move(row));
    }
    return true;
  }

  /// The eigenvalues of an isotropic tangent on symmetric strains are 2 mu (five times) and
  /// 3 lambda + 2 mu.
  void check_positive_definite() {
    const char* name = "positive definite at rest";
    const ex shear = result_.moduli.mu;
    const ex bulk = (3 * result_.moduli.lambda + 2 * shear).normal();
    if (follows_from_young_poisson(law_) && equals_young_poisson()) {
      add(name, "", Evidence::proved, true,
          "2 mu = young/(1 + poisson) and 3 lambda + 2 mu = young/(1 - 2*poisson) are positive");
      if (!is_plainly_positive(shear, law_) || !is_plainly_positive(bulk, law_)) {
        result_.notes.push_back(fmt::format(
            "parameters given directly, not by young and poisson, must have {} > 0 and {} > 0; "
            "their ranges do not ensure that",
            expression_text(shear), expression_text(bulk)));
      }
      return;
    }
    if (is_plainly_positive(shear, law_) && is_plainly_positive(bulk, law_)) {
      add(name, "", Evidence::proved, true,
          fmt::format("2 mu = 2*({}) and 3 lambda + 2 mu = {} are positive within the ranges",
                      expression_text(shear), expression_text(bulk)));
      return;
    }
    for (const ParameterSample& sample : samples_) {
      for (const auto& [what, value] :
           {std::pair{"mu", shear}, std::pair{"3 lambda + 2 mu", bulk}}) {
        const auto number = value_of(value, sample);
        if (number && number->is_positive()) continue;
        add(name, "", Evidence::measured, false,
            fmt::format("{} at rest is {} at {}, must be > 0; narrow the parameters' ranges", what,
                        number ? fmt::format("{:.6g}", number->to_double()) : "not real",
                        sample.text));
        return;
      }
    }
    add(name, "", Evidence::measured, true,
        fmt::format("2 mu and 3 lambda + 2 mu are positive at {} admissible choices of parameters",
                    samples_.size()));
  }

  std::optional<numeric> value_of(const ex& expression, const ParameterSample& sample) const {
    try {
      const ex value = expression.subs(sample.values).evalf();
      if (GiNaC::is_a<numeric>(value) && GiNaC::ex_to<numeric>(value).is_real()) {
        return GiNaC::ex_to<numeric>(value);
      }
    } catch (const std::exception&) {  // GiNaC's, at a pole
    }
    return std::nullopt;
  }

  [[nodiscard]] bool equals_young_poisson() const {
    const GiNaC::exmap formulas = parameters_of_young_poisson(law_);
    const RestModuli expected = moduli_of_young_poisson();
    return (result_.moduli.lambda.subs(formulas) - expected.lambda).normal().is_zero() &&
           (result_.moduli.mu.subs(formulas) - expected.mu).normal().is_zero();
  }

  void check_moduli() {
    if (follows_from_young_poisson(law_)) {
      compare_moduli(parameters_of_young_poisson(law_), moduli_of_young_poisson(),
                     "from_young_poisson");
    }
    if (law_.moduli) compare_moduli({}, {law_.moduli->lambda, law_.moduli->mu}, "[moduli]");
  }

  /// What is equal by more than algebra of quotients (roots of products ...) counts as different:
  /// the law's author can write both alike.
  void compare_moduli(const GiNaC::exmap& formulas, const RestModuli& declared,
                      const std::string& by) {
    std::string differences;
    for (const auto& [name, found, expected] :
         {std::tuple{"lambda", result_.moduli.lambda, declared.lambda},
          std::tuple{"mu", result_.moduli.mu, declared.mu}}) {
      const ex difference = (found.subs(formulas) - expected).normal();
      if (difference.is_zero()) continue;
      differences += fmt::format("{}{} at rest is {}; {} says {}", differences.empty() ? "" : "; ",
                                 name, expression_text(found.subs(formulas).normal()), by,
                                 expression_text(expected));
    }
    add("moduli at rest", "", Evidence::proved, differences.empty(),
        differences.empty() ? fmt::format("lambda and mu are those of {}", by)
                            : differences + "; mend the energy or the declaration");
  }

  /// The graph that kernels are made from against the printed formulas.
  void check_derivatives() {
    double difference = 0, asymmetry = 0;
    int compared = 0;
    Random generator(3);
    for (const int dim : {3, 2}) {
      const DensityGraph graph = build_density_graph(law_, energy_density(law_, dim, {}));
      for (int k = 0; k < num_deformations; ++k) {
        const ParameterSample& sample = samples_[static_cast<std::size_t>(k) % samples_.size()];
        compared += compare_at(graph, dim, sample, generator, difference, asymmetry);
      }
    }
    const std::string where =
        fmt::format("at {} random deformations in 3D and plane strain", compared);
    add("stress and tangent", "", Evidence::measured,
        compared > 0 && difference<same, compared> 0
            ? fmt::format("the generator's and the printed formulas differ by {:.1e} {}",
                          difference, where)
            : "the law is defined at no deformation that was tried, however small");
    add("symmetric tangent", "", Evidence::measured, compared > 0 && asymmetry < same,
        fmt::format("d2W/dH2 differs from its transpose by {:.1e} {}", asymmetry, where));
  }

  /// 1 if the law is defined there, else 0. Deformations outside the domain are halved first.
  int compare_at(const DensityGraph& graph, int dim, const ParameterSample& sample,
                 Random& generator, double& difference, double& asymmetry) const {
    matrix h = random_gradient(numeric(1, 5), dim, generator);
    const matrix dh = random_gradient(1, dim, generator);
    std::optional<ReferenceState> expected;
    for (int halved = 0; halved < 20 && !expected; ++halved) {
      if (halved > 0) h = h.mul_scalar(numeric(1, 2));
      expected = reference_state(energy_of(law_), result_.stress, h, dh, sample.values);
    }
    if (!expected) return 0;
    const std::size_t size = graph.gradient.size();
    const auto component = [&](const matrix& m, std::size_t c) {
      const auto d = static_cast<std::size_t>(dim);
      return GiNaC::ex_to<numeric>(m(static_cast<unsigned>(c / d), static_cast<unsigned>(c % d)));
    };
    std::vector<NodeId> roots = graph.stress;
    for (const std::vector<NodeId>& row : graph.tangent) {
      roots.insert(roots.end(), row.begin(), row.end());
    }
    roots.push_back(graph.energy);
    std::map<NodeId, cln::cl_R> inputs;
    for (std::size_t c = 0; c < size; ++c) inputs[graph.gradient[c]] = cln_value(component(h, c));
    for (std::size_t p = 0; p < law_.parameters.size(); ++p) {
      inputs[graph.parameters[p]] = cln_value(sample.values.at(law_.parameters[p].symbol));
    }
    const std::vector<cln::cl_R> values = evaluate<ClnArithmetic>(
        graph.dag, roots, ClnArithmetic(digits), [&](NodeId id) { return inputs.at(id); });
    const auto tangent = [&](std::size_t c, std::size_t e) {
      return numeric(values[size + c * size + e]);
    };
    numeric largest = 0;
    for (std::size_t c = 0; c < size * size; ++c) {
      largest = std::max(largest, numeric(GiNaC::abs(tangent(c / size, c % size))));
    }
    const auto see = [](double& worst, const numeric& error, const numeric& scale) {
      worst = std::max(worst, relative(error, scale));
    };
    see(difference, numeric(values.back()) - expected->energy, expected->energy);
    for (std::size_t c = 0; c < size; ++c) {
      see(difference, numeric(values[c]) - component(expected->stress, c),
          size_of(expected->stress));
      numeric change = 0;
      for (std::size_t e = 0; e < size; ++e) {
        change += tangent(c, e) * component(dh, e);
        see(asymmetry, tangent(c, e) - tangent(e, c), largest);
      }
      see(difference, change - component(expected->stress_change, c), largest);
    }
    return 1;
  }

  void measure_digits() {
    for (std::size_t l = 0; l < law_.terms.size(); ++l) {
      Law one_term = law_;
      one_term.terms = {law_.terms[l]};
      const EnergyDensity energy = energy_density(one_term, 3, {});
      const DensityGraph graph = build_density_graph(one_term, energy);
      SmallStrainDigits entry{law_.terms[l].name, energy.stabilised.front(), {}};
      for (const double strain : digit_strains()) {
        entry.digits.push_back(right_digits(graph, law_.terms[l].expression, strain));
      }
      if (!entry.stabilised) {
        result_.notes.push_back(fmt::format(
            "term '{}' has a form that is not recognised (docs/laws.md): it is not rewritten for "
            "small strain, and its stress keeps {} of 16 digits at a strain of 1e-6, {} at 1e-10",
            entry.term, entry.digits[2], entry.digits[4]));
      }
      result_.digits.push_back(std::move(entry));
    }
  }

  /// The fewest over some deformations of one size; exact input of both arithmetics is the same.
  [[nodiscard]] int right_digits(const DensityGraph& graph, const ex& term, double strain) const {
    const WorkingPrecision wide(100);
    const auto exact = [](double value) { return numeric(cln::rational(cln::cl_DF(value))); };
    const StressForm form = stress_form(term);
    GiNaC::exmap parameters;
    std::map<NodeId, double> inputs;
    for (std::size_t p = 0; p < law_.parameters.size(); ++p) {
      const GiNaC::symbol& symbol = law_.parameters[p].symbol;
      const double value =
          GiNaC::ex_to<numeric>(samples_.front().values.at(symbol).evalf()).to_double();
      inputs[graph.parameters[p]] = value;
      parameters[symbol] = exact(value);
    }
    Random generator(4);
    std::uniform_real_distribution<double> uniform(-strain, strain);
    int fewest = 16;
    for (int k = 0; k < num_deformations; ++k) {
      matrix h(3, 3);
      for (unsigned c = 0; c < 9; ++c) {
        const double value = uniform(generator);
        inputs[graph.gradient[c]] = value;
        h(c / 3, c % 3) = exact(value);
      }
      const auto expected = reference_state(term, form, h, matrix(3, 3), parameters);
      if (!expected) continue;
      const std::vector<double> stress = evaluate<DoubleArithmetic>(
          graph.dag, graph.stress, {}, [&](NodeId id) { return inputs.at(id); });
      double error = 0;
      const numeric scale = size_of(expected->stress);
      for (unsigned c = 0; c < 9; ++c) {
        if (!std::isfinite(stress[c])) return 0;
        error = std::max(error, relative(exact(stress[c]) -
                                             GiNaC::ex_to<numeric>(expected->stress(c / 3, c % 3)),
                                         scale));
      }
      const int right = error == 0 ? 16 : static_cast<int>(std::lround(-std::log10(error)));
      fewest = std::clamp(right, 0, fewest);
    }
    return fewest;
  }

  const Law& law_;
  WorkingPrecision precision_;
  std::vector<ParameterSample> samples_;
  LawCheck result_;
};

}  // namespace

std::string evidence_name(Evidence evidence) {
  switch (evidence) {
    case Evidence::proved:
      return "proved";
    case Evidence::measured:
      return "measured";
    case Evidence::stated:
      break;
  }
  return "stated";
}

const std::vector<double>& digit_strains() {
  static const std::vector<double> strains = {1e-2, 1e-4, 1e-6, 1e-8, 1e-10};
  return strains;
}

bool LawCheck::holds() const {
  return std::all_of(properties.begin(), properties.end(),
                     [](const LawProperty& property) { return property.holds; });
}

LawCheck check_law(const Law& law) { return Check(law).run(); }

}  // namespace elastogen::symgen
