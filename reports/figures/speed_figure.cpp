#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <vector>

#include "properties/files/disk.hpp"
#include "reports/figures/gnuplot.hpp"

namespace touchstone {
namespace {

struct Point {
  std::string candidate;
  double time, error, agreement;
  bool front = false;
};

/// Timed candidates with contacts.
std::vector<Point> points_of(const Report& report, const std::string& group,
                             const std::string& pair) {
  constexpr double min_error = 1e-17;  // a logarithmic axis has no zero
  std::vector<Point> result;
  for (const ResultRow& row : report.summary) {
    const Statistics& s = row.statistics;
    if (row.pair != pair || row.pose_class != group || !row.time || !s.depth_error) continue;
    result.push_back({row.candidate, row.time->nanoseconds.median,
                      std::max(s.depth_error->p99, min_error), agreement(s),
                      row.pareto.value_or(false)});
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

/// The panel's commands; `width` and `height` are of its axes, in characters of its labels.
std::string speed_panel(const std::string& title, const std::vector<Point>& points, const Range& x,
                        const Range& y, double width, double height) {
  std::string text = fmt::format(
      "set title {} noenhanced\nset logscale xy\nset xrange [0.999e{}:1.001e{}]\nset yrange "
      "[1e{}:1e{}]\n"
      "set grid xtics ytics linecolor '#d9dee5'\nset border 3\nset tics nomirror\n"
      "set xtics ('10 ns' 10, '100 ns' 100, '1 µs' 1e3, '10 µs' 1e4, '100 µs' 1e5, '1 ms' 1e6)\n"
      "set ytics 1e{} format '%.0e'\nset xlabel 'time per query'\n"
      "set ylabel 'depth error, p99 (sizes)'\nset key off\nunset label\nunset mxtics\nunset "
      "mytics\n",
      quoted(title), x.low, x.high, y.low, y.high, std::max(1.0, std::ceil((y.high - y.low) / 6)));
  std::vector<Label> labels;
  for (const Point& p : points) {
    labels.push_back({(std::log10(p.time) - x.low) / (x.high - x.low) * width,
                      (std::log10(p.error) - y.low) / (y.high - y.low) * height,
                      static_cast<double>(p.candidate.size()), p.front});
  }
  const auto places = label_places(labels, width, height);
  std::string marks;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Point& p = points[i];
    marks += fmt::format("{}'-' with points pointsize 1 {}",
                         i ? ", " : "plot '-' with lines dashtype 2 linecolor '#5a6472', ",
                         style_of(p.candidate));
    if (!places[i]) continue;
    text +=
        fmt::format("set label {} at {:.6g},{:.6g} {} offset character {:.2f},{:.2f} front{}\n",
                    quoted(p.candidate), p.time, p.error, places[i]->rightwards ? "left" : "right",
                    places[i]->dx, places[i]->dy, p.front ? "" : " textcolor '#5a6472'");
  }
  std::vector<Point> front;
  for (const Point& p : points) {
    if (p.front) front.push_back(p);
  }
  std::sort(front.begin(), front.end(),
            [](const Point& a, const Point& b) { return a.time < b.time; });
  text += marks + '\n';
  for (const Point& p : front) text += fmt::format("{:.6g} {:.6g}\n", p.time, p.error);
  text += "e\n";
  for (const Point& p : points) text += fmt::format("{:.6g} {:.6g}\ne\n", p.time, p.error);
  return text;
}

/// All marks with their names, at the bottom of a page of panels.
std::string key_panel(const std::vector<std::string>& candidates, double share) {
  std::string text = fmt::format(
      "set size 1,{}\nset origin 0,0\nunset title\nunset label\nunset border\nunset tics\n"
      "unset xlabel\nunset ylabel\nunset grid\nset key center center horizontal Left reverse "
      "samplen 1 width 1 font ',9'\n",
      share);
  for (std::size_t i = 0; i < candidates.size(); ++i) {
    text += fmt::format("{}1/0 with points title {} pointsize 1 {}", i ? ", " : "plot ",
                        quoted(candidates[i]), style_of(candidates[i]));
  }
  return text + '\n';
}

}  // namespace

std::string speed_figures(const Report& report, const std::string& group,
                          const std::vector<std::string>& pairs,
                          const std::filesystem::path& folder) {
  std::vector<double> times, errors;
  std::vector<std::string> drawn;
  std::string all_data = "pair,candidate,nanoseconds,depth_error_p99,agreement,on_front\n";
  for (const auto& pair : pairs) {
    const auto points = points_of(report, group, pair);
    if (!points.empty()) drawn.push_back(pair);
    for (const Point& p : points) {
      times.push_back(p.time);
      errors.push_back(p.error);
      all_data += fmt::format("{},{},{},{},{},{}\n", pair, csv_cell(p.candidate), p.time, p.error,
                              p.agreement, p.front ? 1 : 0);
    }
  }
  if (drawn.empty()) return "";
  write_file(folder / (figure_name("speed-accuracy", group) + ".csv"), all_data, "--figures");
  const Range x = decades(times);
  Range y = decades(errors);
  y.low -= 1;  // room for labels above the axis
  std::string script, panels;
  // Two columns of panels above a key of all marks.
  const int columns = drawn.size() > 1 ? 2 : 1;
  const int rows = static_cast<int>(drawn.size() + 1) / 2;
  constexpr int key_height = 90;
  const double share = 1.0 * key_height / (340 * rows + key_height);
  std::vector<std::string> candidates;
  for (const CandidateDescription& c : report.candidates) candidates.push_back(c.name);
  int panel = 0;
  for (const auto& pair : drawn) {
    const std::string title = figure_title(pair, group);
    const std::string name = figure_name("speed-accuracy-" + pair, group);
    const auto points = points_of(report, group, pair);
    script += in_both_forms(name, 640, 440, speed_panel(title, points, x, y, 64, 18));
    panels += fmt::format("set size {},{}\nset origin {},{}\n", 1.0 / columns, (1 - share) / rows,
                          1.0 / columns * (panel % columns),
                          1 - (1 - share) / rows * (panel / columns + 1)) +
              speed_panel(title, points, x, y, 50, 13);
    ++panel;
    std::string data = "candidate,nanoseconds,depth_error_p99,agreement,on_front\n";
    for (const Point& p : points) {
      data += fmt::format("{},{},{},{},{}\n", csv_cell(p.candidate), p.time, p.error, p.agreement,
                          p.front ? 1 : 0);
    }
    write_file(folder / (name + ".csv"), data, "--figures");
  }
  return script + in_both_forms(figure_name("speed-accuracy", group), 1080, 340 * rows + key_height,
                                "set multiplot\n" + panels + key_panel(candidates, share) +
                                    "unset multiplot\n");
}

}  // namespace touchstone
