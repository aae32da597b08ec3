#pragma once

#include <algorithm>
#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "reports/campaign.hpp"
#include "reports/tally.hpp"

namespace touchstone {

/// Consecutive configurations of one cell (pair × class): indices first … last − 1.
struct Unit {
  /// Few enough that a checkpoint loses little.
  static constexpr std::uint64_t max_size = 512;

  std::size_t cell;
  std::uint64_t first, last;
};

/// Units that each cell of so many configurations is cut into, which differ by at most one
/// configuration: were they full but for the last one, this could need a session for itself.
struct EqualUnits {
  std::uint64_t count;

  std::uint64_t units() const { return (count + Unit::max_size - 1) / Unit::max_size; }
  /// Configurations of every unit; the first `larger()` ones have one more.
  std::uint64_t size() const { return count / units(); }
  std::uint64_t larger() const { return count % units(); }
  Unit unit(std::size_t cell, std::uint64_t number) const {
    const auto first = [&](std::uint64_t n) { return n * size() + std::min(n, larger()); };
    return {cell, first(number), first(number + 1)};
  }
};

/// Units that one worker scores in turn, in one session of each candidate as long as it survives.
/// Runs are fixed by whoever plans them, so that answers, even of a candidate with a memory, do not
/// depend on the number of workers.
using UnitRun = std::vector<Unit>;

/// Configurations of a run, and so of a session: a new one costs a candidate as much as hundreds of
/// answers.
inline constexpr std::uint64_t run_size = 1024;

/// Joins successive units to runs of up to `max_size` configurations, or of one larger unit.
std::vector<UnitRun> runs_of(const std::vector<Unit>& units, std::uint64_t max_size);

/// What is kept of the scored configurations of a unit or, added up, of a cell. A configuration is
/// made once and its truth computed once: whatever needs them later finds them here.
struct Sample {
  /// Configurations of a cell that are kept for timing: more would not change its median.
  static constexpr std::uint64_t max_timed = 50;

  /// Exact ones have what a report needs besides tallies.
  Sample(std::size_t candidates, Resolution resolution);
  /// Adds the next configuration of a unit.
  void add(std::size_t cell, std::uint64_t index, const ScoredConfiguration& scored);
  /// Adds the next unit of the same cell.
  void add(const Sample& next);

  std::vector<ScoreTally> tallies;  ///< of each candidate
  // Of exact ones alone:
  Magnitudes oracle_microseconds{Resolution::exact};
  TrendTally trends;
  std::vector<Configuration> timed;                  ///< the first of the cell
  std::vector<std::vector<Outcome>> timed_outcomes;  ///< [candidate], of `timed`

  /// Truth and answers of one of a candidate's worst cases: its own answer, then that of the first
  /// candidate, where that is another.
  struct Examined {
    Configuration configuration;
    oracle::Truth truth;
    std::vector<std::pair<Answer, Score>> answers;
  };
  /// Absent unless the sample is exact.
  std::optional<Examined> examined(std::size_t candidate, std::uint64_t index) const;

  template <class Archive>
  friend void members(Archive& a, Sample& s) {
    a(s.tallies, s.oracle_microseconds, s.trends, s.timed, s.timed_outcomes, s.examined_);
  }

 private:
  void forget_better_cases();

  bool is_exact_;
  /// Examined, as bytes, by candidate and index: of the tallies' worst cases and no others.
  std::map<std::pair<std::size_t, std::uint64_t>, std::string> examined_;
};

/// What scores units, and how: a campaign's candidates, or answers that came in a file.
struct Scorer {
  std::size_t candidates;
  Resolution resolution;
  unsigned workers;
  /// In a worker process: a sample of each unit.
  std::function<std::vector<Sample>(const UnitRun&)> score;
  std::function<std::string(const Unit&)> name;  ///< of a unit's first configuration, for errors
};
/// Asks the campaign's candidates, each of which has a process of its own in each worker.
Scorer scorer(const Campaign& campaign, Resolution resolution);

/// Scores runs 0 … count − 1, as `run` numbers them, spread over worker processes. The samples of a
/// run's units are handed over as they come, runs in no certain order; they depend neither on the
/// number of workers nor on other candidates. Ends early, without the runs in hand, once `go_on`
/// returns false; it is called every 100 ms or more often. Returns whether all runs were scored.
/// Throws std::runtime_error naming the configuration whose truth contradicts itself, or the run in
/// which a worker died by its first configuration. `forget` is called in each worker before the
/// first run.
bool sample(
    const Scorer& scorer, std::uint64_t count, const std::function<UnitRun(std::uint64_t)>& run,
    const std::function<void(std::uint64_t, std::vector<Sample>)>& take,
    const std::function<bool()>& go_on, const std::function<void()>& forget = [] {});

/// Scores cells of so many configurations, and shows how far it is. Absent where the run was
/// interrupted (interruption.hpp) before all of a cell was scored.
std::vector<std::optional<Sample>> sample_cells(const Scorer& scorer,
                                                const std::vector<std::uint64_t>& counts);

/// Scores one run in this process; `cells` are those of the campaign. Returns a sample of each
/// unit.
std::vector<Sample> sample_run(const Campaign& campaign, Resolution resolution,
                               std::span<CandidateProcess* const> candidates,
                               const std::vector<PoseClass>& cells, const UnitRun& run);

}  // namespace touchstone
