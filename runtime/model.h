// Model: the elements of a mesh with their kernels and materials, and what simulators ask of them.
#pragma once

#include <Eigen/SparseCore>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "runtime/element_status.h"
#include "runtime/kernel_abi.h"
#include "runtime/mesh.h"
#include "runtime/stress.h"
#include "runtime/tangent.h"
#include "runtime/vector.h"

namespace elastogen {

/// Elements of one mesh block with one association and one material.
struct ModelPart {
  std::size_t block = 0;                         ///< index into Mesh::blocks
  std::vector<std::int32_t> elements;            ///< element indices within the block, from 0
  const KernelTable<double>* kernels = nullptr;  ///< must outlive the model
  std::vector<double> parameters;                ///< in the order of kernels->parameter_names
  double density = 0;                            ///< [kg/m^3], >= 0
  /// Of the same association, for precisions other than double. Then `kernels` needs only the
  /// operations that are in double: energy and forces, or none.
  const KernelTable<float>* single_kernels = nullptr;
};

/// Indices of a block's elements that lie in a region (an index into Mesh::region_names).
[[nodiscard]] std::vector<std::int32_t> elements_of_region(const ElementBlock& block,
                                                           std::int32_t region);

/// Precision of the element kernels. Global vectors and matrices are of doubles in any case, and
/// elements are summed in double.
enum class Precision {
  double_precision,
  /// Energies and forces in double, what the tangent takes in single precision: Newton's method
  /// comes to the same end, conjugate gradient's products have twice the lanes.
  mixed,
  single_precision,  ///< all: residuals cannot fall below about 1e-5 of the forces
};

/// "double", "mixed", "single"
[[nodiscard]] std::string_view precision_name(Precision precision);

/// When regions of the body sleep: their forces are kept instead of computed until they move. For
/// motions in time by explicit schemes, which call forces() once a step; Model::let_sleep() begins.
struct SleepOptions {
  /// Of every component of every node [m]: so far the displacement that kept forces are of may be
  /// from the true one. 0: nothing sleeps.
  double motion = 0;
  int calls = 10;  ///< of forces() that a region must have been as still before it sleeps
};

struct ModelOptions {
  int threads = 0;  ///< OpenMP threads; 0: as many as OpenMP offers and the elements' work pays for
  TangentProduct tangent_product = TangentProduct::recompute;
  /// Products that follow a linearisation, about: what `automatic` compares costs for.
  double products_per_tangent = 20;
  Precision precision = Precision::double_precision;
  /// Elements that are translations of each other, to 1e-12 of their size, share one set of grouped
  /// constants where most elements do: less memory to read, and results that differ by about as
  /// much.
  bool share_constants = true;
  /// Where neighbours stand far apart in memory (mesh_order.h), passes take elements along a curve
  /// through the body and work on copies of the vectors in its order. Results differ by the order
  /// of summation; numbers of nodes and elements stay those of the mesh.
  bool reorder = true;
  /// Nodes whose displacement is 0 in every call. Elements that have no other nodes are left out of
  /// every pass: they have no energy, forces and products; nor does the stiffness have theirs.
  std::vector<std::int32_t> held_nodes = {};
  /// Regions are compact: elements are taken along the curve whatever their order.
  SleepOptions sleep = {};
};

/// Elements that are computed by the same kernels: one part and one geometry variant, those that
/// share their constants apart from those that do not.
struct GroupSummary {
  std::string association;      ///< "stvk-hexa8-q8-none"
  std::string element;          ///< "hexa8"
  std::string geometry;         ///< "general", "affine", "box"
  std::string scalar;           ///< "double", "float"; with Precision::mixed elements are in both
  std::string instruction_set;  ///< of the kernels: "native", "avx2" (KernelTable::instruction_set)
  std::size_t part = 0;         ///< index into the model's parts
  bool at_rest = false;         ///< left out of passes (ModelOptions::held_nodes)
  std::size_t num_elements = 0;
  std::size_t num_batches = 0;
  std::size_t num_shapes = 0;  ///< sets of grouped constants: fewer than elements where they share
  int lanes = 1;
  int num_constants = 0;  ///< grouped constants per element
  int num_state = 0;      ///< state numbers per element, 0 unless the product is two-stage
  /// Stored per element: connectivity, positions where the kernels read them, grouped constants,
  /// state; padding of the last batch not counted.
  std::size_t bytes_per_element = 0;
};

/// What a model has not computed since its construction, and the time that would have taken: the
/// mean time of an element in forces() and product(), less what finding out took.
struct SkippedWork {
  std::size_t elements_at_rest = 0;  ///< with held nodes only
  std::int64_t element_passes = 0;   ///< elements times calls of forces() and product()
  std::int64_t slept = 0;            ///< of these, forces that were kept
  double seconds_saved = 0;
};

/// The discretised body.
///
/// Displacements, forces and directions are node-major vectors of num_dofs() values (vector.h);
/// lengths other than that throw InternalError. Results depend on the number of threads (in the
/// last bits, through the order of summation), never on timing. After construction only the first
/// call of assemble() allocates, and the first linearize() with TangentProduct::assembled.
///
/// A model may be moved but not copied. Its calls share buffers: one at a time per model.
class Model {
 public:
  /// Checks the input, chooses each element's geometry variant ("box" for an axis-aligned box,
  /// "affine" for a tet10 with straight edges, where its association has that, else "general"),
  /// checks every rest shape and computes grouped constants. The mesh is not kept.
  ///
  /// @throws InputError  a rest shape that is inverted or degenerate at a quadrature point, a node
  ///                     number outside the mesh, an element in no part or in two, a node without
  ///                     elements, kernels for another element, too few parameters, a negative
  ///                     density
  /// @throws InternalError  kernels of another ABI version or lane count, or without the
  ///                        operations `constants` and `geometry_measures`; two_stage without
  ///                        `linearize` and `apply`; no single_kernels where they are needed
  Model(const Mesh& mesh, std::span<const ModelPart> parts, const ModelOptions& options = {});
  ~Model();
  Model(Model&&) noexcept;
  Model& operator=(Model&&) noexcept;

  [[nodiscard]] int dim() const;
  [[nodiscard]] std::size_t num_nodes() const;
  [[nodiscard]] std::size_t num_dofs() const;  ///< dim * num_nodes
  [[nodiscard]] std::size_t num_elements() const;
  [[nodiscard]] int num_threads() const;
  /// `automatic` has become what was chosen.
  [[nodiscard]] TangentProduct tangent_product() const;
  [[nodiscard]] Precision precision() const;
  /// Whether the mesh was found scattered and passes go along a curve (ModelOptions::reorder).
  [[nodiscard]] bool is_reordered() const;

  /// Rounding unit of the elements' energies and forces: 2.2e-16 or 1.2e-7.
  [[nodiscard]] double epsilon() const;

  /// Elastic energy W(u) [J].
  [[nodiscard]] double energy(const ConstVectorRef& u);

  /// f += -dW/dU at u [N].
  void forces(const ConstVectorRef& u, VectorRef f);

  /// Makes u the point about which product(), assemble() and diagonal_blocks() work, until the next
  /// call. The values are copied. forces() and energy() leave the point alone; at first it is 0.
  void linearize(const ConstVectorRef& u, TangentForm form = TangentForm::exact);

  /// df += scale * (df/dU) v = -scale * K v about the linearisation point.
  void product(const ConstVectorRef& v, double scale, VectorRef df);

  /// K = d2W/dU2 about the linearisation point, or what stands for it (TangentForm) [N/m]:
  /// symmetric, stored in full, compressed. The matrix's pattern is made at the first call; a
  /// matrix of that pattern is filled in place.
  void assemble(Eigen::SparseMatrix<double>& stiffness);

  /// Diagonal blocks of K, one of dim x dim per node: blocks[(node * dim + i) * dim + j].
  /// Overwritten; resized where needed.
  void diagonal_blocks(std::vector<double>& blocks);

  /// Whether the last energy(), forces(), linearize(), product(), assemble(), diagonal_blocks(),
  /// element_energies() or stress() found every element's result good; if not, the first bad
  /// element.
  [[nodiscard]] const ElementStatus& status() const;

  /// "element 17 (tet4, nodes 3 8 9 12): ..." for a status that is not good.
  [[nodiscard]] std::string describe(const ElementStatus& status) const;

  /// Whether regions may sleep from the next forces() on, as ModelOptions::sleep says; nothing does
  /// at first, nor where that has no motion. Displacements that are tried, as by critical_step(),
  /// are no steps of a motion: call this after them.
  void let_sleep(bool allowed);

  /// Energy of each element at u [J], in mesh order; resized where needed.
  void element_energies(const ConstVectorRef& u, std::vector<double>& energies);

  /// Displacement gradient, stress, energy density and volume at every quadrature point at u;
  /// resized where needed. Elements at rest (ModelOptions::held_nodes) are computed, too. In double
  /// unless the precision is single. Stresses of other kinds: stress_measures.h; at nodes:
  /// nodal_recovery.h.
  /// @throws InternalError  kernels without the operation `stress`
  void stress(const ConstVectorRef& u, StressField& field);

  /// Rest volume of each element [m^dim], in mesh order.
  [[nodiscard]] std::span<const double> element_volumes() const;

  /// Rest volume that belongs to each node: integral of its shape functions [m^dim].
  [[nodiscard]] std::span<const double> nodal_volumes() const;

  /// Consistent mass of each node [kg]: density times nodal volume, summed over its elements. Body
  /// loads act on it; it may be negative at the corners of quadratic elements.
  [[nodiscard]] std::span<const double> nodal_mass() const;

  /// Lumped mass of each node [kg], the inertia: positive, with the body's mass as its sum. For
  /// linear elements the consistent mass; for quadratic ones each element's mass in proportion to
  /// the diagonal of its mass matrix (Hinton, Rock & Zienkiewicz 1976).
  [[nodiscard]] std::span<const double> lumped_mass() const;

  [[nodiscard]] SkippedWork skipped() const;

  /// The groups in the order they are computed.
  [[nodiscard]] std::vector<GroupSummary> groups() const;

  /// Position in groups() for each element, in mesh order; with Precision::mixed of the double one.
  [[nodiscard]] std::vector<std::int32_t> group_of_elements() const;

 private:
  struct Data;
  std::unique_ptr<Data> data_;
};

}  // namespace elastogen
