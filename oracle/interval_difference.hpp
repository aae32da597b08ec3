#pragma once

#include <CGAL/Interval_nt.h>
#include <boost/container/static_vector.hpp>

#include "oracle/difference.hpp"

namespace touchstone::oracle {

/// A real number between two doubles. Every operation rounds outward, but only while a
/// CGAL::Protect_FPU_rounding is alive and in code compiled with -frounding-math.
using Interval = CGAL::Interval_nt<false>;
using IntervalVector = Vector3<Interval>;

/// A Difference in double intervals, with all lengths relative to `scale`.
struct IntervalDifference {
  struct IntervalFrame {
    IntervalVector axis, e, f;  ///< unit
  };
  struct Segment {
    IntervalFrame frame;
    Interval half_length;
  };
  struct Disc {
    IntervalFrame frame;
    Interval radius;
  };

  explicit IntervalDifference(const Difference& difference);

  /// g(n/|n|) relative to `scale`; everything if n may be zero.
  Interval gap(const IntervalVector& n) const;

  Integer scale;  ///< units: the sum of all half lengths, radii and the inflation
  IntervalVector d;
  boost::container::static_vector<Segment, most_segments> segments;
  boost::container::static_vector<Disc, most_discs> discs;
  Interval inflation;
};

}  // namespace touchstone::oracle
