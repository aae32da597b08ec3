#pragma once

#include <optional>
#include <string>
#include <vector>

#include "simulation/scenes/replayed.hpp"
#include "simulation/scenes/scene_run.hpp"

namespace touchstone {

/// Which models a scene is tried with.
struct ChooseOptions {
  std::vector<const Candidate*> candidates;  ///< beside the exact one
  unsigned workers = 1;                      ///< processes; they do not change the runs
  Limits limits = {};
};

/// Every candidate there is, with the families of simplified models swept: 1 to 64 spheres, prisms
/// of 8 to 128 sides, boxes as spheres and capsules.
std::vector<const Candidate*> swept_candidates();

/// What a scene needs.
struct Choice {
  Trajectory exact_run;
  PairKinds kinds;
  std::vector<const Candidate*> candidates;     ///< the exact one first
  std::vector<std::vector<Replayed>> replayed;  ///< by kind and candidate
  /// The exact run first, then each candidate for all kinds that it supports, then what the search
  /// tried. Each is one whole run of the scene.
  std::vector<SceneRun> runs;
  /// Candidates that would take too long to run the scene with, and cost more than the exact one.
  std::vector<const Candidate*> too_slow;
  std::size_t answer = 0;   ///< the cheapest run that meets all needs; meaningless if `impossible`
  bool impossible = false;  ///< exact contacts do not meet the needs either
  /// By kind: the run in which only this kind's model is the next cheaper one; it breaks a need.
  /// Absent where nothing cheaper supports the kind.
  std::vector<std::optional<std::size_t>> cheaper;
  /// Replayed with each candidate of a run, the exact run first.
  double nanoseconds(std::size_t kind, const Candidate& candidate) const;
};

/// A candidate counts as cheaper than another when its queries take less than this share of the
/// other's time: smaller differences are the machine's.
inline constexpr double cheaper_share = 0.9;

/// Runs the scene exactly, replays what occurred with every candidate, runs the whole scene with
/// each of them, then searches by kind of pairs: every kind's cheapest model that serves while the
/// others are exact, all of these together, and back by steps where they do not serve together.
/// Ends when the answer was run and no single kind can take its next cheaper model. Progress goes
/// to standard error. Throws InvalidInput when the scene has no needs or no cylinder touches
/// anything.
Choice choose(const SceneFile& file, const ChooseOptions& options);

}  // namespace touchstone
