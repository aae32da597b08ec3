#pragma once

#include <vector>

namespace touchstone {

/// A candidate's place in the chart of speed and accuracy.
struct SpeedAccuracy {
  double low, high;  ///< spread of its time per query
  double error;
};

/// Tells whether the spreads overlap: neither may be called the faster one.
bool tied_in_time(const SpeedAccuracy& a, const SpeedAccuracy& b);

/// Tells whether `a` is better: more accurate and not slower beyond the spreads, or as accurate and
/// faster beyond them.
bool beats(const SpeedAccuracy& a, const SpeedAccuracy& b);

/// Finds the candidates on the Pareto front: those that no candidate on the front beats. Ties are
/// not transitive (a chain of overlapping spreads may join a fast candidate and a slow one), so a
/// candidate off the front beats nobody: the front is built in the order of accuracy, and every
/// candidate off it is beaten by one on it.
std::vector<bool> pareto_front(const std::vector<SpeedAccuracy>& candidates);

}  // namespace touchstone
