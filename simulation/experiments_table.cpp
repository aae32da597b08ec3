#include <cmath>
#include <fmt/format.h>

#include "simulation/experiment_results.hpp"

namespace touchstone {
namespace {

using Outcome = ExperimentResult::Outcome;

std::string number(double value, const char* format) {
  return std::isfinite(value) ? fmt::format(fmt::runtime(format), value) : "-";
}

std::string row(const ExperimentResult& r) {
  if (r.outcome == Outcome::unsupported) return fmt::format("  {:<21} unsupported\n", r.candidate);
  return fmt::format("  {:<21}{}{:>10} {:>7} {:>6.1f} {:>7.1f} {:>6} {:>8} {:>7.0f}\n", r.candidate,
                     r.exact ? '=' : ' ', number(r.value, "{:.3g}"),
                     r.outcome == Outcome::unsound ? "unsound" : number(r.error, "{:.1e}"),
                     r.points, 100 * r.flicker, number(r.energy_gained, "{:.0e}"),
                     r.nanoseconds ? fmt::format("{:.0f}", *r.nanoseconds) : "-",
                     r.microseconds_per_step);
}

}  // namespace

std::string experiments_table(const ExperimentResults& all) {
  std::string text =
      fmt::format("{:<24}{:>10} {:>7} {:>6} {:>7} {:>6} {:>8} {:>7}\n", "experiment, candidate",
                  "value", "error", "points", "flicker", "gained", "ns/query", "us/step");
  for (const ExperimentDescription& e : all.experiments) {
    for (std::size_t k = 0; k < all.steps.size(); ++k) {
      text += fmt::format("\n{}, step {:.3g} s: {}\n  on paper {:.4g}, resolved to {:.1g} ({})\n",
                          e.name, all.steps[k], e.quantity, e.expected[k], e.resolution[k], e.unit);
      for (const ExperimentResult& r : all.results) {
        if (r.experiment == e.name && r.step == all.steps[k]) text += row(r);
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
