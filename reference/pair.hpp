#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>
#include <type_traits>
#include <utility>

#include "contact.hpp"
#include "largest_gap.hpp"
#include "manifold.hpp"
#include "posed_body.hpp"

namespace touchstone {

// How the four questions of every pair are answered: all that does not depend on the pair. That is
// the bodies' frame, their order, lengths out of range, ties and the bound of rounding. What does
// depend on it is the pair's `Routine`, which is made from two posed bodies and does not change:
//
//   SignedDistance find(double stop_above) const
//       the largest gap and its normal, or the first gap above `stop_above` that it meets
//   CertifiedDistance find_certified() const
//       the same without short cuts; the bound is by how much the search may have missed the
//       largest gap, but for rounding
//   void add_points(Contact&, const Vec3& origin, double contact_threshold, PointRange) const
//       to a contact whose normal and signed distance are set; `origin` is where the bodies' frame
//       lies in the world

/// The routine of a pair whose largest gap one function finds, up to an early exit, and whose
/// points lie where features face each other. The function's bound is as that of `find_certified`.
template <class Body,
          CertifiedDistance (&find_largest)(const PosedCylinder&, const Body&, EarlyExit)>
class SearchRoutine {
 public:
  SearchRoutine(const PosedCylinder& a, const Body& b) : a_(a), b_(b) {}

  SignedDistance find(double stop_above) const {
    const CertifiedDistance found = find_largest(a_, b_, {stop_above});
    return {found.value, found.normal};
  }
  CertifiedDistance find_certified() const { return find_largest(a_, b_, no_short_cuts); }
  void add_points(Contact& contact, const Vec3& origin, double contact_threshold,
                  PointRange range) const {
    add_facing_points(contact, a_, b_, origin, contact_threshold, range);
  }

 private:
  const PosedCylinder& a_;
  const Body& b_;
};

/// Both bodies in one frame, about B's centre; of rounded ones the cores. Balls of radius ρ added
/// to a body take ρ from its gap along every direction: the normals stay, and so does all that
/// compares gaps.
template <class Other>
struct PosedPair {
  PosedCylinder a;
  decltype(posed(std::declval<Other>(), Pose(), Vec3())) b;
  const Vec3& origin;  ///< of the frame, in the world
  bool exchanged;
  double rounding_a, rounding_b;

  /// By which the cores are farther apart.
  double rounding() const { return rounding_a + rounding_b; }
  double lengths() const {
    return (a.centre - b.centre).cwiseAbs().sum() + touchstone::lengths(a).sum +
           touchstone::lengths(b).sum + rounding();
  }
  /// Turns a contact of the cores into that of the bodies: the surface of each moves out by its
  /// rounding.
  void add_rounding(Contact& contact) const {
    if (rounding() == 0) [[likely]]
      return;
    constexpr double same = 1e-14;  // of all lengths: corners of a core that is nearly a point
    contact.signed_distance -= rounding();
    contact.shift_points((rounding_b - rounding_a) / 2 * contact.normal, rounding(),
                         same * lengths());
  }
  /// Turns a normal from this B to this A into that between the bodies as they were given, and
  /// back.
  void turn_as_given(Vec3& normal) const {
    if constexpr (std::is_same_v<Other, Cylinder>) normal *= exchanged ? -1 : 1;
  }
};

template <class Other>
inline PosedPair<Other> posed_pair(const Cylinder& a, const Pose& pose_a, const Other& b,
                                   const Pose& pose_b) {
  const Vec3& origin = pose_b.position();
  return {posed(a, pose_a, pose_a.position() - origin),
          posed(b, pose_b, Vec3::Zero()),
          origin,
          false,
          a.rounding(),
          rounding_in(b)};
}
/// Cylinders in a fixed order, the one with the smaller radius first, so that the answer does not
/// depend on how they were given.
inline PosedPair<Cylinder> posed_pair(const Cylinder& a, const Pose& pose_a, const Cylinder& b,
                                      const Pose& pose_b) {
  const auto key = [](const Cylinder& s, const Pose& p) {
    const Vec3& x = p.position();
    const auto& q = p.orientation();
    return std::make_tuple(s.half_length(), s.rounding(), x.x(), x.y(), x.z(), q.w(), q.x(), q.y(),
                           q.z());
  };
  const bool exchanged =
      a.radius() != b.radius() ? a.radius() > b.radius() : key(a, pose_a) > key(b, pose_b);
  const Pose &first = exchanged ? pose_b : pose_a, &second = exchanged ? pose_a : pose_b;
  const Cylinder &of_first = exchanged ? b : a, &of_second = exchanged ? a : b;
  return {posed(of_first, first, first.position() - second.position()),
          posed(of_second, second, Vec3::Zero()),
          second.position(),
          exchanged,
          of_first.rounding(),
          of_second.rounding()};
}

// Lengths so large or small that their powers overflow or vanish are brought into range by a power
// of two, which rounds nothing, and the answer back. Nobody simulates such bodies, but a body that
// has flown off must be answered with a number, not with NaN.

/// Does no power of a length overflow or vanish? The largest are the twelfth (`ellipse_normal`
/// takes lengths of sixth powers): with all lengths within these bounds none leaves 1e-300 to
/// 1e300, whichever lengths it multiplies.
inline constexpr double min_length_in_range = 1e-25, max_length_in_range = 1e25;
inline bool are_in_range(const Lengths& a, const Lengths& b) {
  return std::min(a.smallest, b.smallest) > min_length_in_range &&
         a.sum + b.sum < max_length_in_range;
}
inline bool is_in_range(const Vec3& d) {
  return d.x() * d.x() + d.y() * d.y() + d.z() * d.z() < max_length_in_range * max_length_in_range;
}
template <class Other>
inline bool powers_in_range(const PosedPair<Other>& pair) {
  return are_in_range(lengths(pair.a), lengths(pair.b)) &&
         is_in_range(pair.a.centre - pair.b.centre);
}

/// The bodies about the origin of their frame, with all lengths times a power of two so that the
/// largest is about one; sizes that vanish against it are made 1e-24 of it, which moves a clearance
/// by far less than the bound of rounding.
template <class Other>
class ScaledBodies {
 public:
  ScaledBodies(const PosedPair<Other>& pair, const Cylinder& a, const Pose& pose_a, const Other& b,
               const Pose& pose_b)
      : origin_(pair.origin),
        exponent_(std::ilogb(std::min(pair.lengths(), max_length))),
        a_(scaled(a)),
        b_(scaled(b)),
        pose_a_(scaled_difference(pose_a.position()), pose_a.orientation()),
        pose_b_(scaled_difference(pose_b.position()), pose_b.orientation()) {}

  /// question(length, a, pose_a, b, pose_b) of the scaled length and bodies, scaled back; what
  /// overflows is the largest double.
  template <class Question>
  auto answer(double length, Question question) const {
    return back(question(scaled(length), a_, pose_a_, b_, pose_b_));
  }

 private:
  static constexpr double vanishing = 1e-24;
  static constexpr double max_length = std::numeric_limits<double>::max();

  double scaled(double length) const { return std::scalbn(length, -exponent_); }
  Vec3 scaled(const Vec3& x) const { return {scaled(x.x()), scaled(x.y()), scaled(x.z())}; }
  double size(double length) const { return std::max(scaled(length), vanishing); }
  Plane scaled(const Plane& s) const { return {s.unit_normal(), scaled(s.unit_displacement())}; }
  Sphere scaled(const Sphere& s) const { return Sphere(size(s.radius())); }
  Cylinder scaled(const Cylinder& s) const {
    const double r = size(s.radius()), h = size(s.half_length());
    return {r, h, rounding(s.rounding(), std::min(r, h))};
  }
  Capsule scaled(const Capsule& s) const { return {size(s.radius()), size(s.half_length())}; }
  Box scaled(const Box& s) const {
    const Vec3& e = s.half_extents();
    const Vec3 half(size(e.x()), size(e.y()), size(e.z()));
    return Box(half, rounding(s.rounding(), half.minCoeff()));
  }
  /// At most what leaves a core of a size that does not vanish.
  double rounding(double given, double least) const {
    return std::max(0.0, std::min(scaled(given), least - vanishing));
  }
  Convex scaled(const Convex& s) const { return s.scaled(-exponent_); }
  /// The position less the origin; a difference that overflows is scaled before it is taken.
  Vec3 scaled_difference(const Vec3& position) const {
    const Vec3 difference = position - origin_;
    return difference.allFinite() ? scaled(difference) : Vec3(scaled(position) - scaled(origin_));
  }

  double back(double length) const {
    return std::clamp(std::scalbn(length, exponent_), -max_length, max_length);
  }
  bool back(bool answer) const { return answer; }
  SignedDistance back(const SignedDistance& x) const { return {back(x.value), x.normal}; }
  /// A value that overflows is not proven; one that underflows is rounded by less than the least
  /// double, as its bound is.
  CertifiedDistance back(const CertifiedDistance& x) const {
    const double value = back(x.value), bound = std::scalbn(x.error_bound, exponent_);
    constexpr double least = std::numeric_limits<double>::denorm_min();
    constexpr double infinite = std::numeric_limits<double>::infinity();
    return {{value, x.normal}, std::abs(value) < max_length ? bound + 2 * least : infinite};
  }
  Contact back(const Contact& x) const {
    Contact result;
    result.normal = x.normal;
    result.signed_distance = back(x.signed_distance);
    for (const ContactPoint& p : x.points()) {
      const Vec3 arm(back(p.position.x()), back(p.position.y()), back(p.position.z()));
      result.add_point((origin_ + arm).cwiseMax(-max_length).cwiseMin(max_length), back(p.depth));
    }
    return result;
  }

  Vec3 origin_;
  int exponent_;
  Cylinder a_;
  Other b_;
  Pose pose_a_, pose_b_;
};

/// Out of line, so that what hardly ever happens costs the others nothing.
template <class Other, class Question>
[[gnu::noinline, gnu::cold]] auto answer_scaled(double length, Question question, const Cylinder& a,
                                                const Pose& pose_a, const Other& b,
                                                const Pose& pose_b) {
  return ScaledBodies(posed_pair(a, pose_a, b, pose_b), a, pose_a, b, pose_b)
      .answer(length, question);
}

/// Calls `offer` with the unit vectors along a body's axes and, of bodies of revolution, radially
/// along `v`.
template <class Revolved, class Offer>
void offer_normals(const Revolved& s, const Vec3& v, Offer offer) {
  offer(s.axis());
  const Vec3 radial = v - v.dot(s.axis()) * s.axis();
  constexpr double noise = 1e-12, vanishing = 1e-100;
  if (const double length = radial.norm(); length > noise * v.norm() + vanishing) {
    offer(radial / length);
  }
}
template <class Offer>
void offer_normals(const PosedSphere&, const Vec3&, Offer) {}
template <class Offer>
void offer_normals(const PosedBox& s, const Vec3&, Offer offer) {
  for (int i = 0; i < 3; ++i) offer(s.axes.col(i));
}

template <class Offer>
void offer_normals(const PosedConvex& s, const Vec3&, Offer offer) {
  const ConvexTables& tables = s.body.tables();
  for (int f = 0; f < tables.face_count; ++f) offer(Vec3(s.axes * tables.face_normal(f)));
}

/// The gap along a unit vector.
template <class Body>
SignedDistance gap_along(const PosedCylinder& a, const Body& b, const Vec3& n) {
  return {(a.centre - b.centre).dot(n) - reach(a, n) - reach(b, n), n};
}

/// Of the normals whose gap is within `threshold` of the largest, the one nearest to the previous
/// one: an axis or face of a body, radially off one, or the one found; and where all of these are
/// more than 5 degrees away, the previous one itself. Nearer ones are taken for its own motion.
/// `previous` is a unit vector.
template <class Body>
SignedDistance nearest_tie(const PosedCylinder& a, const Body& b, const SignedDistance& found,
                           double threshold, const Vec3& previous) {
  const Vec3 d = a.centre - b.centre;
  SignedDistance chosen = found;
  double nearest = found.normal.dot(previous);
  const auto offer = [&](const Vec3& axis) {
    const Vec3 n = axis.dot(previous) < 0 ? Vec3(-axis) : axis;
    if (!(n.dot(previous) > nearest)) return;
    const SignedDistance along = gap_along(a, b, n);
    if (!(along.value >= found.value - threshold)) return;
    chosen = along;
    nearest = n.dot(previous);
  };
  for (const Vec3& v : {d, previous}) {
    offer_normals(a, v, offer);
    offer_normals(b, v, offer);
  }
  constexpr double cosine_of_5_degrees = 0.9962;
  if (nearest < cosine_of_5_degrees) offer(previous);
  return chosen;
}

// The four questions. Where the bodies are out of range, each is asked again of scaled ones.

template <class Routine, class Other>
SignedDistance find_signed_distance(const Cylinder& a, const Pose& pose_a, const Other& b,
                                    const Pose& pose_b) {
  const auto pair = posed_pair(a, pose_a, b, pose_b);
  if (!powers_in_range(pair)) {
    const auto again = [](double, const auto&... bodies) { return signed_distance(bodies...); };
    return answer_scaled(0, again, a, pose_a, b, pose_b);
  }
  SignedDistance found = Routine(pair.a, pair.b).find(no_early_exit);
  found.value -= pair.rounding();
  pair.turn_as_given(found.normal);
  return found;
}

template <class Routine, class Other>
CertifiedDistance find_certified_distance(const Cylinder& a, const Pose& pose_a, const Other& b,
                                          const Pose& pose_b) {
  const auto pair = posed_pair(a, pose_a, b, pose_b);
  if (!powers_in_range(pair)) {
    const auto again = [](double, const auto&... bodies) { return certified_distance(bodies...); };
    return answer_scaled(0, again, a, pose_a, b, pose_b);
  }
  CertifiedDistance found = Routine(pair.a, pair.b).find_certified();
  found.value -= pair.rounding();
  pair.turn_as_given(found.normal);
  found.error_bound += rounding_part * pair.lengths();
  return found;
}

template <class Routine, class Other>
bool find_overlap(const Cylinder& a, const Pose& pose_a, const Other& b, const Pose& pose_b) {
  const auto pair = posed_pair(a, pose_a, b, pose_b);
  if (!powers_in_range(pair)) {
    const auto again = [](double, const auto&... bodies) { return overlaps(bodies...); };
    return answer_scaled(0, again, a, pose_a, b, pose_b);
  }
  return Routine(pair.a, pair.b).find(pair.rounding()).value <= pair.rounding();
}

/// Makes a contact, without points yet, that along a normal: with points if it is within the
/// threshold. (In its place: a contact is long.)
template <class Routine>
void make_contact(Contact& result, const SignedDistance& along, const Routine& routine,
                  const Vec3& origin, double contact_threshold, PointRange range) {
  result.normal = along.normal;
  result.signed_distance = along.value;
  if (along.value <= contact_threshold) {
    routine.add_points(result, origin, contact_threshold, range);
  }
}

/// Is each point of a contact, moved to either surface, outside no body by more than the tolerance?
template <class Body>
bool meet_at_points(const PosedCylinder& a, const Body& b, const Contact& contact,
                    const Vec3& origin, double tolerance) {
  for (const ContactPoint& p : contact.points()) {
    const Vec3 x = p.position - origin, half = p.depth / 2 * contact.normal;
    if (!(std::max(outside(a, x - half), outside(b, x + half)) <= tolerance)) return false;
  }
  return true;
}

/// Makes a contact that along the normal that `nearest_tie` chooses; where the bodies do not meet
/// along that to within the threshold, as features need not whose clearances tie, along the
/// previous one itself. False, where that is no better or no other than the one found.
/// `previous_normal` may have any length; zero or not finite, it decides nothing.
template <class Routine, class Other>
bool make_hinted_contact(Contact& result, const SignedDistance& found, const Routine& routine,
                         const PosedPair<Other>& pair, double contact_threshold,
                         Vec3 previous_normal, PointRange range) {
  const double largest = previous_normal.cwiseAbs().maxCoeff();
  if (!(largest > 0 && previous_normal.allFinite())) return false;
  pair.turn_as_given(previous_normal);
  const Vec3 previous = (previous_normal / largest).normalized();
  // Points are as exact as their coordinates in the world.
  constexpr double epsilon = std::numeric_limits<double>::epsilon();
  const double of_cores = contact_threshold + pair.rounding();
  const double tolerance =
      contact_threshold + rounding_part * pair.lengths() + epsilon * pair.origin.cwiseAbs().sum();
  for (const SignedDistance& tie : {nearest_tie(pair.a, pair.b, found, contact_threshold, previous),
                                    gap_along(pair.a, pair.b, previous)}) {
    if (tie.normal == found.normal) break;
    if (!(tie.value >= found.value - contact_threshold)) continue;
    result.clear_points();
    make_contact(result, tie, routine, pair.origin, of_cores, range);
    if (meet_at_points(pair.a, pair.b, result, pair.origin, tolerance)) return true;
  }
  result.clear_points();
  return false;
}
/// A plane has one normal.
template <class Routine>
bool make_hinted_contact(Contact&, const SignedDistance&, const Routine&, const PosedPair<Plane>&,
                         double, const Vec3&, PointRange) {
  return false;
}

template <class Routine, class Other>
Contact contact_in_range(const PosedPair<Other>& pair, double contact_threshold,
                         const Vec3* previous_normal, PointRange range) {
  const Routine routine(pair.a, pair.b);
  const double of_cores = contact_threshold + pair.rounding();
  const SignedDistance found = routine.find(of_cores);
  Contact result;
  if (!(previous_normal && found.value <= of_cores &&
        make_hinted_contact(result, found, routine, pair, contact_threshold, *previous_normal,
                            range))) {
    make_contact(result, found, routine, pair.origin, of_cores, range);
  }
  pair.add_rounding(result);
  pair.turn_as_given(result.normal);
  return result;
}

template <class Routine, class Other>
Contact find_contact(const Cylinder& a, const Pose& pose_a, const Other& b, const Pose& pose_b,
                     double contact_threshold, const Vec3* previous_normal, PointRange range) {
  const auto pair = posed_pair(a, pose_a, b, pose_b);
  if (!powers_in_range(pair)) {
    const auto again = [=](double threshold, const auto&... bodies) {
      return contact(bodies..., threshold, previous_normal, range);
    };
    return answer_scaled(contact_threshold, again, a, pose_a, b, pose_b);
  }
  return contact_in_range<Routine>(pair, contact_threshold, previous_normal, range);
}

}  // namespace touchstone
