#include "symgen/emit/print_cpp.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "runtime/error.h"
#include "symgen/emit/operation_printer.h"
#include "symgen/emit/source_writer.h"
#include "symgen/version.h"

namespace elastogen::symgen {
namespace {

constexpr const char* kernel_parameters =
    "([[maybe_unused]] const kernel::Inputs<V>& in, [[maybe_unused]] V* out, "
    "[[maybe_unused]] V& margin";

/// Points of a loop that take their steps together: what they carry shall fit the first cache.
constexpr int most_points_at_once = 9;

/// A step's name, and whether it writes results; the others write what is carried.
struct Step {
  const char* name;
  const Fragment& fragment;
  bool is_last;
};
std::array<Step, 3> in_order(const Steps& steps) {
  return {{{"arguments", steps.arguments, false},
           {"functions", steps.functions, false},
           {"rest", steps.rest, true}}};
}

class CppPrinter : public OperationPrinter {
 public:
  using OperationPrinter::OperationPrinter;

 protected:
  std::string number(double value) const override {
    return fmt::format("S({})", fmt::format("{:.17g}", value));
  }
  std::string tabulated_number(int entry) const override {
    return fmt::format("S(row.number[{}])", entry);
  }
  std::string input(Slot slot, int index, int entry) const override {
    const std::string at = entry >= 0 ? fmt::format("row.index[{}]", entry) : std::to_string(index);
    return fmt::format("{}[{}]", array_name(slot), at);
  }
  std::string output(int index, int entry) const override {
    return entry >= 0 ? fmt::format("out[row.index[{}]]", entry) : fmt::format("out[{}]", index);
  }
  std::string declaration(const std::string& name, bool uniform) const override {
    return fmt::format("const {} {}", uniform ? 'S' : 'V', name);
  }
  std::string spread(const std::string& value) const override {
    return fmt::format("(V{{}} + {})", value);
  }
  std::string function_call(Function function, const std::string& argument) const override {
    return fmt::format("kernel::{}({})", name_of(function), argument);
  }
  std::string root(const std::string& argument, long degree) const override {
    return fmt::format("kernel::root({}, {})", argument, degree);
  }
  std::string margin_update(const std::string& value) const override {
    return fmt::format("kernel::keep_smaller<V>(margin, {});", value);
  }

  std::string function_name(const std::string& operation) const override { return operation; }
  void open_function(const std::string& name, Role role, SourceWriter& out) const override {
    const bool is_fragment = role == Role::fragment || role == Role::fragment_with_row;
    out.line("template <class V>");
    out.line(fmt::format(
        "{} {}{}{}) {{", is_fragment ? "[[gnu::noinline]] void" : "inline void", name,
        kernel_parameters,
        role == Role::fragment_with_row ? fmt::format(", const {}_row& row", name) : ""));
    out.indent();
    if (role == Role::caller) return;
    open_body(out);
  }
  std::string zero() const override { return "V{}"; }
  std::string call(const std::string& name, Role role, std::size_t count) const override {
    if (role == Role::fragment_with_row) {
      return fmt::format("for (const auto& row : {0}_rows) {0}<V>(in, out, margin, row);", name);
    }
    const std::string once = fmt::format("{}<V>(in, out, margin);", name);
    return count > 1 ? fmt::format("for (int k = 0; k < {}; ++k) {}", count, once) : once;
  }
  std::string array(const std::string& name, int count) const override {
    return fmt::format("V {}[{}];", name, count);
  }
  std::string call_with(const std::string& name, const Arrays& arrays) const override {
    return fmt::format("{}<V>({}, {}, margin);", name, inputs_of(arrays), arrays.out);
  }
  std::string stored_at(const std::string& array, const std::string& count) const override {
    return fmt::format("{} + {}", array, count);
  }
  void print_function(const OperationKernels& operation, const std::string& name,
                      SourceWriter& out) const override {
    if (!operation.steps) {
      OperationPrinter::print_function(operation, name, out);
      return;
    }
    print_steps(operation, name, out);
    open_function(name, Role::caller, out);
    out.line(array("w", operation.steps->num_carried));
    for (const Step& step : in_order(*operation.steps)) {
      out.line(fmt::format("{}_steps::{}<V>(in, w, {}, margin);", name, step.name,
                           step.is_last ? "out" : "w"));
    }
    close_function(out);
  }
  void print_point_function(const OperationKernels& operation, const std::string& name,
                            SourceWriter& out) const override {
    if (operation.steps) {
      print_steps(operation, name, out);
    } else {
      OperationPrinter::print_function(operation, name, out);
    }
  }
  void print_points(const OperationKernels& operation, const std::string& name, int num_points,
                    const Arrays& arrays, SourceWriter& out) const override {
    if (!operation.steps) {
      OperationPrinter::print_points(operation, name, num_points, arrays, out);
      return;
    }
    const int num_carried = operation.steps->num_carried;
    const int at_once = std::min(num_points, most_points_at_once);
    const bool is_all = at_once == num_points;
    out.line(array("w", at_once * num_carried));
    if (!is_all) {
      out.line(fmt::format("for (int first = 0; first < {}; first += {}) {{", num_points, at_once));
      out.indent();
      out.line(fmt::format("const int end = first + {0} < {1} ? first + {0} : {1};", at_once,
                           num_points));
    }
    const std::string carried = is_all ? fmt::format("w + {} * g", num_carried)
                                       : fmt::format("w + {} * (g - first)", num_carried);
    for (const Step& step : in_order(*operation.steps)) {
      open_loop("g", is_all ? "0" : "first", is_all ? std::to_string(num_points) : "end", out);
      out.line(fmt::format("{}_steps::{}<V>({}, {}, {}, margin);", name, step.name,
                           inputs_of(arrays), carried, step.is_last ? arrays.out : carried));
      close_block(out);
    }
    if (!is_all) close_block(out);
  }
  std::string open_row_type(const std::string& name) const override {
    return fmt::format("struct {}_row {{", name);
  }
  std::string close_row_type(const std::string&) const override { return "};"; }
  std::string row_number_type() const override { return "double"; }
  std::string row_number(double value) const override { return fmt::format("{:.17g}", value); }
  std::string open_rows(const std::string& name, std::size_t count) const override {
    return fmt::format("inline constexpr {0}_row {0}_rows[{1}] = {{", name, count);
  }

 private:
  static void open_body(SourceWriter& out) {
    out.line("using S [[maybe_unused]] = kernel::Scalar<V>;");
    out.line("[[maybe_unused]] const auto& [x, p, c, u, v, s] = in;");
  }

  static std::string inputs_of(const Arrays& arrays) {
    return fmt::format("kernel::Inputs<V>{{{}, p, {}, {}, {}, {}}}", arrays.x, arrays.c, arrays.u,
                       arrays.v, arrays.s);
  }

  /// A struct of one function per step: kernel::run takes those of several batches in turn.
  void print_steps(const OperationKernels& operation, const std::string& name,
                   SourceWriter& out) const {
    out.line(fmt::format("struct {}_steps {{", name));
    out.indent();
    out.line(fmt::format("static constexpr int num_carried = {};", operation.steps->num_carried));
    for (const Step& step : in_order(*operation.steps)) {
      out.line("template <class V>");
      out.line(fmt::format(
          "static void {}([[maybe_unused]] const kernel::Inputs<V>& in, [[maybe_unused]] const V* "
          "w, [[maybe_unused]] V* out, [[maybe_unused]] V& margin) {{",
          step.name));
      out.indent();
      open_body(out);
      print_body(step.fragment, step.is_last ? operation.num_outputs : 0, out);
      close_block(out);
    }
    out.outdent();
    out.line("};");
    out.line();
  }
};

/// K column by column: the state once, then the second stage of the product along each unit
/// direction.
void print_stiffness(const VariantKernels& kernels, SourceWriter& out) {
  const int num_dofs = kernels.num_nodes * kernels.dim;
  out.line("/// stiffness: linearize once, apply along every unit direction; K = -product");
  out.line("template <class V>");
  out.line(fmt::format("inline void stiffness{}) {{", kernel_parameters));
  out.indent();
  out.line(fmt::format("V state[{}];", std::max(kernels.num_stored_state(), 1)));
  out.line("linearize<V>(in, state, margin);");
  out.line(fmt::format("V direction[{}] = {{}};", num_dofs));
  out.line(fmt::format("V column[{}];", num_dofs));
  out.line("const kernel::Inputs<V> stage{in.x, in.p, in.c, in.u, direction, state};");
  out.line(fmt::format("for (int j = 0; j < {}; ++j) {{", num_dofs));
  out.indent();
  out.line("direction[j] = V{} + kernel::Scalar<V>(1);");
  out.line("apply<V>(stage, column, margin);");
  out.line("direction[j] = V{};");
  out.line(fmt::format("for (int i = 0; i < {0}; ++i) out[i * {0} + j] = -column[i];", num_dofs));
  out.outdent();
  out.line("}");
  out.outdent();
  out.line("}");
  out.line();
}

void print_no_steps(const std::string& operation, SourceWriter& out) {
  out.line(fmt::format("using {}_steps = kernel::NoSteps;", operation));
  out.line();
}

/// Arrays of shape functions at points, and the structure that refers to them.
void print_points(const std::string& name, const ReferencePoints& points, SourceWriter& out) {
  const auto print_array = [&](const char* what, const std::vector<double>& values) {
    out.line(
        fmt::format("constexpr double {}_{}[] = {{{}}};", name, what, fmt::join(values, ", ")));
  };
  print_array("weights", points.weights);
  print_array("shapes", points.shapes);
  print_array("gradients", points.gradients);
  out.line(
      fmt::format("constexpr elastogen::ReferencePoints {0} = {{{1}, {0}_weights, {0}_shapes, "
                  "{0}_gradients}};",
                  name, points.weights.size()));
}

void set_code_bytes(VariantReport& report, const std::string& name, std::size_t bytes) {
  for (OperationReport& operation : report.operations) {
    if (operation.name == name) operation.code_bytes = static_cast<long>(bytes);
  }
}

}  // namespace

std::string print_cpp_header(const AssociationId& id, const Provenance& provenance,
                             const std::vector<VariantKernels>& variants,
                             std::vector<VariantReport>& reports) {
  SourceWriter out;
  print_provenance(provenance, reports, out);
  out.line("#pragma once");
  out.line();
  out.line("#include \"runtime/kernel_support.h\"");
  out.line();
  out.line(fmt::format("namespace elastogen::kernels::{}::inline ELASTOGEN_INSTRUCTION_SET {{",
                       id.identifier()));
  out.line();
  out.line(fmt::format("inline constexpr char hash[] = \"{}\";", provenance.hash));
  out.line(fmt::format("inline constexpr int dim = {};", variants[0].dim));
  out.line(fmt::format("inline constexpr int num_nodes = {};", variants[0].num_nodes));
  out.line(fmt::format("inline constexpr int num_points = {};", variants[0].num_points));
  out.line();
  for (std::size_t k = 0; k < variants.size(); ++k) {
    const VariantKernels& kernels = variants[k];
    const std::string geometry = geometry_name(kernels.geometry);
    out.line(fmt::format("namespace {} {{", geometry));
    out.line();
    out.line(
        fmt::format("inline constexpr int num_constants = {};", kernels.num_stored_constants()));
    out.line(fmt::format("inline constexpr int num_state = {};", kernels.num_stored_state()));
    out.line(fmt::format("inline constexpr bool reads_positions = {};", kernels.reads_positions));
    out.line(fmt::format("inline constexpr int batches_at_once = {};",
                         kernels.loop ? "1" : "most_batches_at_once"));
    out.line(fmt::format("inline constexpr KernelCosts costs = {{{}, {}, {}}};",
                         kernels.operations_of("product").time(),
                         kernels.operations_of("linearize").time(),
                         kernels.operations_of("apply").time()));
    out.line();
    const CppPrinter printer(kernels.dag.numbers());
    if (kernels.loop) printer.print_maps(*kernels.loop, out);
    for (const OperationKernels& operation : kernels.operations) {
      const std::size_t before = out.size();
      printer.print_operation(kernels, operation, out);
      set_code_bytes(reports[k], operation.name, out.size() - before);
      if (kernels.loop || !operation.steps) print_no_steps(operation.name, out);
    }
    const std::size_t before = out.size();
    print_stiffness(kernels, out);
    set_code_bytes(reports[k], "stiffness", out.size() - before);
    print_no_steps("stiffness", out);
    out.line(fmt::format("}}  // namespace {}", geometry));
    out.line();
  }
  out.line(fmt::format("}}  // namespace elastogen::kernels::{}", id.identifier()));
  return out.take();
}

std::string print_cpp_registration(const Registration& registration, const Instantiation& what) {
  const AssociationId& id = registration.id;
  struct Entry {
    const char *name, *num_outputs;
    bool always;
  };
  static const std::vector<Entry> entries = {
      {"constants", "kernels::{}::num_constants", true},
      {"geometry", "2 * kernels::num_nodes + kernels::num_points", true},
      {"energy", "1", false},
      {"forces", "num_dofs", false},
      {"product", "num_dofs", false},
      {"linearize", "kernels::{}::num_state", false},
      {"apply", "num_dofs", false},
      {"stiffness", "num_dofs * num_dofs", false},
      {"stress", "elastogen::stress_numbers * kernels::num_points", false},
  };
  for (const std::string& name : what.operations) {
    if (std::none_of(entries.begin(), entries.end(),
                     [&](const Entry& entry) { return name == entry.name; })) {
      throw InternalError("unknown operation " + name);
    }
  }
  const auto is_wanted = [&what](const Entry& entry) {
    return entry.always || std::find(what.operations.begin(), what.operations.end(), entry.name) !=
                               what.operations.end();
  };
  SourceWriter out;
  out.line(fmt::format("// Generated by elastogen {}: compiled kernels of {}.", generator_version,
                       id.text()));
  out.line(fmt::format("#include \"{}.h\"", id.identifier()));
  out.line();
  out.line("namespace {");
  out.line();
  out.line(fmt::format("namespace kernels = elastogen::kernels::{};", id.identifier()));
  out.line(fmt::format("using S = {};", what.single_precision ? "float" : "double"));
  out.line(fmt::format("using V = {};", !what.simd              ? "S"
                                        : what.single_precision ? "elastogen::kernel::FloatPack"
                                                                : "elastogen::kernel::DoublePack"));
  out.line("using Arguments = elastogen::KernelArguments<S>;");
  out.line("[[maybe_unused]] constexpr int num_dofs = kernels::num_nodes * kernels::dim;");
  out.line();
  std::string variants;
  for (const std::string& geometry : registration.geometries) {
    variants += fmt::format(
        "{{\"{0}\", kernels::{0}::num_constants, kernels::{0}::num_state, "
        "kernels::{0}::reads_positions, kernels::{0}::batches_at_once, kernels::{0}::costs",
        geometry);
    for (const Entry& entry : entries) {
      if (!is_wanted(entry)) {
        variants += ", nullptr";
        continue;
      }
      variants += fmt::format(", {}_{}", geometry, entry.name);
      const std::string num_outputs = fmt::format(fmt::runtime(entry.num_outputs), geometry);
      out.line(
          fmt::format("void {}_{}(const Arguments* batches, int count) {{", geometry, entry.name));
      out.indent();
      out.line(fmt::format("elastogen::kernel::run<V, {}, kernels::{}::{}_steps>(", num_outputs,
                           geometry, entry.name));
      out.indent();
      out.indent();
      out.line("batches, count, [](const auto& in, V* out, V& margin) {");
      out.indent();
      out.line(fmt::format("kernels::{}::{}<V>(in, out, margin);", geometry, entry.name));
      out.outdent();
      out.line("});");
      out.outdent();
      out.outdent();
      out.outdent();
      out.line("}");
    }
    variants += "}, ";
  }
  out.line();
  std::string names;
  for (const std::string& name : registration.parameter_names)
    names += fmt::format("\"{}\", ", name);
  out.line(fmt::format("constexpr const char* parameter_names[] = {{{}nullptr}};", names));
  out.line(fmt::format("constexpr elastogen::VariantTable<S> variants[] = {{{}}};",
                       variants.substr(0, variants.size() - 2)));
  print_points("points", registration.points, out);
  if (registration.rich_points) print_points("rich_points", *registration.rich_points, out);
  out.line(fmt::format(
      "constexpr elastogen::KernelTable<S> table = {{elastogen::kernel_abi_version, "
      "elastogen::kernel::lanes_of<V>, \"{}\", \"{}\", kernels::hash, "
      "elastogen::kernel::instruction_set, "
      "kernels::dim, kernels::num_nodes, kernels::num_points, {}, "
      "parameter_names, "
      "elastogen::kernel::nodal_pass<V, kernels::num_nodes, kernels::dim>, "
      "{}, variants, points, {}}};",
      id.text(), id.element, registration.parameter_names.size(), registration.geometries.size(),
      registration.rich_points ? "rich_points" : "points"));
  out.line();
  out.line("}  // namespace");
  out.line();
  const std::string function =
      fmt::format("ELASTOGEN_TABLE_FUNCTION({})", registration_symbol(id, what));
  out.line("extern \"C\" {");
  out.line(fmt::format("const elastogen::KernelTable<S>* {}();", function));
  out.line(fmt::format("const elastogen::KernelTable<S>* {}() {{", function));
  out.indent();
  out.line("return &table;");
  out.outdent();
  out.line("}");
  out.line("}");
  return out.take();
}

}  // namespace elastogen::symgen
