// Operations of a kernel as functions of a C-like language; a language's printer overrides what
// differs. Both targets, C++ and OpenCL C, are printed by this one walk over the same
// OperationKernels.
#pragma once

#include <string>

#include "symgen/build_kernels.h"
#include "symgen/emit/expression_printer.h"

namespace elastogen::symgen {

/// An operation that is one fragment is one function, which assigns its outputs. Else there is one
/// function per fragment group, which adds to them, and one that sets them to zero and calls those;
/// where fragments differ in numbers and indices, they read those from a row of a table.
class OperationPrinter : public ExpressionPrinter {
 public:
  using ExpressionPrinter::ExpressionPrinter;

  void print_operation(const OperationKernels& operation, SourceWriter& out) const;

 protected:
  /// `whole` computes an operation, `caller` adds up its fragments; a fragment may get a table row.
  enum class Role { whole, caller, fragment, fragment_with_row };

  /// Name of an operation's function.
  [[nodiscard]] virtual std::string function_name(const std::string& operation) const = 0;
  /// Everything before the first statement, opening brace included.
  virtual void open_function(const std::string& name, Role role, SourceWriter& out) const = 0;
  /// A zero of the type of outputs.
  [[nodiscard]] virtual std::string zero() const = 0;
  /// The statement that calls a fragment for each of its `count` members.
  [[nodiscard]] virtual std::string call(const std::string& name, Role role,
                                         std::size_t count) const = 0;

  /// Tables, type NAME_row and array NAME_rows: the type's opening and closing line, a number's
  /// type in it and its text, and the array's opening line.
  [[nodiscard]] virtual std::string open_row_type(const std::string& name) const = 0;
  [[nodiscard]] virtual std::string close_row_type(const std::string& name) const = 0;
  [[nodiscard]] virtual std::string row_number_type() const = 0;
  [[nodiscard]] virtual std::string row_number(double value) const = 0;
  [[nodiscard]] virtual std::string open_rows(const std::string& name, std::size_t count) const = 0;

 private:
  void print_whole(const OperationKernels& operation, SourceWriter& out) const;
  void print_rows(const FragmentGroup& group, const std::string& name, SourceWriter& out) const;
};

}  // namespace elastogen::symgen
