#pragma once

#include <algorithm>
#include <concepts>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "properties/files/bytes.hpp"
#include "simulation/scenes/need.hpp"
#include "simulation/scenes/trajectory.hpp"

// Repetitions of a run: one run can be luck.

namespace touchstone {

// Bounds of what nobody knows of a scene.
inline constexpr double max_shift = 1e-4;  ///< of a body's smallest width
inline constexpr double max_angle = 1e-3;  ///< radians

/// A scene as it might as well have been: every moving body up to `max_shift` of its smallest width
/// from where it was written and up to `max_angle` askew, with a kick of up to 1e-3 of the speed
/// that a fall of that width gives, what joints connect as one, and not at all where it is held by
/// the world or driven; the whole world turned at random about the origin; the bodies in another
/// order. What holds in the scene as it is written alone is luck.
struct DisturbedScene {
  Scene scene;
  Eigen::Quaterniond turn;  ///< of the world
  std::vector<int> origin;  ///< by body of `scene`: its index in the scene as it is written

  /// Disturbance 0 is none: the scene as it is written.
  DisturbedScene(const Scene& written, std::uint64_t seed, std::size_t disturbance);
  /// A run of `scene` as seen in the scene as it is written: turned back, bodies in their order.
  Trajectory turned_back(const Trajectory& run) const;
};

/// How far two disturbances of a body can end it from each other where they only carry on: the
/// shift stays, the kick lasts, and the way is turned.
struct Carrying {
  double metres = 0, radians = 0;
};
/// Of a body of the scene as it is written, which goes this way, m; zero of what is not disturbed.
Carrying carrying(const Scene& written, int body, double way);

/// Repetitions of a run under disturbances: a need holds if it holds in all.
struct Trials {
  std::size_t disturbances = 16;  ///< beside the scene as it is written
  std::uint64_t seed = 1;

  /// The answer is held to more, because it is the best of many: of 50 models that break one run in
  /// 30, every second is lucky in 16.
  std::size_t of_answer() const { return 5 * disturbances; }
};

/// The worst answer of a run's models before its first need broke.
struct Evidence {
  Configuration configuration;
  std::string bodies, candidate;
  std::string wrong;  ///< in words: "missed, 0.0012 m deep"
  double time;        ///< s
};
/// How a run differs from the one with exact contacts, asked for or not: a body that falls through
/// the floor upright still stands.
struct Straying {
  double overlap = 0;     ///< largest true depth, metres
  double distance = 0;    ///< metres, largest of a body's end from its end in the exact run
  std::string body = {};  ///< the one with that distance
  double tilt = 0;  ///< degrees, largest of a body's local z at the end likewise; not of spheres
  std::string tilted_body = {};  ///< the one with that tilt

  /// Keeps the larger of each, and its body.
  void add(const Straying& other);
};
/// Of a run of the scene as it is written or turned back to it, from the exact one.
Straying straying(const Scene& scene, const Trajectory& run, const Trajectory& exact);
/// What one run came to.
struct Trial {
  std::vector<Verdict> verdicts;  ///< by need
  std::optional<Evidence> evidence = {};
  std::string end = {};  ///< why the run ended early: "Segmentation fault"
  double points = 0;     ///< contact points given to the solver, mean of a step
  double solver_seconds = 0;
  Straying straying = {};
};
/// The start and the end of a run alone.
Trajectory ends_of(const Trajectory& run);

/// Runs of a scene with the same models under several disturbances.
struct RepeatedRun {
  std::size_t trials = 0, held = 0;    ///< runs that were made, and those in which all needs held
  std::size_t disturbance = 0;         ///< the worst run, which verdicts and evidence are of
  std::vector<Verdict> verdicts = {};  ///< by need
  std::optional<Evidence> evidence = {};
  std::string end = {};  ///< why it ended early: "Segmentation fault"
  double points = 0;     ///< contact points given to the solver, mean of a step, as it is written
  double solver_seconds = 0;  ///< of the run as it is written
  Straying straying = {};     ///< largest of all trials

  bool holds() const { return first_broken() < 0; }
  /// Largest share of its limit that a need takes; above one: broken.
  double error() const;
  /// Index of the need that broke first; −1: all hold.
  int first_broken() const;
};

/// Index of the need that broke first; −1: all hold.
int first_broken(const std::vector<Verdict>& verdicts);

/// Those of the wanted runs that are not among the known ones, each once. `key`: the member that
/// tells them apart.
template <class Run, class Key>
std::vector<Run> fresh(const std::vector<Run>& wanted, const std::vector<Run>& known, Key key) {
  std::vector<Run> result;
  for (const Run& run : wanted) {
    const auto is_same = [&](const Run& other) { return other.*key == run.*key; };
    if (std::ranges::none_of(known, is_same) && std::ranges::none_of(result, is_same)) {
      result.push_back(run);
    }
  }
  return result;
}

/// Adds to the runs what they come to under the disturbances up to `last` that they have not had;
/// those that broke a need get no more. `trial` makes one run, by the index in `runs`, in one of
/// the worker processes; the results do not depend on their number.
void repeat(const std::vector<RepeatedRun*>& runs, std::size_t last, unsigned workers,
            const std::function<Trial(std::size_t run, std::size_t disturbance)>& trial,
            const std::function<std::string(std::size_t run)>& name);
template <std::derived_from<RepeatedRun> Run>
void repeat(std::vector<Run>& runs, std::size_t last, unsigned workers, const auto& trial,
            const auto& name) {
  std::vector<RepeatedRun*> repeated;
  for (Run& run : runs) repeated.push_back(&run);
  repeat(repeated, last, workers, trial, name);
}

/// Runs made in turns, so that what else the machine does meets all alike: of each of them the
/// least time of every step in so many rounds. `step_seconds` makes a run, by its index.
std::vector<std::vector<double>> least_step_seconds(
    std::size_t runs, const std::function<std::vector<double>(std::size_t run)>& step_seconds,
    std::size_t rounds = 5);

/// What exact runs of a scene come to, as bytes, by disturbance: as it is written, and under so
/// many. `make` makes one, in one of the worker processes. `name` is that of the scene in errors.
std::vector<std::string> exact_runs(const Scene& scene, std::uint64_t seed,
                                    std::size_t disturbances, unsigned workers,
                                    const std::string& name,
                                    const std::function<std::string(const DisturbedScene&)>& make);

}  // namespace touchstone
