#pragma once

#include <cstddef>
#include <string>

namespace touchstone {

struct Report;

/// What text is written for: how wide it may be, and whether colours are seen.
struct Terminal {
  std::size_t columns = 80;
  bool has_colours = false;

  /// The text, in colour where colours are seen. It may be padded with blanks.
  std::string heading(const std::string& text) const;
  std::string good(const std::string& text) const;
  std::string bad(const std::string& text) const;

  /// The text in lines that are no wider, broken between words, with a line's end.
  std::string folded(const std::string& text) const;
  /// Likewise, the first line indented by two blanks, others by four.
  std::string below(const std::string& text) const;
};

/// Standard output: as wide as COLUMNS says, otherwise as the terminal is, otherwise 80; 40 at
/// least, 80 at most. In colour on a terminal, unless NO_COLOR is set (https://no-color.org) or
/// TERM is "dumb".
Terminal standard_output();

/// The text with its lines broken between words, where `line_end` comes, which may indent the next
/// one: what it adds does not count in the width.
std::string wrapped(const std::string& text, std::size_t width, const std::string& line_end);

/// The summary of a report: a row for each pair and candidate in everyday poses, and for all pairs
/// in those of the other groups, with the columns that fit; the pose classes in which a candidate
/// is slow now and then; what a candidate passes and fails once turned or tilted; its worst
/// failure. Commands replay both, each in a line however long.
std::string terminal_table(const Report& report, const Terminal& terminal = {});

}  // namespace touchstone
