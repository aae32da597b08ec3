#pragma once

#include "oracle/line_search.hpp"

namespace touchstone::oracle {

/// The angles of a point on the first of two rims, at one vertex of the two segments: which can
/// belong to a stationary pair of rim points that is in contact there.
class RimSearch {
 public:
  RimSearch(const IntervalDifference& difference, unsigned signs);

  /// May the piece hold such a pair whose gap reaches the bar, which is raised?
  bool is_open(const Piece& piece, Bar& bar) const;

 private:
  struct Point {
    IntervalVector radial, tangent, w, off_axis;  // of rim 1; w and its part across u2 from q
    Interval w_u, off_axis_length;
  };
  Point at(unsigned turn, double lo, double hi) const;
  void sample(const Piece& piece, Bar& bar) const;

  const IntervalDifference& difference_;
  IntervalVector q_, up1_, up2_;
  Interval radius1_, radius2_;
};

}  // namespace touchstone::oracle
