#pragma once

#include <optional>
#include <vector>

#include "simulation/world.hpp"

namespace touchstone {

/// What a contact model was asked in one step, and how right its answer was.
struct Asked {
  int frame;     ///< the states that it was asked about
  int a, b;      ///< bodies as in PairQuestion
  double depth;  ///< true one, metres; negative apart
  ts_status status;
  double signed_distance;  ///< as answered, metres; of no contact, zero
  /// Degrees between the answered normal and the true one; zero where the answered one separates
  /// the bodies as well. Absent without a contact.
  std::optional<double> normal_angle;
  int points;

  /// By how much the answer is too shallow or too deep, metres; of bodies apart without a contact,
  /// nothing.
  double depth_error() const;
};

/// How a scene went.
struct Trajectory {
  double step = 0;                             ///< s
  std::vector<std::vector<BodyState>> frames;  ///< the first is the start; one for each step
  std::vector<Asked> asked;                    ///< in order of time
  bool sound = true;           ///< false: the motion became absurd, and the frames end there
  double seconds = 0;          ///< of the processor's clock, for all
  double contact_seconds = 0;  ///< of these, for asking the contact model

  double end() const { return step * static_cast<double>(frames.size() - 1); }
  Configuration configuration(const Scene& scene, const Asked& asked) const;
};

/// Runs the scene to its duration. Truths come from our own routines (held to 1e-13).
Trajectory run_scene(const Scene& scene, ContactModel& model);

}  // namespace touchstone
