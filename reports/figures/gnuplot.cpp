#include "reports/figures/gnuplot.hpp"

#include <algorithm>
#include <cstdlib>
#include <fmt/format.h>
#include <fstream>
#include <iterator>
#include <numeric>
#include <stdexcept>

#include "properties/files/disk.hpp"
#include "reports/pages/page.hpp"

namespace touchstone {
namespace {

struct Rectangle {
  double left, bottom, right, top;
  bool meets(const Rectangle& o) const {
    return left < o.right && o.left < right && bottom < o.top && o.bottom < top;
  }
};

constexpr LabelPlace choices[] = {{true, 1, 0},      {false, -1, 0},     {true, 0.6, 0.8},
                                  {true, 0.6, -0.8}, {false, -0.6, 0.8}, {false, -0.6, -0.8}};

Rectangle text_at(const Label& l, const LabelPlace& p) {
  const double end = l.x + p.dx, other = end + (p.rightwards ? l.length : -l.length);
  return {std::min(end, other), l.y + p.dy - 0.5, std::max(end, other), l.y + p.dy + 0.5};
}

}  // namespace

std::string style_of(const std::string& candidate) {
  constexpr const char* colours[] = {"#0072b2", "#d55e00", "#009e73", "#cc79a7",
                                     "#a67c00", "#3a9bdc", "#7a5195", "#555555"};
  constexpr int symbols[] = {7, 5, 9, 13, 1, 11};  // gnuplot's circle, square, triangle, …
  const Mark mark = mark_of(candidate);
  return fmt::format("pointtype {} linecolor '{}'", symbols[mark.symbol], colours[mark.colour]);
}

std::string quoted(const std::string& text) {
  std::string result = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') result += '\\';
    result += c;
  }
  return result + '"';
}

std::string csv_cell(const std::string& text) {
  if (text.find_first_of(",\"\n") == std::string::npos) return text;
  std::string result = "\"";
  for (const char c : text) result += c == '"' ? "\"\"" : std::string(1, c);
  return result + '"';
}

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

std::string in_both_forms(const std::string& name, int width, int height,
                          const std::string& commands) {
  const std::string reset = "\nreset\n";
  return fmt::format(
      "set terminal svg size {0},{1} noenhanced font 'DejaVu Sans,11' "
      "background '#ffffff'\nset output {2}\n{3}{4}"
      "set terminal pngcairo size {5},{6} noenhanced font 'DejaVu Sans,11' "
      "fontscale 2 linewidth 2 pointscale 1.6\nset output {7}\n{3}{4}",
      width, height, quoted(name + ".svg"), commands, reset, 2 * width, 2 * height,
      quoted(name + ".png"));
}

std::string figure_name(const std::string& name, const std::string& group) {
  return group == group_name(Group::everyday) ? name : name + '-' + group;
}

std::string figure_title(const std::string& pair, const std::string& group) {
  return fmt::format("{}, {} poses", pair == "all" ? "all pairs" : pair, group);
}

double agreement(const Statistics& s) {
  return static_cast<double>(s.of(Outcome::agree)) /
         static_cast<double>(s.count - s.of(Outcome::unsupported));
}

std::vector<std::optional<LabelPlace>> label_places(const std::vector<Label>& labels, double width,
                                                    double height) {
  const Rectangle chart{0, -0.5, width, height + 1.5};  // a line more, below the title
  std::vector<Rectangle> taken;
  for (const Label& l : labels) taken.push_back({l.x - 0.7, l.y - 0.35, l.x + 0.7, l.y + 0.35});
  std::vector<std::size_t> order(labels.size());
  std::iota(order.begin(), order.end(), 0);
  std::stable_partition(order.begin(), order.end(),
                        [&](std::size_t i) { return labels[i].important; });
  std::vector<std::optional<LabelPlace>> result(labels.size());
  for (const std::size_t i : order) {
    // How bad a place is: what it lies on, and what of it is cut off.
    const auto badness = [&](const LabelPlace& p) {
      const Rectangle text = text_at(labels[i], p);
      const auto hits = std::count_if(taken.begin(), taken.end(),
                                      [&](const Rectangle& r) { return r.meets(text); });
      const bool cut = text.left < chart.left || text.right > chart.right ||
                       text.bottom < chart.bottom || text.top > chart.top;
      return hits + (cut ? 100 : 0);
    };
    const LabelPlace* best = std::min_element(
        std::begin(choices), std::end(choices),
        [&](const LabelPlace& a, const LabelPlace& b) { return badness(a) < badness(b); });
    if (badness(*best) > 0 && !labels[i].important) continue;
    result[i] = *best;
    taken.push_back(text_at(labels[i], *best));
  }
  return result;
}

}  // namespace touchstone
