#include "runtime/elimination_order.h"

#include <Eigen/OrderingMethods>
#include <algorithm>

#include "runtime/cholesky_factor.h"

namespace elastogen {
namespace {

using Matrix = Eigen::SparseMatrix<double>;
using Permutation = Eigen::PermutationMatrix<Eigen::Dynamic, Eigen::Dynamic, int>;

/// An entry for each pair of nodes that have one between them.
Matrix node_graph(const Matrix& stiffness, int dim) {
  const Eigen::Index num_nodes = stiffness.cols() / dim;
  Matrix graph(num_nodes, num_nodes);
  graph.resizeNonZeros(stiffness.nonZeros() / (dim * dim));
  int* inner = graph.innerIndexPtr();
  int* outer = graph.outerIndexPtr();
  *outer = 0;
  for (Eigen::Index node = 0; node < num_nodes; ++node) {
    const int begin = stiffness.outerIndexPtr()[dim * node];
    const int end = stiffness.outerIndexPtr()[dim * node + 1];
    for (int k = begin; k < end; k += dim) *inner++ = stiffness.innerIndexPtr()[k] / dim;
    *++outer = static_cast<int>(inner - graph.innerIndexPtr());
  }
  std::fill_n(graph.valuePtr(), graph.nonZeros(), 1.0);
  return graph;
}

double multiplications(const Matrix& graph, const Permutation& position) {
  Matrix permuted(graph.rows(), graph.cols());
  permuted.selfadjointView<Eigen::Lower>() =
      graph.selfadjointView<Eigen::Lower>().twistedBy(position);
  SimplicialCholesky factor;
  factor.analyze(permuted);
  return factor.multiplications();
}

}  // namespace

std::vector<std::int32_t> elimination_order(const Matrix& stiffness, int dim) {
  const Matrix graph = node_graph(stiffness, dim);
  Permutation own(graph.cols());
  own.setIdentity();
  Permutation order;
  Eigen::AMDOrdering<int>()(graph, order);
  if (multiplications(graph, own) <= multiplications(graph, order.inverse())) order = own;
  return {order.indices().begin(), order.indices().end()};
}

}  // namespace elastogen
