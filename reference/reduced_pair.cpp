#include "reduced_pair.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "point_ellipse.hpp"
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

/// d less the ends of all segments but one; bit i of `signs` chooses the end of segment i.
Vec3 reduced_point(const ReducedPair& pair, unsigned signs, int skipped) {
  Vec3 q = pair.d;
  for (int i = 0; i < pair.segment_count; ++i) {
    if (i == skipped) continue;
    const auto& s = pair.segments[i];
    q -= ((signs >> i & 1U) ? s.half_length : -s.half_length) * s.axis;
  }
  return q;
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

/// Nearest point of one disc's rim to the vertex q, when q lies beyond the rim.
void offer_rim_vertex_normal(const ReducedPair& pair, const Vec3& q, BestNormal& best) {
  const auto& disc = pair.discs[0];
  const Vec3 across = q - q.dot(disc.axis) * disc.axis;
  const double length = across.norm();
  if (length > disc.radius) offer_normal(pair, q - (disc.radius / length) * across, best);
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

/// Normals across segment `line`: every disc is projected along it to an ellipse (or, seen flat on,
/// to itself).
void offer_line_normals(const ReducedPair& pair, int line, unsigned signs, BestNormal& best) {
  const Vec3& s = pair.segments[line].axis;
  Vec3 q = reduced_point(pair, signs, line);
  q -= q.dot(s) * s;
  // A disc seen flat on is the same circle in every direction.
  double flat_radius = 0;
  for (int j = 0; j < pair.disc_count; ++j) {
    if (s.cross(pair.discs[j].axis).isZero(0)) flat_radius += pair.discs[j].radius;
  }
  for (int j = 0; j < pair.disc_count; ++j) {
    const auto& disc = pair.discs[j];
    const Vec3 tilt = s.cross(disc.axis);
    if (tilt.isZero(0)) {
      if (q.norm() - flat_radius - pair.inflation <= best.gap) continue;
      offer_normal(pair, q, best);
      // On the axis every radial direction is as good as another.
      offer_normal(pair, s.unitOrthogonal(), best);
      continue;
    }
    // The product of nearly parallel axes has few digits left; across the line it must stay.
    Vec3 major = tilt.normalized();
    major = (major - major.dot(s) * s).normalized();
    const Vec3 minor = s.cross(major).normalized();
    const double a = disc.radius, b = disc.radius * std::abs(s.dot(disc.axis));
    // The ellipse holds a disc of radius b, so no direction across the line is better than this.
    if (q.norm() - b - flat_radius - pair.inflation <= best.gap) continue;
    const EllipseFeet feet = feet_on_ellipse(a, std::min(a, b), q.dot(major), q.dot(minor));
    for (int k = 0; k < feet.count; ++k) {
      const double c = std::cos(feet.angle[k]), t = std::sin(feet.angle[k]);
      offer_normal(pair, (b * c) * major + (a * t) * minor, best);
      // The point itself where the ellipse ends in a vertex.
      offer_normal(pair, q - (a * c) * major - (b * t) * minor, best);
    }
  }
}

/// Eight neighbours at a shrinking angle: takes off what rounding and a missed narrow well leave
/// over.
void climb(const ReducedPair& pair, BestNormal& best) {
  constexpr int evaluations = 400;
  double step = 1e-3;
  for (int count = 0; count < evaluations / 8 && step > 1e-9; ++count) {
    const Vec3 e = best.normal.unitOrthogonal(), f = best.normal.cross(e);
    const double before = best.gap;
    const Vec3 centre = best.normal;
    for (const auto& [x, y] : {std::pair(1.0, 0.0),
                               {-1.0, 0.0},
                               {0.0, 1.0},
                               {0.0, -1.0},
                               {0.7, 0.7},
                               {-0.7, 0.7},
                               {0.7, -0.7},
                               {-0.7, -0.7}}) {
      const Vec3 n = (centre + step * (x * e + y * f)).normalized();
      const double g = pair.gap(n);
      if (g > best.gap) best = {g, n};
    }
    if (!(best.gap > before)) step /= 4;
  }
}

}  // namespace

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
  if (g > best.gap) best = {g, n};
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
  BestNormal best{-std::numeric_limits<double>::infinity(), Vec3::UnitZ()};
  offer_axial_normals(pair, best);
  // The segments' ends that the best direction so far selects come first: they are mostly the right
  // ones, and a good gap dismisses the others.
  unsigned likely = 0;
  for (int i = 0; i < pair.segment_count; ++i) {
    if (pair.segments[i].axis.dot(best.normal) > 0) likely |= 1U << i;
  }
  const unsigned vertices = 1U << pair.segment_count;
  for (unsigned other = 0; other < vertices; ++other) {
    for (int line = 0; line < pair.segment_count; ++line) {
      // Either end of the line's own segment gives the same problem.
      if (!(other >> line & 1U)) offer_line_normals(pair, line, likely ^ other, best);
    }
  }
  for (unsigned other = 0; other < vertices; ++other) {
    const unsigned signs = likely ^ other;
    const Vec3 q = reduced_point(pair, signs, -1);
    if (pair.disc_count == 1) {
      offer_rim_vertex_normal(pair, q, best);
    } else if (rims_may_meet(pair, signs, q, best)) {
      offer_rim_rim_normals(pair, q, best);
    }
  }
  climb(pair, best);
  return best;
}

}  // namespace touchstone
