#include "runtime/vector.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace elastogen {
namespace {

// Pieces of a dot product; each is summed by one thread, then the pieces in order.
constexpr Eigen::Index num_pieces = 64;

double dot_piece(const double* x, const double* y, Eigen::Index begin, Eigen::Index end) {
  double sum = 0;
#pragma omp simd reduction(+ : sum)
  for (Eigen::Index i = begin; i < end; ++i) sum += x[i] * y[i];
  return sum;
}

}  // namespace

double dot(const ConstVectorRef& x, const ConstVectorRef& y, int threads) {
  const Eigen::Index n = x.size();
  const Eigen::Index length = (n + num_pieces - 1) / num_pieces;
  const double* px = x.data();
  const double* py = y.data();
  std::array<double, num_pieces> sums;
#pragma omp parallel for schedule(static) num_threads(threads) if (n > parallel_length)
  for (Eigen::Index piece = 0; piece < num_pieces; ++piece) {
    sums[static_cast<std::size_t>(piece)] =
        dot_piece(px, py, std::min(n, piece * length), std::min(n, (piece + 1) * length));
  }
  double sum = 0;
  for (const double s : sums) sum += s;
  return sum;
}

double norm(const ConstVectorRef& x, int threads) { return std::sqrt(dot(x, x, threads)); }

void axpy(double a, const ConstVectorRef& x, VectorRef y, int threads) {
  const Eigen::Index n = x.size();
  const double* px = x.data();
  double* py = y.data();
#pragma omp parallel for simd schedule(static) num_threads(threads) if (n > parallel_length)
  for (Eigen::Index i = 0; i < n; ++i) py[i] += a * px[i];
}

void xpby(const ConstVectorRef& x, double b, VectorRef y, int threads) {
  const Eigen::Index n = x.size();
  const double* px = x.data();
  double* py = y.data();
#pragma omp parallel for simd schedule(static) num_threads(threads) if (n > parallel_length)
  for (Eigen::Index i = 0; i < n; ++i) py[i] = px[i] + b * py[i];
}

}  // namespace elastogen
