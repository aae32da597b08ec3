// The signed distance is the largest of the gaps along fixed directions, which are linear in t: one
// that is positive keeps the bodies apart until its line reaches zero. There the next normal is
// asked for, until next to nothing is left. Positions in between are rounded to doubles; what that
// may change of a gap is left as a margin, so that all of it holds of the exact ones. With a spin
// the gaps are not linear, but fall no faster than A's farthest point moves along the normal: so
// far, and no farther, each of them keeps the bodies apart (conservative advancement).
#include "oracle/audit/cast_certificate.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

#include "reference/invalid_input.hpp"

namespace touchstone::audit {
namespace {

/// How fast the gap along a fixed normal falls at most, rounded up; not positive if it does not.
/// With a spin, no faster than A's farthest point from its centre moves along the normal.
double approach(const RationalVector& normal, const Cylinder& a, const Vec3& axis,
                const Sweep& sweep) {
  const Vec3 n = Vec3(normal[0].get_d(), normal[1].get_d(), normal[2].get_d()).stableNormalized();
  const Vec3 &w = sweep.translation(), &spin = sweep.spin();
  const double reach = std::hypot(a.radius(), a.half_length());
  const double turns = std::min(spin.cross(n).stableNorm(), spin.cross(axis).stableNorm());
  return -n.dot(w) + reach * turns + 0x1p-48 * (w.stableNorm() + reach * spin.stableNorm());
}

}  // namespace

CastCertificate certify_cast(const Configuration& c, const Sweep& sweep) {
  constexpr double max_spin = 100;  // of the checker
  const double spin = sweep.spin().stableNorm();
  if (!(spin <= max_spin)) {
    throw InvalidInput("spin", std::to_string(spin) + " radians long", "must be at most 100");
  }
  const Vec3& w = sweep.translation();
  const double lengths = larger_size(c) + c.pose_a.position().lpNorm<1>() + w.lpNorm<1>();
  const double margin = 0x1p-50 * (1 + spin) * lengths;
  if (!std::isfinite(lengths)) {
    throw InvalidInput("sweep", "as long as that", "must be finite, together with all lengths");
  }
  constexpr Budget budget{1e-16, 4000};
  // Where bodies graze, each part halves the way. With a spin it leaves a part of the distance.
  const int max_parts = sweep.turns() ? 900 : 400;
  CastCertificate result;
  double t = 0;
  for (int part = 0; part < max_parts; ++part) {
    const Pose there = sweep.moved(c.pose_a, t);
    const Certificate proof = certify({c.a, there, c.b, c.pose_b}, budget);
    const double gap = proof.lo.get_d() - 2 * margin;
    if (part == 0 && !(proof.lo > 0)) {
      throw InvalidInput("sweep", "of bodies that touch or overlap",
                         "must start where they are apart");
    }
    const double speed = approach(proof.normal, c.a, there.axis(), sweep);
    const double until = t + (1 - 0x1p-50) * (gap / speed);
    const bool is_last = sweep.turns() && part + 1 == max_parts;
    const bool is_near = is_last || !(gap > 2 * margin && (speed <= 0 || until > t));
    if (is_near && proof.pair) {
      if (part == 0) result.apart.push_back({0, proof.normal});
      result.pair = proof.pair;
      result.distance = proof.hi + mpq_class(margin);
      return result;
    }
    if (is_near) break;
    const bool is_to_the_end = speed <= 0 || until >= 1;
    t = is_to_the_end ? 1 : until;
    result.apart.push_back({t, proof.normal});
    if (is_to_the_end) return result;
  }
  throw std::logic_error("certificate: the normals do not lead to the touch");
}

}  // namespace touchstone::audit
