#pragma once

#include "properties/draw.hpp"
#include "reference/configuration.hpp"

namespace touchstone {

/// A configuration beside another one.
struct Neighbour {
  Configuration configuration;
  double magnitude;  ///< of the steps between them, relative to the sizes; radians of turns
};

/// Steps from configuration to configuration, for a search that climbs. Routines break where cases
/// meet, which is often a region far thinner than what sampling meets, so that every octave of
/// magnitudes from 1 to 2^-57 is equally likely, and a step goes along what decides the case: an
/// axis, the product of both, the way between them. Every third step leaves out what parts a
/// configuration from a case (sizes, directions, offsets become equal) or changes what rounding
/// alone sees.
class RandomStep {
 public:
  /// The sizes of what is stepped to stay between half and twice those of `start`: a climb does not
  /// become one to the longest needle. `draw` must outlive this.
  RandomStep(const Configuration& start, Draw& draw);

  /// Half of the steps have about the magnitude of `likely`, unless that is zero.
  Neighbour from(const Configuration& configuration, double likely = 0);

 private:
  double min_size_, max_size_;
  Draw& draw_;
};

}  // namespace touchstone
