// The signed distance is the largest of the gaps along fixed directions, which are linear in t: one
// that is positive keeps the bodies apart until its line reaches zero. There the next normal is
// asked for, until next to nothing is left. Positions in between are rounded to doubles; what that
// may change of a gap is left as a margin, so that all of it holds of the exact ones.
#include "oracle/audit/cast_certificate.hpp"

#include <cmath>
#include <stdexcept>
#include <string>

#include "reference/invalid_input.hpp"

namespace touchstone::audit {
namespace {

/// How fast the gap along a normal falls, rounded up; not positive if it does not.
double approach(const RationalVector& normal, const Vec3& sweep) {
  const Vec3 n = Vec3(normal[0].get_d(), normal[1].get_d(), normal[2].get_d()).stableNormalized();
  return -n.dot(sweep) + 0x1p-48 * sweep.stableNorm();
}

}  // namespace

CastCertificate certify_cast(const Configuration& c, const Vec3& sweep) {
  const double lengths = larger_size(c) + c.pose_a.position().lpNorm<1>() + sweep.lpNorm<1>();
  const double margin = 0x1p-50 * lengths;
  if (!std::isfinite(lengths)) {
    throw InvalidInput("sweep", "as long as that", "must be finite, together with all lengths");
  }
  constexpr Budget budget{1e-16, 4000};
  constexpr int max_parts = 400;  // where bodies graze, each halves the way
  CastCertificate result;
  double t = 0;
  for (int part = 0; part < max_parts; ++part) {
    const Pose there(c.pose_a.position() + t * sweep, c.pose_a.orientation());
    const Certificate proof = certify({c.a, there, c.b, c.pose_b}, budget);
    const double gap = proof.lo.get_d() - 2 * margin;
    if (part == 0 && !(proof.lo > 0)) {
      throw InvalidInput("sweep", "of bodies that touch or overlap",
                         "must start where they are apart");
    }
    const double speed = approach(proof.normal, sweep);
    const double until = t + (1 - 0x1p-50) * (gap / speed);
    const bool is_near = !(gap > 2 * margin && (speed <= 0 || until > t));
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
