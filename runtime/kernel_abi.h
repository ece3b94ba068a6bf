// The one versioned contract between generated kernels and the runtime that calls them.
//
// Levels of data, each with its index formula (L = lanes of a batch, n = nodes of the element,
// d = space dimensions, a = node, i = component, l = lane):
//
//   batch     L elements of one association and one material, computed together, one per SIMD lane
//   positions, displacement, direction, forces, product   value[(a * d + i) * L + l]
//   constants value[k * L + l]                 grouped constants, k < VariantTable::num_constants
//   state     value[k * L + l]                 stored by linearize, k < VariantTable::num_state
//   energy    value[l]
//   stiffness value[((a * d + i) * n * d + (b * d + j)) * L + l]
//   geometry  value[k * L + l]: k < n: nodal volumes, integral of shape function k over the rest
//             shape [m^d]; n <= k < 2 n: positive shares of the volume for a diagonal mass, of node
//             k - n [m^d] (in linear elements the nodal volumes); 2 n <= k < 2 n + num_points:
//             Jacobian determinant at quadrature point k - 2 n
//   stress    value[(g * 20 + k) * L + l], of quadrature point g, as tensors in space whatever d is:
//             k < 9: displacement gradient H[i * 3 + j] = dU_i/dX_j (plane: last row and column 0);
//             9 <= k < 18: first Piola-Kirchhoff stress P[i * 3 + j] = dW/dH_ij [Pa] (plane strain:
//             with P_33); 18: energy density W [J/m^3]; 19: rest volume w_g det J that the point
//             stands for [m^d]
//   parameters value[k]                        uniform over the batch, in the law's order
//
// All arrays are aligned to 64 bytes. A batch that is not full repeats its last element in the
// empty lanes; the caller drops their results.
//
// Signs: energy W; forces f = -dW/dU; stiffness K = d2W/dU2; product p = (df/dU) V = -K V.
// Kernels overwrite their output; who calls them adds it to what there is (NodalPass below).
#pragma once

#include <cstddef>
#include <cstdint>

namespace elastogen {

inline constexpr std::uint32_t kernel_abi_version = 6;

/// Most lanes that a batch may have: one 64-byte vector, 8 doubles or 16 floats. A table has as
/// many as the vectors that its kernels were compiled for, a power of 2; 1 for scalar kernels.
template <class Scalar>
inline constexpr int most_lanes = static_cast<int>(64 / sizeof(Scalar));

/// Most batches that a kernel computes in one call.
inline constexpr int most_batches_at_once = 4;

/// Numbers that the operation `stress` gives for each quadrature point.
inline constexpr int stress_numbers = 20;

/// Bits of the per-element status; 0 is a good result.
enum KernelStatus : std::uint32_t {
  status_ok = 0,
  status_not_finite = 1,  ///< an output is NaN or infinite, or their sum overflows
  status_outside_domain =
      2,  ///< the law's domain was left (the argument of a logarithm or root <= 0)
};

/// What a kernel reads and writes. A pointer that the operation does not use may be null:
///   constants, geometry   read positions, parameters
///   energy, forces        read positions*, parameters, constants, displacement
///   product               ... and direction
///   linearize             reads as forces, writes state (to output)
///   apply                 reads positions*, parameters, constants, state, direction
///   stiffness             reads as forces
///   stress                reads positions, parameters, displacement
/// *: only where VariantTable::reads_positions says so.
template <class Scalar>
struct KernelArguments {
  const Scalar* positions = nullptr;
  const Scalar* parameters = nullptr;
  const Scalar* constants = nullptr;
  const Scalar* displacement = nullptr;
  const Scalar* direction = nullptr;
  const Scalar* state = nullptr;
  Scalar* output = nullptr;
  std::uint32_t* status = nullptr;  ///< [L], bits are or-ed in; null: not reported
};

/// Computes `count` batches, at most most_batches_at_once. They get what each would get alone, to
/// the bit; kernels that wait for functions fill the wait with the other batches.
template <class Scalar>
using KernelFunction = void (*)(const KernelArguments<Scalar>* batches, int count);

/// A kernel of nodal outputs (forces, product, apply) over batches of one group, from global
/// vectors into one. Global vectors are node-major and of doubles, whatever the kernel's precision:
///   sum[dof - first_dof] += scale * output
/// In single precision gathered values are those less the value of the element's node 0, so that
/// its own motion is not lost in that of the body.
template <class Scalar>
struct NodalPass {
  KernelFunction<Scalar> kernel = nullptr;
  int batches_at_once = 1;
  /// Parameters, and positions, constants, state of set 0 (null: not read); the rest is not used.
  KernelArguments<Scalar> arguments;
  std::size_t positions_stride = 0;      ///< numbers from one set to the next
  std::size_t constants_stride = 0;      ///< likewise
  std::size_t state_stride = 0;          ///< likewise, from batch to batch
  const std::int32_t* shape = nullptr;   ///< [batch]: set of positions and constants; null: batch
  const std::int32_t* dofs = nullptr;    ///< [(batch * n + a) * L + l], d * node
  std::size_t begin = 0, end = 0;        ///< batches to compute
  std::size_t num_elements = 0;          ///< of the group: lanes beyond them are not added
  const double* displacement = nullptr;  ///< null: not read
  const double* direction = nullptr;     ///< likewise
  double scale = 1;
  /// Only the numbers of the elements' nodes are touched.
  double* sum = nullptr;
  std::int32_t first_dof = 0;
};

/// Computes a pass; returns the status bits of all its elements, or-ed together.
template <class Scalar>
using NodalPassFunction = std::uint32_t (*)(const NodalPass<Scalar>&);

/// Time that kernels take for an element whose operands are in cache, in additions
/// (symgen/passes/cost.h): what TangentProduct::automatic compares.
struct KernelCosts {
  double product, linearize, apply;
};

/// The kernels of one geometry variant ("general", "affine", "box") of an association.
template <class Scalar>
struct VariantTable {
  const char* geometry;
  std::int32_t num_constants;
  std::int32_t num_state;
  bool reads_positions;  ///< energy ... stiffness recompute something from the rest positions
  /// How many batches a pass shall give nodal kernels in one call.
  std::int32_t batches_at_once;
  KernelCosts costs;
  KernelFunction<Scalar> constants;
  KernelFunction<Scalar> geometry_measures;  ///< operation `geometry` above
  KernelFunction<Scalar> energy;             ///< null: not generated for this scene; so below
  KernelFunction<Scalar> forces;
  KernelFunction<Scalar> product;
  KernelFunction<Scalar> linearize;
  KernelFunction<Scalar> apply;
  KernelFunction<Scalar> stiffness;
  KernelFunction<Scalar> stress = nullptr;
};

/// Shape functions at points of the reference element, for what is summed over points beside the
/// kernels, such as projections onto nodes.
struct ReferencePoints {
  std::int32_t num_points = 0;
  const double* weights = nullptr;    ///< [g], of the reference volume
  const double* shapes = nullptr;     ///< [g * n + a]: Lambda_a
  const double* gradients = nullptr;  ///< [(g * n + a) * d + k]: d Lambda_a / d xi_k
};

/// One association, as a compiled kernel library exports it.
template <class Scalar>
struct KernelTable {
  std::uint32_t abi_version;
  std::int32_t lanes;       ///< 1, 2, 4 ... most_lanes<Scalar>
  const char* association;  ///< "stvk-hexa8-q8-none"
  const char* element;      ///< "hexa8"
  const char* hash;         ///< content hash of the generated source
  /// What the kernels are compiled for: "x86_64", "avx2", "avx512", or "native" for other flags.
  const char* instruction_set;
  std::int32_t dim;
  std::int32_t num_nodes;
  std::int32_t num_points;
  std::int32_t num_parameters;
  const char* const* parameter_names;
  NodalPassFunction<Scalar> nodal_pass;
  std::int32_t num_variants;  ///< the first is always "general"
  const VariantTable<Scalar>* variants;
  ReferencePoints points{};       ///< those of the quadrature, in its order
  ReferencePoints rich_points{};  ///< of a rule that is exact for products of two shape functions
};

}  // namespace elastogen
