#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "candidates/host/candidate_process.hpp"
#include "simulation/scenes/pair_kind.hpp"
#include "simulation/scenes/scene_file.hpp"

namespace touchstone {

/// The configuration on which a run's models were worst before its first need broke.
struct Evidence {
  Configuration configuration;
  std::string bodies, candidate;
  std::string wrong;  ///< in words: "missed, 0.0012 m deep"
  double time;        ///< s
};

/// A whole run of a scene with a candidate for each kind of pairs.
struct SceneRun {
  std::string name;                      ///< of its models: "capsule", "chosen", …
  std::vector<const Candidate*> models;  ///< by kind
  double nanoseconds = 0;              ///< that its models take for what the exact run asks, in all
  std::vector<Verdict> verdicts = {};  ///< by need
  std::optional<Evidence> evidence = {};

  bool holds() const;
  /// The largest share of its limit that a need takes; above one: broken.
  double error() const;
  /// The need that broke first, by time; −1: all hold.
  int first_broken() const;
};

/// Candidates' processes, started when they are first needed.
class Processes {
 public:
  explicit Processes(const Limits& limits) : limits_(limits) {}
  CandidateProcess& of(const Candidate& candidate);

 private:
  Limits limits_;
  std::map<const Candidate*, CandidateProcess> processes_;
};

/// Runs the scene with `exact` where a kind has no model (a null one, or a pair that the exact run
/// never asked about).
Trajectory run_with(const Scene& scene, const PairKinds& kinds,
                    const std::vector<const Candidate*>& models, const Candidate& exact,
                    Processes& processes);

/// Fills in the verdicts of these runs and, where a need is broken, the evidence; in `workers`
/// processes, which does not change the result.
void judge(std::vector<SceneRun>& runs, const SceneFile& file, const Trajectory& exact_run,
           const PairKinds& kinds, const Candidate& exact, const Limits& limits, unsigned workers);

}  // namespace touchstone
