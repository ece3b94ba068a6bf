#include "selector/certify/case_families.h"

#include <fmt/format.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <limits>

#include "symgen/law/moduli.h"

namespace elastogen::selector {
namespace {

using symgen::ElementCase;
using Matrix = Eigen::MatrixXd;

double uniform(std::mt19937& generator, double low, double high) {
  return std::uniform_real_distribution<double>(low, high)(generator);
}

/// 10 to a power that is uniform in [low, high].
double magnitude(std::mt19937& generator, double low, double high) {
  return std::pow(10.0, uniform(generator, low, high));
}

Matrix random_matrix(int dim, std::mt19937& generator) {
  return Matrix::NullaryExpr(dim, dim, [&](auto, auto) { return uniform(generator, -1, 1); });
}

Matrix random_rotation(int dim, std::mt19937& generator) {
  const Eigen::HouseholderQR<Matrix> qr(random_matrix(dim, generator));
  Matrix q = qr.householderQ();
  if (q.determinant() < 0) q.col(0) = -q.col(0);
  return q;
}

/// A symmetric gradient whose largest principal value is `strain`.
Matrix random_stretch(int dim, double strain, std::mt19937& generator) {
  const Matrix any = random_matrix(dim, generator);
  const Matrix symmetric = (any + any.transpose()) / 2;
  const Eigen::SelfAdjointEigenSolver<Matrix> solver(symmetric);
  return strain * symmetric / solver.eigenvalues().cwiseAbs().maxCoeff();
}

/// Parameters of a law of about a modulus [Pa]; where they follow from E and nu, of that nu.
std::vector<double> parameters_of(const symgen::Law& law, double modulus, double poisson,
                                  std::mt19937& generator) {
  if (symgen::follows_from_young_poisson(law)) {
    return symgen::parameters_from_young_poisson(law, modulus, poisson);
  }
  std::vector<double> values;
  for (const symgen::Parameter& parameter : law.parameters) {
    // A parameter in powers of Pa scales with the modulus.
    const double unit = std::pow(modulus, parameter.unit.powers[symgen::kilogram].to_double());
    // What may be negative is kept small beside the others: laws with a small negative weight.
    const bool is_signed = !parameter.minimum || parameter.minimum->is_negative();
    double value =
        unit * (is_signed ? uniform(generator, -0.05, 0.05) : uniform(generator, 0.2, 2));
    if (parameter.minimum) value = std::max(value, parameter.minimum->to_double());
    if (parameter.maximum) value = std::min(value, parameter.maximum->to_double());
    values.push_back(value);
  }
  return values;
}

/// A case in the making.
class Maker {
 public:
  explicit Maker(const CaseContext& context) : context_(context), random_(context.generator) {
    case_.parameters =
        parameters_of(context.law, magnitude(random_, 2, 6), uniform(random_, -0.3, 0.45), random_);
    distort();
  }

  [[nodiscard]] int dim() const { return context_.shape.dim; }
  [[nodiscard]] std::mt19937& random() { return random_; }

  Maker& parameters(double modulus, double poisson) {
    case_.parameters = parameters_of(context_.law, modulus, poisson, random_);
    return *this;
  }

  /// X -> A X
  Maker& reshape(const Matrix& a) {
    case_.rest_positions = mapped(a, case_.rest_positions);
    return *this;
  }

  /// One node goes to where the smallest Jacobian determinant is so much of what it was.
  Maker& crumple(double fraction) {
    const auto n = static_cast<std::size_t>(context_.shape.num_nodes);
    const auto d = static_cast<std::size_t>(dim());
    std::vector<double>& x = case_.rest_positions;
    const std::size_t node = random_() % n;
    std::vector<double> start(&x[d * node], &x[d * node] + d), centre(d, 0.0);
    for (std::size_t a = 0; a < n; ++a) {
      for (std::size_t i = 0; i < d && a != node; ++i) {
        centre[i] += x[d * a + i] / static_cast<double>(n - 1);
      }
    }
    const double whole = context_.shape.smallest_determinant(x);
    double low = 0, high = 3;  // along the line through the others' centre: sound, inverted
    for (int step = 0; step < 60; ++step) {
      const double middle = (low + high) / 2;
      for (std::size_t i = 0; i < d; ++i)
        x[d * node + i] = start[i] + middle * (centre[i] - start[i]);
      (context_.shape.smallest_determinant(x) > fraction * whole ? low : high) = middle;
    }
    for (std::size_t i = 0; i < d; ++i) x[d * node + i] = start[i] + low * (centre[i] - start[i]);
    return *this;
  }

  /// u = H X, and noise of a tenth of `strain` that makes it inhomogeneous.
  Maker& displace(const Matrix& h, double strain) {
    case_.displacement = mapped(h, case_.rest_positions);
    const double size = extent() / 2;
    for (double& value : case_.displacement) {
      value += 0.1 * strain * size * uniform(random_, -1, 1);
    }
    return *this;
  }
  Maker& stretch(double strain) { return displace(random_stretch(dim(), strain, random_), strain); }

  /// Turns the deformed shape about the origin.
  Maker& rotate() {
    const Matrix turn = random_rotation(dim(), random_);
    std::vector<double> deformed = case_.rest_positions;
    for (std::size_t k = 0; k < deformed.size(); ++k) deformed[k] += case_.displacement[k];
    deformed = mapped(turn, deformed);
    for (std::size_t k = 0; k < deformed.size(); ++k) {
      case_.displacement[k] = deformed[k] - case_.rest_positions[k];
    }
    return *this;
  }

  Maker& translate(double distance) {
    for (double& value : case_.displacement) value += distance * extent();
    return *this;
  }

  Maker& spoil(double value) {
    case_.displacement[random_() % case_.displacement.size()] = value;
    return *this;
  }

  [[nodiscard]] ElementCase done() {
    const double size = std::max(extent(), std::numeric_limits<double>::min());
    for (std::size_t k = 0; k < case_.rest_positions.size(); ++k) {
      case_.direction.push_back(size * uniform(random_, -1, 1));
    }
    return case_;
  }

 private:
  /// Moves the reference nodes by up to 0.15; by less where that would all but invert the element,
  /// as it does those with nodes in the middle of their edges.
  void distort() {
    const std::vector<double>& nodes = context_.shape.nodes;
    std::vector<double> shift;
    for (std::size_t k = 0; k < nodes.size(); ++k) shift.push_back(uniform(random_, -0.15, 0.15));
    const double whole = context_.shape.smallest_determinant(nodes);
    for (double share = 1;; share /= 2) {
      case_.rest_positions = nodes;
      for (std::size_t k = 0; k < nodes.size(); ++k) case_.rest_positions[k] += share * shift[k];
      if (context_.shape.smallest_determinant(case_.rest_positions) > 0.05 * whole) break;
    }
  }

  [[nodiscard]] std::vector<double> mapped(const Matrix& a, const std::vector<double>& x) const {
    std::vector<double> result(x.size());
    for (std::size_t first = 0; first < x.size(); first += static_cast<std::size_t>(dim())) {
      Eigen::Map<Eigen::VectorXd>(&result[first], dim()) =
          a * Eigen::Map<const Eigen::VectorXd>(&x[first], dim());
    }
    return result;
  }
  [[nodiscard]] double extent() const {
    double size = 0;
    for (std::size_t k = 0; k < case_.rest_positions.size(); ++k) {
      const std::size_t first = k % static_cast<std::size_t>(dim());
      size = std::max(size, std::abs(case_.rest_positions[k] - case_.rest_positions[first]));
    }
    return size;
  }

  const CaseContext& context_;
  std::mt19937& random_;
  ElementCase case_;
};

Matrix diagonal(int dim, double last, double others = 1) {
  Matrix m = others * Matrix::Identity(dim, dim);
  m(dim - 1, dim - 1) = last;
  return m;
}

std::vector<CaseFamily> make_families() {
  std::vector<CaseFamily> families;
  const auto add = [&](const std::string& name, bool well_posed, const auto& make) {
    families.push_back({name, well_posed, usual_digits, [make](const CaseContext& context) {
                          Maker maker(context);
                          make(maker);
                          return maker.done();
                        }});
  };
  for (const double strain : {1e-12, 1e-9, 1e-6, 1e-3, 0.1, 0.5}) {
    add(fmt::format("strain {:g}", strain), true, [=](Maker& m) { m.stretch(strain); });
  }
  add("no displacement", true, [](Maker& m) { m.displace(Matrix::Zero(m.dim(), m.dim()), 0); });
  for (const double strain : {1e-9, 1e-6, 1e-3, 0.1}) {
    add(fmt::format("strain {:g}, rotated", strain), false,
        [=](Maker& m) { m.stretch(strain).rotate(); });
  }
  add("translated by 1e6 sizes", false, [](Maker& m) { m.stretch(0.1).translate(1e6); });
  add("sizes 1e-9 to 1e9 m", false, [](Maker& m) {
    m.reshape(magnitude(m.random(), -9, 9) * Matrix::Identity(m.dim(), m.dim())).stretch(0.01);
  });
  add("moduli 1e-3 to 1e12 Pa", false,
      [](Maker& m) { m.parameters(magnitude(m.random(), -3, 12), 0.3).stretch(0.01); });
  add("nu to 0.5", false,
      [](Maker& m) { m.parameters(1e4, 0.5 - magnitude(m.random(), -7, -2)).stretch(0.01); });
  add("nu to -1", false,
      [](Maker& m) { m.parameters(1e4, -1 + magnitude(m.random(), -7, -1)).stretch(0.01); });
  add("aspect ratios to 1e4", false, [](Maker& m) {
    m.reshape(diagonal(m.dim(), magnitude(m.random(), -4, 4)));
    m.reshape(random_rotation(m.dim(), m.random())).stretch(0.01);
  });
  add("slivers, det dX/dxi to 1e-6", false,
      [](Maker& m) { m.crumple(magnitude(m.random(), -6, -1)).stretch(1e-3); });
  add("equal stretches", false, [](Maker& m) {
    m.displace(uniform(m.random(), -0.3, 0.5) * Matrix::Identity(m.dim(), m.dim()), 0);
  });
  add("nearly equal stretches", false, [](Maker& m) {
    const double stretch = uniform(m.random(), -0.3, 0.5);
    m.displace(diagonal(m.dim(), stretch * (1 + 1e-8), stretch), 0);
  });
  add("strain 1 to 10", false, [](Maker& m) {
    const double size = magnitude(m.random(), 0, 1);
    m.displace(size * random_matrix(m.dim(), m.random()), 0);
  });
  add("det F to 1e-6", false, [](Maker& m) {
    m.displace(diagonal(m.dim(), magnitude(m.random(), -6, -1) - 1, 0), 0).rotate();
  });
  add("det F = 0", false, [](Maker& m) { m.displace(diagonal(m.dim(), -1, 0), 0); });
  add("turned inside out", false, [](Maker& m) {
    m.displace(diagonal(m.dim(), uniform(m.random(), -3, -1.1), 0.1), 0).rotate();
  });
  add("denormal displacement", false, [](Maker& m) {
    const double tiny = 3e-310;  // in float it is 0: no displacement
    m.displace(tiny * random_matrix(m.dim(), m.random()), 0);
  });
  families.back().digits = 700;
  add("not a number", false,
      [](Maker& m) { m.stretch(0.1).spoil(std::numeric_limits<double>::quiet_NaN()); });
  add("infinity", false,
      [](Maker& m) { m.stretch(0.1).spoil(std::numeric_limits<double>::infinity()); });
  return families;
}

}  // namespace

ReferenceShape::ReferenceShape(const symgen::Element& element, const symgen::Quadrature& quadrature)
    : dim(element.dim), num_nodes(element.num_nodes()) {
  const auto number = [](const GiNaC::ex& exact) {
    return GiNaC::ex_to<GiNaC::numeric>(exact.evalf()).to_double();
  };
  for (const std::vector<GiNaC::ex>& node : element.nodes) {
    for (const GiNaC::ex& coordinate : node) nodes.push_back(number(coordinate));
  }
  for (const std::vector<GiNaC::ex>& point : quadrature.points) {
    GiNaC::exmap at_point;
    for (std::size_t j = 0; j < point.size(); ++j) at_point[element.coordinates[j]] = point[j];
    std::vector<double>& slopes = slopes_.emplace_back();
    for (const GiNaC::ex& shape : element.shape_functions) {
      for (const GiNaC::symbol& coordinate : element.coordinates) {
        slopes.push_back(number(shape.diff(coordinate).subs(at_point)));
      }
    }
  }
}

double ReferenceShape::smallest_determinant(const std::vector<double>& positions) const {
  double smallest = std::numeric_limits<double>::infinity();
  for (const std::vector<double>& slopes : slopes_) {
    // [i, j] = sum over nodes of X_i dLambda/dxi_j; both lists are node-major.
    const Eigen::Map<const Eigen::MatrixXd> x(positions.data(), dim, num_nodes);
    const Eigen::Map<const Eigen::MatrixXd> s(slopes.data(), dim, num_nodes);
    smallest = std::min(smallest, (x * s.transpose()).determinant());
  }
  return smallest;
}

const std::vector<CaseFamily>& case_families() {
  static const std::vector<CaseFamily> families = make_families();
  return families;
}

ElementCase rounded(ElementCase input, bool single_precision) {
  if (!single_precision) return input;
  for (auto* values :
       {&input.rest_positions, &input.parameters, &input.displacement, &input.direction}) {
    for (double& value : *values) value = static_cast<double>(static_cast<float>(value));
  }
  return input;
}

ElementCase perturbed(const ElementCase& input, int dim, bool single_precision,
                      std::mt19937& generator) {
  const double epsilon = single_precision
                             ? static_cast<double>(std::numeric_limits<float>::epsilon())
                             : std::numeric_limits<double>::epsilon();
  const auto change = [&](double value) {
    return value * (1 + epsilon * uniform(generator, -1, 1));
  };
  ElementCase result = input;
  for (double& value : result.parameters) value = change(value);
  const auto d = static_cast<std::size_t>(dim);
  for (auto* values : {&result.rest_positions, &result.displacement}) {
    for (std::size_t k = d; k < values->size(); ++k) {
      const double first = (*values)[k % d];
      (*values)[k] = first + change((*values)[k] - first);
    }
  }
  return result;
}

bool is_finite(const ElementCase& input) {
  for (const auto* values :
       {&input.rest_positions, &input.parameters, &input.displacement, &input.direction}) {
    if (!std::all_of(values->begin(), values->end(), [](double v) { return std::isfinite(v); })) {
      return false;
    }
  }
  return true;
}

}  // namespace elastogen::selector
