#pragma once

#include <optional>

#include "simulation/scenes/trajectory.hpp"

namespace touchstone {

/// How soon two bodies that meet would have passed through each other.
struct Passing {
  double seconds;  ///< from their touch to where they would be apart again, both going on straight
  int a, b;        ///< bodies: the cylinder, and what it meets
  double time;     ///< s, of the frame before they meet
};

/// The shortest passing of a run: with steps no longer than that, each of its impacts is seen at
/// least once; in a longer one the two may pass through each other, unseen. By casts of our own
/// (reference/cast.hpp) with the velocities before the impact; that the bodies turn is left out.
/// Absent where nothing meets, or only half-spaces are met, which nobody leaves behind.
std::optional<Passing> shortest_passing(const Scene& scene, const Trajectory& run);

}  // namespace touchstone
