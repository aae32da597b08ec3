#pragma once

#include <algorithm>
#include <array>
#include <limits>

#include "oracle/interval_difference.hpp"

namespace touchstone::oracle {

/// The largest gap found so far, and how far below it a direction still matters.
class Bar {
 public:
  explicit Bar(double slack) : slack_(slack) {}

  /// Raises the bar to a gap that some direction is proven to have.
  void raise(const Interval& gap) {
    best_ = std::max(best_, gap.inf());
    bar_ = (Interval(best_) - Interval(slack_)).inf();
  }
  /// Is every number of the interval below the bar? False for what is not a number.
  bool is_above(const Interval& gap) const { return gap.sup() < bar_; }

 private:
  double slack_;
  double best_ = -std::numeric_limits<double>::infinity();
  double bar_ = best_;
};

/// A piece of a curve of directions: t from lo to hi, within [-1, 1] (see CriticalSite::turn).
struct Piece {
  unsigned curve, turn;
  double lo, hi;
};

/// The circle of directions across one segment: which pieces can hold a critical direction of the
/// other parts, at which vertices.
class LineSearch {
 public:
  LineSearch(const IntervalDifference& difference, unsigned segment);

  /// Bit v: at the vertex v (one sign for each of the other segments, in order) the gap along
  /// this circle may be stationary somewhere in the piece and reach the bar, which is raised.
  unsigned long open_vertices(const Piece& piece, Bar& bar) const;

  /// Number of other segments.
  std::size_t others() const { return segments_.size(); }

 private:
  struct Planar {
    Interval e, f;
  };
  struct Segment {
    Planar axis;
    Interval half_length;
  };
  struct Disc {
    Planar axis;
    Interval along;  // the axis's part along the line
    Interval radius;
  };
  struct At {
    Interval x, y, length;
  };
  static At at(const Piece& piece, const Interval& t);
  static Interval along(const Planar& v, const At& n) { return v.e * n.x + v.f * n.y; }
  static Interval across(const Planar& v, const At& n) { return v.f * n.x - v.e * n.y; }
  Interval sine(const Disc& disc, const At& n) const;
  Interval gap(const At& n) const;

  Planar d_;
  boost::container::static_vector<Segment, most_segments - 1> segments_;
  boost::container::static_vector<Disc, most_discs> discs_;
  Interval inflation_;
};

}  // namespace touchstone::oracle
