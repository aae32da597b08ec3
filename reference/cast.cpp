#include "cast.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "batch.hpp"
#include "contact.hpp"
#include "invalid_input.hpp"
#include "largest_gap.hpp"

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

/// Halves the distance with each step at least, where bodies graze as spheres do.
constexpr int max_steps = 200;

}  // namespace

template <class Other>
Cast cast(const Cylinder& a, const Pose& pose_a, const Vec3& sweep, const Other& b,
          const Pose& pose_b) {
  check_sweep(sweep);
  const SweptOffset offset(pose_a.position(), pose_b.position(), sweep);
  const Pose still(Vec3::Zero(), pose_b.orientation());
  const double sizes = largest_half_extent(a) + size_for_rounding(b);
  const Vec3 quarter = sweep / 4;  // whose components' sum is finite
  double t = 0;
  Vec3 at = offset.at(0);
  SignedDistance found = signed_distance(a, Pose(at, pose_a.orientation()), b, still);
  if (found.value <= 0) return {CastStatus::from_start, 0, found.normal};
  for (int step = 0; step < max_steps; ++step) {
    const double lengths = sizes + at.cwiseAbs().sum();
    if (t > 0 && found.value <= tie_part * lengths) break;
    const double approach = -found.normal.dot(quarter);
    // Along this normal they are as far apart at the end as the tangent is there.
    const bool stay_apart = found.value / 4 - approach * (1 - t) > rounding_part * lengths;
    if (!(approach > 0) || stay_apart) return {CastStatus::never, 1, found.normal};
    const double next = std::min(1.0, t + found.value / 4 / approach);
    if (!(next > t)) break;
    at = offset.at(next);
    const SignedDistance there = signed_distance(a, Pose(at, pose_a.orientation()), b, still);
    // Within rounding a tangent may go too far where bodies graze.
    const bool is_no_nearer = std::abs(there.value) >= found.value;
    if (is_no_nearer && found.value <= rounding_part * lengths) break;
    t = next;
    found = there;
    if (found.value <= 0) break;
  }
  return {CastStatus::touch, t, found.normal};
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
