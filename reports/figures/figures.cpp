#include "reports/figures/figures.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <fmt/format.h>
#include <fstream>
#include <iterator>
#include <set>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "properties/files/disk.hpp"
#include "reference/invalid_input.hpp"
#include "reports/history.hpp"
#include "reports/pages/page.hpp"
#include "reports/row_text.hpp"

namespace touchstone {

using std::filesystem::path;

std::map<std::string, std::string> figure_styles(const std::vector<std::string>& candidates) {
  constexpr const char* colours[] = {
      "#0072b2", "#d55e00", "#009e73", "#cc79a7", "#a67c00", "#3a9bdc", "#7a5195", "#555555",
      "#8f5a1e", "#4b3f9e", "#b0477f", "#b3123c", "#5d7d00", "#00808a", "#a020a0", "#1f3a8a"};
  // The pages' symbols (gnuplot's circle, square, triangle, …), then each as an outline, then
  // others.
  constexpr std::size_t symbols = 6;
  constexpr struct {
    int symbol;
    const char* dash;
  } looks[] = {{7, "solid"},      {5, "(9,3)"},          {9, "(4,4)"}, {13, "(9,3,2,3)"},
               {1, "(16,4)"},     {11, "(9,3,2,3,2,3)"}, {6, "(2,2)"}, {4, "(14,3,3,3)"},
               {8, "(6,2)"},      {12, "(20,3,2,3)"},    {2, "(3,6)"}, {10, "(12,6)"},
               {15, "(9,2,9,6)"}, {14, "(5,2,2,2,2,2)"}, {3, "(12,2)"}};
  std::map<std::string, std::string> result;
  std::map<std::size_t, std::set<std::size_t>> taken;  // places in `looks`, by colour
  for (const std::string& name : candidates) {
    if (result.contains(name)) continue;
    const Mark mark = mark_of(name);
    std::set<std::size_t>& of_colour = taken[mark.colour];
    // Its symbol, or that as an outline, or one that is no other's, or another one's.
    std::vector<std::size_t> wanted = {mark.symbol, mark.symbol + symbols};
    for (std::size_t i = std::size(looks); i-- > 0;) wanted.push_back(i);
    const auto free = std::find_if(wanted.begin(), wanted.end(),
                                   [&](std::size_t i) { return !of_colour.contains(i); });
    const std::size_t look = free == wanted.end() ? mark.symbol : *free;
    of_colour.insert(look);
    result[name] = fmt::format("pointtype {} linecolor '{}' dashtype {}", looks[look].symbol,
                               colours[mark.colour], looks[look].dash);
  }
  return result;
}

namespace {

using Styles = std::map<std::string, std::string>;

/// Tics at every `step`-th power of ten, as the pages write them: "'1e-4' 1e-4, …".
std::string power_tics(double low, double high, int step) {
  std::string text;
  for (int power = static_cast<int>(low); power <= high; power += step) {
    text += fmt::format("{}'1e{}' 1e{}", text.empty() ? "" : ", ", power, power);
  }
  return text;
}

/// "errors-cylinder-box", and of another group of pose classes than everyday
/// "errors-cylinder-box-extreme".
std::string figure_name(const std::string& name, const std::string& group) {
  return group == group_name(Group::everyday) ? name : name + '-' + group;
}

/// "cylinder-box, everyday poses".
std::string figure_title(const std::string& pair, const std::string& group) {
  return fmt::format("{}, {} poses", pair == "all" ? "all pairs" : pair, group);
}

/// Text within single quotes, for gnuplot, which would run what stands between backquotes within
/// double ones.
std::string gnuplot_quoted(const std::string& text) {
  std::string result = "'";
  for (const char c : text) result += c == '\'' ? "''" : std::string(1, c);
  return result + '\'';
}

/// A cell of CSV.
std::string csv_cell(const std::string& text) {
  if (text.find_first_of(",\"\n") == std::string::npos) return text;
  std::string result = "\"";
  for (const char c : text) result += c == '"' ? "\"\"" : std::string(1, c);
  return result + '"';
}

/// Runs a script within `folder`. Throws std::runtime_error with gnuplot's words if it fails; the
/// script is then left there.
void run_gnuplot(const std::string& script, const std::filesystem::path& folder) {
  const std::filesystem::path file = folder / "figures.gnuplot", said = folder / "figures.log";
  write_file(file, script, "--figures");
  const std::string command =
      fmt::format("cd {} && gnuplot figures.gnuplot >figures.log 2>&1", "\"$TOUCHSTONE_FIGURES\"");
  setenv("TOUCHSTONE_FIGURES", folder.c_str(), 1);
  const int code = std::system(command.c_str());
  unsetenv("TOUCHSTONE_FIGURES");
  std::ifstream log(said);
  const std::string words((std::istreambuf_iterator<char>(log)), {});
  std::filesystem::remove(said);
  if (code != 0) throw std::runtime_error("gnuplot failed on " + file.string() + ": " + words);
  std::filesystem::remove(file);
}

/// A figure's commands, once for NAME.svg and once for NAME.png of twice as many pixels.
std::string in_both_forms(const std::string& name, int width, int height,
                          const std::string& commands) {
  const std::string reset = "\nreset\n";
  return fmt::format(
      "set terminal svg size {0},{1} noenhanced font 'DejaVu Sans,11' "
      "background '#ffffff'\nset output {2}\n{3}{4}"
      "set terminal pngcairo size {5},{6} noenhanced font 'DejaVu Sans,11' "
      "fontscale 2 linewidth 2 pointscale 1.6\nset output {7}\n{3}{4}",
      width, height, gnuplot_quoted(name + ".svg"), commands, reset, 2 * width, 2 * height,
      gnuplot_quoted(name + ".png"));
}

struct Point {
  std::string candidate, label;
  double time, error, agreement;
  bool front = false;
};

constexpr const char* columns_of_csv = "candidate,nanoseconds,depth_error_p99,agreement,on_front\n";
std::string csv_row(const Point& p) {
  return fmt::format("{},{},{},{},{}\n", csv_cell(p.candidate), p.time, p.error, p.agreement,
                     p.front ? 1 : 0);
}

/// Timed candidates with contacts.
std::vector<Point> points_of(const Report& report, const std::string& group,
                             const std::string& pair) {
  constexpr double min_error = 1e-17;  // a logarithmic axis has no zero
  std::vector<Point> result;
  for (const ResultRow& row : report.summary) {
    const Statistics& s = row.statistics;
    if (row.pair != pair || row.pose_class != group || !row.time || !s.depth_error) continue;
    result.push_back({row.candidate, row.candidate + covered_text(report, row),
                      row.time->nanoseconds.median, std::max(s.depth_error->p99, min_error),
                      s.agreement(), row.pareto.value_or(false)});
  }
  return result;
}

struct Range {
  double low, high;  ///< powers of ten
};
Range decades(const std::vector<double>& values) {
  const auto [low, high] = std::minmax_element(values.begin(), values.end());
  const double first = std::floor(std::log10(*low));
  return {first, std::max(first + 1, std::ceil(std::log10(*high)))};
}

/// The dashed line through the candidates that no other beats in time and error.
constexpr const char* front_style =
    "with lines title 'Pareto front' dashtype 2 linecolor '#5a6472'";

std::string speed_panel(const std::string& title, const std::vector<Point>& points,
                        const Styles& styles, const Range& x, const Range& y) {
  std::string text = fmt::format(
      "set title {} noenhanced\nset logscale xy\nset xrange [0.999e{}:1.001e{}]\nset yrange "
      "[1e{}:1e{}]\n"
      "set grid xtics ytics linecolor '#d9dee5'\nset border 3\nset tics nomirror\n"
      "set xtics ('10 ns' 10, '100 ns' 100, '1 µs' 1e3, '10 µs' 1e4, '100 µs' 1e5, '1 ms' 1e6)\n"
      "set ytics ({})\nset xlabel 'time per query'\n"
      "set ylabel 'depth error, p99 (relative to size)'\nunset mxtics\nunset mytics\n",
      gnuplot_quoted(title), x.low, x.high, y.low, y.high,
      power_tics(y.low, y.high, std::max(1, static_cast<int>(std::ceil((y.high - y.low) / 6)))));
  std::vector<Point> front;
  for (const Point& p : points) {
    if (p.front) front.push_back(p);
  }
  std::sort(front.begin(), front.end(),
            [](const Point& a, const Point& b) { return a.time < b.time; });
  text += fmt::format("plot '-' {}", front_style);
  for (const Point& p : points) {
    text += fmt::format(", '-' with points title {} pointsize 1 {}", gnuplot_quoted(p.label),
                        styles.at(p.candidate));
  }
  text += '\n';
  for (const Point& p : front) text += fmt::format("{:.6g} {:.6g}\n", p.time, p.error);
  text += "e\n";
  for (const Point& p : points) text += fmt::format("{:.6g} {:.6g}\ne\n", p.time, p.error);
  return text;
}

/// All marks with their names, at the bottom of a page of panels. `labels`: by candidate.
std::string key_panel(const std::vector<std::pair<std::string, std::string>>& labels,
                      const Styles& styles, double share) {
  std::string text = fmt::format(
      "set size 1,{}\nset origin 0,0\nunset title\nunset border\nunset tics\n"
      "unset xlabel\nunset ylabel\nunset grid\nset key center center horizontal Left reverse "
      "samplen 1 width 1 font ',9'\n",
      share);
  text += fmt::format("plot 1/0 {}", front_style);
  for (const auto& [name, label] : labels) {
    text += fmt::format(", 1/0 with points title {} pointsize 1 {}", gnuplot_quoted(label),
                        styles.at(name));
  }
  return text + '\n';
}

/// The charts of speed and accuracy in one group, together and of each pair. Writes their data as
/// CSV and returns their commands, none where there is nothing to show.
std::string speed_figures(const Report& report, const Styles& styles, const std::string& group,
                          const std::vector<std::string>& pairs,
                          const std::filesystem::path& folder) {
  std::vector<double> times, errors;
  std::vector<std::string> drawn;
  std::string all_data = std::string("pair,") + columns_of_csv;
  for (const auto& pair : pairs) {
    const auto points = points_of(report, group, pair);
    if (!points.empty()) drawn.push_back(pair);
    for (const Point& p : points) {
      times.push_back(p.time);
      errors.push_back(p.error);
      all_data += pair + ',' + csv_row(p);
    }
  }
  if (drawn.empty()) return "";
  write_file(folder / (figure_name("speed-accuracy", group) + ".csv"), all_data, "--figures");
  const Range x = decades(times), y = decades(errors);
  std::string script, panels;
  // Two columns of panels above a key of all marks.
  const int columns = drawn.size() > 1 ? 2 : 1;
  const int rows = static_cast<int>(drawn.size() + 1) / 2;
  constexpr int key_height = 90;
  const double share = 1.0 * key_height / (340 * rows + key_height);
  std::vector<std::pair<std::string, std::string>> labels;
  for (const CandidateDescription& c : report.candidates) {
    labels.emplace_back(c.name, c.name + covered_pairs(report, group, c.name).text());
  }
  const std::string key = "set key outside right top maxcols 1 Left reverse samplen 1 font ',9'\n";
  int panel = 0;
  for (const auto& pair : drawn) {
    const std::string title = figure_title(pair, group);
    const std::string name = figure_name("speed-accuracy-" + pair, group);
    const auto points = points_of(report, group, pair);
    script += in_both_forms(name, 860, 440, key + speed_panel(title, points, styles, x, y));
    const int row = panel / columns;
    panels += fmt::format("set size {},{}\nset origin {},{}\n", 1.0 / columns, (1 - share) / rows,
                          1.0 / columns * (panel % columns), 1 - (1 - share) / rows * (row + 1)) +
              "set key off\n" + speed_panel(title, points, styles, x, y);
    ++panel;
    std::string data = columns_of_csv;
    for (const Point& p : points) data += csv_row(p);
    write_file(folder / (name + ".csv"), data, "--figures");
  }
  return script + in_both_forms(figure_name("speed-accuracy", group), 1080, 340 * rows + key_height,
                                "set multiplot\n" + panels + key_panel(labels, styles, share) +
                                    "unset multiplot\n");
}

/// Cumulative distribution of the depth error, a line for each candidate.
std::string error_figure(const Report& report, const Styles& styles, const std::string& group,
                         const std::string& pair, const path& folder) {
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
    plot += fmt::format(
        "{}'-' with linespoints title {} pointsize 0.7 {}", plot.empty() ? "plot " : ", ",
        gnuplot_quoted(row.candidate + covered_text(report, row)), styles.at(row.candidate));
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
      fmt::format("set title {}\nset logscale x\nset xtics ('0' 1e-18, {})\nunset mxtics\n"
                  "set yrange [0:1]\nset grid linecolor '#d9dee5'\nset border 3\n"
                  "set tics nomirror\nset xlabel 'depth error (relative to size)'\n"
                  "set ylabel 'share of contacts with at most this error'\n"
                  "set key outside right top maxcols 1 Left reverse samplen 5 font ',9'\n",
                  gnuplot_quoted(figure_title(pair, group)), power_tics(-16, 16, 4)) +
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
    if (s.supported() == 0) continue;
    const double share = 1 - s.agreement();
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
      text += fmt::format("{}{} {}", i ? ", " : "", gnuplot_quoted(names[i]), i);
    }
    return text;
  };
  // Pixels: a row is as high as its name, and the margins have room for the longest names.
  constexpr int letter = 8, row = 18, column = 26, title = 40, scale = 110;
  const auto longest = [](const std::vector<std::string>& names) {
    std::size_t result = 0;
    for (const std::string& each : names) result = std::max(result, each.size());
    return letter * static_cast<int>(result) + 20;
  };
  const int left = longest(classes), bottom = longest(candidates);
  const int width = left + column * static_cast<int>(candidates.size()) + scale;
  const int height = title + row * static_cast<int>(classes.size()) + bottom;
  return in_both_forms(
      name, width, height,
      fmt::format("set lmargin at screen {:.4f}\nset rmargin at screen {:.4f}\n"
                  "set bmargin at screen {:.4f}\nset tmargin at screen {:.4f}\n",
                  1.0 * left / width, 1 - 1.0 * scale / width, 1.0 * bottom / height,
                  1 - 1.0 * title / height) +
          fmt::format("set title {}\nset palette defined (0 '#ffffff', 1 '#b3321f')\n"
                      "set cbrange [0:1]\nset cblabel 'share that disagrees'\n"
                      "set xrange [-0.5:{}]\nset yrange [{}:-0.5]\nset tics scale 0\n"
                      "set xtics rotate by 90 right ({})\nset ytics ({})\n"
                      "plot '-' using 1:2:3 with image pixels notitle\n{}e\n",
                      gnuplot_quoted(figure_title(pair, group)),
                      static_cast<double>(candidates.size()) - 0.5,
                      static_cast<double>(classes.size()) - 0.5, tics(candidates), tics(classes),
                      cells));
}

/// Agreement and time of each pair over the releases of an engine (history.hpp).
std::string history_figure(const Report& report, const path& folder) {
  const std::string& engine = report.history->engine;
  std::string data = "release,pair,agreement,nanoseconds\n", releases;
  std::map<std::string, std::string> agreements, times;  // by pair, as gnuplot reads them
  int x = 0;
  for (const std::string& name : releases_of(report, engine)) {
    const std::string release = name.substr(engine.size() + 1);
    releases += fmt::format("{}{} {}", x ? ", " : "", gnuplot_quoted(release), x);
    for (const ResultRow& row : report.summary) {
      const Statistics& s = row.statistics;
      if (row.candidate != name || row.pose_class != "everyday" || s.supported() == 0) continue;
      const double share = s.agreement(), time = row.time ? row.time->nanoseconds.median : NAN;
      data += fmt::format("{},{},{:.6g},{:.6g}\n", csv_cell(release), row.pair, share, time);
      agreements[row.pair] += fmt::format("{} {:.6g}\n", x, 100 * share);
      if (row.time) times[row.pair] += fmt::format("{} {:.6g}\n", x, time / 1000);
    }
    ++x;
  }
  write_file(folder / "history.csv", data, "--figures");
  const auto panel = [&](const char* title, const std::map<std::string, std::string>& lines) {
    std::string text = fmt::format("set title {}\n", gnuplot_quoted(engine + ", " + title)), points;
    int line = 0;
    for (const auto& [pair, values] : lines) {
      text += fmt::format("{}'-' with linespoints title {} linetype {} pointtype {} linewidth {}",
                          line ? ", " : "plot ", gnuplot_quoted(pair == "all" ? "all pairs" : pair),
                          line + 1, line + 4, pair == "all" ? 3 : 1);
      points += values + "e\n";
      ++line;
    }
    return lines.empty() ? "" : text + '\n' + points;
  };
  return in_both_forms(
      "history", times.empty() ? 640 : 1080, 420,
      fmt::format("set multiplot layout 1,{}\nset border 3\nset tics nomirror\n"
                  "set grid ytics linecolor '#d9dee5'\nset xtics rotate by 45 right ({})\n"
                  "set xrange [-0.3:{}]\nset key below maxrows 3 font ',9'\nset yrange [:100.5]\n",
                  times.empty() ? 1 : 2, releases, x - 0.7) +
          panel("% of everyday poses answered right", agreements) +
          "set key off\nset logscale y\nset yrange [*:*]\n" + panel("median µs of a query", times) +
          "unset multiplot\n");
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
  for (const char* const name : {"speed-accuracy", "errors-", "classes-", "history"}) {
    for (const char* const form : {".csv", ".svg", ".png"}) remove_older(folder, name, form);
  }
  std::vector<std::string> names;
  for (const CandidateDescription& c : report.candidates) names.push_back(c.name);
  for (const ResultRow& row : report.summary) names.push_back(row.candidate);
  const Styles styles = figure_styles(names);
  std::string script;
  for (const Group group : reported_groups) {
    const std::string name = group_name(group);
    std::vector<std::string> pairs;
    for (const ResultRow& row : report.summary) {
      if (row.pose_class != name) continue;
      if (pairs.empty() || pairs.back() != row.pair) pairs.push_back(row.pair);
    }
    script += speed_figures(report, styles, name, pairs, folder);
    for (const auto& pair : pairs) {
      script += error_figure(report, styles, name, pair, folder) +
                class_figure(report, name, pair, folder);
    }
  }
  if (report.history) script += history_figure(report, folder);
  run_gnuplot(script, folder);
}

}  // namespace touchstone
