#pragma once

#include <array>
#include <cstddef>
#include <vector>

// What the probe and a library with planted faults say to each other: plain numbers, so that no
// mutated shape, pose or configuration reaches the probe, its cases or its truths.

namespace touchstone::mutation {

using Numbers3 = std::array<double, 3>;
using Numbers4 = std::array<double, 4>;

/// A configuration: `pair` counts as enum Pair does, `sizes` are those of A, then those of B;
/// orientations are w, x, y, z; `normal` and `displacement` are a plane's, `vertices` and `faces` a
/// hull's.
struct RawConfiguration {
  double pair = 0;
  std::array<double, 5> sizes{};
  std::vector<Numbers3> vertices{};
  std::vector<std::vector<int>> faces{};
  Numbers3 position_a{}, position_b{};
  Numbers4 orientation_a{}, orientation_b{};
  Numbers3 normal{};
  double displacement = 0;
};

struct RawDistance {
  double value;
  Numbers3 normal;
  double error_bound;  ///< of a certified distance
};

struct RawPoint {
  Numbers3 position;
  double depth;
};

struct RawContact {
  double signed_distance;
  Numbers3 normal;
  std::size_t count;
  std::array<RawPoint, 8> points;
};

struct RawBounds {
  Numbers3 lower, upper;
};

/// What the search of rims takes for proven of one arc of the smaller cylinder's rim
/// (reference/rims.hpp), and the numbers that it has of the two rims.
struct RawArc {
  double c, s;  ///< cosine and sine between the axes
  Numbers3 q;   ///< from rim 2's centre to rim 1's, but for the bodies' halves (proofs.md)
  double r1, r2;
  double min_speed, max_speed, min_radial, max_radial, turn, max_rate, max_second, max_bend;
  bool only_maxima, points_inward, may_meet_overlapping, may_meet_apart;
};

/// The answers to three questions of one pair.
struct RawAnswers {
  RawDistance distance;
  bool overlaps;
  RawContact contact;
};

/// Which of the routines for many poses, or for poses in single precision, is asked.
enum class Batch { in_double, in_float, in_float_one_by_one };

/// The routines of one library.
struct Routines {
  /// Null where a shape or a pose refuses its numbers, and `field` then says which.
  const void* (*make)(const RawConfiguration&, const char** field);
  void (*release)(const void*);
  RawDistance (*signed_distance)(const void*);
  RawDistance (*certified_distance)(const void*);
  bool (*overlaps)(const void*);
  RawContact (*contact)(const void*, double threshold, const Numbers3* previous_normal);
  void (*bounds)(const void*, RawBounds& a, RawBounds& b);
  bool (*bounds_overlap)(const void*);
  /// Two cylinders only; ends are +1 or −1, the angle and half width radians along the rim.
  RawArc (*arc)(const void*, double end1, double end2, double angle, double half_width);
  /// Answers of `count` pairs of the same shapes, every second one with the poses exchanged; in
  /// float of poses, threshold and hint that are floats. One by one with the hint, if any.
  void (*batch)(const void*, Batch how, std::size_t count, double threshold,
                const Numbers3* previous_normal, RawAnswers* results);
  /// The field that is refused of a batch of three poses of A and so many of B and results, empty
  /// if none; `question` counts the members of RawAnswers.
  const char* (*refused_batch)(const void*, Batch how, int question, std::size_t poses_b,
                               std::size_t results);
};

}  // namespace touchstone::mutation

extern "C" __attribute__((visibility("default"))) const touchstone::mutation::Routines*
touchstone_routines();
