#include "reduced_pair.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "line_normals.hpp"
#include "rim_rim.hpp"

namespace touchstone {
namespace {

Vec3 axis_of(const Pose& pose) { return pose.rotation().col(2); }

ReducedPair with_cylinder(const Cylinder& a, const Pose& pose_a, const Pose& pose_b) {
  ReducedPair pair;
  pair.d = pose_a.position() - pose_b.position();
  const Vec3 axis = axis_of(pose_a);
  pair.add(ReducedPair::Segment{axis, a.half_length()});
  pair.add(ReducedPair::Disc{axis, a.radius()});
  return pair;
}

/// d less the ends of all segments; bit i of `signs` chooses the end of segment i.
Vec3 reduced_point(const ReducedPair& pair, unsigned signs) {
  Vec3 q = pair.d;
  for (int i = 0; i < pair.segment_count; ++i) {
    const auto& s = pair.segments[i];
    q -= ((signs >> i & 1U) ? s.half_length : -s.half_length) * s.axis;
  }
  return q;
}

/// The ends of the segments that n selects.
unsigned ends_along(const ReducedPair& pair, const Vec3& n) {
  unsigned signs = 0;
  for (int i = 0; i < pair.segment_count; ++i) {
    if (pair.segments[i].axis.dot(n) > 0) signs |= 1U << i;
  }
  return signs;
}

void offer_axial_normals(const ReducedPair& pair, BestNormal& best) {
  for (int j = 0; j < pair.disc_count; ++j) offer_normal(pair, pair.discs[j].axis, best);
  for (int i = 0; i < pair.segment_count; ++i) {
    for (int j = 0; j < i; ++j) {
      const Vec3& s = pair.segments[i].axis;
      const Vec3 n = pair.segments[j].axis.cross(s);
      if (n.isZero(0)) continue;
      // The product of nearly parallel axes has few digits left; across them it must stay.
      const Vec3 unit = n.normalized();
      offer_normal(pair, unit - unit.dot(s) * s, best);
    }
  }
}

/// The normal between one disc's rim and the vertex that is nearest to it. Only bodies apart can
/// meet so, and no vertex is nearer to the disc than the bodies to each other.
void offer_rim_vertex_normal(const ReducedPair& pair, BestNormal& best) {
  const auto& disc = pair.discs[0];
  Vec3 nearest = Vec3::Zero();
  double nearest_distance = std::numeric_limits<double>::infinity();
  for (unsigned signs = 0; signs < 1U << pair.segment_count; ++signs) {
    const Vec3 q = reduced_point(pair, signs);
    const double height = q.dot(disc.axis);
    const Vec3 across = q - height * disc.axis;
    const double length = across.norm();
    const double distance = std::hypot(height, std::max(length - disc.radius, 0.0));
    if (distance < nearest_distance) {
      nearest_distance = distance;
      nearest = length > disc.radius ? Vec3(q - (disc.radius / length) * across)
                                     : Vec3(height * disc.axis);
    }
  }
  best.limit = std::min(best.limit, std::max(nearest_distance - pair.inflation, 0.0));
  offer_normal(pair, nearest, best);
}

/// With parallel axes the sum of two cylinders is a cylinder; its rim has this normal.
void offer_parallel_rim_normal(const ReducedPair& pair, BestNormal& best) {
  const Vec3& axis = pair.discs[0].axis;
  const double height = pair.d.dot(axis);
  const Vec3 across = pair.d - height * axis;
  const double beyond_cap =
      std::abs(height) - pair.segments[0].half_length - pair.segments[1].half_length;
  const double beyond_side = across.norm() - pair.discs[0].radius - pair.discs[1].radius;
  if (beyond_cap > 0 && beyond_side > 0) {
    offer_normal(pair, std::copysign(beyond_cap, height) * axis + beyond_side * across.normalized(),
                 best);
  }
}

/// Is a contact of two rims possible at these ends? Its normal n has u·n >= 0 for both axes u
/// towards the ends, and q differs from a sum of rim points by at most the depth against n, so that
/// q·u cannot lie further back than the other rim reaches.
bool rims_may_meet(const ReducedPair& pair, unsigned signs, const Vec3& q, const BestNormal& best) {
  const double depth = std::max(0.0, -best.gap);
  const double sine = pair.discs[0].axis.cross(pair.discs[1].axis).norm();
  for (int i = 0; i < 2; ++i) {
    const double along = q.dot(pair.discs[i].axis) * ((signs >> i & 1U) ? 1 : -1);
    if (along < -(pair.discs[1 - i].radius * sine + depth)) return false;
  }
  return true;
}

void offer_all_rim_rim_normals(const ReducedPair& pair, BestNormal& best) {
  // Tilts that only rounding makes cost no more than rounding.
  constexpr double parallel = 2e-16;
  offer_parallel_rim_normal(pair, best);
  if (pair.discs[0].axis.cross(pair.discs[1].axis).norm() <= parallel) return;
  const unsigned likely = ends_along(pair, best.normal);
  for (unsigned other = 0; other < 4 && !best.proven(); ++other) {
    const unsigned signs = likely ^ other;
    const Vec3 q = reduced_point(pair, signs);
    if (rims_may_meet(pair, signs, q, best)) offer_rim_rim_normals(pair, q, best);
  }
}

}  // namespace

double ReducedPair::size() const {
  double sum = d.norm() + inflation;
  for (int i = 0; i < segment_count; ++i) sum += segments[i].half_length;
  for (int j = 0; j < disc_count; ++j) sum += discs[j].radius;
  return sum;
}

double ReducedPair::gap(const Vec3& n) const {
  double g = d.dot(n) - inflation;
  for (int i = 0; i < segment_count; ++i) {
    g -= segments[i].half_length * std::abs(segments[i].axis.dot(n));
  }
  for (int j = 0; j < disc_count; ++j) g -= discs[j].radius * discs[j].axis.cross(n).norm();
  return g;
}

void offer_normal(const ReducedPair& pair, const Vec3& direction, BestNormal& best) {
  const double length = direction.norm();
  if (!(length > 0)) return;
  // Of ±n the one towards A has the larger gap.
  const Vec3 n = direction / (direction.dot(pair.d) < 0 ? -length : length);
  const double g = pair.gap(n);
  if (g > best.gap + best.rounding) {
    best.gap = g;
    best.normal = n;
  }
}

ReducedPair reduce(const Cylinder& a, const Pose& pose_a, const Capsule& b, const Pose& pose_b) {
  ReducedPair pair = with_cylinder(a, pose_a, pose_b);
  pair.add(ReducedPair::Segment{axis_of(pose_b), b.half_length()});
  pair.inflation = b.radius();
  return pair;
}

ReducedPair reduce(const Cylinder& a, const Pose& pose_a, const Cylinder& b, const Pose& pose_b) {
  ReducedPair pair = with_cylinder(a, pose_a, pose_b);
  pair.add(ReducedPair::Segment{axis_of(pose_b), b.half_length()});
  pair.add(ReducedPair::Disc{axis_of(pose_b), b.radius()});
  return pair;
}

ReducedPair reduce(const Cylinder& a, const Pose& pose_a, const Box& b, const Pose& pose_b) {
  ReducedPair pair = with_cylinder(a, pose_a, pose_b);
  const Eigen::Matrix3d axes = pose_b.rotation();
  for (int i = 0; i < 3; ++i) {
    pair.add(ReducedPair::Segment{axes.col(i), b.half_extents()[i]});
  }
  return pair;
}

BestNormal largest_gap(const ReducedPair& pair) {
  BestNormal best;
  best.rounding = 2e-16 * pair.size();
  offer_axial_normals(pair, best);
  for (int line = 0; line < pair.segment_count && !best.proven(); ++line) {
    offer_line_normals(pair, line, best);
  }
  if (best.proven()) return best;
  if (pair.disc_count == 1) {
    offer_rim_vertex_normal(pair, best);
  } else {
    offer_all_rim_rim_normals(pair, best);
  }
  return best;
}

}  // namespace touchstone
