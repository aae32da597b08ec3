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
  // All works are run together: to start the candidates takes a second.
  std::vector<Work> works;
  std::vector<std::function<void(std::span<const std::string>)>> takers;
  const auto add = [&](auto measure, auto& place) {
    works.push_back(std::move(measure.work));
    takers.push_back([&place, of = std::move(measure.result)](std::span<const std::string> texts) {
      place = of(texts);
    });
  };
  if (options.parts.contains(StabilityPart::amplification)) {
    if (options.base) {
      result.amplification =
          amplification(*options.base, options.ladder.seed, options.ladder.count, study);
    } else {
      add(amplification(options.ladder, study), result.amplification);
    }
  }
  if (options.parts.contains(StabilityPart::maps)) {
    const auto poses = of_pairs(critical_poses(), options.pairs,
                                [](const CriticalPose& pose) { return pose.configuration; });
    add(maps(poses, options.grid, study), result.maps);
  }
  if (options.parts.contains(StabilityPart::sequences)) {
    const auto chosen = of_pairs(motions(), options.pairs,
                                 [](const Motion& motion) { return pose_at(motion, 0, 1); });
    add(sequences(chosen, options.steps, study), result.sequences);
  }
  const std::vector<std::string> texts = run_in_workers(study, works);
  std::span<const std::string> left = texts;
  for (std::size_t i = 0; i < works.size(); ++i) {
    takers[i](left.first(works[i].count));
    left = left.subspan(works[i].count);
  }
  return result;
}

std::vector<std::string> run_in_workers(const Study& study, std::span<const Work> works) {
  struct Task {
    const Work* work;
    std::size_t number;
  };
  std::vector<Task> tasks;
  std::size_t poses = 0;
  for (const Work& work : works) {
    for (std::size_t i = 0; i < work.count; ++i) tasks.push_back({&work, i});
    poses += work.count * work.poses_per_task;
  }
  if (tasks.empty()) return {};
  Progress progress("poses", poses);
  WorkerCandidates candidates(study.candidates, study.bar.threshold, study.limits);
  return run_in_processes(
      tasks.size(), study.workers,
      [&](std::size_t i) { return tasks[i].work->run(tasks[i].number, candidates.get()); },
      [&](std::size_t i) { return tasks[i].work->name(tasks[i].number); },
      [&](std::size_t done) { progress.update(poses * done / tasks.size()); });
}

}  // namespace touchstone
