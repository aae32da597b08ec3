#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "curves.hpp"
#include "disc_layout.hpp"
#include "manifold.hpp"

namespace touchstone {

/// What a cap shares with a convex polygon, a contact patch, and the few points that stand for it.
/// Vectors are arms from the cap's middle, in the cap's plane; of a face with four sides at right
/// angles CapOnFace does the same in less time.
///
/// The points are the patch's farthest ones in fixed directions of the polygon, between the normals
/// of its sides: its corners and the ends of what of an edge is in the cap, continuous functions of
/// where the cap lies. Of a whole cap they are three. The deepest place of a body that leans is one
/// more, or where there are eight the one next to it goes there.
///
/// `Corners` gives corner(i), counterclockwise, of count(). A polygon may have thousands: nothing
/// of them is kept, and each question goes through all sides.
template <class Corners>
class CapOnPolygon {
 public:
  CapOnPolygon(double radius, const Corners& corners) : radius_(radius), corners_(corners) {
    double nearest = std::numeric_limits<double>::infinity();
    Vec2 first = Vec2::Zero(), before = first;
    const auto turn = [&](const Vec2& from, const Vec2& to) {
      if (from.dot(to) > 0) half_turn_ = std::min(half_turn_, std::abs(cross2(from, to)) / 2);
    };
    for_each_side([&](const Side& s) {
      if (!(s.distance >= 0)) is_centre_inside_ = false;
      nearest = std::min(nearest, s.distance);
      if (first.isZero()) first = s.outward;
      turn(before, s.outward);
      before = s.outward;
      if (!(s.lo <= s.hi)) return;
      is_cut_ = true;
      max_cut_ = std::max(max_cut_, (radius_ - s.distance) / radius_);
    });
    turn(before, first);
    inner_ = std::min(radius_, nearest);
  }

  bool empty() const { return !is_cut_ && !is_centre_inside_; }
  /// The polygon's point that is nearest to the cap's middle.
  Vec2 nearest() const {
    if (is_centre_inside_) return Vec2::Zero();
    Vec2 found = Vec2::Zero();
    double least = std::numeric_limits<double>::infinity();
    for_each_side([&](const Side& s) {
      const Vec2 p = s.place(within(0, s.from, s.to));
      if (p.squaredNorm() < least) least = p.squaredNorm(), found = p;
    });
    return found;
  }
  /// As CapOnFace.
  Vec2 farthest(const Vec2& unit, double straight = 0) const {
    const Vec2 arm = radius_ * unit;
    bool is_inside = true, is_along_side = false;
    Vec2 found = arm;
    double most = -std::numeric_limits<double>::infinity();
    straight = std::min(straight, half_turn_);
    for_each_side([&](const Side& s) {
      is_inside = is_inside && s.outward.dot(arm) <= s.distance;
      if (!(s.lo <= s.hi) || is_along_side) return;
      const double sine = cross2(s.outward, unit);
      if (std::abs(sine) < straight && unit.dot(s.outward) > 0) {
        is_along_side = true;
        const double half = (s.hi - s.lo) / 2, gain = std::max(radius_, half / straight);
        found = s.place(within((s.lo + s.hi) / 2 + gain * sine, s.lo, s.hi));
        return;
      }
      for (const double t : {s.lo, s.hi}) {
        const Vec2 p = s.place(t);
        if (const double far = unit.dot(p); far > most) most = far, found = p;
      }
    });
    return is_inside ? arm : found;
  }

  static constexpr int max_points = 8;
  /// As CapOnFace.
  int spread(const Vec2& towards, const Vec2& deepest, double clearness,
             std::array<Vec2, max_points>& points) const {
    std::array<Vec2, max_points> ways;
    const int count = directions(ways);
    const double progress = is_cut_ ? ramp(max_cut_, unseen_part, handed_over) : 0;
    const auto arms = three_arms(inner_, ways[0]);
    for (int i = 0; i < count; ++i) {
      points[i] = arms[3 * i / count];
      if (progress > 0) points[i] += progress * (farthest(ways[i]) - points[i]);
    }
    if (clearness == 0) return count;
    if (count < max_points) {  // room for one more
      points[count] = points[0] + clearness * (deepest - points[0]);
      return count + 1;
    }
    double nearest = -1;
    for (int i = 0; i < count; ++i) nearest = std::max(nearest, ways[i].dot(towards));
    for (int i = 0; i < count; ++i) {
      constexpr double beside = 0.15;
      const double weight = clearness * ramp(ways[i].dot(towards), nearest - beside, nearest);
      points[i] += weight * (deepest - points[i]);
    }
    return count;
  }

  /// Moves points that are higher along the unit vector `up` down to that line across it, to where
  /// it runs through the patch.
  void cut_off(const Vec2& up, double height, std::array<Vec2, max_points>& points,
               int count) const {
    const Vec2 along = turned_left(up);
    double hi = std::sqrt(std::max(0.0, (radius_ - height) * (radius_ + height))), lo = -hi;
    for_each_side([&](const Side& s) {
      // Where a line runs along an edge rounding would say where they cross.
      constexpr double parallel = 1e-9;
      const double rises = s.outward.dot(along), left = s.distance - height * s.outward.dot(up);
      if (rises > parallel) hi = std::min(hi, left / rises);
      if (rises < -parallel) lo = std::max(lo, left / rises);
    });
    for (int i = 0; i < count; ++i) {
      if (up.dot(points[i]) > height) {
        points[i] = height * up + within(along.dot(points[i]), lo, hi) * along;
      }
    }
  }

 private:
  /// While an edge cuts off no more than this part of the radius, the three points of a whole cap
  /// are handed over.
  static constexpr double handed_over = 0.01;

  /// A side of the polygon, along its edge from the foot of the cap's middle on.
  struct Side {
    Vec2 outward, along;
    double distance;  ///< of the edge
    double from, to;  ///< of the edge
    double lo, hi;    ///< of what of it is in the cap; lo > hi if nothing is
    Vec2 place(double t) const { return distance * outward + t * along; }
  };
  template <class Visit>
  void for_each_side(Visit visit) const {
    Vec2 p = corners_.corner(corners_.count() - 1);
    for (int i = 0; i < corners_.count(); ++i) {
      const Vec2 q = corners_.corner(i), edge = q - p;
      const double length = edge.norm();
      if (length > 0) {
        Side s;
        s.along = edge / length;
        s.outward = Vec2(s.along.y(), -s.along.x());
        s.distance = s.outward.dot(p);
        s.from = s.along.dot(p);
        s.to = s.from + length;
        const double squared = (radius_ - s.distance) * (radius_ + s.distance);
        const double half = squared >= 0 ? std::sqrt(squared) : -1;
        s.lo = half < 0 ? 1 : std::max(s.from, -half);
        s.hi = half < 0 ? -1 : std::min(s.to, half);
        visit(s);
      }
      p = q;
    }
  }
  /// The fixed directions: two beside each side's normal, of up to four sides; of up to eight those
  /// halfway between two normals; of more eight all around.
  int directions(std::array<Vec2, max_points>& ways) const {
    int count = 0, sides = 0;
    const bool few = corners_.count() <= 4, some = corners_.count() <= max_points;
    Vec2 first = Vec2::Zero(), before = first;
    const auto add = [&](const Vec2& x) {
      if (count < max_points) ways[count++] = x.normalized();
    };
    const auto add_between = [&](const Vec2& x, const Vec2& y) {
      constexpr double nearer = 3;
      if (few) {
        add(nearer * x + y);
        add(x + nearer * y);
      } else if (some) {
        add(x + y);
      }
    };
    for_each_side([&](const Side& s) {
      if (sides++ == 0)
        first = s.outward;
      else
        add_between(before, s.outward);
      before = s.outward;
    });
    add_between(before, first);
    if (!some) {
      // The golden section of 45°, so that of a regular polygon none is across a side, of which
      // rounding would say which end is the farther one.
      constexpr double cosine = 0.9553378474102883, sine = 0.29551581566047647;
      constexpr double diagonal = 0.7071067811865476;
      Vec2 way = cosine * first + sine * turned_left(first);
      for (int i = 0; i < max_points; ++i) {
        add(way);
        way = diagonal * (way + turned_left(way));
      }
    }
    return count;
  }

  double radius_;
  const Corners& corners_;
  double inner_;  ///< radius of the circle about the middle that is in cap and polygon
  double max_cut_ = 0;
  double half_turn_ = 0.5;  ///< half the sine by which the polygon turns least at a corner
  bool is_cut_ = false, is_centre_inside_ = true;
};

}  // namespace touchstone
