#include "reports/terminal.hpp"

#include <algorithm>
#include <charconv>
#include <cstdlib>
#include <cstring>
#include <fmt/format.h>
#include <sstream>
#include <string_view>
#include <sys/ioctl.h>
#include <unistd.h>
#include <utility>

namespace touchstone {
namespace {

constexpr std::size_t min_columns = 40, max_columns = 80;

/// Select graphic rendition, ECMA-48 8.3.117.
std::string rendered(const Terminal& terminal, const char* parameter, const std::string& text) {
  if (!terminal.has_colours) return text;
  return std::string("\x1b[") + parameter + 'm' + text + "\x1b[0m";
}

bool is_set(const char* variable) {
  const char* value = std::getenv(variable);
  return value && *value != '\0';
}

/// Zero where COLUMNS says nothing.
std::size_t given_columns() {
  const char* const value = std::getenv("COLUMNS");
  std::size_t columns = 0;
  if (!value) return columns;
  const char* const end = value + std::strlen(value);
  const auto [parsed_end, error] = std::from_chars(value, end, columns);
  return error == std::errc() && parsed_end == end ? columns : 0;
}

/// Of UTF-8, of which each is taken to be a column wide.
std::size_t letters(std::string_view text) {
  return static_cast<std::size_t>(std::count_if(text.begin(), text.end(), [](char c) {
    return (static_cast<unsigned char>(c) & 0xc0U) != 0x80U;
  }));
}

bool is_dumb() {
  const char* name = std::getenv("TERM");
  return !name || std::string_view(name) == "dumb";
}

}  // namespace

std::string wrapped(const std::string& text, std::size_t width, const std::string& line_end) {
  std::istringstream words(text);
  std::string result, word;
  std::size_t column = 0;
  while (words >> word) {
    const bool fits = column + 1 + letters(word) <= width;
    if (column > 0) result += fits ? " " : line_end;
    column = (column > 0 && fits ? column + 1 : 0) + letters(word);
    result += word;
  }
  return result;
}

std::string Terminal::heading(const std::string& text) const { return rendered(*this, "1", text); }
std::string Terminal::good(const std::string& text) const { return rendered(*this, "32", text); }
std::string Terminal::bad(const std::string& text) const { return rendered(*this, "31", text); }

std::string Terminal::folded(const std::string& text) const {
  std::string result;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    const std::size_t indent = std::min(line.find_first_not_of(' '), line.size());
    const std::string_view words = std::string_view(line).substr(indent);
    const bool is_command = words.starts_with("./") || words.starts_with("touchstone ");
    if (letters(line) > columns && !is_command) {
      const std::size_t further = indent == 0 ? 0 : indent + 2;
      line = line.substr(0, indent) +
             wrapped(line, columns - further, '\n' + std::string(further, ' '));
    }
    result += line + '\n';
  }
  return result;
}
std::string Terminal::below(const std::string& text) const { return folded("  " + text); }

TextTable::TextTable(std::string heading, std::size_t name_width, std::vector<Column> columns,
                     const Terminal& terminal)
    : terminal_(terminal),
      heading_(std::move(heading)),
      name_width_(std::max(name_width, letters(heading_))),
      columns_(std::move(columns)) {
  std::size_t width = name_width_, shown = columns_.size();
  for (const Column& c : columns_) width += 1 + c.width;
  for (; width > terminal.columns && shown > 1; --shown) {
    Column& dropped =
        *std::max_element(columns_.begin(), columns_.end(), [](const Column& a, const Column& b) {
          return std::pair(a.is_shown, a.rank) < std::pair(b.is_shown, b.rank);
        });
    width -= 1 + dropped.width;
    dropped.is_shown = false;
  }
}

bool TextTable::has(std::string_view heading) const {
  return std::any_of(columns_.begin(), columns_.end(),
                     [&](const Column& c) { return c.is_shown && c.heading == heading; });
}

std::string TextTable::what_is_left_out() const {
  const bool is_whole =
      std::all_of(columns_.begin(), columns_.end(), [](const Column& c) { return c.is_shown; });
  if (is_whole || terminal_.columns >= max_columns) return "";
  return terminal_.folded("Wider terminals show more columns, up to 80 characters.");
}

std::string TextTable::headings() const {
  std::string text = fmt::format("{:<{}}", heading_, name_width_);
  for (const Column& c : columns_) {
    if (c.is_shown) text += fmt::format(" {:>{}}", c.heading, c.width);
  }
  return terminal_.heading(text) + '\n';
}

std::string TextTable::row(const std::string& name, const std::vector<Cell>& cells,
                           bool is_good) const {
  const bool is_above = letters(name) > name_width_;
  std::string text =
      (is_above ? name + '\n' : "") + fmt::format("{:<{}}", is_above ? "" : name, name_width_);
  if (is_good) text = terminal_.good(text);
  for (std::size_t i = 0; i < columns_.size(); ++i) {
    if (!columns_[i].is_shown) continue;
    const std::string cell = fmt::format(" {:>{}}", cells[i].text, columns_[i].width);
    text += cells[i].is_bad ? terminal_.bad(cell) : cell;
  }
  text.erase(text.find_last_not_of(' ') + 1);
  return text + '\n';
}

Legend& Legend::of(std::string_view column, const std::string& meaning) {
  return table_.has(column) ? line(fmt::format("{}: {}", column, meaning)) : *this;
}
Legend& Legend::line(const std::string& text) {
  text_ += terminal_.folded(text);
  return *this;
}

std::string shown_name(const std::string& candidate) {
  return candidate == "reference" ? candidate + " (Touchstone's own)" : candidate;
}

Terminal standard_output() {
  Terminal result;
  const bool is_terminal = isatty(STDOUT_FILENO) != 0;
  result.has_colours = is_terminal && !is_set("NO_COLOR") && !is_dumb();
  std::size_t columns = given_columns();
  winsize size{};
  if (columns == 0 && is_terminal && ioctl(STDOUT_FILENO, TIOCGWINSZ, &size) == 0) {
    columns = size.ws_col;
  }
  if (columns > 0) result.columns = std::clamp(columns, min_columns, max_columns);
  return result;
}

}  // namespace touchstone
