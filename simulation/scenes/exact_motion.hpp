#pragma once

#include <string>
#include <vector>

#include "candidates/host/candidate_process.hpp"
#include "simulation/scenes/disturbed_scene.hpp"

// What runs with exact contacts say of a scene in which nobody says what has to come out right.

namespace touchstone {

/// How far the bodies of a scene move with exact contacts, and how deep these are.
struct ExactMotion {
  std::vector<double> depths = {};  ///< by body, m: the largest of pairs with a cylinder, in all
                                    ///< runs; zero of one that touches nothing
  std::vector<double> ways = {};    ///< by body, m, in the run as it is written

  bool has_contacts() const;
};
/// Of one run.
ExactMotion motion_of(const Scene& scene, const Trajectory& run);

/// Of runs in our own world, of the scene as it is written and under the disturbances, in worker
/// processes, whatever their number. `name` is that of the scene in errors.
ExactMotion exact_motion(const Scene& scene, const Trials& trials, unsigned workers,
                         const Limits& limits, const std::string& name);

/// Likewise in an engine's own world with our routines, whose contacts may be softer. Throws
/// std::runtime_error if the engine ends a run.
ExactMotion exact_motion_in(const std::string& engine, const Scene& scene, const Trials& trials,
                            unsigned workers, const std::string& name);

}  // namespace touchstone
