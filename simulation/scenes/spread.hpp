#pragma once

#include <optional>
#include <string>
#include <vector>

#include "simulation/scenes/disturbed_scene.hpp"
#include "simulation/scenes/scene_file.hpp"
#include "simulation/scenes/trajectory.hpp"

// Which needs exact contacts decide. A relative need compares a run with the exact one under the
// same disturbance, which by itself always meets it; but where exact runs end further apart than
// the limit, for a shift that nobody knows of, what misses it may be as good as exact. Not so where
// they end no further apart than the disturbances carry them: a kick that a rod rolls on by is none
// of its contacts' doing.

namespace touchstone {

/// A relative need that is not judged.
struct Undecidable {
  std::string text, unit;  ///< of the need
  double limit;
  double spread;  ///< largest value between two exact runs, which exceeds the limit
};

/// How far exact runs of a scene decide its relative needs.
struct Spreads {
  std::vector<std::optional<double>> of_needs = {};  ///< by need that is judged; of relative ones
  std::vector<Undecidable> undecidable = {};         ///< needs that are not judged
};

/// Largest value that a relative need has between two of these exact runs of a scene, of which each
/// may be the first. Zero of a single run.
double spread(const Need& need, const Scene& scene, const std::vector<Trajectory>& exact_runs);

/// Distance and tilt by which these exact runs differ from each other at their ends, of the bodies
/// that strayed the most.
Straying spread(const Straying& strayed, const Scene& scene,
                const std::vector<Trajectory>& exact_runs);

/// Takes out of the file the relative needs whose limit lies within the spread of the exact runs,
/// if that is more than the disturbances carry the body. Those that nobody asked for, a robot's,
/// allow the spread instead: its wheels could leave the ground unnoticed. Throws InvalidInput
/// (field "needs") if no other is left.
Spreads take_undecidable(SceneFile& file, const std::vector<Trajectory>& exact_runs);

}  // namespace touchstone
