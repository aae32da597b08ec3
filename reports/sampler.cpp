#include "reports/sampler.hpp"

#include <algorithm>
#include <memory>
#include <numeric>
#include <set>
#include <stdexcept>

#include "candidates/host/interruption.hpp"
#include "candidates/host/progress.hpp"
#include "candidates/host/worker_processes.hpp"
#include "properties/files/bytes.hpp"

namespace touchstone {

Sample::Sample(std::size_t candidates, Resolution resolution)
    : tallies(candidates, ScoreTally(resolution)),
      timed_outcomes(candidates),
      is_exact_(resolution == Resolution::exact) {}

void Sample::add(std::size_t cell, std::uint64_t index, const ScoredConfiguration& scored) {
  for (std::size_t k = 0; k < tallies.size(); ++k) tallies[k].add(cell, index, scored.scores[k]);
  if (!is_exact_) return;
  oracle_microseconds.add(scored.oracle_microseconds);
  trends.add(scored.configuration, scored.truth.signed_distance.midpoint(), scored.scores);
  if (index < max_timed) timed.push_back(scored.configuration);
  bool is_among_worst = false;
  for (std::size_t k = 0; k < tallies.size(); ++k) {
    if (index < max_timed) timed_outcomes[k].push_back(scored.scores[k].outcome);
    const auto& worst = tallies[k].worst;
    if (std::none_of(worst.begin(), worst.end(), [&](const Case& c) { return c.index == index; })) {
      continue;
    }
    Examined examined{scored.configuration, scored.truth, {{scored.answers[k], scored.scores[k]}}};
    if (k > 0 && scored.answers[0].was_asked) {
      examined.answers.emplace_back(scored.answers[0], scored.scores[0]);
    }
    examined_[{k, index}] = to_bytes(examined);
    is_among_worst = true;
  }
  if (is_among_worst) forget_better_cases();
}

void Sample::add(const Sample& next) {
  for (std::size_t k = 0; k < tallies.size(); ++k) {
    tallies[k].add(next.tallies[k]);
    timed_outcomes[k].insert(timed_outcomes[k].end(), next.timed_outcomes[k].begin(),
                             next.timed_outcomes[k].end());
  }
  oracle_microseconds.add(next.oracle_microseconds);
  trends.add(next.trends);
  timed.insert(timed.end(), next.timed.begin(), next.timed.end());
  examined_.insert(next.examined_.begin(), next.examined_.end());
  forget_better_cases();
}

void Sample::forget_better_cases() {
  std::set<std::pair<std::size_t, std::uint64_t>> worst;
  for (std::size_t k = 0; k < tallies.size(); ++k) {
    for (const Case& c : tallies[k].worst) worst.insert({k, c.index});
  }
  std::erase_if(examined_, [&](const auto& entry) { return !worst.contains(entry.first); });
}

std::optional<Sample::Examined> Sample::examined(std::size_t candidate, std::uint64_t index) const {
  const auto found = examined_.find({candidate, index});
  if (found == examined_.end()) return std::nullopt;
  return from_bytes<Examined>(found->second);
}

std::vector<UnitRun> runs_of(const std::vector<Unit>& units, std::uint64_t max_size) {
  std::vector<UnitRun> runs;
  std::uint64_t room = 0;
  for (const Unit& unit : units) {
    const std::uint64_t size = unit.last - unit.first;
    if (runs.empty() || size > room) {
      runs.emplace_back();
      room = std::max(size, max_size);
    }
    runs.back().push_back(unit);
    room -= size;
  }
  return runs;
}

std::vector<Sample> sample_run(const Campaign& campaign, Resolution resolution,
                               std::span<CandidateProcess* const> candidates,
                               const std::vector<PoseClass>& cells, const UnitRun& run) {
  /// Where a configuration belongs.
  struct Place {
    std::size_t unit;
    std::uint64_t index;
  };
  std::vector<Configuration> configurations;
  std::vector<Place> places;
  std::vector<std::size_t> unit_ends;
  const auto identity = [&](const Place& place) {
    return Identity{cells[run[place.unit].cell], campaign.seed, place.index};
  };
  for (std::size_t unit = 0; unit < run.size(); ++unit) {
    for (std::uint64_t i = run[unit].first; i < run[unit].last; ++i) {
      places.push_back({unit, i});
      configurations.push_back(configuration_of(campaign, identity(places.back())));
    }
    unit_ends.push_back(places.size());
  }
  std::vector<Sample> result(run.size(), Sample(candidates.size(), resolution));
  std::size_t at = 0;
  try {
    std::vector<std::vector<Answer>> answers;
    for (CandidateProcess* const candidate : candidates) {
      const auto ask = [&](std::span<const Configuration> asked, bool in_new_session) {
        return candidate->answers_until_timeout(asked, in_new_session);
      };
      answers.push_back(answers_until_stopped(ask, configurations, unit_ends));
    }
    score_answers(configurations, std::move(answers), campaign.bar, truth_width,
                  [&](const ScoredConfiguration& scored) {
                    const auto [unit, index] = places[at];
                    result[unit].add(run[unit].cell, index, scored);
                    ++at;
                  });
  } catch (const std::exception& e) {
    throw std::runtime_error(name_of(campaign, identity(places[at])) + ": " + e.what());
  }
  return result;
}

Scorer scorer(const Campaign& campaign, Resolution resolution) {
  const auto candidates = std::make_shared<WorkerCandidates>(
      campaign.candidates, campaign.bar.threshold, campaign.limits);
  return {campaign.candidates.size(), resolution, campaign.workers,
          [=, cells = cells(campaign)](const UnitRun& run) {
            return sample_run(campaign, resolution, pointers(candidates->get()), cells, run);
          },
          [=, cells = cells(campaign)](const Unit& unit) {
            return name_of(campaign, {cells[unit.cell], campaign.seed, unit.first});
          }};
}

bool sample(const Scorer& scorer, std::uint64_t count,
            const std::function<UnitRun(std::uint64_t)>& run,
            const std::function<void(std::uint64_t, std::vector<Sample>)>& take,
            const std::function<bool()>& go_on, const std::function<void()>& forget) {
  return stream_from_processes(
      count, scorer.workers,
      [&](std::uint64_t task) {
        BytesOut out;
        for (const Sample& of_unit : scorer.score(run(task))) out(of_unit);
        return out.take();
      },
      [&](std::uint64_t task) { return scorer.name(run(task).front()); },
      [&](std::uint64_t task, const std::string& bytes) {
        BytesIn in(bytes);
        std::vector<Sample> samples(run(task).size(), Sample(scorer.candidates, scorer.resolution));
        for (Sample& of_unit : samples) in(of_unit);
        take(task, std::move(samples));
      },
      go_on, forget);
}

std::vector<std::optional<Sample>> sample_cells(const Scorer& scorer,
                                                const std::vector<std::uint64_t>& counts) {
  std::vector<Unit> units;
  for (std::size_t cell = 0; cell < counts.size(); ++cell) {
    const EqualUnits cut{counts[cell]};
    for (std::uint64_t n = 0; n < cut.units(); ++n) units.push_back(cut.unit(cell, n));
  }
  const std::vector<UnitRun> runs = runs_of(units, run_size);
  std::vector<std::vector<Sample>> samples(runs.size());  // of the units of each run
  Progress progress("configurations",
                    std::accumulate(counts.begin(), counts.end(), std::uint64_t{0}));
  std::uint64_t done = 0;
  sample(
      scorer, runs.size(), [&](std::uint64_t number) { return runs[number]; },
      [&](std::uint64_t number, std::vector<Sample> of_run) {
        samples[number] = std::move(of_run);
        for (const Unit& unit : runs[number]) done += unit.last - unit.first;
        progress.update(done);
      },
      [] { return !interrupted(); });

  std::vector<std::vector<Sample*>> units_of(counts.size());  // of each cell
  for (std::size_t number = 0; number < runs.size(); ++number) {
    for (std::size_t i = 0; i < samples[number].size(); ++i) {
      units_of[runs[number][i].cell].push_back(&samples[number][i]);
    }
  }
  std::vector<std::optional<Sample>> result(counts.size());
  for (std::size_t cell = 0; cell < counts.size(); ++cell) {
    const std::vector<Sample*>& parts = units_of[cell];
    if (parts.empty() || parts.size() < EqualUnits{counts[cell]}.units()) continue;
    result[cell] = sum_of(0, parts.size(), [&](std::size_t i) { return std::move(*parts[i]); });
  }
  return result;
}

}  // namespace touchstone
