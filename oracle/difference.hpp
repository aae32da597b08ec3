#pragma once

#include <gmpxx.h>
#include <vector>

#include "oracle/ball.hpp"
#include "reference/configuration.hpp"

namespace touchstone::oracle {

using Integer = mpz_class;
using IntegerVector = Vector3<Integer>;

/// Three exactly orthogonal directions, each of the exact length Difference::norm.
struct Frame {
  IntegerVector axis, e, f;
};

/// Of a cylinder and a box.
inline constexpr std::size_t most_segments = 4;
/// Of two cylinders.
inline constexpr std::size_t most_discs = 2;

/// The Minkowski difference B − A of a configuration, exactly. Up to the ball of radius
/// `inflation` it is a sum of segments [−s, s] and discs about the origin, all with rational data,
/// so that the gap along a unit direction n is
///
///   g(n) = d·n − Σ half_length |axis·n| − Σ radius |axis × n| − inflation,   d = centre A − centre
///   B.
///
/// Everything is given in body A's frame, where a pose's doubles make all directions rational: for
/// a quaternion q of doubles, R(q) |q|² is an integer matrix once q is scaled to integers. Parallel
/// segments and parallel discs are merged, so that the remaining ones are pairwise not parallel,
/// exactly.
struct Difference {
  struct Segment {
    Frame frame;  ///< along frame.axis
    Integer half_length;
  };
  struct Disc {
    Frame frame;  ///< across frame.axis
    Integer radius;
  };

  Integer norm;     ///< Length of every Frame direction.
  mpq_class unit;   ///< Metres per unit of the integer lengths below.
  IntegerVector d;  ///< Centre A − centre B, in units, times norm.
  std::vector<Segment> segments;
  std::vector<Disc> discs;
  Integer inflation = 0;
  /// Body B's axes, each of the exact length `norm`; zero for a sphere or a plane.
  IntegerVector axes_b[3];
  /// For a plane: its normal, of any length; the origin of B is then a point of the plane.
  IntegerVector plane_normal{0, 0, 0};
  bool is_plane = false;

  /// Integer matrix that turns a direction of A's frame into the world, up to a positive factor.
  IntegerVector world_rows[3];
};

Difference make_difference(const Configuration& configuration);

/// A world vector of doubles in body A's frame, up to a positive factor.
IntegerVector in_frame_of_a(const Difference& difference, const Vec3& world);

/// `width` times the larger size, in units. Throws InvalidInput unless it is positive and finite.
mpq_class width_in_units(const Difference& difference, const Configuration& configuration,
                         double width);

/// A Difference at the working precision of its construction.
class BallDifference {
 public:
  explicit BallDifference(const Difference& difference);

  /// d·n and the half width h(n) = d·n − g(n) for a vector n of any length not zero; both times
  /// |n|.
  struct Along {
    Ball centre_distance, half_width;
  };
  Along along(const BallVector& n) const;

  /// g(n/|n|) in units; not finite if n may be zero.
  Ball gap(const BallVector& n) const;

 private:
  struct Part {
    BallVector axis;  // unit
    Ball length;
  };
  BallVector d_;
  std::vector<Part> segments_, discs_;
  Ball inflation_;
};

}  // namespace touchstone::oracle
