#pragma once

#include <gmpxx.h>
#include <optional>

#include "oracle/truth.hpp"
#include "reference/sweep.hpp"

namespace touchstone::oracle {

/// What is proven of the first touch of A, as it moves, with B.
struct FirstTouch {
  enum class Status {
    touch,       ///< apart at the start; the first touch lies within `fraction`
    never,       ///< apart during the whole sweep
    from_start,  ///< touching or overlapping at the start
    undecided    ///< apart before fraction.lo; if the bodies touch, then first within `fraction`
  };
  Status status;
  /// Of the sweep, within [0, 1]; both ends 0 from the start and 1 for never.
  Enclosure fraction;
  /// The truth of the pose at fraction.hi, of a touch and from the start: its normals are those
  /// that reach zero at the touch, or miss it by no more than A moves within `fraction`.
  std::optional<Truth> there;
};

/// The first touch by convexity (see oracle/truth.md). Of a translation the fraction's enclosure is
/// no wider than `width`; undecided stays what no proof reaches at that width, as a touch of one
/// moment at an irrational time. With a spin, lengths are rounded to doubles, and what is proven is
/// as wide as that leaves it: some 1e-14 of the sweep, more where A grazes B.
FirstTouch first_touch(const Configuration& configuration, const Sweep& sweep,
                       double width = 1e-20);

/// The simplest fraction within [lo, hi], of the least denominator. Precondition: 0 <= lo <= hi.
mpq_class simplest_between(const mpq_class& lo, const mpq_class& hi);

}  // namespace touchstone::oracle
