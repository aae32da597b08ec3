#pragma once

#include <limits>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "reference/shape.hpp"
#include "simulation/scenes/trajectory.hpp"

namespace touchstone {

// What must come out right in a scene. Bodies are given by their place in it, times in seconds.

/// Its local z stays within that angle of the vertical, either way up, from a time to another.
struct Stands {
  int body;
  double degrees, from, until;
};
/// Its centre ends that far from where it began, horizontally; without a distance, as far as with
/// exact contacts. Off by no more than a share of it.
struct Rolls {
  int body;
  std::optional<double> distance;  ///< metres
  double share;
};
/// None of the bodies is faster at that time or later: of its centre, or of its surface by its
/// spin.
struct Rests {
  std::vector<int> bodies;
  double speed, by;  ///< m/s
};
/// They tilt by more than an angle from how they began, in this order.
struct FallsInOrder {
  std::vector<int> bodies;
  double degrees;
};
/// No pair with a cylinder is truly deeper, whatever depth is answered; of these two bodies alone
/// if they are given.
struct Penetration {
  std::vector<int> bodies;  ///< none or two
  double metres, from;
};
/// Of these two bodies, the normal of every contact: where another one separates them as well, its
/// angle does not count.
struct Normals {
  std::vector<int> bodies;  ///< two
  double degrees;
};
/// Its centre ends within a distance of where it ends with exact contacts.
struct EndsNear {
  int body;
  double metres;
};
/// Its local z ends within an angle of how it ends with exact contacts.
struct EndsTilted {
  int body;
  double degrees;
};
/// Its centre stays in a box of the world, or at most that far outside, from a time to the end.
struct StaysIn {
  int body;
  Vec3 lower, upper;
  double metres, from;
};

using Need = std::variant<Stands, Rolls, Rests, FallsInOrder, Penetration, Normals, EndsNear,
                          EndsTilted, StaysIn>;

/// What became of a need in one run.
struct Verdict {
  double value;  ///< measured, in the unit of the limit; not finite when the run is not sound
  double limit;
  double time;  ///< when the limit was first passed; of a need that holds, of its largest value
  bool holds() const { return value <= limit; }
  /// Of the limit; with a limit of zero, more than one as soon as the need is broken.
  double share() const { return limit > 0 ? value / limit : value > 0 ? 1 + value : 0; }
};

/// `exact` is the run with exact contacts, maybe the same one.
Verdict measure(const Need& need, const Scene& scene, const Trajectory& run,
                const Trajectory& exact);

/// The bodies that it names; none: all.
std::vector<int> bodies_of(const Need& need);

/// "can-1 stands within 0.5°", and its unit: "°", "m", …
std::string describe(const Need& need, const Scene& scene);
const char* unit(const Need& need);

}  // namespace touchstone
