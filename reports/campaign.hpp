#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "candidates/host/candidate_process.hpp"
#include "oracle/judge/score.hpp"
#include "oracle/truth.hpp"
#include "properties/identity.hpp"

namespace touchstone {

/// Which configurations are scored, by whom, and how strictly.
struct Campaign {
  std::vector<Pair> pairs;
  std::vector<std::string> classes;  ///< empty: all; else each must be a class of one of the pairs
  std::vector<Group> groups;         ///< empty: all
  Coverage coverage = Coverage::pairs;
  std::vector<const Candidate*> candidates;
  std::uint64_t count = 100;  ///< configurations of each pair × class
  /// As many of a class of the everyday and recorded groups and of arrangements along the world's
  /// own axes, to which their turned ones are compared.
  std::uint64_t everyday_times = 1;
  std::uint64_t seed = 1;
  unsigned workers = 1;
  Bar bar;
  Limits limits;  ///< of each candidate on one configuration
};

/// One pair × class.
struct Cell {
  Pair pair;
  std::string pose_class;
};
/// Lists the cells in report order. Throws InvalidInput when a class belongs to none of the pairs.
std::vector<Cell> cells(const Campaign& campaign);
std::uint64_t count_of(const Campaign& campaign, const Cell& cell);

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

/// Asks each candidate for all configurations in a new session, so that the scores depend on these
/// configurations alone, and hands the scored ones over in order. `width`: of the truth, relative
/// to the larger size. Throws like the oracle.
void score_configurations(std::span<const Configuration> configurations,
                          std::span<CandidateProcess* const> candidates, const Bar& bar,
                          double width,
                          const std::function<void(const ScoredConfiguration&)>& take);

}  // namespace touchstone
