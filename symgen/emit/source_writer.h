// Text of generated sources: indented lines, wrapped at 100 columns.
#pragma once

#include <string>
#include <string_view>

namespace elastogen::symgen {

class SourceWriter {
 public:
  /// One line at the current indentation; longer ones are broken at blanks, continued deeper.
  void line(std::string_view text = {});
  void indent() { depth_ += 2; }
  void outdent() { depth_ -= 2; }
  [[nodiscard]] std::size_t size() const { return text_.size(); }
  [[nodiscard]] std::string take() { return std::move(text_); }

 private:
  std::string text_;
  std::size_t depth_ = 0;
};

}  // namespace elastogen::symgen
