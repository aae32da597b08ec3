// What each engine makes of each pair, for a page of somebody's own: Markdown or HTML.
#include "reports/engine_table.hpp"

#include <algorithm>
#include <array>
#include <filesystem>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include "candidates/candidates.hpp"
#include "reference/invalid_input.hpp"
#include "reports/row_text.hpp"

namespace touchstone {
namespace {

/// A pose of each pair at rest, in which the contact is a point, a line or a face.
const char* resting_class(Pair pair) {
  constexpr std::array names = {
      "standing+turned",           "cap-on-axis+turned",         "parallel-side+turned",
      "cap-on-cap-centred+turned", "cap-on-face-centred+turned", "cap-on-face-centred+turned"};
  static_assert(std::size(names) == std::size(all_pairs));
  return names[static_cast<std::size_t>(pair)];
}

const ResultRow* found_row(const std::vector<ResultRow>& rows, std::string_view pair,
                           std::string_view pose_class, const std::string& candidate) {
  const auto at = std::ranges::find_if(rows, [&](const ResultRow& row) {
    return row.pair == pair && row.pose_class == pose_class && row.candidate == candidate &&
           row.statistics.supported() > 0;
  });
  return at == rows.end() ? nullptr : &*at;
}

std::string most_frequent_points(const ResultRow* row) {
  if (!row || row->statistics.points.empty()) return "-";
  const auto& points = row->statistics.points;
  return fmt::format("{}", std::ranges::max_element(points, {}, [](const auto& each) {
                             return each.second;
                           })->first);
}

using Lines = std::vector<std::string>;  ///< of a cell

/// The class of the first group with failures that the engine fails most often in, and how.
Lines fails_first(const Report& report, const std::string& candidate) {
  for (const Group group : reported_groups) {
    const ResultRow* worst = nullptr;
    for (const ResultRow& row : report.results) {
      const auto described = find_pose_class(row.pair, row.pose_class);
      const bool counts = row.candidate == candidate && row.statistics.supported() > 0 &&
                          described && described->group() == group &&
                          row.statistics.agreement() < 1;
      if (counts && (!worst || row.statistics.agreement() < worst->statistics.agreement())) {
        worst = &row;
      }
    }
    if (!worst) continue;
    const Statistics& s = worst->statistics;
    Outcome most = Outcome::missed;
    for (const Outcome o : all_outcomes) {
      if (!agrees(o) && o != Outcome::unsupported && s.of(o) > s.of(most)) most = o;
    }
    return {worst->pair + '/' + worst->pose_class + ':', outcome_name(most)};
  }
  return {"-"};
}

std::vector<std::vector<Lines>> table_rows(const Report& report, const std::vector<Pair>& pairs) {
  std::vector<std::vector<Lines>> rows(1, {{"engine"}});
  for (const Pair pair : pairs) rows.front().push_back({pair_name(pair)});
  rows.front().push_back({"fails first"});
  for (const CandidateDescription& c : report.candidates) {
    auto& cells = rows.emplace_back();
    cells.push_back({c.name, c.version});
    for (const Pair pair : pairs) {
      const char* const name = pair_name(pair);
      const ResultRow* const row = found_row(report.summary, name, "everyday", c.name);
      if (!row) {
        cells.push_back({"-"});
        continue;
      }
      const Statistics& s = row->statistics;
      const auto error = s.depth_error ? fmt::format("{:.0e}", s.depth_error->max) : "-";
      cells.push_back(
          {agreement_text(s),
           most_frequent_points(found_row(report.results, name, resting_class(pair), c.name)),
           error, median_time(*row)});
    }
    cells.push_back(fails_first(report, c.name));
  }
  return rows;
}

constexpr std::string_view table_legend =
    "Of everyday poses: % answered right, points of a contact at rest, largest depth error in the "
    "smaller size, median ns";

std::string repeated(const std::string& text, std::size_t times) {
  std::string result;
  for (std::size_t i = 0; i < times; ++i) result += text;
  return result;
}

std::string as_html(std::string_view text) {
  std::string result;
  for (const char c : text) {
    result += c == '<' ? "&lt;" : c == '&' ? "&amp;" : std::string(1, c);
  }
  return result;
}

}  // namespace

bool is_html_table(const std::filesystem::path& file) {
  if (file.extension() == ".html") return true;
  if (file.extension() == ".md") return false;
  throw InvalidInput("--table", in_quotes(file.string()), "must end in .md or .html");
}

std::string engine_table(const Report& report, bool is_html) {
  std::vector<Pair> pairs;
  for (const Pair pair : all_pairs) {
    if (std::ranges::any_of(report.summary, [&](const ResultRow& row) {
          return row.pair == pair_name(pair) && row.pose_class == "everyday";
        })) {
      pairs.push_back(pair);
    }
  }
  const std::string source = fmt::format("By Touchstone {}:", report.version);
  std::string text;
  if (is_html) {
    text = fmt::format(
        "<!doctype html>\n<meta charset=\"utf-8\">\n<title>Cylinder contacts of engines</title>\n"
        "<p>{}. {} <code>{}</code></p>\n<table>\n",
        table_legend, source, as_html(report.command));
  } else {
    text = fmt::format("{}. {} `{}`\n\n", table_legend, source, report.command);
  }
  bool is_heading = true;
  for (const auto& row : table_rows(report, pairs)) {
    Lines cells;
    for (const Lines& lines : row) {
      Lines shown;
      for (const std::string& line : lines) shown.push_back(is_html ? as_html(line) : line);
      cells.push_back(fmt::format("{}", fmt::join(shown, "<br>")));
    }
    const std::string cell = is_heading ? "th" : "td";
    text += is_html ? fmt::format("<tr><{0}>{1}</{0}></tr>\n", cell,
                                  fmt::join(cells, "</" + cell + "><" + cell + '>'))
                    : fmt::format("|{}|\n", fmt::join(cells, "|"));
    if (is_heading && !is_html) text += '|' + repeated("---|", cells.size()) + '\n';
    is_heading = false;
  }
  return is_html ? text + "</table>\n" : text;
}

}  // namespace touchstone
