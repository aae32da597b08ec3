#include "reports/figures/figures.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <fmt/format.h>
#include <set>
#include <string>
#include <vector>

#include "properties/files/disk.hpp"
#include "reference/invalid_input.hpp"
#include "reports/figures/gnuplot.hpp"

namespace touchstone {

using std::filesystem::path;

namespace {

/// Cumulative distribution of the depth error, a line for each candidate.
std::string error_figure(const Report& report, const std::string& group, const std::string& pair,
                         const path& folder) {
  std::string data = "candidate,depth_error,share_at_most\n", plot, points;
  for (const ResultRow& row : report.summary) {
    const Statistics& s = row.statistics;
    if (row.pair != pair || row.pose_class != group || !s.depth_histogram) continue;
    const LogHistogram& histogram = *s.depth_histogram;
    // Contacts that were not reported are below no error.
    auto sum = static_cast<double>(histogram.zero), owed = sum;
    for (const auto n : histogram.counts) owed += static_cast<double>(n);
    for (const Outcome lost : {Outcome::missed, Outcome::not_finite, Outcome::failed,
                               Outcome::crashed, Outcome::timed_out}) {
      owed += static_cast<double>(s.of(lost));
    }
    plot +=
        fmt::format("{}'-' with linespoints title {} pointsize 0.5 {}",
                    plot.empty() ? "plot " : ", ", quoted(row.candidate), style_of(row.candidate));
    int bin = histogram.first;
    const auto add = [&](double error) {
      data += fmt::format("{},{:.4g},{:.6g}\n", csv_cell(row.candidate), error, sum / owed);
      points += fmt::format("{:.4g} {:.6g}\n", error, sum / owed);
    };
    if (sum > 0) add(1e-18);
    for (const auto n : histogram.counts) {
      sum += static_cast<double>(n);
      add(std::pow(10, ++bin / 2.0));
    }
    points += "e\n";
  }
  if (plot.empty()) return "";
  const std::string name = figure_name("errors-" + pair, group);
  write_file(folder / (name + ".csv"), data, "--figures");
  return in_both_forms(
      name, 900, 520,
      fmt::format("set title {}\nset logscale x\nset xtics 1e4 format '%.0e'\nunset mxtics\n"
                  "set yrange [0:1]\nset grid linecolor '#d9dee5'\nset border 3\n"
                  "set tics nomirror\nset xlabel 'depth error (sizes)'\n"
                  "set ylabel 'share of contacts with at most this error'\n"
                  "set key outside right top maxcols 1 font ',9'\n",
                  quoted(figure_title(pair, group))) +
          plot + '\n' + points);
}

/// Share that disagrees, by pose class and candidate.
std::string class_figure(const Report& report, const std::string& group, const std::string& pair,
                         const path& folder) {
  std::set<std::string> of_group;
  for (const PoseClassDescription& c : report.classes) {
    if (c.pair == pair && c.group == group) of_group.insert(c.pose_class);
  }
  std::vector<std::string> classes, candidates;
  std::string data = "class,candidate,share_that_disagrees\n", cells;
  const auto place = [](std::vector<std::string>& names, const std::string& name) {
    const auto at = std::find(names.begin(), names.end(), name);
    const auto index = at - names.begin();
    if (at == names.end()) names.push_back(name);
    return index;
  };
  for (const ResultRow& row : report.results) {
    const Statistics& s = row.statistics;
    if (row.pair != pair || !of_group.contains(row.pose_class)) continue;
    if (s.of(Outcome::unsupported) == s.count) continue;
    const double share = 1 - agreement(s);
    data += fmt::format("{},{},{:.6g}\n", row.pose_class, csv_cell(row.candidate), share);
    const auto y = place(classes, row.pose_class), x = place(candidates, row.candidate);
    cells += fmt::format("{} {} {:.6g}\n", x, y, share);
  }
  if (cells.empty()) return "";
  const std::string name = figure_name("classes-" + pair, group);
  write_file(folder / (name + ".csv"), data, "--figures");
  const auto tics = [](const std::vector<std::string>& names) {
    std::string text;
    for (std::size_t i = 0; i < names.size(); ++i) {
      text += fmt::format("{}{} {}", i ? ", " : "", quoted(names[i]), i);
    }
    return text;
  };
  const int width = 320 + 26 * static_cast<int>(candidates.size());
  const int height = 200 + 15 * static_cast<int>(classes.size());
  return in_both_forms(
      name, width, height,
      fmt::format("set title {}\nset palette defined (0 '#ffffff', 1 '#b3321f')\n"
                  "set cbrange [0:1]\nset cblabel 'share that disagrees'\n"
                  "set xrange [-0.5:{}]\nset yrange [{}:-0.5]\nset tics scale 0\n"
                  "set xtics rotate by 90 right ({})\nset ytics ({})\n"
                  "plot '-' using 1:2:3 with image pixels notitle\n{}e\n",
                  quoted(figure_title(pair, group)), static_cast<double>(candidates.size()) - 0.5,
                  static_cast<double>(classes.size()) - 0.5, tics(candidates), tics(classes),
                  cells));
}

}  // namespace

void check_figures(const path& folder) {
  if (std::system("command -v gnuplot >/dev/null 2>&1") != 0) {
    throw InvalidInput("--figures", '"' + folder.string() + '"',
                       "needs gnuplot, which is not installed (Debian: gnuplot-nox)");
  }
  check_writable(folder, "--figures");
}

void write_figures(const Report& report, const path& folder) {
  check_figures(folder);
  std::string script;
  for (const Group group : all_groups) {
    const std::string name = group_name(group);
    std::vector<std::string> pairs;
    for (const ResultRow& row : report.summary) {
      if (row.pose_class != name) continue;
      if (pairs.empty() || pairs.back() != row.pair) pairs.push_back(row.pair);
    }
    script += speed_figures(report, name, pairs, folder);
    for (const auto& pair : pairs) {
      script += error_figure(report, name, pair, folder) + class_figure(report, name, pair, folder);
    }
  }
  run_gnuplot(script, folder);
}

}  // namespace touchstone
