#include "symgen/emit/operation_printer.h"

#include <fmt/format.h>

namespace elastogen::symgen {
namespace {

/// "{1, 2, 3}"
template <class Row, class Text>
std::string braced(const Row& row, const Text& text) {
  std::string result;
  for (const auto& each : row) result += (result.empty() ? "{" : ", ") + text(each);
  return result + "}";
}

/// Functions that map between nodes and points.
constexpr const char* interpolate = "interpolate";
constexpr const char* integrate = "integrate";
constexpr const char* weigh = "weigh";
constexpr const char* jacobian_of = "jacobian";
constexpr const char* point_weights = "point_weights";

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

void OperationPrinter::print_operation(const VariantKernels& kernels,
                                       const OperationKernels& operation, SourceWriter& out) const {
  if (kernels.loop && operation.name != "geometry") {
    print_loop(kernels, operation, out);
  } else if (operation.fragments.size() == 1) {
    out.line(summary(operation, 1));
    print_function(operation, function_name(operation.name), out);
  } else {
    print_fragments(operation, out);
  }
}

void OperationPrinter::print_fragments(const OperationKernels& operation, SourceWriter& out) const {
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

void OperationPrinter::print_function(const OperationKernels& operation, const std::string& name,
                                      SourceWriter& out) const {
  print_whole(operation, name, Role::whole, out);
}

void OperationPrinter::open_loop(const std::string& counter, const std::string& first,
                                 const std::string& end, SourceWriter& out) {
  out.line(fmt::format("for (int {0} = {1}; {0} < {2}; ++{0}) {{", counter, first, end));
  out.indent();
}

void OperationPrinter::close_block(SourceWriter& out) {
  out.outdent();
  out.line("}");
}

void OperationPrinter::close_function(SourceWriter& out) {
  close_block(out);
  out.line();
}

void OperationPrinter::print_points(const OperationKernels&, const std::string& name,
                                    int num_points, const Arrays& arrays, SourceWriter& out) const {
  open_loop("g", "0", std::to_string(num_points), out);
  out.line(call_with(name, arrays));
  close_block(out);
}

void OperationPrinter::print_whole(const OperationKernels& operation, const std::string& name,
                                   Role role, SourceWriter& out) const {
  open_function(name, role, out);
  print_body(operation.fragments[0], operation.num_outputs, out);
  close_function(out);
}

void OperationPrinter::print_body(const Fragment& fragment, int num_outputs,
                                  SourceWriter& out) const {
  std::vector<bool> written(static_cast<std::size_t>(num_outputs), false);
  for (const Output& each : fragment.outputs) {
    if (each.index >= 0 && each.index < num_outputs) written[each.index] = true;
  }
  for (std::size_t k = 0; k < written.size(); ++k) {
    if (!written[k]) out.line(fmt::format("out[{}] = {};", k, zero()));
  }
  print(fragment, false, out);
}

void OperationPrinter::print_maps(const PointLoop& loop, SourceWriter& out) const {
  const auto print_map = [&](const OperationKernels& map, const char* name, const char* what) {
    out.line(fmt::format("/// {}: {} flops", what, map.fragments[0].operations.flops()));
    print_whole(map, function_name(name), Role::fragment, out);
  };
  print_map(loop.interpolate, interpolate,
            "gradients in reference coordinates at all points, of nodal values u");
  print_map(loop.integrate, integrate, "nodal values of the fluxes u at all points");
  print_map(loop.weigh, weigh, "energy of the densities u at all points");
  if (loop.is_affine) print_map(loop.jacobian, jacobian_of, "Jacobian of rest positions x");
  print_map(loop.point_weights, point_weights, "weights of the points");
}

std::string OperationPrinter::print_gradients(const VariantKernels& kernels,
                                              const std::string& field, SourceWriter& out) const {
  const PointLoop& loop = *kernels.loop;
  const int entries = kernels.dim * kernels.dim;
  const bool is_once = field == "x" && loop.is_affine;
  const std::string name = "d" + field;
  out.line(array(name, (is_once ? 1 : kernels.num_points) * entries));
  Arrays arrays;
  (is_once ? arrays.x : arrays.u) = field;
  arrays.out = name;
  out.line(call_with(function_name(is_once ? jacobian_of : interpolate), arrays));
  return is_once ? name : fmt::format("{} + {} * g", name, entries);
}

void OperationPrinter::print_loop(const VariantKernels& kernels, const OperationKernels& operation,
                                  SourceWriter& out) const {
  const std::string& name = operation.name;
  const std::string at_point = function_name(name + "_at_point");
  out.line(summary(operation, 1) + " and point");
  print_point_function(operation, at_point, out);

  const bool is_constants = name == "constants";
  const bool is_same_everywhere = kernels.loop->is_affine;
  const bool is_loop = !is_constants || !is_same_everywhere;
  out.line(fmt::format("/// {}: {} flops per element", name, kernels.flops(name)));
  open_function(function_name(name), Role::whole, out);
  Arrays point;
  if (reads(operation, Slot::position)) point.x = print_gradients(kernels, "x", out);
  if (reads(operation, Slot::displacement)) point.u = print_gradients(kernels, "u", out);
  if (reads_weights(name)) {
    out.line(array("dv", kernels.num_points));
    Arrays weights;
    weights.out = "dv";
    out.line(call_with(function_name(point_weights), weights));
    point.v = "dv + g";
  } else if (reads(operation, Slot::direction)) {
    point.v = print_gradients(kernels, "v", out);
  }
  if (!is_constants && !is_same_everywhere && name != "stress") {
    point.c = stored_at("c", fmt::format("{} * g", kernels.constants.size()));
  }
  if (name == "apply") point.s = stored_at("s", fmt::format("{} * g", kernels.num_state));
  const bool is_stored = !is_nodal(name) && name != "energy";
  if (!is_stored) out.line(array("result", kernels.num_points * operation.num_outputs));
  point.out = is_stored ? "out" : "result";
  if (is_loop) {
    point.out += fmt::format(" + {} * g", operation.num_outputs);
    print_points(operation, at_point, kernels.num_points, point, out);
  } else {
    out.line(call_with(at_point, point));
  }
  if (!is_stored) {
    Arrays last;
    last.u = "result";
    out.line(call_with(function_name(is_nodal(name) ? integrate : weigh), last));
  }
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
