#include <fmt/format.h>

#include "simulation/run_experiments.hpp"

namespace touchstone {
namespace {

using nlohmann::json;

std::string number(const json& row, const char* member, const char* format) {
  const auto found = row.find(member);
  if (found == row.end() || found->is_null()) return "-";
  return fmt::format(fmt::runtime(format), found->get<double>());
}

std::string percent(const json& row, const char* member) {
  const auto found = row.find(member);
  return found == row.end() ? "-" : fmt::format("{:.1f}", 100 * found->get<double>());
}

std::string row_text(const json& row) {
  const std::string name = row["candidate"];
  if (row["outcome"] == "unsupported") return fmt::format("  {:<21} unsupported\n", name);
  const std::string error =
      row["outcome"] == "unsound" ? "unsound" : number(row, "error", "{:.1e}");
  return fmt::format("  {:<21}{}{:>10} {:>7} {:>6} {:>7} {:>6} {:>8} {:>7}\n", name,
                     row["exact"].get<bool>() ? '=' : ' ', number(row, "value", "{:.3g}"), error,
                     number(row, "points", "{:.1f}"), percent(row, "flicker"),
                     number(row, "energy_gained", "{:.0e}"), number(row, "nanoseconds", "{:.0f}"),
                     number(row, "microseconds_per_step", "{:.0f}"));
}

}  // namespace

std::string experiments_table(const json& result) {
  std::string text =
      fmt::format("{:<24}{:>10} {:>7} {:>6} {:>7} {:>6} {:>8} {:>7}\n", "experiment, candidate",
                  "value", "error", "points", "flicker", "gained", "ns/query", "us/step");
  for (const json& e : result["experiments"]) {
    for (std::size_t k = 0; k < result["steps"].size(); ++k) {
      const double step = result["steps"][k], resolution = e["resolution"][k];
      text += fmt::format("\n{}, step {:.3g} s: {}\n  on paper {:.4g}, resolved to {:.1g} ({})\n",
                          e["name"].get<std::string>(), step, e["quantity"].get<std::string>(),
                          e["expected"][k].get<double>(), resolution, e["unit"].get<std::string>());
      for (const json& row : result["results"]) {
        if (row["experiment"] == e["name"] && row["step"] == step) text += row_text(row);
      }
    }
  }
  return text +
         "\n=: held: within what the experiment resolves, where all are equal\n"
         "value and error: as the headings say\n"
         "points: mean number of contact points; flicker: % of steps in which it changed\n"
         "gained: largest rise of energy, in weight x size\n"
         "ns: median of one query; us: of a whole step, the way to the candidate included\n";
}

}  // namespace touchstone
