#include "runtime/earlier_cholesky.h"

#include <utility>

namespace elastogen {
namespace {

// A factorisation costs about as much as so many substitutions and products: 15 on a bending beam
// of hexa20 with 6,675 degrees of freedom, and more in larger bodies, where it grows faster than
// they.
constexpr int worth_of_factorization = 20;

}  // namespace

EarlierCholesky::EarlierCholesky(Model& model, const Constraints& constraints,
                                 std::unique_ptr<CholeskyFactor> factor)
    : model_(model), cholesky_(model, constraints, std::move(factor)) {}

void EarlierCholesky::update(const Vector& added) {
  if (!is_stale_ && has_factor_) return;
  // A mass keeps the condition so low that rounding of the factor does no harm.
  is_bounded_ = added.size() > 0;
  if (is_bounded_) cholesky_.set_added_diagonal(added);
  cholesky_.update();
  is_stale_ = false;
  has_factor_ = false;
}

bool EarlierCholesky::set_shift(double shift) {
  // With another shift the factor is only another one nearby.
  if (!has_factor_) is_new_ = has_factor_ = cholesky_.set_shift(shift);
  return has_factor_;
}

double EarlierCholesky::apply(const Vector& r, Vector& z) {
  if (is_bounded_) {
    cholesky_.solve_roughly(r, z);
  } else {
    cholesky_.substitute(r, z);
  }
  return dot(r, z, model_.num_threads());
}

void EarlierCholesky::note_iterations(int iterations) {
  if (is_new_) iterations_when_new_ = iterations;
  is_new_ = false;
  if (iterations > iterations_when_new_ + worth_of_factorization) is_stale_ = true;
}

}  // namespace elastogen
