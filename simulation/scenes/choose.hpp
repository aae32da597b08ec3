#pragma once

#include <optional>
#include <string>
#include <vector>

#include "simulation/scenes/trials.hpp"

namespace touchstone {

/// Which models to try in a scene.
struct ChooseOptions {
  std::vector<const Candidate*> candidates;  ///< beside the exact one
  unsigned workers = 1;                      ///< processes; the runs do not depend on them
  Limits limits = {};
};

/// All candidates, with the families of simplified models swept: 1 to 64 spheres, prisms of 8 to
/// 128 sides, boxes as spheres and capsules.
std::vector<const Candidate*> swept_candidates();

/// The exact candidate (`reference`), then the others.
std::vector<const Candidate*> exact_first(const std::vector<const Candidate*>& candidates);

/// The cheapest models that meet the needs of a scene, and all that was tried to find them.
struct Choice {
  SceneFile file;
  Trajectory exact_run;
  PairKinds kinds;
  std::vector<const Candidate*> candidates;        ///< the exact one first
  std::vector<std::vector<ReplayScore>> replayed;  ///< by kind and candidate
  /// Whole runs of the scene: the exact one first, then each candidate for all kinds that it
  /// supports, then those that the search tried.
  std::vector<SceneRun> runs = {};
  /// Candidates whose run of the scene would take too long.
  std::vector<const Candidate*> too_slow = {};
  std::size_t answer = 0;   ///< index of the cheapest run that meets all needs; 0 if `impossible`
  bool impossible = false;  ///< exact contacts do not meet the needs either
  /// By kind: index of the run in which only this kind's model is the next cheaper one; it breaks a
  /// need. Absent where nothing cheaper supports the kind.
  std::vector<std::optional<std::size_t>> cheaper = {};
  /// Time of a query of this kind; infinite where the candidate has no routine.
  double nanoseconds(std::size_t kind, const Candidate& candidate) const;
};

/// Share of another candidate's time below which a candidate counts as cheaper: smaller differences
/// are noise of the machine.
inline constexpr double cheaper_share = 0.9;

/// Runs the scene exactly, replays what occurred with every candidate, runs the whole scene with
/// each of them, then searches by kind of pairs: the cheapest model of each kind that serves while
/// the others are exact, all of these together, and step by step back where they do not serve
/// together. Ends when the answer has been run and no single kind can take its next cheaper model.
/// Progress goes to standard error. Throws InvalidInput if the scene has no needs or no cylinder
/// touches anything.
Choice choose(const SceneFile& file, const ChooseOptions& options);

}  // namespace touchstone
