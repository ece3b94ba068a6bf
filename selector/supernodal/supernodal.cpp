// CHOLMOD's supernodal Cholesky factorisation as a library that is loaded where it pays.
//
// Apart from the program because loading CHOLMOD and a BLAS takes longer than small bodies need
// altogether. Its licence is the GPL.
#include <omp.h>

#include <Eigen/CholmodSupport>
#include <optional>

#include "runtime/cholesky_factor.h"
#include "selector/supernodal/rounded_factor.h"

namespace {

/// CHOLMOD starts four threads for loops of a few hundred turns, however many processors there are:
/// waiting for them takes a quarter of the time. None of them while this lives.
class OneThread {
 public:
  OneThread() { omp_set_max_active_levels(0); }
  ~OneThread() { omp_set_max_active_levels(levels_); }
  OneThread(const OneThread&) = delete;
  OneThread& operator=(const OneThread&) = delete;

 private:
  int levels_ = omp_get_max_active_levels();
};

/// CHOLMOD's factor, which Eigen keeps to itself.
class OpenFactor
    : public Eigen::CholmodSupernodalLLT<elastogen::CholeskyFactor::Matrix, Eigen::Lower> {
 public:
  [[nodiscard]] const cholmod_factor& factor() const { return *m_cholmodFactor; }
};

/// Dense blocks of columns by BLAS, in the matrix's own order.
/// Source: Chen, Davis, Hager & Rajamanickam, Algorithm 887, ACM Trans. Math. Softw. 35 (2008).
class Supernodal final : public elastogen::CholeskyFactor {
 public:
  Supernodal() {
    cholmod_common& settings = factor_.cholmod();
    settings.print = 0;  // the caller says what went wrong
    settings.nmethods = 1;
    settings.method[0].ordering = CHOLMOD_NATURAL;
  }

  void analyze(const Matrix& matrix) override { factor_.analyzePattern(matrix); }
  bool factorize(const Matrix& matrix) override {
    const OneThread one_thread;
    factor_.factorize(matrix);
    rounded_.reset();
    return factor_.info() == Eigen::Success;
  }
  void solve(const elastogen::Vector& b, elastogen::Vector& x) override {
    const OneThread one_thread;
    x = factor_.solve(b);
  }
  void solve_roughly(const elastogen::Vector& b, elastogen::Vector& x) override {
    if (!rounded_) rounded_.emplace(factor_.factor());
    rounded_->solve(b, x);
  }

 private:
  OpenFactor factor_;
  std::optional<elastogen::RoundedFactor> rounded_;  // of the present factor, made when needed
};

}  // namespace

extern "C" elastogen::CholeskyFactor* elastogen_supernodal_cholesky() { return new Supernodal; }
