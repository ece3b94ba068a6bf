// CHOLMOD's supernodal Cholesky factorisation as a library that is loaded where it pays.
//
// Apart from the program because loading CHOLMOD and a BLAS takes longer than small bodies need
// altogether. Its licence is the GPL.
#include <Eigen/CholmodSupport>

#include "runtime/cholesky_factor.h"

namespace {

/// Dense blocks of columns by BLAS. Ordering by minimum degree.
/// Source: Chen, Davis, Hager & Rajamanickam, Algorithm 887, ACM Trans. Math. Softw. 35 (2008).
class Supernodal final : public elastogen::CholeskyFactor {
 public:
  Supernodal() { factor_.cholmod().print = 0; }  // the caller says what went wrong

  void analyze(const Matrix& matrix) override { factor_.analyzePattern(matrix); }
  bool factorize(const Matrix& matrix) override {
    factor_.factorize(matrix);
    return factor_.info() == Eigen::Success;
  }
  void solve(const elastogen::Vector& b, elastogen::Vector& x) override { x = factor_.solve(b); }

 private:
  Eigen::CholmodSupernodalLLT<Matrix, Eigen::Lower> factor_;
};

}  // namespace

extern "C" elastogen::CholeskyFactor* elastogen_supernodal_cholesky() { return new Supernodal; }
