#pragma once

#include <CGAL/Interval_nt.h>
#include <algorithm>
#include <array>
#include <boost/container/static_vector.hpp>
#include <cmath>
#include <limits>
#include <optional>
#include <vector>

#include "oracle/difference.hpp"
#include "oracle/slope_root.hpp"

namespace touchstone::oracle {

/// A real number between two doubles. Operations round outward only while a
/// CGAL::Protect_FPU_rounding is alive and in code compiled with -frounding-math.
using Interval = CGAL::Interval_nt<false>;
using IntervalVector = Vector3<Interval>;

/// Without changing the rounding mode, which CGAL's square root does twice: it costs more than the
/// root. The root rounded up exceeds the exact one by less than an ulp, which is at most 2^-52 of
/// it.
template <>
inline Interval square_root(const Interval& x) {
  constexpr double below = 1 - 0x1p-52;
  const double rounded_up = x.inf() > 0 ? std::sqrt(x.inf()) : 0;
  return {(Interval(rounded_up) * Interval(below)).inf(), std::sqrt(x.sup())};
}

inline Interval norm(const IntervalVector& v) {
  return square_root<Interval>(square(v.x) + square(v.y) + square(v.z));
}

/// Rises with x, towards zero with |y|: taken at the ends, so that no width is added.
template <>
inline Interval cosine_towards(const Interval& x, const Interval& y) {
  const Interval beside = abs(y);
  const auto at = [](double u, double v) {
    return Interval(u) / square_root<Interval>(square(Interval(u)) + square(Interval(v)));
  };
  return {at(x.inf(), x.inf() > 0 ? beside.sup() : beside.inf()).inf(),
          at(x.sup(), x.sup() > 0 ? beside.inf() : beside.sup()).sup()};
}

/// The gaps along a direction and along its opposite, which share the half width.
struct OppositeGaps {
  Interval forth, back;
};

/// A Difference in double intervals; all lengths are relative to `scale`.
struct IntervalDifference {
  struct IntervalFrame {
    IntervalVector axis, e, f;  ///< unit
  };
  struct Segment {
    IntervalFrame frame;
    Interval half_length;
    Interval projection(const IntervalVector& n) const { return abs(dot(frame.axis, n)); }
  };
  struct Disc {
    IntervalFrame frame;
    Interval radius;
    Interval projection(const IntervalVector& n) const {
      return square_root<Interval>(square(dot(frame.e, n)) + square(dot(frame.f, n)));
    }
  };

  explicit IntervalDifference(const Difference& difference);

  /// g(n/|n|) and g(−n/|n|) relative to `scale`, but for a hull; all real numbers if n may be zero.
  OppositeGaps gaps(const IntervalVector& n) const;
  /// The same against a hull, and the first of them against one vertex alone: no smaller than
  /// against all.
  OppositeGaps gaps_of_hull(const IntervalVector& n) const;
  Interval gap_of_vertex(const IntervalVector& vertex, const IntervalVector& n) const;

  Integer scale;  ///< in units: the sum of all sizes
  Interval metre;
  IntervalVector d;
  boost::container::static_vector<Segment, max_segments> segments;
  boost::container::static_vector<Disc, max_discs> discs;
  Interval inflation;
  std::vector<IntervalVector> vertices;  // of the hull
};

/// Each coordinate within [-1, 1], and one of them about 1: of the vector's direction.
IntervalVector scaled_direction(const IntegerVector& v);

/// The largest proven gap so far, minus a slack: directions with a smaller gap do not matter.
class GapThreshold {
 public:
  explicit GapThreshold(const Interval& slack) : slack_(slack) {}

  /// Raises the threshold to a gap that is proven for some direction.
  void raise(const Interval& gap) {
    if (!(gap.inf() > best_)) return;  // of lengths next to the least double nothing may be proven
    best_ = gap.inf();
    threshold_ = (Interval(best_) - slack_).inf();
  }
  /// Is every number of the interval below the threshold? False for NaN.
  bool is_above(const Interval& gap) const { return gap.sup() < threshold_; }

 private:
  Interval slack_;  // may reach infinity
  double best_ = -std::numeric_limits<double>::infinity();
  double threshold_ = best_;
};

/// A piece of a curve of directions: lo <= t <= hi within [-1, 1] (see CriticalSite::turn).
struct Piece {
  unsigned curve, turn;
  double lo, hi;
};

/// The circle of directions perpendicular to one segment, or the arc of those at which an edge of
/// a hull is the highest. Decides which of its pieces can contain a critical direction of the other
/// parts, and at which vertices.
class LineSearch {
 public:
  /// `tilted_disc`: the disc that is not perpendicular to the segment, if there is one.
  LineSearch(const IntervalDifference& difference, const Difference& exact, unsigned segment,
             std::optional<unsigned> tilted_disc);

  /// An edge of a hull, not parallel to A's axis: its direction, d less a vertex of it, and the
  /// normals of its faces, the second counterclockwise of the first about the edge.
  LineSearch(const IntervalDifference& difference, const Difference& exact, unsigned edge,
             const IntegerVector& direction, const IntegerVector& q, const IntervalVector& from,
             const IntervalVector& to);

  /// Which part of a quarter turn can be in the arc: lo > hi if none.
  Piece in_arc(unsigned turn) const;

  /// Bit v is set if at vertex v (one sign for each of the other segments, in order) the gap along
  /// this circle may be stationary somewhere in a piece, or in the opposite one, and reach the
  /// threshold.
  struct Open {
    unsigned long forth, back;
  };
  /// Nothing is open on a side on which nothing of `asked` is. Raises the threshold.
  Open open_vertices(const Piece& piece, const Open& asked, GapThreshold& threshold) const;

  /// The number of the segment or the edge.
  unsigned line() const { return line_; }
  /// Number of other segments.
  std::size_t others() const { return segments_.size(); }

  /// See CriticalSite.
  double heading() const { return heading_; }
  std::optional<unsigned> tilted_disc() const { return tilted_disc_; }

  /// The slope of the gap at one vertex. Precondition: there is a tilted disc.
  LineSlope<Interval> slope(unsigned vertex, int branch) const;
  /// May the gap along some direction of the piece reach the threshold?
  bool reaches(const Piece& piece, const GapThreshold& threshold) const;

 private:
  /// A direction perpendicular to the line, of that length.
  struct Direction {
    Interval x, y, length;
  };
  /// The part of a vector perpendicular to the line.
  struct Planar {
    Interval e, f;
    Interval along(const Direction& n) const { return e * n.x + f * n.y; }
    Interval across(const Direction& n) const { return f * n.x - e * n.y; }
  };
  struct Segment {
    Planar axis;
    Interval half_length;
    Interval projection(const Direction& n) const { return abs(axis.along(n)); }
  };
  struct Disc {
    Planar axis;
    Interval along;  // component of the axis along the line
    Interval radius;
    /// |axis × n|, without cancellation for a disc that is nearly perpendicular to n.
    Interval projection(const Direction& n) const {
      return square_root<Interval>(square(axis.across(n)) + square(along * n.length));
    }
  };
  static Direction direction(const Piece& piece, const Interval& t);
  OppositeGaps gaps(const Direction& n) const;
  bool is_in_arc(const Direction& n) const;

  unsigned line_;
  Planar d_;
  boost::container::static_vector<Segment, max_segments - 1> segments_;
  boost::container::static_vector<Disc, max_discs> discs_;
  Interval inflation_;
  std::optional<unsigned> tilted_disc_;
  double heading_ = 0;
  bool is_flat_ = false;  // the tilted disc's axis is exactly perpendicular to the line
  /// Of an edge: elsewhere other vertices of the hull are higher, so that gaps prove nothing there.
  struct Arc {
    Planar from, to;
  };
  std::optional<Arc> arc_;
};

/// The angles of a point on the first of two rims, at one vertex of the two segments. Decides which
/// of them can belong to a stationary pair of rim points whose common normal both rims have.
///
/// Only rim 2's nearest point is looked at, since its farthest one has no maxima. Where g has one,
/// of depth λ = −g > 0, the boundary of the sum of both bodies is curved no more than a sphere of
/// radius λ. Of its matrix of radii of curvature, Σ radius_j / |u_j × n| t_j t_jᵀ, the second part
/// alone is left across rim 1's tangent t_1, so that radius2 >= λ |u_2 × n|: rim 1's point, at
/// −λ n from rim 2's, lies on the same side of rim 2's axis. Apart (λ < 0) it lies beyond it.
class RimSearch {
 public:
  RimSearch(const IntervalDifference& difference, unsigned signs);

  /// Can the piece contain such a pair with a gap that reaches the threshold? Raises the threshold.
  bool is_open(const Piece& piece, GapThreshold& threshold) const;

  /// The slope of half the squared distance from rim 1's point to rim 2.
  RimSlope<Interval> slope(int branch) const;

 private:
  struct Point {
    Angle<Interval> angle;
    IntervalVector w, off_axis;  // w = point − q; its component across u2
    Interval w_u, off_axis_length;
  };
  Point at(unsigned turn, double lo, double hi) const;
  void sample(const Piece& piece, GapThreshold& threshold) const;

  const IntervalDifference& difference_;
  IntervalVector q_, axis2_;
  Interval radius1_, radius2_;
  Interval side1_, side2_;  // of each segment's axis: 1 or −1
};

/// Appends, in rising order, a bracket for each root of a slope in a piece of its curve, and for
/// one that lies just beyond an end. False where double intervals do not separate all roots:
/// multiple ones, slopes that vanish identically, and directions at which the square root
/// vanishes.
bool isolate_slope_roots(const LineSlope<Interval>& slope, int branch, const Piece& piece,
                         std::vector<SlopeBracket>& out);
bool isolate_slope_roots(const RimSlope<Interval>& slope, int branch, const Piece& piece,
                         std::vector<SlopeBracket>& out);

}  // namespace touchstone::oracle
