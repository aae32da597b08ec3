#include "simulation/scenes/scene_run.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <functional>
#include <limits>

#include "candidates/host/progress.hpp"
#include "candidates/host/worker_processes.hpp"
#include "simulation/scenes/evidence.hpp"

namespace touchstone {
namespace {

/// A candidate for each pair of bodies.
class PairwiseModel : public ContactModel {
 public:
  /// The process that answers for bodies a and b, always the same one for the same pair.
  using Choice = std::function<CandidateProcess&(int a, int b)>;
  explicit PairwiseModel(Choice choice) : choice_(std::move(choice)) {}
  void begin() override { begun_.clear(); }
  std::vector<Answer> answers(std::span<const PairQuestion> questions) override {
    std::vector<CandidateProcess*> chosen;
    for (const PairQuestion& q : questions) {
      chosen.push_back(&choice_(q.a, q.b));
      if (std::find(begun_.begin(), begun_.end(), chosen.back()) != begun_.end()) continue;
      chosen.back()->restart();
      begun_.push_back(chosen.back());
    }
    std::vector<Answer> result(questions.size());
    for (CandidateProcess* process : begun_) {
      std::vector<PairQuestion> batch;
      for (std::size_t i = 0; i < questions.size(); ++i) {
        if (chosen[i] == process) batch.push_back(questions[i]);
      }
      if (batch.empty()) continue;
      auto answers = CandidateModel(*process).answers(batch);
      auto next = answers.begin();
      for (std::size_t i = 0; i < questions.size(); ++i) {
        if (chosen[i] == process) result[i] = std::move(*next++);
      }
    }
    return result;
  }

 private:
  Choice choice_;
  std::vector<CandidateProcess*> begun_;
};

}  // namespace

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
