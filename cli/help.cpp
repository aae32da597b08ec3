#include "cli/help.hpp"

#include <sstream>
#include <string>

namespace touchstone {
namespace {

constexpr std::size_t page_width = 80, name_width = 24;

/// With its lines broken between words, where `line_end` comes.
std::string wrapped(const std::string& text, std::size_t width, const std::string& line_end) {
  std::istringstream words(text);
  std::string result, word;
  std::size_t column = 0;
  while (words >> word) {
    const bool fits = column + 1 + word.size() <= width;
    if (column > 0) result += fits ? " " : line_end;
    column = (column > 0 && fits ? column + 1 : 0) + word.size();
    result += word;
  }
  return result;
}

class Format : public CLI::Formatter {
 public:
  Format() { column_width(name_width); }
  std::string make_option_desc(const CLI::Option* option) const override {
    // CLI11 indents what follows a line's end.
    return wrapped(CLI::Formatter::make_option_desc(option), page_width - name_width, "\n");
  }
};

}  // namespace

std::string list_entry(const std::string& name, std::size_t width, const std::string& text) {
  const std::size_t indent = width + 4;
  std::string entry = "  " + name;
  entry.resize(indent, ' ');
  return entry + wrapped(text, page_width - indent, '\n' + std::string(indent, ' ')) + '\n';
}

std::shared_ptr<CLI::FormatterBase> help_format() { return std::make_shared<Format>(); }

}  // namespace touchstone
