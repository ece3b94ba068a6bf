#include "symgen/emit/source_writer.h"

namespace elastogen::symgen {

void SourceWriter::line(std::string_view text) {
  constexpr std::size_t columns = 100;
  std::size_t margin = text.empty() ? 0 : depth_;
  const bool is_comment = text.starts_with("//");
  std::string_view opening;  // of continued lines
  while (margin + opening.size() + text.size() > columns) {
    const std::size_t room = columns - margin - opening.size();
    std::size_t at = text.rfind(' ', room);
    if (at == std::string_view::npos || at == 0) at = text.find(' ', room);
    if (at == std::string_view::npos) break;
    text_.append(margin, ' ').append(opening).append(text.substr(0, at)).append("\n");
    text.remove_prefix(at + 1);
    if (is_comment) {
      opening = "//                ";
    } else {
      margin = depth_ + 4;
    }
  }
  text_.append(margin, ' ').append(opening).append(text).append("\n");
}

}  // namespace elastogen::symgen
