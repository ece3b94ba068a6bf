#include "selector/scene/best_cholesky.h"

#include <dlfcn.h>
#include <fmt/format.h>

#include <filesystem>
#include <optional>

#include "runtime/error.h"

namespace elastogen::selector {
namespace {

// Up to here loading and the small blocks cost more than they save (measured on beams and spheres).
constexpr double most_by_columns = 5e7;

std::unique_ptr<CholeskyFactor> load_supernodal() {
  const std::filesystem::path program = std::filesystem::read_symlink("/proc/self/exe");
  const std::filesystem::path library =
      program.parent_path().parent_path() / "libexec" / "elastogen" / "elastogen-supernodal.so";
  // Never closed: factors may live to the program's end.
  void* const handle = dlopen(library.c_str(), RTLD_NOW | RTLD_LOCAL);
  void* const make = handle ? dlsym(handle, "elastogen_supernodal_cholesky") : nullptr;
  if (!make) throw WorkError(fmt::format("the sparse solver cannot be loaded: {}", dlerror()));
  return std::unique_ptr<CholeskyFactor>(reinterpret_cast<CholeskyFactor* (*)()>(make)());
}

class BestCholesky final : public CholeskyFactor {
 public:
  void analyze(const Matrix& matrix) override {
    auto by_columns = std::make_unique<SimplicialCholesky>();
    by_columns->analyze(matrix);
    if (by_columns->multiplications() <= most_by_columns) {
      factor_ = std::move(by_columns);
      return;
    }
    factor_ = load_supernodal();
    factor_->analyze(matrix);
  }
  bool factorize(const Matrix& matrix) override { return factor_->factorize(matrix); }
  void solve(const Vector& b, Vector& x) override { factor_->solve(b, x); }
  void solve_roughly(const Vector& b, Vector& x) override { factor_->solve_roughly(b, x); }
  std::optional<int> negative_pivots(const Matrix& matrix) override {
    return factor_->negative_pivots(matrix);
  }

 private:
  std::unique_ptr<CholeskyFactor> factor_;
};

}  // namespace

std::unique_ptr<CholeskyFactor> make_best_cholesky() { return std::make_unique<BestCholesky>(); }

}  // namespace elastogen::selector
