// The generator's stages in order. Read this first.
//
//   law, element, quadrature          symgen/law, symgen/element, symgen/quadrature
//     -> energy density W(H)          symgen/mechanics/energy        (GiNaC, definitions not
//     expanded)
//     -> lowered expression DAG       symgen/dag/lower               (exact numbers, hash-consed)
//     -> energies of the element      symgen/mechanics/element_graph (per law term and Gauss point,
//                                     or at any one point, of gradients in reference coordinates)
//     -> forces, product              symgen/dag/differentiate       (reverse, then forward mode)
//                                     or symgen/mechanics/ginac_derivatives (--derive ginac)
//     -> fragments                    symgen/passes/split
//     -> factored, common pairs out   symgen/passes/factor, group_stages, share_pairs
//     -> fewer numbers                symgen/passes/balance_numbers, absorb_factor
//     -> grouped constants, state     symgen/passes/extract_grouped_constants
//     -> statements in order          symgen/emit/kernel_ast
//     -> steps around functions       symgen/passes/cut_at_functions (C++ only)
//     -> beside them: stress        symgen/mechanics/stress_graph, symgen/build_stress
//                                   (nothing stored; the other operations stay as they are)
//     -> C++ text, OpenCL C text      symgen/emit/print_cpp, print_opencl (both of the same
//                                     statements, by the walk of operation_printer)
//
// symgen/build_kernels calls the stages from derivatives to statements, symgen/pipeline the whole;
// symgen/formulation decides whether kernels are straight-line or loops over quadrature points.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "symgen/element/element.h"
#include "symgen/law/law.h"
#include "symgen/mechanics/derivation.h"
#include "symgen/quadrature/quadrature.h"
#include "symgen/stage_log.h"

namespace elastogen::symgen {

/// law x element x quadrature x split, written "stvk-hexa8-q8-lg".
struct AssociationId {
  std::string law, element, quadrature, split;

  /// @throws InputError  when the text is not of that form or names an unknown element,
  ///                     quadrature or split (the law is looked up later)
  [[nodiscard]] static AssociationId parse(const std::string& text);
  [[nodiscard]] std::string text() const;        ///< "stvk-hexa8-q8-lg"
  [[nodiscard]] std::string identifier() const;  ///< "stvk_hexa8_q8_lg"
  auto operator<=>(const AssociationId&) const = default;
};

/// "none", "auto", "l", "g", ..., "lgnd": `auto` and the 16 subsets of {l, g, n, d}.
[[nodiscard]] const std::vector<std::string>& split_names();

/// How grouped constants are chosen.
enum class Grouping { minimum_cut, algorithm6 };

struct GenerateOptions {
  std::string profile = "x86-cache";  ///< target profile: fixes beta and the limits of `auto`
  Grouping grouping = Grouping::minimum_cut;
  Derivation derivation = Derivation::dag;
  bool stabilise = true;
};

/// Names of the target profiles.
[[nodiscard]] const std::vector<std::string>& profile_names();

/// Cost of one operation of one geometry variant.
struct OperationReport {
  /// "constants", "geometry", "energy", "forces", "product", "linearize", "apply", "stress",
  /// "stiffness"
  std::string name;
  long flops = 0;     ///< per element; FMA = 2, a division or a function counts as 1 here
  int constants = 0;  ///< grouped constants read (for `constants`: written)
  int state = 0;      ///< state numbers read or written
  long bytes_read =
      0;  ///< per element in double: positions, constants, state, displacement, direction
  long bytes_written = 0;
  int fragments = 0;
  long code_bytes = 0;  ///< size of the emitted source text of the operation
};

struct VariantReport {
  std::string geometry;
  int num_constants = 0;
  int num_state = 0;
  bool reads_positions = false;
  int constants_algorithm6 = 0;  ///< what the thesis's algorithm 6 would store
  std::vector<OperationReport> operations;
  std::vector<StageRecord> stages;  ///< from the element's graph to statements
};

/// Everything that the generator makes of one association.
struct GeneratedAssociation {
  AssociationId id;
  std::string chosen_split;  ///< for `auto`: the split taken; else id.split
  std::string split_reason;  ///< why, in a sentence
  std::string hash;          ///< association_hash
  std::string header;        ///< C++ source of the kernel templates, `identifier().h`
  std::string opencl;        ///< OpenCL C source of the same kernels, `identifier().cl`
  double seconds = 0;        ///< time that generation took
  std::vector<VariantReport> variants;
};

/// Which compiled tables a registration source instantiates.
struct Instantiation {
  bool single_precision = false;  ///< float instead of double
  bool simd = true;               ///< packs of elements; else one element at a time
  /// Operations beside constants and geometry: subset of {"energy", "forces", "product",
  /// "linearize", "apply", "stiffness", "stress"}; the others' table entries are null.
  std::vector<std::string> operations;
};

/// @throws InputError  when the law cannot have the association's quadrature
void check_association(const AssociationId& id, const Law& law);

/// Fingerprint of the generator's own sources: two generators of equal fingerprint make the same of
/// equal input.
[[nodiscard]] std::string generator_fingerprint();

/// Content hash of what `generate_association` is asked for: association, law text, options,
/// version of generator and kernel interface. It stands in the generated text; the fingerprint does
/// not, so that a text changes only when something in it does.
[[nodiscard]] std::string association_hash(const AssociationId& id, const Law& law,
                                           const GenerateOptions& options);

[[nodiscard]] GeneratedAssociation generate_association(const AssociationId& id, const Law& law,
                                                        const GenerateOptions& options);

/// C++ source that includes `identifier().h`, instantiates its kernels and exports
///   extern "C" const elastogen::KernelTable<S>*
///   elastogen_kernels_<identifier>_<f32|f64>_<simd|scalar>();
/// Where its compiler is told a name by -DELASTOGEN_INSTRUCTION_SET=..., the function's ends in
/// _<name>.
[[nodiscard]] std::string registration_source(const AssociationId& id, const Law& law,
                                              const Instantiation& what);

/// Name of the function that `registration_source` exports.
[[nodiscard]] std::string registration_symbol(const AssociationId& id, const Instantiation& what);

/// Expression graph of a small association in Graphviz's language.
[[nodiscard]] std::string dot_graph(const AssociationId& id, const Law& law,
                                    const GenerateOptions& options, const std::string& operation);

/// Results of one element, numbers as text: 17 digits for double, 40 for CLN.
struct Evaluation {
  std::string energy;
  std::vector<std::string> forces, product;  ///< [a * dim + i]; product empty without a direction
  std::vector<std::string> stiffness;        ///< [(a * dim + i) * N + b * dim + j]
  std::string status;                        ///< "ok" or what is wrong
};

/// Inputs of one element: [a * dim + i]; `direction` may be empty.
struct ElementCase {
  std::vector<double> rest_positions, parameters, displacement, direction;
};

/// What walks which graph: double the one that `options` choose, after all passes; CLN, with 100
/// digits and 40 shown, the textbook form before all passes (derived as `options` say), or the
/// thesis's polynomials with every
/// monomial written out (affine elements with laws polynomial in H).
enum class GraphScalar { dag_double, cln, cln_expanded };

/// Walks the expression graph without compiling anything.
[[nodiscard]] Evaluation evaluate_graph(const AssociationId& id, const Law& law,
                                        const ElementCase& input, GraphScalar scalar,
                                        const GenerateOptions& options = {});

}  // namespace elastogen::symgen
