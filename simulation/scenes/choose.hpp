#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "simulation/scenes/scene_judge.hpp"
#include "simulation/scenes/spread.hpp"

// The cheapest models that a scene needs.

namespace touchstone {

/// Is what stands for a cylinder one sphere, as spheres:1: the capsule inside one that is no longer
/// than wide, or spheres inside one just as long as wide, which all have the same place?
inline bool is_one_sphere(const Cylinder& c, bool is_capsule) {
  return is_capsule ? c.half_length() <= c.radius() : c.half_length() == c.radius();
}

/// What stands for a box in a model of boxes; absent with other candidates and for other shapes.
std::optional<BoxParts> box_parts(const Candidate& candidate, const Shape& shape);

/// All candidates, with the families of simplified models swept: 1 to 64 spheres, prisms of 8 to
/// 128 sides, boxes as spheres and capsules.
std::vector<const Candidate*> swept_candidates();

/// The exact candidate (`reference`), then the others in the order of all_candidates, members of a
/// family by their parameter.
std::vector<const Candidate*> exact_first(const std::vector<const Candidate*>& candidates);

/// The cheapest models that meet the needs of a scene, and all that was tried to find them.
struct Choice {
  SceneFile file;  ///< with the needs that are judged
  Trajectory exact_run;
  PairKinds kinds;
  std::vector<const Candidate*> candidates;        ///< the exact one first
  std::vector<std::vector<ReplayScore>> replayed;  ///< by kind and candidate
  /// Whole runs of the scene: the exact one first, then each candidate for all kinds that it
  /// supports, then those that the search tried.
  std::vector<SceneRun> runs = {};
  /// Candidates whose run of the scene would take too long.
  std::vector<const Candidate*> too_slow = {};
  /// Candidates that are left out, for they are spheres:1 here by another name.
  std::vector<const Candidate*> same_as_sphere = {};
  Trials trials = {};
  Spreads spreads = {};
  /// Distance and tilt by which exact runs differ from each other at their ends, of the bodies that
  /// stray the most with the answer.
  Straying exact_spread = {};
  /// What names the scene on a command line, with the options of a robot's motion.
  std::string arguments = {};
  /// Index of the cheapest run that meets all needs; 0 if `impossible`, or where no other saves
  /// more of a step than the noise.
  std::size_t answer = 0;
  bool impossible = false;  ///< exact contacts do not meet the needs either
  /// By kind: index of the run in which only this kind's model is the one with the next cheaper
  /// query; it breaks a need, or saves too little of a step. Absent where nothing cheaper supports
  /// the kind.
  std::vector<std::optional<std::size_t>> cheaper = {};
  /// Can these be an answer: the exact cylinder, or models in its place? Engines' routines for the
  /// cylinder are run and judged, but are no models, nor are those for a hull in its place; a model
  /// that was added is one.
  bool has_models_alone(const SceneRun& run) const;
  /// What read_contacts makes the contacts of a run of: one name if that says the same.
  std::vector<std::string> contacts_of(const SceneRun& run) const;
  /// Time of a query of this kind; infinite where the candidate has no routine.
  double nanoseconds(std::size_t kind, const Candidate& candidate) const;
  /// Is this candidate, by its name a capsule or several spheres, one sphere for this kind's
  /// cylinders (is_one_sphere)?
  bool is_sphere(std::size_t kind, const Candidate& candidate) const;
  /// Bytes that what a candidate puts in place of a cylinder, or of a kind's box, takes in double
  /// precision: its corners, its spheres, its capsules, or its sizes.
  std::size_t model_bytes(std::size_t kind, const Candidate& candidate) const;
  /// Number of steps of a run.
  double steps() const { return static_cast<double>(exact_run.frames.size() - 1); }
  /// Share of the time of a whole step with exact contacts that the answer saves, or if that is
  /// exact, the cheapest other run of models that meets all needs; 0 where none saves anything.
  double step_saved() const;
  /// Seconds that a frame of 1/60 s takes with the models of a run: contacts and solver.
  double frame_seconds(const SceneRun& run) const;
  /// Seconds that the solver takes for each contact point that it gets: the slope of the line that
  /// fits the runs in which all needs hold. Absent where they give it much the same points.
  std::optional<double> point_seconds() const;
};

/// Share of a step's time below which a saving cannot be told from noise: the advice then is the
/// exact cylinder.
inline constexpr double noise_of_step = 0.05;

/// Runs the scene exactly, replays what occurred with every candidate, runs the whole scene with
/// each of them under all disturbances, then searches by kind of pairs: the model of each kind with
/// which a step is the cheapest while the others are exact, all of these together, and step by step
/// back where they do not serve together. The runs among which the answer is are timed in turns. Of
/// those that take much the same the simplest is taken: whose models come first in the order of the
/// candidates, summed over the kinds. Ends when no single kind can take its next cheaper model.
/// Engines' routines are run and judged for all kinds, but are no answer. Progress goes to standard
/// error. What is one sphere for all kinds is left out beside `spheres:1`, which is the same. Needs
/// within the spread of exact runs are not judged. Throws InvalidInput if the scene has no needs,
/// or none that is judged, or no cylinder touches anything.
Choice choose(const SceneFile& file, const ChooseOptions& options);

// Which of several choices that all serve is the answer: noise of the machine must not decide.

/// Share of another's time below which a candidate or a run counts as cheaper: smaller differences
/// are noise of the machine, and the simpler one is preferred.
inline constexpr double cheaper_share = 0.9;

/// What may be the answer.
struct Finalist {
  std::size_t index;  ///< of a run or setting
  double seconds;
  std::size_t rank;  ///< 0 is the simplest
};

/// Indices of the runs or settings that may prove to be the answer once they are timed together: of
/// these the one that now seems the cheapest first, then the simplest that may cost much the same.
/// Twice the noise apart, for what is within a tenth by its times must not be left out by an
/// estimate; six at most.
std::vector<std::size_t> finalists(std::vector<Finalist> promising);

/// Index of the simplest finalist of those that take at most `limit` seconds and much the same as
/// the cheapest; of equally simple ones the first. Absent where all take longer than the limit.
std::optional<std::size_t> simplest_of_cheapest(const std::vector<Finalist>& finalists,
                                                double limit);

}  // namespace touchstone
