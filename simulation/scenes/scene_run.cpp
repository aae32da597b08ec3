#include "simulation/scenes/scene_run.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <limits>

#include "candidates/host/progress.hpp"
#include "candidates/host/worker_processes.hpp"
#include "simulation/scenes/evidence.hpp"

namespace touchstone {

bool SceneRun::holds() const { return first_broken() < 0; }

double SceneRun::error() const {
  double largest = 0;
  for (const Verdict& v : verdicts) largest = std::max(largest, v.share());
  return largest;
}

int SceneRun::first_broken() const {
  int first = -1;
  for (std::size_t i = 0; i < verdicts.size(); ++i) {
    if (verdicts[i].holds()) continue;
    if (first < 0 || verdicts[i].time < verdicts[first].time) first = static_cast<int>(i);
  }
  return first;
}

CandidateProcess& Processes::of(const Candidate& candidate) {
  const auto found = processes_.find(&candidate);
  if (found != processes_.end()) return found->second;
  return processes_.emplace(&candidate, CandidateProcess(candidate, simulation_threshold, limits_))
      .first->second;
}

Trajectory run_with(const Scene& scene, const PairKinds& kinds,
                    const std::vector<const Candidate*>& models, const Candidate& exact,
                    Processes& processes) {
  PairwiseModel model([&](int a, int b) -> CandidateProcess& {
    const int kind = kinds.of(a, b);
    return processes.of(kind >= 0 && models[kind] ? *models[kind] : exact);
  });
  return run_scene(scene, model);
}

void judge(std::vector<SceneRun>& runs, const SceneFile& file, const Trajectory& exact_run,
           const PairKinds& kinds, const Candidate& exact, const Limits& limits, unsigned workers) {
  if (runs.empty()) return;
  Progress progress("runs of the scene", runs.size());
  Processes processes(limits);  // each worker starts its own
  const auto results = run_in_processes(
      runs.size(), workers,
      [&](std::size_t i) {
        SceneRun run = runs[i];
        const Trajectory went = run_with(file.scene, kinds, run.models, exact, processes);
        for (const Need& need : file.needs) {
          run.verdicts.push_back(measure(need, file.scene, went, exact_run));
        }
        if (!run.holds()) run.evidence = find_evidence(run, file, went, kinds, exact, processes);
        return to_bytes(run);
      },
      [&](std::size_t i) { return file.name + " with " + runs[i].name; },
      [&](std::size_t done) { progress.update(done); });
  for (std::size_t i = 0; i < runs.size(); ++i) from_bytes(results[i], runs[i]);
}

}  // namespace touchstone
