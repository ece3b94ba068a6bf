// Measures products of a tangent that lies assembled in memory.
#include <eigen3/Eigen/SparseCore>

#include "bench/peers/peer_driver.h"
#include "block_matrix.h"

namespace elastogen::peers {
namespace {

SparseRows read_tangent(const std::filesystem::path& folder) {
  return {read_array<std::int64_t>(folder / "row_begin.i64"),
          read_array<std::int32_t>(folder / "column.i32"),
          read_array<double>(folder / "value.f64")};
}

void print_bytes(const Problem& problem, const char* variant, double bytes) {
  std::printf("# %s: %.1f MB, %.0f bytes per node\n", variant, 1e-6 * bytes,
              bytes / static_cast<double>(problem.num_nodes));
}

using EigenMatrix = Eigen::SparseMatrix<double, Eigen::RowMajor>;

EigenMatrix eigen_matrix(const SparseRows& rows) {
  const auto size = static_cast<Eigen::Index>(rows.row_begin.size() - 1);
  const std::vector<int> row_begin(rows.row_begin.begin(), rows.row_begin.end());
  return Eigen::Map<const EigenMatrix>(size, size, static_cast<Eigen::Index>(rows.value.size()),
                                       row_begin.data(), rows.column.data(), rows.value.data());
}

void measure_eigen(const Problem& problem, const SparseRows& rows) {
  const EigenMatrix tangent = eigen_matrix(rows);
  print_bytes(problem, "eigen", 12.0 * static_cast<double>(tangent.nonZeros()));
  std::vector<double> result(problem.direction.size());
  const auto size = static_cast<Eigen::Index>(result.size());
  const Eigen::Map<const Eigen::VectorXd> direction(problem.direction.data(), size);
  Eigen::Map<Eigen::VectorXd> product(result.data(), size);
  measure(problem, "eigen", "product", result, [&] {
    product.setZero();
    product.noalias() -= tangent * direction;
  });
}

void measure_blocks(const Problem& problem, const SparseRows& rows) {
  const BlockMatrix tangent(rows);
  print_bytes(problem, "blocks", tangent.bytes());
  std::vector<double> result(problem.direction.size());
  measure(problem, "blocks", "product", result,
          [&] { tangent.multiply_negative(problem.direction.data(), result.data()); });
}

void measure_all(Problem problem) {
  const SparseRows rows = read_tangent(problem.folder);
  if (rows.row_begin.size() != problem.positions.size() + 1) {
    throw std::runtime_error("the tangent does not have 3 rows per node");
  }
  std::printf("# Eigen %d.%d.%d\n", EIGEN_WORLD_VERSION, EIGEN_MAJOR_VERSION, EIGEN_MINOR_VERSION);
  measure_eigen(problem, rows);
  measure_blocks(problem, rows);
}

}  // namespace
}  // namespace elastogen::peers

int main(int argc, char** argv) {
  return elastogen::peers::run_driver(argc, argv, elastogen::peers::measure_all);
}
