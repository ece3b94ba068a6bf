// Operations of a kernel as functions of a C-like language; a language's printer overrides what
// differs. Both targets, C++ and OpenCL C, are printed by this one walk over the same
// OperationKernels.
#pragma once

#include <string>

#include "symgen/emit/expression_printer.h"
#include "symgen/variant_kernels.h"

namespace elastogen::symgen {

/// An operation that is one fragment is one function, which assigns its outputs. Else there is one
/// function per fragment group, which adds to them, and one that sets them to zero and calls those;
/// where fragments differ in numbers and indices, they read those from a row of a table. An
/// operation that is a loop over points is a function for one point, and one that calls it.
class OperationPrinter : public ExpressionPrinter {
 public:
  using ExpressionPrinter::ExpressionPrinter;

  void print_operation(const VariantKernels& kernels, const OperationKernels& operation,
                       SourceWriter& out) const;

  /// The maps between nodes and points, functions that the operations of a loop call.
  void print_maps(const PointLoop& loop, SourceWriter& out) const;

 protected:
  /// `whole` computes an operation, `caller` adds up its fragments; a fragment may get a table row.
  enum class Role { whole, caller, fragment, fragment_with_row };

  /// The arrays of a call as text.
  struct Arrays {
    std::string x = "x", c = "c", u = "u", v = "v", s = "s", out = "out";
  };

  /// Name of an operation's function.
  [[nodiscard]] virtual std::string function_name(const std::string& operation) const = 0;
  /// Everything before the first statement, opening brace included.
  virtual void open_function(const std::string& name, Role role, SourceWriter& out) const = 0;
  /// A zero of the type of outputs.
  [[nodiscard]] virtual std::string zero() const = 0;
  /// The statement that calls a fragment for each of its `count` members.
  [[nodiscard]] virtual std::string call(const std::string& name, Role role,
                                         std::size_t count) const = 0;

  /// An array of `count` values of the type of outputs, and the statement that calls a function
  /// that is no fragment with a row.
  [[nodiscard]] virtual std::string array(const std::string& name, int count) const = 0;
  [[nodiscard]] virtual std::string call_with(const std::string& name,
                                              const Arrays& arrays) const = 0;
  /// The function of an operation that is one fragment, or of one point of it.
  virtual void print_function(const OperationKernels& operation, const std::string& name,
                              SourceWriter& out) const;
  virtual void print_point_function(const OperationKernels& operation, const std::string& name,
                                    SourceWriter& out) const {
    print_function(operation, name, out);
  }
  /// The loop that calls a point's function, point g with `arrays`.
  virtual void print_points(const OperationKernels& operation, const std::string& name,
                            int num_points, const Arrays& arrays, SourceWriter& out) const;
  /// Assigns the outputs of a fragment; those that it does not compute are zero.
  void print_body(const Fragment& fragment, int num_outputs, SourceWriter& out) const;
  static void open_loop(const std::string& counter, const std::string& first,
                        const std::string& end, SourceWriter& out);
  static void close_block(SourceWriter& out);
  static void close_function(SourceWriter& out);

  /// `count` entries of constants or state on from the beginning of "c" or "s".
  [[nodiscard]] virtual std::string stored_at(const std::string& array,
                                              const std::string& count) const = 0;

  /// Tables, type NAME_row and array NAME_rows: the type's opening and closing line, a number's
  /// type in it and its text, and the array's opening line.
  [[nodiscard]] virtual std::string open_row_type(const std::string& name) const = 0;
  [[nodiscard]] virtual std::string close_row_type(const std::string& name) const = 0;
  [[nodiscard]] virtual std::string row_number_type() const = 0;
  [[nodiscard]] virtual std::string row_number(double value) const = 0;
  [[nodiscard]] virtual std::string open_rows(const std::string& name, std::size_t count) const = 0;

 private:
  void print_fragments(const OperationKernels& operation, SourceWriter& out) const;
  void print_whole(const OperationKernels& operation, const std::string& name, Role role,
                   SourceWriter& out) const;
  /// Gradients of a nodal field at all points; what a point's are called in the loop.
  std::string print_gradients(const VariantKernels& kernels, const std::string& field,
                              SourceWriter& out) const;
  void print_loop(const VariantKernels& kernels, const OperationKernels& operation,
                  SourceWriter& out) const;
  void print_rows(const FragmentGroup& group, const std::string& name, SourceWriter& out) const;
};

}  // namespace elastogen::symgen
