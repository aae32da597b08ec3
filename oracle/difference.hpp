#pragma once

#include <boost/container/static_vector.hpp>
#include <gmpxx.h>
#include <optional>
#include <utility>
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

/// Reached by a cylinder and a box.
inline constexpr std::size_t max_segments = 4;
/// Reached by two cylinders.
inline constexpr std::size_t max_discs = 2;

/// The exact Minkowski difference B − A of a configuration. Apart from a ball of radius `inflation`
/// it is a sum of segments [−s, s] and discs about the origin, all with rational data, so that the
/// gap along a unit direction n is
///
///   g(n) = d·n − Σ half_length |axis·n| − Σ radius |axis × n| − inflation,
///   d = centre A − centre B,
///
/// less the largest v·n over the vertices v of a hull, if B is one. A rounded body is its core and
/// part of the ball: of a core that is a segment or a point a disc of radius zero may be left,
/// whose rim is a point.
///
/// All vectors are in body A's frame. The doubles of a pose make all directions rational: for a
/// quaternion q of integers, R(q) |q|² is an integer matrix. Parallel segments and parallel discs
/// are merged, so that no two of the remaining ones are parallel; the test is exact.
struct Difference {
  struct Segment {
    Frame frame;  ///< along frame.axis
    Integer half_length;
  };
  struct Disc {
    Frame frame;  ///< perpendicular to frame.axis
    Integer radius;
  };

  /// A convex body, about a point within its box, which stands for the centre of B.
  struct Hull {
    std::vector<IntegerVector> vertices;  ///< in units, times norm
    Convex body;                          ///< whose faces and edges join them
    Integer reach;                        ///< bound of their distance from that point, in units
  };

  Integer norm;       ///< length of every Frame direction
  Integer per_metre;  ///< units of the integer lengths below
  IntegerVector d;    ///< centre A − centre B, in units, times norm
  /// The first of each is body A's, with the frame (z; x, y).
  boost::container::static_vector<Segment, max_segments> segments;
  boost::container::static_vector<Disc, max_discs> discs;
  Integer inflation = 0;
  std::optional<Hull> hull;
  /// Body B's axes, each of the exact length `norm`; zero for a sphere or a plane.
  IntegerVector axes_b[3];
  /// For a plane: its normal, of any length; the origin of B is then a point of the plane.
  IntegerVector plane_normal{0, 0, 0};
  bool is_plane = false;

  /// Integer matrix that transforms a direction from A's frame to the world, up to a positive
  /// factor.
  IntegerVector world_rows[3];
};

Difference make_difference(const Configuration& configuration);

/// All half lengths, radii, the inflation and the hull's reach, in units: the half width is nowhere
/// larger.
Integer sum_of_sizes(const Difference& difference);

/// Are the faces exactly plane, and all angles between them and between their edges below 180°? Who
/// makes a body of faces of his own knows them only to within rounding. False for polygons of more
/// than three corners.
bool has_exact_faces(const Difference::Hull& hull);
/// The outward normal of a hull's face, of any length.
IntegerVector face_normal(const Difference::Hull& hull, int face);
/// From the first vertex of a hull's edge to the second.
IntegerVector edge_vector(const Difference::Hull& hull, int edge);

/// A world vector of doubles in body A's frame, up to a positive factor.
IntegerVector in_frame_of_a(const Difference& difference, const Vec3& world);

/// `width` times the larger size, in units. Throws InvalidInput unless it is positive and finite.
Float width_in_units(const Difference& difference, const Configuration& configuration,
                     double width);

/// d − Σ sign·half_length·axis over the segments other than `skipped`, in any arithmetic: the
/// reduced point after each of these segments has been replaced by one of its ends. Bit i of
/// `signs` is the sign of segment i. Times what d is times.
template <class AnyDifference>
auto reduced_point(const AnyDifference& difference, unsigned signs,
                   const typename AnyDifference::Segment* skipped = nullptr) {
  auto q = difference.d;
  for (std::size_t i = 0; i < difference.segments.size(); ++i) {
    const auto& s = difference.segments[i];
    if (&s == skipped) continue;
    const auto half = s.half_length * s.frame.axis;
    q = (signs >> i & 1U) ? q - half : q + half;
  }
  return q;
}

/// The component of q perpendicular to a frame's axis, times the square of the frame's length.
template <class Number, class AnyFrame>
Vector3<Number> off_axis(const Vector3<Number>& q, const AnyFrame& frame) {
  return dot(q, frame.e) * frame.e + dot(q, frame.f) * frame.f;
}

/// The plane vector (x, y) turned counterclockwise by that many quarters.
template <class Number>
std::pair<Number, Number> turned(const Number& x, const Number& y, unsigned quarters) {
  switch (quarters) {
    case 0:
      return {x, y};
    case 1:
      return {-y, x};
    case 2:
      return {-x, -y};
    default:
      return {y, -x};
  }
}

/// Adds Σ half_length |axis·n| + Σ radius |axis × n| to `sum`: the half width of a difference,
/// times |n|, in any arithmetic. `projection` of a segment is |axis·n|, of a disc |axis × n|.
template <class Number, class Segments, class Discs, class Direction>
Number add_half_width(Number sum, const Segments& segments, const Discs& discs,
                      const Direction& n) {
  for (const auto& s : segments) sum = sum + s.half_length * s.projection(n);
  for (const auto& disc : discs) sum = sum + disc.radius * disc.projection(n);
  return sum;
}

/// A Difference in balls, at the working precision of its construction.
class BallDifference {
 public:
  explicit BallDifference(const Difference& difference);

  /// d·n and the half width, of all but the hull, along n/|n|, in units; not finite if n may be
  /// zero.
  struct Along {
    Ball centre_distance, half_width;
  };
  Along along(const BallVector& n) const;

  /// The height of the hull along n/|n|, likewise; zero without a hull.
  Ball height(const BallVector& n) const;
  /// The vertices of the hull that may be the highest along n.
  std::vector<int> highest(const BallVector& n) const;
  const BallVector& vertex(int i) const { return vertices_[i]; }

  /// g(n/|n|), d·n less both, likewise.
  Ball gap(const BallVector& n) const;

  /// The unit axis of a segment.
  const BallVector& axis(std::size_t segment) const { return segments_[segment].axis; }
  const Ball& inflation() const { return inflation_; }

 private:
  struct Segment {
    BallVector axis;  // unit
    Ball half_length;
    Ball projection(const BallVector& n) const { return abs(dot(axis, n)); }
  };
  struct Disc {
    BallVector axis;  // unit
    Ball radius;
    Ball projection(const BallVector& n) const { return norm(cross(axis, n)); }
  };
  BallVector d_;
  boost::container::static_vector<Segment, max_segments> segments_;
  boost::container::static_vector<Disc, max_discs> discs_;
  Ball inflation_;
  std::vector<BallVector> vertices_;
  std::vector<Vec3> relative_vertices_;  ///< to the reach, rounded
};

}  // namespace touchstone::oracle
