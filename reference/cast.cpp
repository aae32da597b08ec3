#include "cast.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <type_traits>

#include "batch.hpp"
#include "contact.hpp"
#include "first_zero.hpp"
#include "invalid_input.hpp"
#include "passing_sphere.hpp"

namespace touchstone {
namespace {

/// A's position from B's, at t of the sweep: to a unit in its last place, however far the bodies
/// are from the world's origin or A comes from.
class SweptOffset {
 public:
  SweptOffset(const Vec3& a, const Vec3& b, const Vec3& sweep) : sweep_(sweep) {
    for (int i = 0; i < 3; ++i) {
      // The difference with its rounding error (Knuth, The Art of Computer Programming, vol. 2,
      // theorem 4.2.2 B).
      high_[i] = a[i] - b[i];
      const double minus_b = high_[i] - a[i];
      low_[i] = a[i] - (high_[i] - minus_b) - (b[i] + minus_b);
      if (!std::isfinite(low_[i])) low_[i] = 0;
    }
  }
  /// What overflows is the largest double.
  Vec3 at(double t) const {
    constexpr double max = std::numeric_limits<double>::max();
    Vec3 offset;
    for (int i = 0; i < 3; ++i) {
      offset[i] = std::clamp(std::fma(t, sweep_[i], high_[i]) + low_[i], -max, max);
    }
    return offset;
  }

 private:
  Vec3 high_, low_, sweep_;
};

double size_for_rounding(const Plane& s) { return std::abs(s.unit_displacement()); }
template <class Other>
double size_for_rounding(const Other& s) {
  return largest_half_extent(s);
}

void check_sweep(const Vec3& sweep) {
  if (!sweep.allFinite()) throw InvalidInput("sweep", "not finite", "must be finite");
}

}  // namespace

template <class Other>
Cast cast(const Cylinder& a, const Pose& pose_a, const Vec3& sweep, const Other& b,
          const Pose& pose_b) {
  check_sweep(sweep);
  const SweptOffset offset(pose_a.position(), pose_b.position(), sweep);
  const Pose still(Vec3::Zero(), pose_b.orientation());
  const double sizes = largest_half_extent(a) + size_for_rounding(b);
  const Vec3 quarter = sweep / 4;  // whose components' sum is finite
  const auto moment = [&](double t) -> Moment {
    const Vec3 at = offset.at(t);
    const SignedDistance found = signed_distance(a, Pose(at, pose_a.orientation()), b, still);
    return {t, found, found.value / 4, found.normal.dot(quarter), sizes + at.cwiseAbs().sum()};
  };
  Moment start{};
  if constexpr (std::is_same_v<Other, Sphere>) {
    const PassingSphere passing(a, pose_a, pose_a.position() - pose_b.position(), sweep, b);
    if (passing.misses()) return {CastStatus::never, 1, moment(0).found.normal};
    if (passing.time() > 0 && passing.time() <= 1) {
      start = moment(passing.time());
      // A distance that still falls was positive before: it is convex, and the bodies start apart.
      if (start.is_at_zero()) return {CastStatus::touch, start.t, start.found.normal};
    }
  }
  if (!(start.height > 0 && start.approaches())) start = moment(0);
  if (start.found.value <= 0) return {CastStatus::from_start, 0, start.found.normal};
  const FirstZero end = FirstZeroSearch(start).find(moment);
  if (!end.is_reached) return {CastStatus::never, 1, end.at.found.normal};
  return {CastStatus::touch, end.at.t, end.at.found.normal};
}

template Cast cast(const Cylinder&, const Pose&, const Vec3&, const Plane&, const Pose&);
template Cast cast(const Cylinder&, const Pose&, const Vec3&, const Sphere&, const Pose&);
template Cast cast(const Cylinder&, const Pose&, const Vec3&, const Capsule&, const Pose&);
template Cast cast(const Cylinder&, const Pose&, const Vec3&, const Cylinder&, const Pose&);
template Cast cast(const Cylinder&, const Pose&, const Vec3&, const Box&, const Pose&);
template Cast cast(const Cylinder&, const Pose&, const Vec3&, const Convex&, const Pose&);

Cast cast(const Cylinder& a, const Pose& pose_a, const Vec3& sweep, const Shape& b,
          const Pose& pose_b) {
  return std::visit([&](const auto& other) { return cast(a, pose_a, sweep, other, pose_b); }, b);
}

void cast(const Cylinder& a, std::span<const Pose> poses_a, std::span<const Vec3> sweeps,
          const Shape& b, std::span<const Pose> poses_b, std::span<Cast> results) {
  check_lengths(poses_a.size(), poses_b.size(), results.size());
  if (sweeps.size() != poses_a.size()) {
    throw InvalidInput("sweeps.size()", std::to_string(sweeps.size()),
                       "must be that of poses_a, " + std::to_string(poses_a.size()));
  }
  std::visit(
      [&](const auto& other) {
        for (std::size_t i = 0; i < results.size(); ++i) {
          results[i] = cast(a, poses_a[i], sweeps[i], other, poses_b[i]);
        }
      },
      b);
}

}  // namespace touchstone
