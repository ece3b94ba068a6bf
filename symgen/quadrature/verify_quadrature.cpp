#include "symgen/quadrature/verify_quadrature.h"

#include <cln/cln.h>

#include <algorithm>

#include "symgen/quadrature/exact_value.h"
#include "symgen/quadrature/reference_integral.h"

namespace elastogen::symgen {
namespace {

using GiNaC::ex;

ex at_point(const Element& element, const ex& function, const std::vector<ex>& point) {
  GiNaC::exmap values;
  for (std::size_t i = 0; i < point.size(); ++i) values[element.coordinates[i]] = point[i];
  return function.subs(values);
}

bool is_exact(const Element& element, const Quadrature& rule, const ex& function) {
  ExactNumber sum(0);
  for (std::size_t g = 0; g < rule.weights.size(); ++g) {
    sum = sum +
          exact_value(rule.weights[g]) * exact_value(at_point(element, function, rule.points[g]));
  }
  return sum == exact_value(integrate_over_reference(element, function));
}

/// Determinant of the gradients of `dim` nodes, one in each row.
ex gradient_determinant(const std::vector<std::vector<ex>>& gradients,
                        const std::vector<std::size_t>& nodes) {
  const auto dim = static_cast<unsigned>(nodes.size());
  GiNaC::matrix rows(dim, dim);
  for (unsigned r = 0; r < dim; ++r) {
    for (unsigned c = 0; c < dim; ++c) rows(r, c) = gradients[nodes[r]][c];
  }
  return rows.determinant().normal();
}

/// det[grad Lambda_a, grad Lambda_b (, grad Lambda_c)] for all a < b (< c), without zeros.
std::vector<ex> gradient_determinants(const Element& element) {
  const std::vector<std::vector<ex>> gradients = shape_gradients(element);
  std::vector<ex> determinants;
  // Every subset of `dim` nodes is one arrangement of the marks.
  std::vector<bool> chosen(gradients.size(), false);
  std::fill_n(chosen.begin(), element.dim, true);
  do {
    std::vector<std::size_t> nodes;
    for (std::size_t a = 0; a < chosen.size(); ++a) {
      if (chosen[a]) nodes.push_back(a);
    }
    const ex value = gradient_determinant(gradients, nodes);
    if (!value.is_zero()) determinants.push_back(value);
  } while (std::prev_permutation(chosen.begin(), chosen.end()));
  return determinants;
}

using Matrix = std::vector<std::vector<cln::cl_F>>;

const cln::float_format_t format = cln::float_format(60);

cln::cl_F float_value(const ex& constant) { return exact_value(constant).to_float(format); }

/// Rank by elimination with complete pivoting. Entries are of order one with rounding errors of
/// about 1e-60; pivots that exact arithmetic would make zero stay far below 1e-30.
int rank(Matrix matrix) {
  const cln::cl_F tolerance = cln::cl_float(cln::expt(cln::cl_RA(10), -30), format);
  std::size_t done = 0;
  const std::size_t num_columns = matrix.front().size();
  while (done < matrix.size() && done < num_columns) {
    std::size_t row = done, column = done;
    for (std::size_t i = done; i < matrix.size(); ++i) {
      for (std::size_t j = done; j < num_columns; ++j) {
        if (cln::abs(matrix[i][j]) > cln::abs(matrix[row][column])) {
          row = i;
          column = j;
        }
      }
    }
    if (cln::abs(matrix[row][column]) < tolerance) break;
    std::swap(matrix[done], matrix[row]);
    for (std::vector<cln::cl_F>& line : matrix) std::swap(line[done], line[column]);
    for (std::size_t i = done + 1; i < matrix.size(); ++i) {
      const cln::cl_F factor = matrix[i][done] / matrix[done][done];
      for (std::size_t j = done; j < num_columns; ++j) {
        matrix[i][j] = matrix[i][j] - factor * matrix[done][j];
      }
    }
    ++done;
  }
  return static_cast<int>(done);
}

using Vectors = std::vector<std::vector<cln::cl_F>>;  ///< [a][i]

/// cof(J) grad Lambda_a, that is det J times the gradient in the rest shape, at one point. The
/// factor does not change the rank and saves the inverse.
Vectors scaled_rest_gradients(const Vectors& reference, const Vectors& positions) {
  const std::size_t dim = reference.front().size();
  Vectors jacobian(dim, std::vector<cln::cl_F>(dim, cln::cl_float(cln::cl_I(0), format)));
  for (std::size_t a = 0; a < reference.size(); ++a) {
    for (std::size_t i = 0; i < dim; ++i) {
      for (std::size_t j = 0; j < dim; ++j) {
        jacobian[i][j] = jacobian[i][j] + positions[a][i] * reference[a][j];
      }
    }
  }
  const auto cofactor = [&](std::size_t i, std::size_t j) -> cln::cl_F {
    if (dim == 2) return i == j ? jacobian[1 - i][1 - j] : -jacobian[1 - i][1 - j];
    const std::size_t i1 = (i + 1) % 3, i2 = (i + 2) % 3, j1 = (j + 1) % 3, j2 = (j + 2) % 3;
    return jacobian[i1][j1] * jacobian[i2][j2] - jacobian[i1][j2] * jacobian[i2][j1];
  };
  Vectors result = reference;
  for (std::size_t a = 0; a < reference.size(); ++a) {
    for (std::size_t i = 0; i < dim; ++i) {
      result[a][i] = cofactor(i, 0) * reference[a][0];
      for (std::size_t j = 1; j < dim; ++j) {
        result[a][i] = result[a][i] + cofactor(i, j) * reference[a][j];
      }
    }
  }
  return result;
}

}  // namespace

int polynomial_degree(const Element& element, const Quadrature& rule, int limit) {
  const std::vector<GiNaC::symbol> coordinates = reference_coordinates();
  for (int degree = 0; degree <= limit; ++degree) {
    for (int a = 0; a <= degree; ++a) {
      for (int b = element.dim == 2 ? degree - a : 0; a + b <= degree; ++b) {
        const ex monomial = GiNaC::pow(coordinates[0], a) * GiNaC::pow(coordinates[1], b) *
                            GiNaC::pow(coordinates[2], degree - a - b);
        if (!is_exact(element, rule, monomial)) return degree - 1;
      }
    }
  }
  return limit;
}

bool integrates_shape_gradients(const Element& element, const Quadrature& rule) {
  const std::vector<ex> determinants = gradient_determinants(element);
  return std::all_of(determinants.begin(), determinants.end(),
                     [&](const ex& value) { return is_exact(element, rule, value); });
}

bool integrates_nodal_volumes(const Element& element, const Quadrature& rule) {
  for (const ex& determinant : gradient_determinants(element)) {
    for (const ex& function : element.shape_functions) {
      if (!is_exact(element, rule, (function * determinant).normal())) return false;
    }
  }
  return true;
}

int stiffness_rank(const Element& element, const Quadrature& rule,
                   const std::vector<std::vector<ex>>& positions) {
  Vectors rest;
  for (const std::vector<ex>& position : positions) {
    std::vector<cln::cl_F> row;
    for (const ex& component : position) row.push_back(float_value(component));
    rest.push_back(row);
  }
  const std::vector<std::vector<ex>> gradients = shape_gradients(element);
  const cln::cl_F zero = cln::cl_float(cln::cl_I(0), format);
  Matrix strains;
  for (const std::vector<ex>& point : rule.points) {
    Vectors reference;
    for (const std::vector<ex>& gradient : gradients) {
      std::vector<cln::cl_F> row;
      for (const ex& component : gradient) {
        row.push_back(float_value(at_point(element, component, point)));
      }
      reference.push_back(row);
    }
    const Vectors gradient = scaled_rest_gradients(reference, rest);
    const auto dim = static_cast<std::size_t>(element.dim);
    for (std::size_t i = 0; i < dim; ++i) {
      for (std::size_t j = i; j < dim; ++j) {
        std::vector<cln::cl_F> row(dim * gradient.size(), zero);
        for (std::size_t a = 0; a < gradient.size(); ++a) {
          row[dim * a + i] = row[dim * a + i] + gradient[a][j];
          row[dim * a + j] = row[dim * a + j] + gradient[a][i];
        }
        strains.push_back(row);
      }
    }
  }
  return rank(strains);
}

}  // namespace elastogen::symgen
