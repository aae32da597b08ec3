#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "candidates/host/candidate_process.hpp"
#include "candidates/model.hpp"
#include "simulation/scenes/disturbed_scene.hpp"
#include "simulation/scenes/scene_file.hpp"

// How candidates do in a scene: query by query on the configurations of a run, and in whole runs.

namespace touchstone {

/// Errors and time of one candidate on configurations of one kind of pairs.
struct ReplayScore {
  std::optional<double> nanoseconds;  ///< per query, median of the rounds; absent: unsupported,
                                      ///< or it died or took too long
  std::size_t count = 0, agree = 0;   ///< configurations, and those on which it agrees
  /// Largest error of the depth, metres; for a missed contact, its depth; infinite without an
  /// answer.
  double depth_error = 0;
  /// Largest angle, degrees, of an answered normal that does not separate the bodies as well as the
  /// true one.
  double normal_angle = 0;
  std::size_t worst_depth = 0, worst_angle = 0;  ///< indices of the configurations with them
};

/// Scores the candidates against the oracle and times them in turns, one process at a time. All
/// configurations are of one kind of pairs.
std::vector<ReplayScore> replay(const std::vector<Configuration>& configurations,
                                std::vector<CandidateProcess>& candidates);

/// Largest number of configurations of a kind that are replayed, evenly spread over the run.
inline constexpr std::size_t max_replayed = 64;

/// Replays what occurred in a run: result[kind][candidate].
std::vector<std::vector<ReplayScore>> replay(const Scene& scene, const Trajectory& run,
                                             const std::vector<PairKind>& kinds,
                                             const std::vector<const Candidate*>& candidates,
                                             const Limits& limits);

/// A candidate for each kind of pairs, and whole runs of a scene with them.
struct SceneRun : RepeatedRun {
  SceneRun() = default;
  SceneRun(std::string run_name, std::vector<const Candidate*> run_models, double cost)
      : name(std::move(run_name)), models(std::move(run_models)), nanoseconds(cost) {}

  std::string name;                      ///< of its models: "capsule", "combination", …
  std::vector<const Candidate*> models;  ///< by kind
  double nanoseconds = 0;                ///< cost of its models for all questions of the exact run
  /// Which timing its solver's time is of (SceneJudge::time), from 1; 0: of its first run alone.
  /// Times of two timings do not compare: the machine's speed may have changed.
  std::size_t timing = 0;

  /// Cost of the whole run: contacts and solver.
  double seconds() const { return 1e-9 * nanoseconds + solver_seconds; }
};

/// Processes of candidates, each started on first use.
class Processes {
 public:
  explicit Processes(const Limits& limits) : limits_(limits) {}
  CandidateProcess& of(const Candidate& candidate);

 private:
  Limits limits_;
  std::map<const Candidate*, CandidateProcess> processes_;
};

/// Runs the scene with a model for each kind, and `exact` for kinds whose model is null and for
/// pairs that the exact run never asked about.
Trajectory run_with(const DisturbedScene& scene, const PairKinds& kinds,
                    const std::vector<const Candidate*>& models, const Candidate& exact,
                    Processes& processes);

/// Contacts of a run, as they are named: of one candidate for all pairs, or of candidates for kinds
/// of pairs (PairKind::name), with exact ones for all others.
struct NamedContacts {
  const Candidate* for_all = nullptr;
  std::map<std::string, const Candidate*> by_kind = {};
};

/// Reads "capsule", or "cylinder ⌀0.1×0.3 on plane=capsule" and more of these. Throws InvalidInput
/// (field "--contacts") for an unknown candidate, or a kind that no two bodies of the scene are of.
NamedContacts read_contacts(const std::vector<std::string>& names, const Scene& scene);

Trajectory run_with(const DisturbedScene& scene, const NamedContacts& contacts,
                    const Candidate& exact, Processes& processes);

/// Which models to try in a scene.
struct ChooseOptions {
  std::vector<const Candidate*> candidates;  ///< beside the exact one
  unsigned workers = 1;                      ///< processes; the runs do not depend on them
  Limits limits = {};
  Trials trials = {};
};

/// Judges runs of one scene, as it is written and disturbed.
class SceneJudge {
 public:
  /// All arguments must outlive it.
  SceneJudge(const SceneFile& file, const PairKinds& kinds, const Candidate& exact,
             const ChooseOptions& options);

  /// Ends of the exact runs under all disturbances that an answer has to bear, in their order.
  const std::vector<Trajectory>& exact_runs();

  /// Adds what the runs with their models come to under the disturbances up to `last` that they
  /// have not had; those that broke a need get no more. Needs are measured against exact runs under
  /// the same disturbances. Nothing depends on the number of worker processes.
  void judge(std::vector<SceneRun>& runs, std::size_t last);

  /// Times the solver in runs of the scene as it is written, in turns: of each step the least of so
  /// many rounds.
  void time(const std::vector<SceneRun*>& runs, std::size_t rounds = 5);

 private:
  const SceneFile& file_;
  const PairKinds& kinds_;
  const Candidate& exact_;
  const ChooseOptions& options_;
  std::vector<Trajectory> exact_runs_ = {};  ///< by disturbance: first and last frames alone
  std::size_t timings_ = 0;
};

}  // namespace touchstone
