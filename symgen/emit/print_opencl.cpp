#include "symgen/emit/print_opencl.h"

#include <fmt/format.h>

#include <algorithm>

#include "runtime/error.h"
#include "symgen/emit/operation_printer.h"
#include "symgen/emit/source_writer.h"

namespace elastogen::symgen {
namespace {

/// A number of the type `real`. R() gives it its suffix, which needs a point or an exponent.
std::string real_number(double value) {
  std::string text = fmt::format("{:.17g}", value);
  if (text.find_first_of(".e") == std::string::npos) text += ".0";
  return fmt::format("R({})", text);
}

class OpenclPrinter : public OperationPrinter {
 public:
  OpenclPrinter(const NumberPool& numbers, std::string geometry)
      : OperationPrinter(numbers), geometry_(std::move(geometry)) {}

  std::string function_name(const std::string& operation) const override {
    return fmt::format("{}_{}", geometry_, operation);
  }

 protected:
  std::string number(double value) const override { return real_number(value); }
  std::string tabulated_number(int entry) const override {
    return fmt::format("row->number[{}]", entry);
  }
  std::string input(Slot slot, int index, int entry) const override {
    const bool strided = slot == Slot::constant || slot == Slot::state;
    const std::string at =
        entry >= 0 ? fmt::format("row->index[{}]", entry) : std::to_string(index);
    return fmt::format("{}[{}{}]", array_name(slot), at, strided ? " * n" : "");
  }
  std::string output(int index, int entry) const override {
    return entry >= 0 ? fmt::format("out[row->index[{}]]", entry) : fmt::format("out[{}]", index);
  }
  std::string declaration(const std::string& name, bool) const override {
    return "const real " + name;
  }
  std::string spread(const std::string& value) const override { return value; }
  std::string function_call(Function function, const std::string& argument) const override {
    return fmt::format("{}({})", name_of(function), argument);
  }
  std::string root(const std::string& argument, long degree) const override {
    return fmt::format("root({}, {})", argument, degree);
  }
  std::string margin_update(const std::string& value) const override {
    return fmt::format("keep_smaller(margin, {});", value);
  }

  void open_function(const std::string& name, Role role, SourceWriter& out) const override {
    out.line(fmt::format(
        "static void {}(const real *x, __constant real *p, __global const real *c, const real *u, "
        "const real *v, __global const real *s, const size_t n, real *out, real *margin{}) {{",
        name,
        role == Role::fragment_with_row ? fmt::format(", __constant {}_row *row", name) : ""));
    out.indent();
  }
  std::string zero() const override { return "0"; }
  std::string call(const std::string& name, Role role, std::size_t count) const override {
    const std::string once =
        fmt::format("{0}(x, p, c, u, v, s, n, out, margin{1});", name,
                    role == Role::fragment_with_row ? fmt::format(", &{}_rows[k]", name) : "");
    return count > 1 ? fmt::format("for (int k = 0; k < {}; ++k) {}", count, once) : once;
  }
  std::string array(const std::string& name, int count) const override {
    return fmt::format("real {}[{}];", name, count);
  }
  std::string call_with(const std::string& name, const Arrays& arrays) const override {
    return fmt::format("{}({}, p, {}, {}, {}, {}, n, {}, margin);", name, arrays.x, arrays.c,
                       arrays.u, arrays.v, arrays.s, arrays.out);
  }
  std::string stored_at(const std::string& array, const std::string& count) const override {
    return fmt::format("{} + {} * n", array, count);
  }
  std::string open_row_type(const std::string&) const override { return "typedef struct {"; }
  std::string close_row_type(const std::string& name) const override {
    return fmt::format("}} {}_row;", name);
  }
  std::string row_number_type() const override { return "real"; }
  std::string row_number(double value) const override { return real_number(value); }
  std::string open_rows(const std::string& name, std::size_t count) const override {
    return fmt::format("__constant {0}_row {0}_rows[{1}] = {{", name, count);
  }

 private:
  std::string geometry_;
};

/// What an operation needs of the mesh and how its results leave it.
struct Interface {
  const char* operation;
  bool positions;  ///< always, and no constants; the others where the variant reads positions
  bool displacement, direction;
  bool scatters;  ///< into slots; else rows of the output
};

const Interface& interface_of(const std::string& operation) {
  static const std::vector<Interface> interfaces = {
      {"constants", true, false, false, false}, {"geometry", true, false, false, false},
      {"energy", false, true, false, false},    {"forces", false, true, false, true},
      {"product", false, true, true, true},     {"linearize", false, true, false, false},
      {"apply", false, false, true, true},      {"stress", true, true, false, false},
  };
  for (const Interface& each : interfaces) {
    if (each.operation == operation) return each;
  }
  throw InternalError("no interface of operation " + operation);
}

/// The kernel around an operation's function: from the mesh to one element, and back.
void print_kernel(const AssociationId& id, const VariantKernels& kernels,
                  const OperationKernels& operation, const OpenclPrinter& printer,
                  SourceWriter& out) {
  const Interface& interface = interface_of(operation.name);
  const std::string function = printer.function_name(operation.name);
  const std::string shape = fmt::format("{}, {}", kernels.num_nodes, kernels.dim);
  const int num_dofs = kernels.num_nodes * kernels.dim;
  const int num_outputs = kernels.num_outputs(operation);
  out.line(fmt::format("__kernel void {}_{}(ELASTOGEN_ELEMENT_ARGUMENTS) {{", id.identifier(),
                       function));
  out.indent();
  out.line("const size_t e = get_global_id(0);");
  out.line("if (e >= num_elements) return;");
  const auto gather = [&](bool reads, const char* array, const char* values) -> std::string {
    if (!reads) return "0";
    out.line(fmt::format("real {}[{}];", array, num_dofs));
    out.line(fmt::format("gather({}, e, stride, nodes, {}, {});", shape, values, array));
    return array;
  };
  const bool at_rest = interface.positions;
  const std::string x = gather(at_rest || kernels.reads_positions, "x", "positions");
  const std::string u = gather(interface.displacement, "u", "displacement");
  const std::string v = gather(interface.direction, "v", "direction");
  out.line(fmt::format("real out[{}];", std::max(num_outputs, 1)));
  out.line("real margin = 1;");
  out.line(fmt::format("{}({}, parameters, {}, {}, {}, {}, stride, out, &margin);", function, x,
                       at_rest ? "0" : "constants + e", u, v,
                       operation.name == "apply" ? "state + e" : "0"));
  out.line(
      interface.scatters
          ? fmt::format("scatter({}, e, stride, node_stride, nodes, slots, out, output);", shape)
          : fmt::format("store_rows({}, e, stride, out, output);", num_outputs));
  out.line(fmt::format("report_status(margin, {}, out, e, status);", num_outputs));
  out.outdent();
  out.line("}");
  out.line();
}

}  // namespace

std::string print_opencl(const AssociationId& id, const Provenance& provenance,
                         const std::vector<VariantKernels>& variants,
                         const std::vector<VariantReport>& reports) {
  std::vector<VariantReport> printed = reports;
  for (VariantReport& report : printed) {
    std::erase_if(report.operations,
                  [](const OperationReport& each) { return each.name == "stiffness"; });
  }
  SourceWriter out;
  print_provenance(provenance, printed, out);
  out.line("//");
  out.line(
      "// One work item per element e. Arguments of the kernels and index formulas of their "
      "arrays:");
  out.line(
      "// opencl/prelude.cl. In functions, of one element: rest positions x, displacement u and");
  out.line("// direction v [a * dim + i], parameters p[k], constants c and state s [k * n].");
  out.line("#include \"opencl/prelude.cl\"");
  out.line();
  for (const VariantKernels& kernels : variants) {
    const std::string geometry = geometry_name(kernels.geometry);
    out.line(fmt::format(
        "// ---- {}: dim = {}, num_nodes = {}, num_points = {}, num_constants = {}, "
        "num_state = {}, reads_positions = {}",
        geometry, kernels.dim, kernels.num_nodes, kernels.num_points,
        kernels.num_stored_constants(), kernels.num_stored_state(), kernels.reads_positions));
    out.line();
    const OpenclPrinter printer(kernels.dag.numbers(), geometry);
    if (kernels.loop) printer.print_maps(*kernels.loop, out);
    for (const OperationKernels& operation : kernels.operations) {
      printer.print_operation(kernels, operation, out);
      print_kernel(id, kernels, operation, printer, out);
    }
  }
  return out.take();
}

}  // namespace elastogen::symgen
