#include "reports/sampler.hpp"

#include <algorithm>
#include <set>
#include <stdexcept>

#include "candidates/host/worker_processes.hpp"

namespace touchstone {
namespace {

void put(ByteWriter& out, const Magnitudes& m) {
  if (m.precision() == Precision::exact) {
    out.put(m.values());
    return;
  }
  out.put(m.max());
  out.put(m.bins().size());
  for (const auto& [bin, count] : m.bins()) {
    out.put(bin);
    out.put(count);
  }
}

Magnitudes get_magnitudes(ByteReader& in, Precision precision) {
  if (precision == Precision::exact) return Magnitudes(in.get_all<double>());
  const auto max = in.get<double>();
  Magnitudes::Bins bins;
  for (auto left = in.get<std::size_t>(); left > 0; --left) {
    const auto bin = in.get<std::uint16_t>();
    bins[bin] = in.get<std::uint64_t>();
  }
  return Magnitudes(std::move(bins), max);
}

void put(ByteWriter& out, const ScoreTally& t) {
  out.put(t.count);
  out.put(t.outcomes);
  out.put(t.points.size());
  for (const auto& [number, count] : t.points) {
    out.put(number);
    out.put(count);
  }
  for (const Magnitudes& m : t.errors) put(out, m);
  put(out, t.bias.negative);
  put(out, t.bias.positive);
  put(out, t.severity);
  put(out, t.coverage.uncovered);
  out.put(t.coverage.sum);
  out.put(t.coverage.values);
  out.put(t.worst);
}

ScoreTally get_tally(ByteReader& in, Precision precision) {
  ScoreTally t(precision);
  t.count = in.get<std::uint64_t>();
  t.outcomes = in.get<decltype(t.outcomes)>();
  for (auto left = in.get<std::size_t>(); left > 0; --left) {
    const auto number = in.get<int>();
    t.points[number] = in.get<std::uint64_t>();
  }
  for (Magnitudes& m : t.errors) m = get_magnitudes(in, precision);
  t.bias.negative = get_magnitudes(in, precision);
  t.bias.positive = get_magnitudes(in, precision);
  t.severity = get_magnitudes(in, precision);
  t.coverage.uncovered = get_magnitudes(in, precision);
  t.coverage.sum = in.get<std::uint64_t>();
  t.coverage.values = in.get_all<double>();
  t.worst = in.get_all<Case>();
  return t;
}

Precision precision_for(Purpose purpose) {
  return purpose == Purpose::report ? Precision::exact : Precision::binned;
}

std::string examined_bytes(const ScoredConfiguration& scored, std::size_t candidate) {
  ByteWriter out;
  out.put(scored.configuration);
  out.put(scored.truth);
  std::vector<std::size_t> shown = {candidate};
  if (candidate > 0 && scored.answers[0].was_asked) shown.push_back(0);
  out.put(shown.size());
  for (const std::size_t k : shown) {
    out.put(scored.answers[k]);
    out.put(scored.scores[k]);
  }
  return out.take();
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
    examined_[{k, index}] = examined_bytes(scored, k);
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
  ByteReader in(examined_.at({candidate, index}));
  Examined result{in.get_configuration(), in.get_truth(), {}};
  for (auto left = in.get<std::size_t>(); left > 0; --left) {
    Answer answer = in.get_answer();
    result.answers.push_back({std::move(answer), in.get<Score>()});
  }
  return result;
}

std::string Sample::bytes() const {
  ByteWriter out;
  for (const ScoreTally& tally : tallies) put(out, tally);
  if (purpose_ == Purpose::campaign) return out.take();
  out.put(oracle_microseconds);
  trends.write(out);
  out.put(timed.size());
  for (const Configuration& c : timed) out.put(c);
  for (const auto& outcomes : timed_outcomes) out.put(outcomes);
  out.put(examined_.size());
  for (const auto& [key, bytes] : examined_) {
    out.put(key.first);
    out.put(key.second);
    out.put(bytes);
  }
  return out.take();
}

Sample Sample::from_bytes(const std::string& bytes, std::size_t candidates, Purpose purpose) {
  Sample result(candidates, purpose);
  ByteReader in(bytes);
  for (ScoreTally& tally : result.tallies) tally = get_tally(in, precision_for(purpose));
  if (purpose == Purpose::campaign) return result;
  result.oracle_microseconds = in.get_all<double>();
  result.trends = TrendTally::read(in);
  for (auto left = in.get<std::size_t>(); left > 0; --left) {
    result.timed.push_back(in.get_configuration());
  }
  for (auto& outcomes : result.timed_outcomes) outcomes = in.get_all<Outcome>();
  for (auto left = in.get<std::size_t>(); left > 0; --left) {
    const auto candidate = in.get<std::size_t>();
    const auto index = in.get<std::uint64_t>();
    result.examined_[{candidate, index}] = in.get_text();
  }
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
        ByteWriter out;
        for (const Sample& of_unit : samples) out.put(of_unit.bytes());
        return out.take();
      },
      [&](std::uint64_t task) {
        const auto [cell, first, last] = run(task).front();
        if (campaign.given) return answers_in(*campaign.given, all[cell])[first].id;
        return to_string(Identity{all[cell], campaign.seed, first});
      },
      [&](std::uint64_t task, const std::string& bytes) {
        ByteReader in(bytes);
        std::vector<Sample> samples;
        for (auto left = run(task).size(); left > 0; --left) {
          samples.push_back(Sample::from_bytes(in.get_text(), campaign.candidates.size(), purpose));
        }
        take(task, std::move(samples));
      },
      go_on, forget);
}

}  // namespace touchstone
