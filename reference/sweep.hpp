#pragma once

#include "invalid_input.hpp"
#include "pose.hpp"

namespace touchstone {

/// How body A moves while t goes from 0 to 1, in the world: its position by t times the
/// translation (metres), and its orientation by a turn about its centre, of t times the length of
/// the spin (radians) about the spin's direction.
class Sweep {
 public:
  /// Throws InvalidInput of the field "sweep" or "spin" on NaN or infinity.
  explicit Sweep(const Vec3& translation, const Vec3& spin = Vec3::Zero())
      : translation_(translation), spin_(spin) {
    if (!translation.allFinite()) throw InvalidInput("sweep", "not finite", "must be finite");
    if (!spin.allFinite()) throw InvalidInput("spin", "not finite", "must be finite");
  }

  const Vec3& translation() const { return translation_; }
  const Vec3& spin() const { return spin_; }
  bool turns() const { return !spin_.isZero(0); }

  /// The pose at t, to within rounding.
  Pose moved(const Pose& pose, double t) const {
    const Vec3 position = pose.position() + t * translation_;
    const double angle = spin_.stableNorm();
    if (!(angle > 0)) return Pose(position, pose.orientation());
    return Pose(position, Eigen::AngleAxisd(t * angle, spin_ / angle) * pose.unit_orientation());
  }

 private:
  Vec3 translation_, spin_;
};

}  // namespace touchstone
