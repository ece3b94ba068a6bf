// Measures deal.II's matrix-free operators on trilinear hexahedra: FEEvaluation with two points per
// direction. Built twice: with Debian's headers (numbers), and with headers that have vectors.
#include <deal.II/base/mpi.h>
#include <deal.II/base/quadrature_lib.h>
#include <deal.II/dofs/dof_handler.h>
#include <deal.II/fe/fe_q.h>
#include <deal.II/fe/fe_system.h>
#include <deal.II/fe/mapping_q.h>
#include <deal.II/grid/tria.h>
#include <deal.II/lac/affine_constraints.h>
#include <deal.II/lac/la_parallel_vector.h>
#include <deal.II/matrix_free/fe_evaluation.h>
#include <deal.II/matrix_free/matrix_free.h>

#include "bench/peers/peer_driver.h"
#include "laws.h"
#ifdef PEER_VECTORS
#include "instantiations.h"
#endif

namespace elastogen::peers {
namespace {

using Numbers = dealii::VectorizedArray<double>;  // of as many cells as the headers are made for
using Elements = dealii::MatrixFree<3, double, Numbers>;
using Evaluation = dealii::FEEvaluation<3, 1, 2, 3, double, Numbers>;
using Vector = dealii::LinearAlgebra::distributed::Vector<double>;
using CellRange = std::pair<unsigned int, unsigned int>;
constexpr auto gradients = dealii::EvaluationFlags::gradients;

constexpr int num_nodes = 8;
/// VTK's numbers of deal.II's vertices, which are in lexicographic order
constexpr int vtk_nodes[num_nodes] = {0, 1, 3, 2, 4, 5, 7, 6};

void make_triangulation(const Problem& problem, dealii::Triangulation<3>& triangulation) {
  std::vector<dealii::Point<3>> vertices;
  for (std::size_t node = 0; node < problem.num_nodes; ++node) {
    const double* x = &problem.positions[3 * node];
    vertices.emplace_back(x[0], x[1], x[2]);
  }
  std::vector<dealii::CellData<3>> cells(problem.connectivity.size() / num_nodes);
  for (std::size_t cell = 0; cell < cells.size(); ++cell) {
    for (int vertex = 0; vertex < num_nodes; ++vertex) {
      const std::int32_t node = problem.connectivity[num_nodes * cell + vtk_nodes[vertex]];
      cells[cell].vertices[vertex] = static_cast<unsigned int>(node);
    }
  }
  triangulation.create_triangulation(vertices, cells, dealii::SubCellData());
}

/// A problem's mesh as deal.II has it, its degrees of freedom in deal.II's order.
class Mesh {
 public:
  explicit Mesh(const Problem& problem)
      : element_(dealii::FE_Q<3>(1), 3), handler_(triangulation_) {
    make_triangulation(problem, triangulation_);
    handler_.distribute_dofs(element_);
    number_nodes();
    dealii::AffineConstraints<double> constraints;
    constraints.close();
    Elements::AdditionalData options;
    options.tasks_parallel_scheme = Elements::AdditionalData::none;
    options.mapping_update_flags = dealii::update_gradients | dealii::update_JxW_values;
    elements_.reinit(dealii::MappingQ<3>(1), handler_, constraints, dealii::QGauss<1>(2), options);
  }

  [[nodiscard]] const Elements& elements() const { return elements_; }

  [[nodiscard]] Vector zero() const {
    Vector vector;
    elements_.initialize_dof_vector(vector);
    return vector;
  }

  [[nodiscard]] Vector from_nodes(const std::vector<double>& nodal) const {
    Vector vector = zero();
    for (std::size_t k = 0; k < nodal.size(); ++k) vector.local_element(dofs_[k]) = nodal[k];
    return vector;
  }

  void to_nodes(const Vector& vector, std::vector<double>& nodal) const {
    for (std::size_t k = 0; k < nodal.size(); ++k) nodal[k] = vector.local_element(dofs_[k]);
  }

 private:
  void number_nodes() {
    dofs_.resize(handler_.n_dofs());
    for (const auto& cell : handler_.active_cell_iterators()) {
      for (unsigned int vertex = 0; vertex < num_nodes; ++vertex) {
        for (unsigned int i = 0; i < 3; ++i) {
          dofs_[3 * cell->vertex_index(vertex) + i] = cell->vertex_dof_index(vertex, i);
        }
      }
    }
  }

  dealii::Triangulation<3> triangulation_;
  dealii::FESystem<3> element_;
  dealii::DoFHandler<3> handler_;
  std::vector<unsigned int> dofs_;  // of each node's three numbers
  Elements elements_;
};

/// Derivatives of the energy over the whole mesh, for one law. Forces and products have the other
/// sign: deal.II's loop can only add.
template <class Law>
class Passes {
 public:
  Passes(const Elements& elements, const Law& law) : elements_(elements), law_(law) {}

  /// sum = dW/du
  void gradient(const Vector& u, Vector& sum) const {
    elements_.template cell_loop<Vector, Vector>(
        [this](const Elements& elements, Vector& result, const Vector& from,
               const CellRange& cells) {
          Evaluation displacement(elements);
          for (unsigned int cell = cells.first; cell < cells.second; ++cell) {
            read_gradients(displacement, cell, from);
            for (unsigned int q = 0; q < displacement.n_q_points; ++q) {
              displacement.submit_gradient(law_.stress(displacement.get_gradient(q)), q);
            }
            displacement.integrate_scatter(gradients, result);
          }
        },
        sum, u, true);
  }

  /// sum = d2W/du2 v
  void tangent(const Vector& u, const Vector& v, Vector& sum) const {
    elements_.template cell_loop<Vector, Vector>(
        [this, &u](const Elements& elements, Vector& result, const Vector& from,
                   const CellRange& cells) {
          Evaluation displacement(elements), direction(elements);
          for (unsigned int cell = cells.first; cell < cells.second; ++cell) {
            read_gradients(direction, cell, from);
            read_gradients(displacement, cell, u);
            for (unsigned int q = 0; q < direction.n_q_points; ++q) {
              const auto change =
                  law_.stress_change(displacement.get_gradient(q), direction.get_gradient(q));
              direction.submit_gradient(change, q);
            }
            direction.integrate_scatter(gradients, result);
          }
        },
        sum, v, true);
  }

 private:
  static void read_gradients(Evaluation& evaluation, unsigned int cell, const Vector& vector) {
    evaluation.reinit(cell);
    evaluation.gather_evaluate(vector, gradients);
  }

  const Elements& elements_;
  Law law_;
};

template <class Law>
void measure_law(const Problem& problem, const Law& law) {
  const Mesh mesh(problem);
  const Passes<Law> passes(mesh.elements(), law);
  const Vector u = mesh.from_nodes(problem.displacement), v = mesh.from_nodes(problem.direction);
  Vector sum = mesh.zero();
  const auto measure_pass = [&](const char* operation, const auto& pass) {
    const selector::Timing time = selector::time_calls(1, problem.seconds, pass);
    std::vector<double> result(problem.positions.size());
    sum *= -1;
    mesh.to_nodes(sum, result);
    report(problem, PEER_VARIANT, operation, time, result);
  };
  measure_pass("forces", [&] { passes.gradient(u, sum); });
  if constexpr (Law::is_linear) {
    measure_pass("product", [&] { passes.gradient(v, sum); });
  } else {
    measure_pass("product", [&] { passes.tangent(u, v, sum); });
  }
}

void measure_all(Problem problem) {
  std::printf("# %s: deal.II %s, vectors of %zu cells\n", PEER_VARIANT, DEAL_II_PACKAGE_VERSION,
              static_cast<std::size_t>(Numbers::size()));
  if (problem.law == "hooke") {
    measure_law(problem, Hooke{problem.lambda, problem.mu});
  } else if (problem.law == "stvk") {
    measure_law(problem, Stvk{problem.lambda, problem.mu});
  } else {
    measure_law(problem, NeoHookean{problem.lambda, problem.mu});
  }
}

}  // namespace
}  // namespace elastogen::peers

int main(int argc, char** argv) {
  const dealii::Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  return elastogen::peers::run_driver(argc, argv, elastogen::peers::measure_all);
}
