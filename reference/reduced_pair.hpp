#pragma once

#include <array>
#include <limits>

#include "configuration.hpp"

namespace touchstone {

/// A pair of bodies reduced to a point against a sum of segments and discs about the origin, which
/// is the Minkowski difference B − A up to a ball. In double precision, world axes.
///
/// The gap along a unit n is then
///   g(n) = d·n − Σ half_length |axis·n| − Σ radius |axis × n| − inflation,
/// and the signed distance its maximum over n.
struct ReducedPair {
  struct Segment {
    Vec3 axis;  ///< unit
    double half_length;
  };
  struct Disc {
    Vec3 axis;  ///< unit
    double radius;
  };
  static constexpr int max_segments = 4;
  static constexpr int max_discs = 2;

  Vec3 d;  ///< centre of A − centre of B
  std::array<Segment, max_segments> segments;
  std::array<Disc, max_discs> discs;
  int segment_count = 0;
  int disc_count = 0;
  double inflation = 0;

  void add(const Segment& s) { segments[segment_count++] = s; }
  void add(const Disc& disc) { discs[disc_count++] = disc; }

  double gap(const Vec3& n) const;
  /// Sum of all lengths: what rounding is relative to.
  double size() const;
};

ReducedPair reduce(const Cylinder& a, const Pose& pose_a, const Capsule& b, const Pose& pose_b);
ReducedPair reduce(const Cylinder& a, const Pose& pose_a, const Cylinder& b, const Pose& pose_b);
ReducedPair reduce(const Cylinder& a, const Pose& pose_a, const Box& b, const Pose& pose_b);

/// The best direction met so far, and a bound for what better ones can reach. Metres.
struct BestNormal {
  double gap = -std::numeric_limits<double>::infinity();
  Vec3 normal = Vec3::UnitZ();  ///< unit
  /// Distance of d from some point of the sum: the signed distance is not larger.
  double limit = std::numeric_limits<double>::infinity();
  double rounding = 0;  ///< gaps that differ by less are the same

  /// Bodies apart by `gap` with points no further apart than that: nothing is better.
  bool proven() const { return gap >= limit - rounding; }
};

/// Keeps ±direction, of any length, if its gap is larger by more than rounding: of directions that
/// tie the first one stays. A zero vector offers nothing.
void offer_normal(const ReducedPair& pair, const Vec3& direction, BestNormal& best);

/// Signed distance and one optimal normal. Evaluates the gap itself at every direction that may be
/// optimal: ± the discs' axes, across two segments, across one segment (line_normals.hpp), and
/// between a rim and a vertex or two rims (rim_rim.hpp). So that an imprecise direction costs its
/// regret, which is of second order, and nothing is ever overestimated.
BestNormal largest_gap(const ReducedPair& pair);

}  // namespace touchstone
