#include "reports/figures/gnuplot.hpp"

#include <algorithm>
#include <cstdlib>
#include <fmt/format.h>
#include <fstream>
#include <iterator>
#include <stdexcept>
#include <vector>

#include "properties/files/write_file.hpp"
#include "reports/html/marks.hpp"

namespace touchstone {

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

double agreement(const nlohmann::json& row) {
  return row["outcomes"].value("agree", 0.0) /
         (row["count"].get<double>() - row["outcomes"].value("unsupported", 0.0));
}

}  // namespace touchstone
