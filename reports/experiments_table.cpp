// Rigid-body experiments on a terminal.
#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <string_view>

#include "reports/terminal.hpp"
#include "simulation/engines/run_engines.hpp"
#include "simulation/run_experiments.hpp"

namespace touchstone {
namespace {

std::string formatted(double value, const char* format) {
  return std::isfinite(value) ? fmt::format(fmt::runtime(format), value) : "-";
}

/// With a mark that stands in a column of its own.
std::string value_text(const ExperimentResult& r) {
  return fmt::format("{}{:>9}", r.exact ? '=' : ' ', formatted(r.value, "{:.3g}"));
}

std::string error_text(const ExperimentResult& r) {
  return r.outcome == ExperimentResult::Outcome::unsound ? "unsound" : formatted(r.error, "{:.1e}");
}

std::string row(const ExperimentResult& r, const TextTable& table, const Terminal& terminal) {
  if (r.outcome == ExperimentResult::Outcome::unsupported)
    return terminal.below(r.candidate + " unsupported");
  if (r.outcome == ExperimentResult::Outcome::crashed ||
      r.outcome == ExperimentResult::Outcome::timed_out) {
    return terminal.below(r.candidate + ' ' + r.reason);
  }
  return table.row("  " + r.candidate,
                   {{value_text(r)},
                    {error_text(r)},
                    {fmt::format("{:.1f}", r.points)},
                    {fmt::format("{:.1f}", 100 * r.flicker)},
                    {formatted(r.energy_gained, "{:.0e}")},
                    {r.nanoseconds ? fmt::format("{:.0f}", *r.nanoseconds) : "-"},
                    {fmt::format("{:.0f}", r.microseconds_per_step)}});
}

/// What an experiment measures, and what it is on paper.
std::string statement(const ExperimentDescription& e, const std::string& heading, std::size_t step,
                      const Terminal& terminal) {
  return '\n' + terminal.folded(heading + ": " + e.quantity) +
         terminal.below(fmt::format("on paper {:.4g}, resolved to {:.1g} ({})", e.expected[step],
                                    e.resolution[step], e.unit));
}

}  // namespace

std::string experiments_table(const ExperimentResults& all, const Terminal& terminal) {
  std::size_t name_width = 0;
  for (const ExperimentResult& r : all.results) {
    name_width = std::max(name_width, 2 + r.candidate.size());
  }
  const TextTable table("candidate", name_width,
                        {{"value", 10, 0},
                         {"error", 7, 1},
                         {"points", 6, 2},
                         {"flicker", 7, 5},
                         {"gained", 6, 6},
                         {"ns", 6, 3},
                         {"us/step", 7, 4}},
                        terminal);
  std::string text = table.headings();
  for (const ExperimentDescription& e : all.experiments) {
    for (std::size_t k = 0; k < all.steps.size(); ++k) {
      text += statement(e, fmt::format("{}, step {:.3g} s", e.name, all.steps[k]), k, terminal);
      for (const ExperimentResult& r : all.results) {
        if (r.experiment == e.name && r.step == all.steps[k]) text += row(r, table, terminal);
      }
    }
  }
  return text + '\n' +
         Legend(table, terminal)
             .line("=: held: within what the experiment resolves, where all are equal")
             .line("value and error: as the headings say")
             .of("points", "mean number of contact points")
             .of("flicker", "% of steps in which their number changed")
             .of("gained", "largest rise of energy, in weight x size")
             .of("ns", "median time of a query")
             .of("us/step", "time of a whole step, the way to the candidate included")
             .text();
}

namespace {

/// The time after which nothing moved; "jitter" if it is at rest in the mean, as it should, but
/// single steps still move it; "never" if it moved in the last steps; "-" where motion is what is
/// measured.
std::string time_to_rest(const ExperimentResult& r, const ExperimentDescription& e) {
  if (!e.rests) return "-";
  if (r.comes_to_rest()) return fmt::format("{:.2f}", r.last_motion);
  return r.exact ? "jitter" : "never";
}

/// The rows of one experiment.
class EngineRows {
 public:
  EngineRows(const ExperimentDescription& experiment, const TextTable& table,
             const Terminal& terminal)
      : experiment_(experiment), table_(table), terminal_(terminal) {}

  std::string of(const EngineResult& r) const {
    std::string text =
        of(r.engine, r.own, "") + of(r.engine + "+touchstone", r.cured, cure_name(r.cure));
    if (r.best) {
      const bool is_halved = r.best->step < r.cured.step;
      text += of(is_halved ? "  best, half step" : "  best solver", *r.best, "");
    }
    return text;
  }

 private:
  std::string of(const std::string& name, const ExperimentResult& r,
                 const std::string& cure) const {
    if (r.outcome == ExperimentResult::Outcome::crashed ||
        r.outcome == ExperimentResult::Outcome::timed_out) {
      return terminal_.below(name + ' ' + r.reason);
    }
    return table_.row("  " + name, {{value_text(r)},
                                    {error_text(r)},
                                    {fmt::format("{:.1f}", r.points)},
                                    {time_to_rest(r, experiment_)},
                                    {formatted(r.energy_gained, "{:.0e}")},
                                    {fmt::format("{:.1f}", r.microseconds_per_step)},
                                    {cure}});
  }

  const ExperimentDescription& experiment_;
  const TextTable& table_;
  const Terminal& terminal_;
};

/// "3 held, 1 alike", of those that there are.
std::string counts(const EngineResults& all) {
  std::string text;
  for (const Cure cure : {Cure::held, Cure::nearer, Cure::solver, Cure::alike, Cure::open}) {
    const auto count = std::count_if(all.results.begin(), all.results.end(),
                                     [&](const EngineResult& r) { return r.cure == cure; });
    if (count > 0) text += fmt::format("{}{} {}", text.empty() ? "" : ", ", count, cure_name(cure));
  }
  return text;
}

}  // namespace

std::string engines_table(const EngineResults& all, const Terminal& terminal) {
  constexpr std::string_view cured = "+touchstone", longest = "    best, half step";
  std::size_t name_width = longest.size();
  for (const EngineDescription& e : all.engines) {
    name_width = std::max(name_width, 2 + e.name.size() + cured.size());
  }
  const TextTable table("contacts", name_width,
                        {{"value", 10, 0},
                         {"error", 7, 2},
                         {"points", 6, 4},
                         {"rests", 6, 3},
                         {"gained", 6, 5},
                         {"us/step", 7, 6},
                         {"cure", 6, 1}},
                        terminal);
  std::string text = table.headings();
  for (const ExperimentDescription& e : all.experiments) {
    text += statement(e, e.name, 0, terminal);
    for (const EngineResult& r : all.results) {
      if (r.experiment == e.name) text += EngineRows(e, table, terminal).of(r);
    }
  }
  text += '\n' + terminal.folded(fmt::format("Each engine in its own world, steps of {:.3g} s; {} "
                                             "in all: {}.",
                                             all.step, all.results.size(), counts(all)));
  for (const EngineDescription& e : all.engines) {
    text += terminal.folded(fmt::format("{} {}: {}", e.name, e.version, e.settings)) +
            terminal.below("solver at its best: " + e.best_settings);
  }
  return text +
         Legend(table, terminal)
             .line("+touchstone: with our contact routines installed in the engine")
             .line("=, held: within what the experiment resolves; nearer: ten times nearer or more")
             .line(
                 "best solver: with ours and the engine's solver at its best; half step: and half "
                 "the "
                 "step")
             .line("solver: held so; the engine's usual solver is thus what limits")
             .line("alike: as near as the engine's own contacts, also with the solver at its best")
             .of("rests",
                 "time after which nothing moves, s; jitter: at rest in the mean, as it "
                 "should, but single steps still move")
             .of("gained", "rise of energy, weight x size")
             .text();
}

std::string engines_summary(const EngineResults& all, const Terminal& terminal) {
  std::vector<TextTable::Column> columns;
  for (const EngineDescription& e : all.engines) {
    columns.push_back({e.name, 20, static_cast<int>(columns.size())});
  }
  std::size_t name_width = 0;
  for (const ExperimentDescription& e : all.experiments) {
    name_width = std::max(name_width, e.name.size());
  }
  const auto brief = [](const ExperimentResult& r) {
    return r.outcome == ExperimentResult::Outcome::measured ? formatted(r.error, "{:.1e}")
                                                            : std::string("lost");
  };
  const auto mark = [](Cure cure) {
    return cure == Cure::held ? '=' : cure == Cure::nearer ? '+' : cure == Cure::solver ? '*' : ' ';
  };
  const TextTable table("error", name_width, columns, terminal);
  std::string text = table.headings();
  for (const ExperimentDescription& e : all.experiments) {
    std::vector<TextTable::Cell> cells(columns.size());
    for (const EngineResult& r : all.results) {
      if (r.experiment != e.name) continue;
      for (std::size_t i = 0; i < columns.size(); ++i) {
        if (columns[i].heading != r.engine) continue;
        cells[i] = {fmt::format("{} -> {} {}", brief(r.own), brief(r.cured), mark(r.cure))};
      }
    }
    text += table.row(e.name, cells);
  }
  return text + '\n' +
         terminal.folded(
             "In each engine's own world, with its contacts -> with ours: = held, as "
             "on paper; + ten times nearer; * held with the engine's solver at its "
             "best") +
         table.what_is_left_out();
}

}  // namespace touchstone
