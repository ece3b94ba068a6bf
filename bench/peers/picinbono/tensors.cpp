#include "tensors.h"

#include <cmath>

namespace elastogen::peers {
namespace {

double dot(const double* a, const double* b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

void cross(const double* a, const double* b, double* result) {
  for (int i = 0; i < 3; ++i) {
    const int j = (i + 1) % 3, k = (i + 2) % 3;
    result[i] = a[j] * b[k] - a[k] * b[j];
  }
}

void make_cubic_tensors(const TetrahedronGeometry& geometry, double lambda, double mu,
                        StvkTensors<double>& tensors) {
  const auto& a = geometry.gradients;
  const auto& products = geometry.products;
  for (int pair = 0; pair < num_pairs; ++pair) {
    const auto [k, l] = pairs[pair];
    for (int j = 0; j < 4; ++j) {
      for (int i = 0; i < 3; ++i) {
        const double c = lambda / 2 * a[j][i] * products[k][l] + mu / 2 * a[l][i] * products[j][k] +
                         mu / 2 * a[k][i] * products[j][l];
        tensors.c[pair][j][i] = -geometry.volume * c;
      }
    }
  }
}

void make_quartic_tensors(const TetrahedronGeometry& geometry, double lambda, double mu,
                          StvkTensors<double>& tensors) {
  const auto& products = geometry.products;
  for (int j = 0; j < 4; ++j) {
    for (int k = 0; k < 4; ++k) {
      for (int l = 0; l < 4; ++l) {
        for (int m = 0; m < 4; ++m) {
          const double d = lambda / 8 * products[j][k] * products[l][m] +
                           mu / 4 * products[j][m] * products[k][l];
          tensors.d[quartic_places.place[j][k][l][m]] = -geometry.volume * d;
        }
      }
    }
  }
}

}  // namespace

TetrahedronGeometry measure_tetrahedron(const double* const (&x)[4]) {
  double edges[3][3];  // from vertex 0
  for (int j = 0; j < 3; ++j) {
    for (int i = 0; i < 3; ++i) edges[j][i] = x[j + 1][i] - x[0][i];
  }
  TetrahedronGeometry geometry{};
  auto& gradients = geometry.gradients;
  for (int j = 0; j < 3; ++j) cross(edges[(j + 1) % 3], edges[(j + 2) % 3], gradients[j + 1]);
  const double six_volumes = dot(edges[0], gradients[1]);
  geometry.volume = std::abs(six_volumes) / 6;
  for (int i = 0; i < 3; ++i) {
    for (int j = 1; j < 4; ++j) gradients[j][i] /= six_volumes;
    gradients[0][i] = -gradients[1][i] - gradients[2][i] - gradients[3][i];
  }
  for (int j = 0; j < 4; ++j) {
    for (int k = 0; k < 4; ++k) geometry.products[j][k] = dot(gradients[j], gradients[k]);
  }
  return geometry;
}

void make_tensors(const TetrahedronGeometry& geometry, double lambda, double mu,
                  HookeTensors<double>& tensors) {
  for (int pair = 0; pair < num_pairs; ++pair) {
    const auto [j, k] = pairs[pair];
    const double* a_j = geometry.gradients[j];
    const double* a_k = geometry.gradients[k];
    for (int row = 0; row < 3; ++row) {
      for (int column = 0; column < 3; ++column) {
        double b = lambda * a_j[row] * a_k[column] + mu * a_k[row] * a_j[column];
        if (row == column) b += mu * geometry.products[j][k];
        tensors.b[pair][row][column] = -geometry.volume * b;
      }
    }
  }
}

void make_tensors(const TetrahedronGeometry& geometry, double lambda, double mu,
                  StvkTensors<double>& tensors) {
  make_tensors(geometry, lambda, mu, tensors.linear);
  make_cubic_tensors(geometry, lambda, mu, tensors);
  make_quartic_tensors(geometry, lambda, mu, tensors);
}

}  // namespace elastogen::peers
