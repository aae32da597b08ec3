#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <span>
#include <string>
#include <vector>

#include "candidates/host/candidate_process.hpp"
#include "oracle/judge/score.hpp"
#include "oracle/truth.hpp"
#include "properties/identity.hpp"

namespace touchstone {

/// A configuration of a person's own, by its id in a file.
struct OwnConfiguration {
  std::string id;
  Configuration configuration;
};

/// Which configurations are scored, by whom, and how strictly.
struct Campaign {
  std::vector<Pair> pairs = {};
  std::vector<std::string> classes = {};  ///< empty: all; else each must be of one of the pairs
  std::vector<Group> groups = {};         ///< empty: all
  Coverage coverage = Coverage::pairs;
  /// In place of drawn ones, if there are any: those of each pair, its class "given".
  std::map<Pair, std::vector<OwnConfiguration>> own = {};
  std::string own_file = {};  ///< that they are in; "-": standard input
  std::vector<const Candidate*> candidates = {};
  std::uint64_t count = 100;  ///< configurations of each pair × class
  bool is_timed = true;       ///< are answers timed in a report?
  /// As many of a class of the everyday and recorded groups and of arrangements along the world's
  /// own axes, to which their turned ones are compared.
  std::uint64_t everyday_times = 1;
  std::uint64_t seed = 1;
  unsigned workers = 1;
  Bar bar = {};
  Limits limits = {};  ///< of each candidate on one configuration
};

/// Lists the classes of all pairs in report order: the campaign's cells. Throws InvalidInput when a
/// class belongs to none of the pairs.
std::vector<PoseClass> cells(const Campaign& campaign);
std::uint64_t count_of(const Campaign& campaign, const PoseClass& cell);
/// One configuration of a cell, drawn or the person's own, and what it is called: by its identity,
/// or its id in the file.
Configuration configuration_of(const Campaign& campaign, const Identity& identity);
std::string name_of(const Campaign& campaign, const Identity& identity);

/// A number made from those of a configuration: sums tell files of configurations apart, whatever
/// their order.
std::uint64_t hash_of(const Configuration& configuration);

/// Width of every truth that a score is against, relative to the larger size.
inline constexpr double truth_width = 1e-30;

/// One configuration, its truth, and what candidates make of it, in their order.
struct ScoredConfiguration {
  Configuration configuration;
  oracle::Truth truth;
  double oracle_microseconds;
  std::vector<Answer> answers;
  std::vector<Score> scores;
};

/// Hands over the scored configurations in order. `answers`: of each candidate to each
/// configuration. `width`: of the truth, relative to the larger size. Throws like the oracle.
void score_answers(std::span<const Configuration> configurations,
                   std::vector<std::vector<Answer>> answers, const Bar& bar, double width,
                   const std::function<void(const ScoredConfiguration&)>& take);

/// A candidate that times out again and again would take nearly all the time of a campaign. Once so
/// many of its answers in a unit have timed out (each confirmed alone: Limits), it is stopped
/// there: the rest of the unit is not asked. Neither workers nor shards change which answers these
/// are, for a unit is asked in the order of its configurations, and its limit of time follows from
/// answers of the same run alone.
inline constexpr int max_timeouts = 3;

/// Answers of one candidate in a new session; Answer::was_asked says to which there is none.
/// `unit_ends`: where each unit ends, the last one at the end of the configurations. `ask` is
/// CandidateProcess::answers_until_timeout.
std::vector<Answer> answers_until_stopped(
    const std::function<std::vector<Answer>(std::span<const Configuration>, bool in_new_session)>&
        ask,
    std::span<const Configuration> configurations, std::span<const std::size_t> unit_ends);

/// Asks each candidate for all configurations in a new session, so that the scores depend on these
/// configurations alone, and hands the scored ones over in order. `width`: of the truth, relative
/// to the larger size. Throws like the oracle.
void score_configurations(std::span<const Configuration> configurations,
                          std::span<CandidateProcess* const> candidates, const Bar& bar,
                          double width,
                          const std::function<void(const ScoredConfiguration&)>& take);

}  // namespace touchstone
