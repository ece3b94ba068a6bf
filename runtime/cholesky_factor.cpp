#include "runtime/cholesky_factor.h"

#include <Eigen/OrderingMethods>
#include <Eigen/SparseCholesky>

namespace elastogen {
namespace {

template <class Ordering>
class Simplicial final : public CholeskyFactor {
 public:
  void analyze(const Matrix& matrix) override { factor_.analyzePattern(matrix); }
  bool factorize(const Matrix& matrix) override {
    factor_.factorize(matrix);
    return factor_.info() == Eigen::Success;
  }
  void solve(const Vector& b, Vector& x) override { x = factor_.solve(b); }
  [[nodiscard]] double multiplications() const { return factor_.multiplications(); }

 private:
  struct Factor : Eigen::SimplicialLLT<Matrix, Eigen::Lower, Ordering> {
    [[nodiscard]] double multiplications() const {
      return this->m_nonZerosPerCol.template cast<double>().squaredNorm();
    }
  };
  Factor factor_;
};

}  // namespace

SimplicialCholesky::SimplicialCholesky() = default;
SimplicialCholesky::~SimplicialCholesky() = default;

void SimplicialCholesky::analyze(const Matrix& matrix) {
  auto natural = std::make_unique<Simplicial<Eigen::NaturalOrdering<int>>>();
  auto minimum_degree = std::make_unique<Simplicial<Eigen::AMDOrdering<int>>>();
  natural->analyze(matrix);
  minimum_degree->analyze(matrix);
  multiplications_ = std::min(natural->multiplications(), minimum_degree->multiplications());
  if (natural->multiplications() <= minimum_degree->multiplications()) {
    chosen_ = std::move(natural);
  } else {
    chosen_ = std::move(minimum_degree);
  }
}

bool SimplicialCholesky::factorize(const Matrix& matrix) { return chosen_->factorize(matrix); }
void SimplicialCholesky::solve(const Vector& b, Vector& x) { chosen_->solve(b, x); }

}  // namespace elastogen
