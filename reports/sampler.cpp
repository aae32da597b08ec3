#include "reports/sampler.hpp"

#include <algorithm>
#include <set>
#include <stdexcept>

#include "candidates/host/worker_processes.hpp"
#include "properties/files/bytes.hpp"

namespace touchstone {
namespace {

Precision precision_for(Purpose purpose) {
  return purpose == Purpose::report ? Precision::exact : Precision::binned;
}

}  // namespace

Sample::Sample(std::size_t candidates, Purpose purpose)
    : tallies(candidates, ScoreTally(precision_for(purpose))),
      timed_outcomes(candidates),
      purpose_(purpose) {}

void Sample::add(std::size_t cell, std::uint64_t index, const ScoredConfiguration& scored) {
  for (std::size_t k = 0; k < tallies.size(); ++k) tallies[k].add(cell, index, scored.scores[k]);
  if (purpose_ == Purpose::campaign) return;
  oracle_microseconds.push_back(scored.oracle_microseconds);
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
  oracle_microseconds.insert(oracle_microseconds.end(), next.oracle_microseconds.begin(),
                             next.oracle_microseconds.end());
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

Sample::Examined Sample::examined(std::size_t candidate, std::uint64_t index) const {
  Examined result{blank<Configuration>(), {}, {}};
  BytesIn{examined_.at({candidate, index})}(result);
  return result;
}

namespace {

/// Scores a unit of answers that came in a file.
Sample sample_given(const Campaign& campaign, Purpose purpose, const PoseClass& cell,
                    const Unit& unit) {
  const std::span all(answers_in(*campaign.given, cell));
  Sample result(1, purpose);
  for (const GivenAnswer& given : all.subspan(unit.first, unit.last - unit.first)) {
    const Configuration c = answered_configuration(campaign, cell, given);
    try {
      score_answers({&c, 1}, {{given.answer()}}, campaign.bar, truth_width,
                    [&](const ScoredConfiguration& s) { result.add(unit.cell, given.index, s); });
    } catch (const std::exception& e) {
      throw std::runtime_error(given.id + ": " + e.what());
    }
  }
  return result;
}

/// Scores a run of them. Returns a sample of each unit.
std::vector<Sample> sample_given(const Campaign& campaign, Purpose purpose,
                                 const std::vector<PoseClass>& cells, const UnitRun& run) {
  std::vector<Sample> result;
  for (const Unit& unit : run) {
    result.push_back(sample_given(campaign, purpose, cells[unit.cell], unit));
  }
  return result;
}

}  // namespace

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

std::vector<Sample> sample_run(const Campaign& campaign, Purpose purpose,
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
      configurations.push_back(make_configuration(identity(places.back())));
    }
    unit_ends.push_back(places.size());
  }
  std::vector<Sample> result(run.size(), Sample(candidates.size(), purpose));
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
    throw std::runtime_error(to_string(identity(places[at])) + ": " + e.what());
  }
  return result;
}

bool sample(const Campaign& campaign, Purpose purpose, std::uint64_t count,
            const std::function<UnitRun(std::uint64_t)>& run,
            const std::function<void(std::uint64_t, std::vector<Sample>)>& take,
            const std::function<bool()>& go_on, const std::function<void()>& forget) {
  const std::vector<PoseClass> all = cells(campaign);
  WorkerCandidates candidates(campaign.candidates, campaign.bar.threshold, campaign.limits);
  return stream_from_processes(
      count, campaign.workers,
      [&](std::uint64_t task) {
        const std::vector<Sample> samples =
            campaign.given
                ? sample_given(campaign, purpose, all, run(task))
                : sample_run(campaign, purpose, pointers(candidates.get()), all, run(task));
        BytesOut out;
        for (const Sample& of_unit : samples) out(of_unit);
        return out.take();
      },
      [&](std::uint64_t task) {
        const auto [cell, first, last] = run(task).front();
        if (campaign.given) return answers_in(*campaign.given, all[cell])[first].id;
        return to_string(Identity{all[cell], campaign.seed, first});
      },
      [&](std::uint64_t task, const std::string& bytes) {
        BytesIn in(bytes);
        std::vector<Sample> samples(run(task).size(), Sample(campaign.candidates.size(), purpose));
        for (Sample& of_unit : samples) in(of_unit);
        take(task, std::move(samples));
      },
      go_on, forget);
}

}  // namespace touchstone
