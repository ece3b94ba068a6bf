// Statements of a kernel as text of a C-like language; a language's printer overrides what differs.
#pragma once

#include <string>

#include "symgen/emit/kernel_ast.h"
#include "symgen/emit/source_writer.h"

namespace elastogen::symgen {

/// Prints fragments for C-like languages. Decides no mathematics: order, grouping and numbers are
/// the kernel's. Products that one sum uses are written inside it, everything else has a name.
class ExpressionPrinter {
 public:
  explicit ExpressionPrinter(const NumberPool& numbers) : numbers_(numbers) {}
  virtual ~ExpressionPrinter() = default;

  /// The fragment's statements, then its outputs, assigned or (accumulate) added.
  void print(const Fragment& fragment, bool accumulate, SourceWriter& out) const;

 protected:
  /// A number of the kernel's scalar type.
  [[nodiscard]] virtual std::string number(double value) const = 0;
  /// The number `entry` of a table row.
  [[nodiscard]] virtual std::string tabulated_number(int entry) const = 0;
  /// An input; its index is `index` or, with entry >= 0, that of the table row.
  [[nodiscard]] virtual std::string input(Slot slot, int index, int entry) const = 0;
  [[nodiscard]] virtual std::string output(int index, int entry) const = 0;
  /// `uniform`: of parameters and numbers only, the same for all elements.
  [[nodiscard]] virtual std::string declaration(const std::string& name, bool uniform) const = 0;
  /// A uniform value where one of each element is expected.
  [[nodiscard]] virtual std::string spread(const std::string& value) const = 0;
  [[nodiscard]] virtual std::string function_call(Function function,
                                                  const std::string& argument) const = 0;
  [[nodiscard]] virtual std::string root(const std::string& argument, long degree) const = 0;
  /// The statement that keeps the domain's margin no larger than `value`.
  [[nodiscard]] virtual std::string margin_update(const std::string& value) const = 0;

  /// The same in every language: the array of an input, "c" for constants, and "log1p".
  [[nodiscard]] static std::string array_name(Slot slot);
  [[nodiscard]] static std::string name_of(Function function);
  [[nodiscard]] const NumberPool& numbers() const { return numbers_; }

 private:
  [[nodiscard]] std::string literal(const Literal& value) const;
  [[nodiscard]] std::string value(const Reference& reference) const;
  [[nodiscard]] std::string sum(const Fragment& fragment, const Statement& statement) const;
  [[nodiscard]] std::string product(const Statement& statement) const;
  [[nodiscard]] std::string term(const Fragment& fragment, const Reference& reference) const;
  [[nodiscard]] std::string right_side(const Fragment& fragment, const Statement& statement) const;
  [[nodiscard]] std::string output_value(const Fragment& fragment,
                                         const Reference& reference) const;

  const NumberPool& numbers_;
};

}  // namespace elastogen::symgen
