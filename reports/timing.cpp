#include "reports/timing.hpp"

#include <algorithm>
#include <array>
#include <random>
#include <sched.h>

#include "candidates/host/interruption.hpp"
#include "candidates/host/progress.hpp"

namespace touchstone {
namespace {

/// The configurations that a candidate survived, in order; all are asked of it within one process.
std::vector<Configuration> survived(const Sample& sample, std::size_t candidate) {
  std::vector<Configuration> result;
  for (std::size_t i = 0; i < sample.timed.size(); ++i) {
    const Outcome outcome = sample.timed_outcomes[candidate][i];
    if (outcome == Outcome::unsupported) return {};
    if (outcome == Outcome::crashed || outcome == Outcome::timed_out ||
        outcome == Outcome::not_asked) {
      continue;
    }
    result.push_back(sample.timed[i]);
  }
  return result;
}

/// Keeps this process on one processor while it lives, and so the sessions in which it times. A
/// message to a processor that sleeps takes as long as hundreds of queries.
class OnOneProcessor {
 public:
  OnOneProcessor() : is_set_(sched_getaffinity(0, sizeof before_, &before_) == 0) {
    if (!is_set_) return;
    cpu_set_t one;
    CPU_ZERO(&one);
    CPU_SET(sched_getcpu(), &one);
    sched_setaffinity(0, sizeof one, &one);
  }
  ~OnOneProcessor() {
    if (is_set_) sched_setaffinity(0, sizeof before_, &before_);
  }
  OnOneProcessor(const OnOneProcessor&) = delete;
  OnOneProcessor& operator=(const OnOneProcessor&) = delete;

 private:
  cpu_set_t before_;
  bool is_set_;
};

std::vector<Repetitions> time_cell(const Sample& sample, std::vector<CandidateProcess>& candidates,
                                   std::mt19937_64& random) {
  std::vector<std::size_t> order;  // of those that are ready
  for (std::size_t k = 0; k < candidates.size(); ++k) {
    const auto configurations = survived(sample, k);
    if (!configurations.empty() && candidates[k].prepare_timing(configurations)) order.push_back(k);
  }
  std::vector<Repetitions> result(candidates.size());
  for (std::size_t repetition = 0; repetition < max_repetitions; ++repetition) {
    std::shuffle(order.begin(), order.end(), random);
    std::erase_if(order, [&](std::size_t k) {
      const auto cost = candidates[k].cost_per_query();
      if (!cost) {
        result[k].clear();  // it died
        return true;
      }
      result[k].push_back(*cost);
      return result[k].size() >= min_repetitions && is_settled(result[k]);
    });
  }
  return result;
}

bool is_timed(const PoseClass& cell) {
  const Group group = cell.group();
  const auto [arrangement, modifiers] = cell.parts();
  if (group == Group::everyday || group == Group::recorded || modifiers.empty()) return true;
  constexpr std::array of_all = {"general", "parallel", "perpendicular"};
  if (modifiers.size() > 1 ||
      std::find(of_all.begin(), of_all.end(), arrangement) == of_all.end()) {
    return false;
  }
  constexpr std::array timed_tilts = {"tilted-1e-1", "tilted-1e-6", "tilted-1e-12"};
  return !modifiers[0].starts_with("tilted") ||
         std::find(timed_tilts.begin(), timed_tilts.end(), modifiers[0]) != timed_tilts.end();
}

bool all_counted(const Repetitions& repetitions) {
  return std::all_of(repetitions.begin(), repetitions.end(),
                     [](const QueryCost& c) { return c.instructions.has_value(); });
}

/// The largest number of repetitions on one of the cells.
std::size_t repetitions_on(const Times& times, const std::vector<std::size_t>& cells,
                           std::size_t candidate) {
  std::size_t max = 0;
  for (const std::size_t cell : cells) max = std::max(max, times[cell][candidate].size());
  return max;
}

/// Median over the cells, of each of so many repetitions. Precondition: all cells were timed.
template <class Value>
std::vector<double> over_cells(const Times& times, const std::vector<std::size_t>& cells,
                               std::size_t candidate, std::size_t repetitions, const Value& value) {
  std::vector<double> result;
  for (std::size_t r = 0; r < repetitions; ++r) {
    std::vector<double> values;
    for (const std::size_t cell : cells) {
      const Repetitions& of_cell = times[cell][candidate];
      values.push_back(value(of_cell[r % of_cell.size()]));
    }
    result.push_back(touchstone::spread(std::move(values))->median);
  }
  return result;
}

double nanoseconds(const QueryCost& cost) { return cost.nanoseconds; }

}  // namespace

Times time_queries(const Campaign& campaign, const std::vector<PoseClass>& cells,
                   const std::vector<std::optional<Sample>>& samples,
                   std::vector<CandidateProcess>& candidates) {
  Times times(samples.size(), std::vector<Repetitions>(campaign.candidates.size()));
  if (interrupted() || !campaign.is_timed) return times;
  std::vector<std::size_t> timed;
  for (std::size_t i = 0; i < samples.size(); ++i) {
    const bool wanted = !campaign.classes.empty() || !campaign.own.empty() || is_timed(cells[i]);
    if (samples[i] && wanted) timed.push_back(i);
  }
  const OnOneProcessor alone;
  Progress progress("pose classes timed", timed.size());
  std::mt19937_64 random(campaign.seed);
  for (std::size_t done = 0; done < timed.size() && !interrupted(); ++done) {
    times[timed[done]] = time_cell(*samples[timed[done]], candidates, random);
    progress.update(done + 1);
  }
  return times;
}

bool is_settled(const Repetitions& repetitions) {
  constexpr double tolerance = 0.03;
  std::vector<double> times;
  for (const QueryCost& cost : repetitions) times.push_back(cost.nanoseconds);
  const auto s = spread(std::move(times));
  return s && s->high - s->low <= tolerance * s->median;
}

std::optional<Spread> spread(std::vector<double> values) {
  if (values.empty()) return std::nullopt;
  std::sort(values.begin(), values.end());
  const std::size_t last = values.size() - 1;
  return Spread{values[last / 2], values[last / 4], values[last - last / 4]};
}

std::optional<QueryTime> query_time(const Times& times, const std::vector<std::size_t>& cells,
                                    std::size_t candidate) {
  std::vector<std::size_t> timed, counted;
  for (const std::size_t cell : cells) {
    const Repetitions& r = times[cell][candidate];
    if (r.empty()) continue;
    timed.push_back(cell);
    if (all_counted(r)) counted.push_back(cell);
  }
  const std::size_t repetitions = repetitions_on(times, timed, candidate);
  const auto time = spread(over_cells(times, timed, candidate, repetitions, nanoseconds));
  if (!time) return std::nullopt;
  QueryTime result{.nanoseconds = *time, .repetitions = repetitions};
  for (const std::size_t cell : timed) {
    // The least times of all repetitions are those of the last one.
    const std::optional<double>& tail = times[cell][candidate].back().tail;
    if (tail) result.p95 = std::max(result.p95.value_or(0), *tail);
  }
  if (counted == timed) {
    const auto instructions = [](const QueryCost& c) { return *c.instructions; };
    result.instructions =
        spread(over_cells(times, timed, candidate, repetitions, instructions))->median;
  }
  if (times[timed.front()][candidate].front().measured) {
    const auto median = [&](double QueryCost::Measured::*member) {
      const auto value = [&](const QueryCost& c) { return (*c.measured).*member; };
      return spread(over_cells(times, timed, candidate, repetitions, value))->median;
    };
    using Measured = QueryCost::Measured;
    result.measured = {median(&Measured::floor), median(&Measured::our_clock),
                       median(&Measured::processor)};
  }
  return result;
}

bool has_slow_tail(const QueryTime& time) { return *time.p95 > 4 * time.nanoseconds.median; }

std::optional<Spread> time_ratio(const Times& times, const std::vector<std::size_t>& cells,
                                 std::size_t candidate, std::size_t other) {
  std::vector<std::size_t> both;
  for (const std::size_t cell : cells) {
    if (!times[cell][candidate].empty() && !times[cell][other].empty()) both.push_back(cell);
  }
  const std::size_t repetitions =
      std::max(repetitions_on(times, both, candidate), repetitions_on(times, both, other));
  std::vector<double> ratios = over_cells(times, both, candidate, repetitions, nanoseconds);
  const std::vector<double> others = over_cells(times, both, other, repetitions, nanoseconds);
  for (std::size_t r = 0; r < ratios.size(); ++r) ratios[r] /= others[r];
  return spread(std::move(ratios));
}

}  // namespace touchstone
