#include "symgen/emit/operation_printer.h"

#include <fmt/format.h>

namespace elastogen::symgen {
namespace {

void close_function(SourceWriter& out) {
  out.outdent();
  out.line("}");
  out.line();
}

/// "{1, 2, 3}"
template <class Row, class Text>
std::string braced(const Row& row, const Text& text) {
  std::string result;
  for (const auto& each : row) result += (result.empty() ? "{" : ", ") + text(each);
  return result + "}";
}

std::string summary(const OperationKernels& operation, std::size_t num_groups) {
  long flops = 0;
  for (const Fragment& fragment : operation.fragments) flops += fragment.operations.flops();
  std::string text = fmt::format("/// {}: {} flops per element", operation.name, flops);
  if (operation.fragments.size() > 1) {
    text +=
        fmt::format(", {} fragments, {} of them different", operation.fragments.size(), num_groups);
  }
  return text;
}

}  // namespace

void OperationPrinter::print_operation(const OperationKernels& operation, SourceWriter& out) const {
  if (operation.fragments.size() == 1) {
    print_whole(operation, out);
    return;
  }
  const std::vector<FragmentGroup> groups = group_fragments(operation.fragments);
  const std::string whole = function_name(operation.name);
  std::vector<std::string> calls;
  for (std::size_t i = 0; i < groups.size(); ++i) {
    const std::string name = fmt::format("{}_{}", whole, i);
    const bool has_rows = !groups[i].numbers[0].empty() || !groups[i].indices[0].empty();
    const Role role = has_rows ? Role::fragment_with_row : Role::fragment;
    if (groups[i].shape.outputs.empty()) continue;
    if (has_rows) print_rows(groups[i], name, out);
    open_function(name, role, out);
    print(groups[i].shape, true, out);
    close_function(out);
    calls.push_back(call(name, role, groups[i].num_members()));
  }
  out.line(summary(operation, groups.size()));
  open_function(whole, Role::caller, out);
  if (operation.num_outputs > 0) {
    out.line(
        fmt::format("for (int k = 0; k < {}; ++k) out[k] = {};", operation.num_outputs, zero()));
  }
  for (const std::string& each : calls) out.line(each);
  close_function(out);
}

void OperationPrinter::print_whole(const OperationKernels& operation, SourceWriter& out) const {
  const Fragment& fragment = operation.fragments[0];
  out.line(summary(operation, 1));
  open_function(function_name(operation.name), Role::whole, out);
  std::vector<bool> written(static_cast<std::size_t>(operation.num_outputs), false);
  for (const Output& each : fragment.outputs) {
    if (each.index != Output::margin) written[each.index] = true;
  }
  for (std::size_t k = 0; k < written.size(); ++k) {
    if (!written[k]) out.line(fmt::format("out[{}] = {};", k, zero()));
  }
  print(fragment, false, out);
  close_function(out);
}

/// The rows of a fragment that stands for several.
void OperationPrinter::print_rows(const FragmentGroup& group, const std::string& name,
                                  SourceWriter& out) const {
  const std::size_t num_numbers = group.numbers[0].size(), num_indices = group.indices[0].size();
  out.line(open_row_type(name));
  out.indent();
  if (num_numbers > 0) out.line(fmt::format("{} number[{}];", row_number_type(), num_numbers));
  if (num_indices > 0) out.line(fmt::format("int index[{}];", num_indices));
  out.outdent();
  out.line(close_row_type(name));
  out.line(open_rows(name, group.num_members()));
  out.indent();
  for (std::size_t m = 0; m < group.num_members(); ++m) {
    std::string row;
    if (num_numbers > 0) {
      row =
          braced(group.numbers[m], [this](NumberId id) { return row_number(numbers().value(id)); });
    }
    if (num_indices > 0) {
      row += (row.empty() ? "" : ", ") +
             braced(group.indices[m], [](int index) { return std::to_string(index); });
    }
    out.line("{" + row + "},");
  }
  out.outdent();
  out.line("};");
}

}  // namespace elastogen::symgen
