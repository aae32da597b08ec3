#pragma once

#include <functional>
#include <set>
#include <span>
#include <string>
#include <vector>

#include "properties/files/bytes.hpp"
#include "properties/motions/motion.hpp"
#include "reports/campaign.hpp"
#include "reports/stability/stability.hpp"

namespace touchstone {

/// Who is asked, and how strictly. The number of workers does not change the result.
struct Study {
  std::vector<const Candidate*> candidates;
  Bar bar;
  Limits limits;
  unsigned workers = 1;
};

/// Around which configurations steps are made: `count` of each cell, and at each of the sixteen
/// amplitudes one step from each of them.
struct Ladder {
  std::vector<PoseClass> cells;
  std::uint64_t seed = 1, count = 6;
};

/// Every class of these pairs whose degeneracy is exact.
std::vector<PoseClass> degenerate_cells(const std::vector<Pair>& pairs);

/// Work in tasks for worker processes, in which each candidate has a process of its own.
struct Work {
  std::size_t count;                                  ///< tasks
  std::size_t poses_per_task;                         ///< about; what progress counts
  std::function<std::string(std::size_t task)> name;  ///< of a task, for errors
  std::function<std::string(std::size_t task, std::vector<CandidateProcess>&)> run;
};
/// Work, and what comes out of what its tasks have returned, in their order; an empty string for
/// one that was interrupted.
template <class Result>
struct Measure {
  Work work;
  std::function<Result(std::span<const std::string>)> result;
};
/// Runs the tasks of all works in the study's workers, and returns what they returned, one work's
/// after the other's.
std::vector<std::string> run_in_workers(const Study& study, std::span<const Work> works);

/// What tasks have returned, but for those that were interrupted before.
template <class Value>
std::vector<Value> finished(std::span<const std::string> texts) {
  std::vector<Value> result;
  for (const std::string& text : texts) {
    if (!text.empty()) result.push_back(from_bytes<Value>(text));
  }
  return result;
}

template <class Result>
Result run(const Measure<Result>& measure, const Study& study) {
  return measure.result(run_in_workers(study, {&measure.work, 1}));
}

Measure<Amplification> amplification(const Ladder& ladder, const Study& study);
/// Around one configuration: `count` steps at each amplitude.
Amplification amplification(const Subject& base, std::uint64_t seed, std::uint64_t count,
                            const Study& study);

/// Which pixels are asked.
struct MapGrid {
  std::vector<Decade> zooms;
  int stride = 1;  ///< every so many columns and rows, the middle one included; divides map_reach
};

/// Contacts whose points cover less of the patch have too few (as the law "manifold" has it).
inline constexpr double min_coverage = 0.3;
char map_letter(const Score& score);  ///< precondition: the candidate supports the pair

Measure<FailureMaps> maps(const std::vector<const CriticalPose*>& poses, const MapGrid& grid,
                          const Study& study);

/// Each of these motions in so many steps.
Measure<Sequences> sequences(const std::vector<const Motion*>& motions, int steps,
                             const Study& study);

enum class StabilityPart { amplification, maps, sequences };
/// Throws InvalidInput (field "--part") unless it is "amplification", "maps" or "sequences".
StabilityPart parse_stability_part(std::string_view name);

struct StabilityOptions {
  Study study;
  std::set<StabilityPart> parts = {StabilityPart::amplification, StabilityPart::maps,
                                   StabilityPart::sequences};
  std::vector<Pair> pairs;      ///< of maps and sequences
  Ladder ladder;                ///< of amplification …
  std::optional<Subject> base;  ///< … unless it is around this one
  MapGrid grid;
  int steps = 400;  ///< of each motion
};

/// All pairs, all degenerate classes, the finest maps.
StabilityOptions thorough(const Study& study, std::uint64_t seed);
/// A sample of them that takes about ten seconds on two cores, for the report.
StabilityOptions brief(const Study& study, const std::vector<Pair>& pairs, std::uint64_t seed);

/// Measures the parts that are asked for. The same options give the same result. Progress goes to
/// standard error.
Stability measure(const StabilityOptions& options);

}  // namespace touchstone
