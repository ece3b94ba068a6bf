#include "symgen/mechanics/node_matrix.h"

namespace elastogen::symgen {
namespace {

NodeId cofactor_of(Dag& dag, const NodeMatrix& m, int row, int column) {
  if (m.size() == 2) {
    const NodeId minor = m[1 - row][1 - column];
    return (row + column) % 2 == 1 ? dag.scale(NumberPool::minus_one, minor) : minor;
  }
  // cyclic indices carry the sign of the cofactor
  const int r1 = (row + 1) % 3, r2 = (row + 2) % 3;
  const int c1 = (column + 1) % 3, c2 = (column + 2) % 3;
  return dag.subtract(dag.multiply(m[r1][c1], m[r2][c2]), dag.multiply(m[r1][c2], m[r2][c1]));
}

}  // namespace

void append(std::vector<NodeId>& entries, const NodeMatrix& matrix) {
  for (const std::vector<NodeId>& row : matrix) {
    entries.insert(entries.end(), row.begin(), row.end());
  }
}

NodeId determinant_of(Dag& dag, const NodeMatrix& m) {
  std::vector<Operand> terms;
  for (std::size_t j = 0; j < m.size(); ++j) {
    terms.push_back(
        {dag.multiply(m[0][j], cofactor_of(dag, m, 0, static_cast<int>(j))), NumberPool::one});
  }
  return dag.sum(std::move(terms));
}

NodeMatrix inverse_of(Dag& dag, const NodeMatrix& m) {
  NodeMatrix inverse(m.size(), std::vector<NodeId>(m.size()));
  const NodeId reciprocal = dag.inverse(determinant_of(dag, m));
  for (std::size_t i = 0; i < m.size(); ++i) {
    for (std::size_t j = 0; j < m.size(); ++j) {
      inverse[i][j] =
          dag.multiply(reciprocal, cofactor_of(dag, m, static_cast<int>(j), static_cast<int>(i)));
    }
  }
  return inverse;
}

NodeMatrix inverse_of_diagonal(Dag& dag, const NodeMatrix& m) {
  NodeMatrix inverse(m.size(), std::vector<NodeId>(m.size(), dag.number(NumberPool::zero)));
  for (std::size_t i = 0; i < m.size(); ++i) inverse[i][i] = dag.inverse(m[i][i]);
  return inverse;
}

NodeMatrix matrix_product(Dag& dag, const NodeMatrix& a, const NodeMatrix& b) {
  NodeMatrix result(a.size(), std::vector<NodeId>(b[0].size()));
  for (std::size_t i = 0; i < a.size(); ++i) {
    for (std::size_t j = 0; j < b[0].size(); ++j) {
      std::vector<Operand> terms;
      for (std::size_t k = 0; k < b.size(); ++k) {
        terms.push_back({dag.multiply(a[i][k], b[k][j]), NumberPool::one});
      }
      result[i][j] = dag.sum(std::move(terms));
    }
  }
  return result;
}

}  // namespace elastogen::symgen
