#pragma once

#include <gmpxx.h>
#include <optional>
#include <vector>

#include "oracle/enclosure.hpp"
#include "oracle/optimal_normal.hpp"
#include "reference/configuration.hpp"

namespace touchstone::oracle {

/// How many directions reach the signed distance.
enum class Ties { unique, finite, continuum };

/// What is true of one configuration.
struct Truth {
  /// Metres; positive apart, negative inside. Zero lies in it only when the bodies touch exactly,
  /// and then both ends are zero; unless neither that nor the sign could be proven: it is then
  /// ±2^-1000 of the larger size, or ±2^-184 where numbers had to be rounded (see below).
  Enclosure signed_distance;
  /// The critical directions that reach it or tie with one that does, each once. Of a family at
  /// least one.
  std::vector<OptimalNormal> normals;
  Ties ties;
  /// The families of which some of `normals` are members.
  std::vector<NormalFamily> families;
};

/// Signed distance and optimal normals by exact critical directions (see oracle/README.md). The
/// enclosure is no wider than `width` times the larger size, and its sign is decided. It depends on
/// the geometry alone: exactly the same rotation, translation, exchange or scaling by a power of
/// two of both bodies leaves or scales it exactly. `normals` are those that tie: their gap is
/// within 2^-20 `width` times the larger size of the signed distance, or within `tie` >= 0 times it
/// where that is more. Gaps are refined until it is certain which do, so that this depends on the
/// geometry alone too.
///
/// Against a capsule, cylinder or box, lengths are rounded to multiples of 2^-192 of the larger
/// size and orientations to as many bits (resolved.hpp); a narrower `width` keeps more. The
/// enclosure holds for the exact configuration all the same; normals, ties and their alignment to
/// the axes are those of the rounded one, and zero lies in the enclosure of bodies that touch to
/// within 2^-184 of the size. So any finite numbers take about 50 ms at most at the width 1e-30.
///
/// Throws InvalidInput unless 0 < width; std::logic_error if its own bounds contradict each other.
Truth truth(const Configuration& configuration, double width = 1e-30, double tie = 0);

/// Enclosure of the clearance g(n/|n|) of the exact configuration along a vector n of doubles,
/// finite and not zero, no wider than `width` times the larger size. A half-space has no finite
/// gap except along its own normal, and no engine can answer that to the last bit: for a plane, g
/// is taken against the column of the half-space beneath the cylinder's circumsphere, two
/// circumradii deep, so that a tilted answer costs what it is worth to this cylinder.
Enclosure certified_gap(const Configuration& configuration, const Vec3& n, double width = 1e-15);

/// Normal regret σ − g(n) >= 0 in metres, to within `width` times the larger size, rounded to a
/// double not below zero.
double normal_regret(const Configuration& configuration, const Truth& truth, const Vec3& n);

}  // namespace touchstone::oracle
