#include "symgen/emit/kernel_ast.h"

#include <algorithm>
#include <map>
#include <sstream>

#include "runtime/error.h"
#include "symgen/passes/cut_at_functions.h"

namespace elastogen::symgen {
namespace {

bool is_tabulated(Slot slot) { return slot == Slot::constant || slot == Slot::state; }

/// Statements of one fragment, built in depth-first order. Operands are visited in an order that
/// depends on the fragment's structure alone, not on numbers and node ids, so that fragments which
/// differ only in numbers come out alike.
class Scheduler {
 public:
  Scheduler(const Dag& dag, const Inputs& inputs, SumStyle style)
      : dag_(dag), inputs_(inputs), style_(style) {}

  void compute(NodeId root) {
    find_structures(root);
    visit(
        root, [this](NodeId id) { return temporaries_.contains(id); },
        [this](NodeId id) { emit(id); });
  }

  void output(NodeId root, int index) {
    if (dag_.is_zero(root)) return;
    Output output;
    output.index = index;
    const Node& node = dag_[root];
    NodeId value = root;
    if (!inputs_.contains(root) && is_scaled(node)) {
      output.size.value = node.operands[0].factor;
      if (style_ == SumStyle::grouped) {
        output.negative = is_negative(output.size.value);
        output.size.value = size_of(output.size.value);
      }
      value = node.operands[0].node;
      if (output.size.value != NumberPool::one) ++fragment_.operations.multiplications;
    }
    compute(value);
    output.value = reference(value);
    use(output.value);
    fragment_.outputs.push_back(output);
  }

  Fragment take() { return std::move(fragment_); }

 private:
  bool is_leaf(NodeId id) const { return dag_[id].kind == Kind::number || inputs_.contains(id); }

  /// Calls `act` on every node below `root` that is no leaf and not `done`, operands first.
  template <class Done, class Act>
  void visit(NodeId root, const Done& done, const Act& act) {
    std::vector<std::pair<NodeId, bool>> stack{{root, false}};
    while (!stack.empty()) {
      const auto [id, operands_done] = stack.back();
      stack.pop_back();
      if (is_leaf(id) || done(id)) continue;
      if (operands_done) {
        act(id);
        continue;
      }
      stack.emplace_back(id, true);
      const std::vector<NodeId> operands = ordered_operands(id);
      for (auto it = operands.rbegin(); it != operands.rend(); ++it) stack.emplace_back(*it, false);
    }
  }

  std::vector<NodeId> ordered_operands(NodeId id) const {
    std::vector<NodeId> operands;
    for (const Operand& operand : dag_[id].operands) operands.push_back(operand.node);
    std::stable_sort(operands.begin(), operands.end(),
                     [this](NodeId a, NodeId b) { return structure_of(a) < structure_of(b); });
    return operands;
  }

  /// A hash of how a value is computed, leaving out numbers and which constant or state is read.
  std::uint64_t structure_of(NodeId id) const {
    if (dag_[id].kind == Kind::number) return 1;
    if (const auto input = inputs_.find(id); input != inputs_.end()) {
      const auto& [slot, index, entry] = input->second;
      return 16 * (1 + static_cast<std::uint64_t>(is_tabulated(slot) ? 0 : index)) +
             static_cast<std::uint64_t>(slot);
    }
    const auto known = structures_.find(id);
    return known == structures_.end() ? 0 : known->second;
  }

  void find_structures(NodeId root) {
    visit(
        root, [this](NodeId id) { return structures_.contains(id); },
        [this](NodeId id) {
          const Node& node = dag_[id];
          std::vector<std::uint64_t> parts;
          for (const Operand& operand : node.operands) {
            const bool is_exponent = node.kind == Kind::product;
            parts.push_back(structure_of(operand.node) * 1099511628211ULL +
                            (is_exponent ? operand.factor : 0));
          }
          std::sort(parts.begin(), parts.end());
          std::uint64_t hash = 64 + static_cast<std::uint64_t>(node.kind) * 8 +
                               static_cast<std::uint64_t>(node.function);
          for (const std::uint64_t part : parts) {
            hash = (hash ^ part) * 0xff51afd7ed558ccdULL;
            hash ^= hash >> 32;
          }
          structures_[id] = hash;
        });
  }

  Reference reference(NodeId id) const {
    if (dag_[id].kind == Kind::number) return {Slot::number, static_cast<int>(dag_[id].value)};
    if (const auto input = inputs_.find(id); input != inputs_.end()) return input->second;
    const auto temporary = temporaries_.find(id);
    if (temporary == temporaries_.end()) {
      throw InternalError("a kernel reads a value that is neither computed nor an input: " +
                          (dag_[id].kind == Kind::symbol ? dag_.symbol_name(id) : "node"));
    }
    return {Slot::temporary, temporary->second};
  }

  void use(const Reference& value) {
    if (value.slot == Slot::temporary) ++fragment_.statements[value.index].uses;
  }

  bool is_uniform(const Reference& value) const {
    return value.slot == Slot::number || value.slot == Slot::parameter ||
           (value.slot == Slot::temporary && fragment_.statements[value.index].uniform);
  }

  bool is_negative(NumberId factor) const { return dag_.numbers().value(factor) < 0; }
  NumberId size_of(NumberId factor) const { return dag_.numbers().size(factor); }

  void emit(NodeId id) {
    const Node& node = dag_[id];
    Statement statement;
    statement.kind = node.kind;
    statement.function = node.function;
    if (node.kind == Kind::sum) {
      statement.constant.value = node.value;
      statement.groups = groups_of(node);
      for (const TermGroup& group : statement.groups) {
        for (const TermGroup::Term& term : group.terms) {
          use(term.value);
          if (term.value.slot == Slot::temporary) {
            fragment_.statements[term.value.index].used_by_sum = true;
          }
        }
      }
    } else {
      for (const Operand& operand : node.operands) {
        statement.factors.push_back(
            {reference(operand.node), exponent_of(dag_.numbers(), operand.factor)});
      }
      std::sort(statement.factors.begin(), statement.factors.end(),
                [](const Factor& a, const Factor& b) { return a.value < b.value; });
      for (const Factor& factor : statement.factors) use(factor.value);
    }
    statement.uniform =
        std::all_of(node.operands.begin(), node.operands.end(),
                    [this](const Operand& operand) { return is_uniform(reference(operand.node)); });
    fragment_.operations += cost_of(dag_, id);
    temporaries_.emplace(id, static_cast<int>(fragment_.statements.size()));
    fragment_.statements.push_back(std::move(statement));
  }

  /// Terms of equal size together, size 1 first; in a group, positive terms first. In the plain
  /// style each term is its own group, so that the form does not depend on the numbers.
  std::vector<TermGroup> groups_of(const Node& node) const {
    std::vector<std::pair<Reference, NumberId>> terms;
    for (const Operand& operand : node.operands) {
      terms.emplace_back(reference(operand.node), operand.factor);
    }
    std::sort(terms.begin(), terms.end());
    std::vector<TermGroup> groups;
    for (const auto& [value, factor] : terms) {
      if (style_ == SumStyle::plain) {
        groups.push_back({Literal{factor}, {{false, value}}});
        continue;
      }
      const NumberId size = size_of(factor);
      auto group = std::find_if(groups.begin(), groups.end(), [&](const TermGroup& candidate) {
        return candidate.size.value == size;
      });
      if (group == groups.end()) {
        groups.push_back({Literal{size}, {}});
        group = groups.end() - 1;
      }
      group->terms.push_back({is_negative(factor), value});
    }
    if (style_ == SumStyle::plain) return groups;
    std::stable_partition(groups.begin(), groups.end(), [](const TermGroup& group) {
      return group.size.value == NumberPool::one;
    });
    for (TermGroup& group : groups) {
      std::stable_partition(group.terms.begin(), group.terms.end(),
                            [](const TermGroup::Term& term) { return !term.negative; });
    }
    return groups;
  }

  const Dag& dag_;
  const Inputs& inputs_;
  SumStyle style_;
  std::unordered_map<NodeId, std::uint64_t> structures_;
  std::unordered_map<NodeId, int> temporaries_;
  Fragment fragment_;
};

/// Visits every number and every table index of a fragment, always in the same order.
template <class FragmentType, class OnNumber, class OnIndex>
void walk(FragmentType& fragment, const OnNumber& on_number, const OnIndex& on_index) {
  const auto visit = [&](auto& reference) {
    if (is_tabulated(reference.slot)) on_index(reference.index, reference.entry);
  };
  for (auto& statement : fragment.statements) {
    for (auto& group : statement.groups) {
      on_number(group.size);
      for (auto& term : group.terms) visit(term.value);
    }
    on_number(statement.constant);
    for (auto& factor : statement.factors) visit(factor.value);
  }
  for (auto& output : fragment.outputs) {
    on_index(output.index, output.entry);
    on_number(output.size);
    visit(output.value);
  }
}

/// Everything of a fragment but its numbers (other than a constant term of 0) and table indices.
std::string shape_of(const Fragment& fragment) {
  std::ostringstream out;
  const auto put_number = [&out](const Literal& literal) {
    out << (literal.value == NumberPool::zero ? "0" : "#");
  };
  const auto put = [&out](const Reference& reference) {
    out << static_cast<int>(reference.slot) << ":";
    if (!is_tabulated(reference.slot)) out << reference.index;
    out << ",";
  };
  for (const Statement& statement : fragment.statements) {
    out << static_cast<int>(statement.kind) << "f" << static_cast<int>(statement.function);
    for (const TermGroup& group : statement.groups) {
      put_number(group.size);
      out << "(";
      for (const TermGroup::Term& term : group.terms) {
        out << (term.negative ? "-" : "+");
        put(term.value);
      }
      out << ")";
    }
    put_number(statement.constant);
    for (const Factor& factor : statement.factors) {
      put(factor.value);
      out << "^" << factor.exponent.numerator << "/" << factor.exponent.denominator;
    }
    out << ";";
  }
  for (const Output& output : fragment.outputs) {
    out << (output.negative ? "-" : "+");
    put_number(output.size);
    put(output.value);
  }
  return out.str();
}

/// Columns of a table whose rows are the members: one entry per distinct column that varies.
template <class Value>
class Columns {
 public:
  /// The entry of a column, or -1 when all members agree.
  int entry_of(const std::vector<Value>& column) {
    if (std::all_of(column.begin(), column.end(),
                    [&column](const Value& value) { return value == column[0]; })) {
      return -1;
    }
    const auto [it, is_new] = entries_.try_emplace(column, static_cast<int>(columns_.size()));
    if (is_new) columns_.push_back(column);
    return it->second;
  }
  [[nodiscard]] std::vector<std::vector<Value>> rows(std::size_t num_members) const {
    std::vector<std::vector<Value>> rows(num_members);
    for (const std::vector<Value>& column : columns_) {
      for (std::size_t m = 0; m < num_members; ++m) rows[m].push_back(column[m]);
    }
    return rows;
  }

 private:
  std::map<std::vector<Value>, int> entries_;
  std::vector<std::vector<Value>> columns_;
};

FragmentGroup group_of(const std::vector<const Fragment*>& members) {
  const std::size_t count = members.size();
  std::vector<std::vector<NumberId>> numbers;  // [place in the walk][member]
  std::vector<std::vector<int>> indices;
  for (std::size_t m = 0; m < count; ++m) {
    std::size_t number = 0, index = 0;
    const auto place = [m, count](auto& table, std::size_t& at, auto value) {
      if (m == 0) table.emplace_back(count);
      table[at++][m] = value;
    };
    walk(
        *members[m], [&](const Literal& literal) { place(numbers, number, literal.value); },
        [&](int value, int) { place(indices, index, value); });
  }
  FragmentGroup group;
  group.shape = *members[0];
  Columns<NumberId> number_columns;
  Columns<int> index_columns;
  std::size_t number = 0, index = 0;
  walk(
      group.shape,
      [&](Literal& literal) { literal.entry = number_columns.entry_of(numbers[number++]); },
      [&](int&, int& entry) { entry = index_columns.entry_of(indices[index++]); });
  group.numbers = number_columns.rows(count);
  group.indices = index_columns.rows(count);
  return group;
}

}  // namespace

std::set<int> indices_read(const Fragment& fragment, Slot slot) {
  std::set<int> read;
  const auto see = [&](const Reference& value) {
    if (value.slot == slot) read.insert(value.index);
  };
  for (const Statement& statement : fragment.statements) {
    for (const Factor& factor : statement.factors) see(factor.value);
    for (const TermGroup& group : statement.groups) {
      for (const TermGroup::Term& term : group.terms) see(term.value);
    }
  }
  for (const Output& output : fragment.outputs) see(output.value);
  return read;
}

Fragment make_fragment(const Dag& dag, std::span<const NodeId> roots, std::span<const int> outputs,
                       const Inputs& inputs, SumStyle style) {
  Scheduler scheduler(dag, inputs, style);
  for (std::size_t k = 0; k < roots.size(); ++k) scheduler.output(roots[k], outputs[k]);
  return scheduler.take();
}

std::optional<Steps> make_steps(const Dag& dag, std::span<const NodeId> roots,
                                std::span<const int> outputs, const Inputs& inputs,
                                SumStyle style) {
  std::vector<bool> is_input(dag.size(), false);
  for (const auto& [node, reference] : inputs) is_input[node] = true;
  const std::optional<FunctionCut> cut = cut_at_functions(dag, roots, is_input);
  if (!cut) return std::nullopt;

  Steps steps;
  Inputs known = inputs;
  const auto step = [&](int number, const std::vector<NodeId>& stored) {
    std::vector<NodeId> values = stored;
    std::vector<int> places;
    Inputs next = known;
    for (const NodeId value : stored) {
      next[value] = {Slot::carried, steps.num_carried};
      places.push_back(steps.num_carried++);
    }
    for (std::size_t k = 0; k < roots.size(); ++k) {
      const bool is_margin = outputs[k] == Output::margin;
      if (number != (is_margin ? cut->step_of_root[k] : 2)) continue;
      values.push_back(roots[k]);
      places.push_back(outputs[k]);
    }
    Fragment fragment = make_fragment(dag, values, places, known, style);
    known = std::move(next);
    return fragment;
  };
  steps.arguments = step(0, cut->arguments);
  steps.functions = step(1, cut->functions);
  steps.rest = step(2, {});
  return steps;
}

std::vector<FragmentGroup> group_fragments(const std::vector<Fragment>& fragments) {
  std::map<std::string, std::size_t> group_of_shape;
  std::vector<std::vector<const Fragment*>> members;
  for (const Fragment& fragment : fragments) {
    const auto [it, is_new] = group_of_shape.try_emplace(shape_of(fragment), members.size());
    if (is_new) members.emplace_back();
    members[it->second].push_back(&fragment);
  }
  std::vector<FragmentGroup> groups;
  for (const auto& group : members) groups.push_back(group_of(group));
  return groups;
}

}  // namespace elastogen::symgen
