#pragma once

#include <vector>

namespace touchstone {

/// A candidate's place in the chart of speed and accuracy.
struct SpeedAccuracy {
  double low, high;  ///< spread of its time per query
  double error;
};

/// Their spreads overlap: neither may be called the faster one.
bool tied_in_time(const SpeedAccuracy& a, const SpeedAccuracy& b);

/// Is `a` better: more accurate and not slower beyond the spreads, or as accurate and faster beyond
/// them?
bool beats(const SpeedAccuracy& a, const SpeedAccuracy& b);

/// Which of them are on the Pareto front: those that nothing on the front beats. Ties are not
/// transitive (a chain of overlapping spreads may join a fast one and a slow one), so to be beaten
/// by something off the front does not count: the front is built from the most accurate on, and
/// whatever is off it is beaten by something on it.
std::vector<bool> pareto_front(const std::vector<SpeedAccuracy>& candidates);

}  // namespace touchstone
