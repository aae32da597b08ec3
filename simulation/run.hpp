#pragma once

#include <cstdint>
#include <optional>

#include "simulation/world.hpp"

namespace touchstone {

/// What is counted while scenes run.
struct RunTally {
  std::uint64_t steps = 0;
  std::uint64_t points = 0;       ///< contact points, summed over the steps
  std::uint64_t flickers = 0;     ///< steps with another number of points than the step before
  std::uint64_t single = 0;       ///< steps with one contact point in all
  std::uint64_t without = 0;      ///< steps with none
  std::uint64_t failures = 0;     ///< answers other than contact or none
  double energy_gained = 0;       ///< the largest rise above an earlier energy, in weight × size
  bool unsupported = false;       ///< the candidate has no routine for a pair that came up
  std::optional<double> unsound;  ///< s, when a motion became absurd
  double seconds = 0;             ///< of the clock, for all steps

  void add(const RunTally& other);
};

/// A scene that runs, with what happens counted.
class Run {
 public:
  /// `size`, metres, and the weight of all moving bodies make energies comparable.
  Run(const Scene& scene, ContactModel& model, double size);

  /// False when the duration is over or the motion has become absurd.
  bool step();
  const World& world() const { return world_; }
  const RunTally& tally() const { return tally_; }
  /// Of all moving bodies, in weight × size.
  double kinetic_energy() const { return world_.kinetic_energy() / energy_unit_; }

 private:
  double energy() const { return world_.kinetic_energy() + world_.potential_energy(); }

  World world_;
  std::uint64_t steps_;  ///< of the whole duration
  double energy_unit_, least_energy_;
  std::optional<int> last_points_;
  RunTally tally_;
};

}  // namespace touchstone
