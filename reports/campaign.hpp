#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "candidates/host/candidate_process.hpp"
#include "oracle/judge/score.hpp"
#include "properties/identity.hpp"

namespace touchstone {

/// Which configurations are scored, by whom, and how strictly.
struct Campaign {
  std::vector<Pair> pairs;
  std::vector<std::string> classes;  ///< empty: all; else each must be a class of one of the pairs
  std::vector<const Candidate*> candidates;
  std::uint64_t count = 100;  ///< configurations of each pair × class
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
/// In report order. Throws InvalidInput when a class belongs to none of the pairs.
std::vector<Cell> cells(const Campaign& campaign);

/// The scores of one cell: scores[candidate][index]; none if the campaign was interrupted before it
/// was done.
struct CellScores {
  std::vector<std::vector<Score>> scores;
  std::vector<double> oracle_microseconds;
  std::vector<double> signed_distance;  ///< true, metres

  bool done() const { return !oracle_microseconds.empty(); }
};

/// One configuration's scores, in the order of the candidates.
struct ScoredConfiguration {
  std::uint64_t index;
  double oracle_microseconds;
  double signed_distance;  ///< true, metres
  std::vector<Score> scores;
};

/// Scores the configurations first … last − 1 of a cell and hands them over in order. Each
/// candidate has a new session: the scores depend on these configurations alone. Throws
/// std::runtime_error naming the configuration whose truth contradicts itself.
void score_range(const Campaign& campaign, std::vector<CandidateProcess>& candidates,
                 const Cell& cell, std::uint64_t first, std::uint64_t last,
                 const std::function<void(const ScoredConfiguration&)>& take);

/// Scores every cell, spread over worker processes, in each of which every candidate has a process
/// of its own and a new session for each cell: the result does not depend on how many there are,
/// nor on what other candidates do. Progress goes to standard error. Throws std::runtime_error
/// naming the cell if a worker itself dies. When an end is asked for (interruption.hpp), cells that
/// are not done by then have no scores.
std::vector<CellScores> run(const Campaign& campaign);

}  // namespace touchstone
