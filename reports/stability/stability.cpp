#include <algorithm>

#include "candidates/host/progress.hpp"
#include "candidates/host/worker_processes.hpp"
#include "reference/invalid_input.hpp"
#include "reports/stability/measure.hpp"

namespace touchstone {
namespace {

template <class Thing, class ConfigurationOf>
std::vector<const Thing*> of_pairs(const std::vector<Thing>& all, const std::vector<Pair>& pairs,
                                   ConfigurationOf configuration) {
  std::vector<const Thing*> result;
  for (const Thing& thing : all) {
    const Pair pair = pair_of(configuration(thing));
    if (std::find(pairs.begin(), pairs.end(), pair) != pairs.end()) result.push_back(&thing);
  }
  return result;
}

}  // namespace

StabilityPart parse_stability_part(std::string_view name) {
  if (name == "amplification") return StabilityPart::amplification;
  if (name == "maps") return StabilityPart::maps;
  if (name == "sequences") return StabilityPart::sequences;
  throw InvalidInput("--part", '"' + std::string(name) + '"',
                     "must be one of amplification, maps, sequences");
}

StabilityOptions thorough(const Study& study, std::uint64_t seed) {
  StabilityOptions options;
  options.study = study;
  options.pairs.assign(std::begin(all_pairs), std::end(all_pairs));
  options.ladder = {degenerate_cells(options.pairs), seed, 6};
  for (const int exponent : {-15, -12, -8, -4, -2}) options.grid.zooms.emplace_back(exponent);
  return options;
}

StabilityOptions brief(const Study& study, const std::vector<Pair>& pairs, std::uint64_t seed) {
  StabilityOptions options;
  options.study = study;
  options.pairs = pairs;
  options.ladder = {degenerate_cells(pairs), seed, 3};
  for (const int exponent : {-15, -8, -2}) options.grid.zooms.emplace_back(exponent);
  options.grid.stride = 2;
  options.steps = 100;
  return options;
}

Stability measure(const StabilityOptions& options) {
  const Study& study = options.study;
  Stability result{{}, study.bar.tolerance, study.bar.threshold, {}, {}, {}};
  for (const Candidate* c : study.candidates) result.candidates.push_back(c->name);
  if (options.parts.contains(StabilityPart::amplification)) {
    result.amplification = options.base ? amplification(*options.base, options.ladder.seed,
                                                        options.ladder.count, study)
                                        : amplification(options.ladder, study);
  }
  if (options.parts.contains(StabilityPart::maps)) {
    const auto poses = of_pairs(critical_poses(), options.pairs,
                                [](const CriticalPose& pose) { return pose.configuration; });
    result.maps = maps(poses, options.grid, study);
  }
  if (options.parts.contains(StabilityPart::sequences)) {
    const auto chosen = of_pairs(motions(), options.pairs,
                                 [](const Motion& motion) { return pose_at(motion, 0, 1); });
    result.sequences = sequences(chosen, options.steps, study);
  }
  return result;
}

std::vector<std::string> run_in_workers(
    const Study& study, const Work& work,
    const std::function<std::string(std::size_t, std::vector<CandidateProcess>&)>& run) {
  Progress progress(work.unit, work.count * work.units_per_task);
  WorkerCandidates candidates(study.candidates, study.bar.threshold, study.limits);
  return run_in_processes(
      work.count, study.workers, [&](std::size_t task) { return run(task, candidates.get()); },
      work.name, [&](std::size_t done) { progress.update(done * work.units_per_task); });
}

}  // namespace touchstone
