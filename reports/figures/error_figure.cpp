#include <cmath>
#include <fmt/format.h>
#include <vector>

#include "properties/files/write_file.hpp"
#include "reports/figures/gnuplot.hpp"

namespace touchstone {

using nlohmann::json;

std::string error_figure(const json& report, const std::string& pair,
                         const std::filesystem::path& folder) {
  std::string data = "candidate,depth_error,share_at_most\n", plot, points;
  for (const json& row : report["summary"]) {
    if (row["pair"] != pair || row["depth_error"].is_null()) continue;
    const json& histogram = row["depth_error"]["histogram"];
    // Contacts that were not reported are below no error.
    double reported = histogram["zero"], sum = reported;
    for (const json& n : histogram["counts"]) reported += n.get<double>();
    double owed = reported;
    for (const char* lost : {"missed", "not-finite", "failed", "crashed", "timed-out"}) {
      owed += row["outcomes"].value(lost, 0.0);
    }
    const std::string candidate = row["candidate"];
    plot += fmt::format("{}'-' with linespoints title {} pointsize 0.5 {}",
                        plot.empty() ? "plot " : ", ", quoted(candidate), style_of(candidate));
    int bin = histogram["first"];
    const auto add = [&](double error) {
      data += fmt::format("{},{:.4g},{:.6g}\n", csv_cell(candidate), error, sum / owed);
      points += fmt::format("{:.4g} {:.6g}\n", error, sum / owed);
    };
    if (sum > 0) add(1e-18);
    for (const json& n : histogram["counts"]) {
      sum += n.get<double>();
      add(std::pow(10, ++bin / 2.0));
    }
    points += "e\n";
  }
  if (plot.empty()) return "";
  write_file(folder / ("errors-" + pair + ".csv"), data, "--figures");
  return in_both_forms(
      "errors-" + pair, 900, 520,
      fmt::format("set title {}\nset logscale x\nset xtics 1e4 format '%.0e'\nunset mxtics\n"
                  "set yrange [0:1]\nset grid linecolor '#d9dee5'\nset border 3\n"
                  "set tics nomirror\nset xlabel 'depth error (sizes)'\n"
                  "set ylabel 'share of contacts with at most this error'\n"
                  "set key outside right top maxcols 1 font ',9'\n",
                  quoted(pair)) +
          plot + '\n' + points);
}

}  // namespace touchstone
