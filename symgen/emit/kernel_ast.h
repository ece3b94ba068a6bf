// What a kernel does, statement by statement, in no particular language.
#pragma once

#include <compare>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <unordered_map>
#include <vector>

#include "symgen/dag/dag.h"
#include "symgen/passes/cost.h"

namespace elastogen::symgen {

/// Where a value comes from. The index formulas are those of runtime/kernel_abi.h.
enum class Slot : std::uint8_t {
  number,
  position,
  parameter,
  constant,
  displacement,
  direction,
  state,
  carried,  ///< stored by an earlier step
  temporary
};

/// `entry` >= 0, in a fragment that stands for several: the index is taken from the member's table.
struct Reference {
  Slot slot = Slot::temporary;
  int index = 0;  ///< into the slot's array; number: NumberId; temporary: statement number
  int entry = -1;
  auto operator<=>(const Reference&) const = default;
};

/// A number in the code; `entry` >= 0: taken from the member's table instead.
struct Literal {
  NumberId value = NumberPool::one;
  int entry = -1;
};

/// How sums are written: terms of equal size together (fewest operations), or each with its own
/// signed number (alike for fragments that differ in numbers; as fast with fused multiply-add).
enum class SumStyle { grouped, plain };

/// size * (+- a +- b ...); grouped: size > 0; plain: one term, size signed
struct TermGroup {
  struct Term {
    bool negative;
    Reference value;
  };
  Literal size;
  std::vector<Term> terms;
};

struct Factor {
  Reference value;
  Exponent exponent{1, 1};  ///< a positive integer, or +-1/q
};

struct Statement {
  Kind kind = Kind::sum;               ///< sum, product or function
  Function function = Function::none;  ///< of factors[0]
  std::vector<TermGroup> groups;       ///< sum
  Literal constant{NumberPool::zero};  ///< sum
  std::vector<Factor> factors;         ///< product; function: the argument
  int uses = 0;                        ///< by later statements and outputs of this fragment
  bool used_by_sum = false;
  bool uniform = false;  ///< of parameters and numbers only: one value for all elements
};

/// output[index] (+)= sign * size * value; or, with index `margin`: the law is defined where the
/// value is positive.
struct Output {
  static constexpr int margin = -1;
  int index = 0;
  int entry = -1;  ///< >= 0: the index is taken from the member's table
  bool negative = false;
  Literal size;
  Reference value;
};

/// One compiled function of an operation.
struct Fragment {
  std::vector<Statement> statements;  ///< in the order of computation
  std::vector<Output> outputs;
  OperationCount operations;
};

/// A fragment in three steps (passes/cut_at_functions.h). The outputs of the first two are values
/// that later steps read, Slot::carried.
struct Steps {
  Fragment arguments, functions, rest;
  int num_carried = 0;
};

/// Indices into an input array that a fragment reads.
[[nodiscard]] std::set<int> indices_read(const Fragment& fragment, Slot slot);

/// Nodes that a fragment does not compute but reads.
using Inputs = std::unordered_map<NodeId, Reference>;

/// Schedules what `roots` need into statements, depth first so that values are used soon after they
/// are computed. outputs[k] is the output index of root k; roots that are zero write nothing.
[[nodiscard]] Fragment make_fragment(const Dag& dag, std::span<const NodeId> roots,
                                     std::span<const int> outputs, const Inputs& inputs,
                                     SumStyle style);

/// The same computation in steps, if it waits for functions.
[[nodiscard]] std::optional<Steps> make_steps(const Dag& dag, std::span<const NodeId> roots,
                                              std::span<const int> outputs, const Inputs& inputs,
                                              SumStyle style);

/// Fragments that differ only in numbers, in which grouped constants or state they read, and in
/// which outputs they write: emitted once, with one row of numbers and indices per member.
struct FragmentGroup {
  Fragment shape;                              ///< its entries refer to the columns of the rows
  std::vector<std::vector<NumberId>> numbers;  ///< [member][entry]
  std::vector<std::vector<int>> indices;       ///< [member][entry]
  [[nodiscard]] std::size_t num_members() const { return numbers.size(); }
};

/// Groups fragments of equal shape, in the order of their first members.
[[nodiscard]] std::vector<FragmentGroup> group_fragments(const std::vector<Fragment>& fragments);

}  // namespace elastogen::symgen
