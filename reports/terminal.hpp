#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace touchstone {

struct EngineResults;
struct ExperimentResults;
struct Report;

/// What text is written for: how wide it may be, and whether colours are seen.
struct Terminal {
  std::size_t columns = 80;
  bool has_colours = false;

  /// The text, in colour where colours are seen. It may be padded with blanks.
  std::string heading(const std::string& text) const;
  std::string good(const std::string& text) const;
  std::string bad(const std::string& text) const;

  /// The text with its lines that are wider broken between words, and a line's end. What follows a
  /// break is as far in as the line, or by two blanks more where that is indented. Commands
  /// ("./touchstone …", or "touchstone …") stay whole, to be pasted.
  std::string folded(const std::string& text) const;
  /// One line likewise, indented by two blanks.
  std::string below(const std::string& text) const;
};

/// Standard output: as wide as COLUMNS says, otherwise as the terminal is, otherwise 80; 40 at
/// least, 80 at most. In colour on a terminal, unless NO_COLOR is set (https://no-color.org) or
/// TERM is "dumb".
Terminal standard_output();

/// The text with its lines broken between words, where `line_end` comes, which may indent the next
/// one: what it adds does not count in the width.
std::string wrapped(const std::string& text, std::size_t width, const std::string& line_end);

/// A table of names and numbers, with the columns that the terminal has room for.
class TextTable {
 public:
  struct Column {
    std::string heading;
    std::size_t width;  ///< a blank before it comes on top
    int rank = 0;       ///< where there is no room for all, those with the highest are left out
    bool is_shown = true;
  };
  struct Cell {
    std::string text;
    bool is_bad = false;  ///< drawn in red
  };
  /// `heading` and `name_width`: of the names, which stand before the columns.
  TextTable(std::string heading, std::size_t name_width, std::vector<Column> columns,
            const Terminal& terminal);
  bool has(std::string_view heading) const;
  /// Says that a wider terminal shows more; empty where it has all columns or is at its widest.
  std::string what_is_left_out() const;
  std::string headings() const;
  /// A cell for each column, shown or not. A name that is wider than its column has a line of its
  /// own. `is_good`: the name is drawn in green.
  std::string row(const std::string& name, const std::vector<Cell>& cells,
                  bool is_good = false) const;

 private:
  Terminal terminal_;
  std::string heading_;
  std::size_t name_width_;
  std::vector<Column> columns_;
};

/// What stands below a table: what its columns mean, of those that are shown.
class Legend {
 public:
  Legend(const TextTable& table, const Terminal& terminal) : table_(table), terminal_(terminal) {}
  Legend& of(std::string_view column, const std::string& meaning);
  Legend& line(const std::string& text);
  std::string text() const { return text_ + table_.what_is_left_out(); }

 private:
  const TextTable& table_;
  const Terminal& terminal_;
  std::string text_;
};

/// What a person reads for the candidate of this name: of Touchstone's own routine who it is.
std::string shown_name(const std::string& candidate);

/// The first screen of a report, at most 40 lines: a row for each candidate, the best first and our
/// own routine apart, and three findings with the commands that replay them, each in a line however
/// long.
std::string terminal_table(const Report& report, const Terminal& terminal = {});

/// All that a report says in a terminal: a row for each pair and candidate in everyday poses, and
/// for all pairs in those of the other groups, with the columns that fit; the pose classes in which
/// a candidate is slow now and then; what a candidate passes and fails once turned or tilted; its
/// worst failure.
std::string terminal_details(const Report& report, const Terminal& terminal = {});

/// What was measured in experiments, and what the columns mean.
std::string experiments_table(const ExperimentResults& results, const Terminal& terminal = {});
std::string engines_table(const EngineResults& results, const Terminal& terminal = {});
/// The errors alone, for a report.
std::string engines_summary(const EngineResults& results, const Terminal& terminal = {});

}  // namespace touchstone
