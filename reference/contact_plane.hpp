#pragma once

#include <array>
#include <cmath>
#include <tuple>
#include <utility>

#include "contact.hpp"
#include "curves.hpp"
#include "facing_feature.hpp"
#include "manifold.hpp"

namespace touchstone {

/// z = height + slope·p over the contact plane.
struct Incline {
  double height;
  Vec2 slope;
  double at(const Vec2& p) const { return height + slope.dot(p); }
};

/// Two surfaces that face each other.
struct Surfaces {
  Incline a, b;
  Vec2 slope() const { return a.slope - b.slope; }  ///< of the clearance
  double clearance(const Vec2& p) const { return a.at(p) - b.at(p); }
};

/// p(t) = middle + t along, z(t) = height + t rise, |t| <= half_length.
struct Line {
  Vec2 middle, along;
  double height, rise, half_length, radius;
  Vec2 at(double t) const { return middle + t * along; }
};

/// Does a normal point onward along an arbitrary direction, perpendicular to no axis of the world?
/// Where one of two like bodies has to be chosen, neither their order nor a hair's motion may
/// change which it is.
inline bool points_onward(const Vec3& n) { return 0.27 * n.x() + 0.53 * n.y() + 0.8 * n.z() > 0; }

// Component by component: Eigen would load in pairs what was just stored singly, which stalls.
inline double dot(const Vec3& a, const Vec3& b) {
  return a.x() * b.x() + a.y() * b.y() + a.z() * b.z();
}
/// (a × b)·c
inline double triple(const Vec3& a, const Vec3& b, const Vec3& c) {
  return (a.y() * b.z() - a.z() * b.y()) * c.x() + (a.z() * b.x() - a.x() * b.z()) * c.y() +
         (a.x() * b.y() - a.y() * b.x()) * c.z();
}
/// The sine of the angle between two unit vectors.
inline double sine_between(const Vec3& a, const Vec3& b) {
  const double x = a.y() * b.z() - a.z() * b.y(), y = a.z() * b.x() - a.x() * b.z();
  const double z = a.x() * b.y() - a.y() * b.x();
  return std::sqrt(x * x + y * y + z * z);
}
/// a − k b
inline Vec3 less(const Vec3& a, double k, const Vec3& b) {
  return {a.x() - k * b.x(), a.y() - k * b.y(), a.z() - k * b.z()};
}

/// Two unit vectors that make a right-handed frame with the unit normal (Duff et al., "Building an
/// orthonormal basis, revisited", 2017).
inline std::pair<Vec3, Vec3> across(const Vec3& n) {
  const double sign = std::copysign(1.0, n.z());
  const double a = -1 / (sign + n.z());
  const double b = n.x() * n.y() * a;
  return {Vec3(1 + sign * n.x() * n.x() * a, sign * b, -sign * n.x()),
          Vec3(b, sign + n.y() * n.y() * a, -n.y())};
}

/// A contact whose normal and signed distance are set, and to which points are added.
struct Manifold {
  Contact& contact;
  const Vec3& origin;  ///< where the features' frame lies in the world
  const Margins& margins;
};

// Each adds the points where two features face each other (manifold.cpp); in line_contact.cpp and
// flat_contact.cpp.

/// Adds the point at which two segments cross, or come nearest to each other within both. False,
/// and no point, for segments that run side by side.
bool segments_crossing(const Manifold& to, const FacingFeature& a, const FacingFeature& b);
/// Both are across the normal but for the slack, and run side by side.
void segment_on_segment(const Manifold& to, const FacingFeature& a, const FacingFeature& b);
void segment_on_flat(const Manifold& to, const FacingFeature& segment, const FacingFeature& flat,
                     bool segment_is_a);
void disc_on_rectangle(const Manifold& to, const FacingFeature& disc,
                       const FacingFeature& rectangle);
void disc_on_polygon(const Manifold& to, const FacingFeature& disc, const FacingFeature& polygon);
void disc_on_disc(const Manifold& to, const FacingFeature& first, const FacingFeature& second,
                  bool first_is_a);

/// A plane to which features that face each other are carried along the contact's normal. It need
/// not be across the normal: in a cap's own plane the cap is a circle, however it leans.
class ContactPlane {
 public:
  /// Across the contact's normal.
  explicit ContactPlane(const Manifold& to) : to_(to), n_(to.contact.normal), lift_(n_) {
    std::tie(x_, y_) = across(points_onward(n_) ? n_ : Vec3(-n_));
    dual_x_ = x_;
    dual_y_ = y_;
  }
  /// Across `upright`, which has unit length and is not far from the normal or its opposite.
  ContactPlane(const Manifold& to, const Vec3& upright)
      : to_(to), n_(to.contact.normal), lift_(upright / dot(upright, n_)) {
    std::tie(x_, y_) = across(points_onward(upright) ? upright : Vec3(-upright));
    dual_x_ = less(x_, dot(x_, n_), lift_);
    dual_y_ = less(y_, dot(y_, n_), lift_);
  }

  const Margins& margins() const { return to_.margins; }
  Vec2 to_plane(const Vec3& v) const { return {dot(v, dual_x_), dot(v, dual_y_)}; }
  Incline incline(const FacingFeature& f) const { return incline(f, 1 / dot(f.axis, n_)); }
  Line line(const FacingFeature& f) const {
    return {to_plane(f.middle), to_plane(f.axis), dot(f.middle, lift_),
            dot(f.axis, lift_), f.half_length,    f.radius};
  }
  /// A rectangle's own surface, and its coordinates along its sides of what is carried to it along
  /// the normal.
  struct Face {
    Incline surface;
    std::array<Strip, 2> strips;
  };
  Face face(const FacingFeature& f) const {
    const double inverse = 1 / dot(f.axis, n_);
    const auto strip = [&](int i) -> Strip {
      const Vec3 e = less(f.side[i], dot(f.side[i], n_) * inverse, f.axis);
      return {products(e), dot(e, f.middle), f.half_side[i]};
    };
    return {incline(f, inverse), {strip(0), strip(1)}};
  }
  /// Does what runs counterclockwise as seen against `axis` do so in the plane's coordinates?
  bool keeps_turn(const Vec3& axis) const { return triple(x_, y_, axis) > 0; }
  /// The least factor by which a disc across `axis` shrinks when it is carried to the plane across
  /// `upright`, or somewhat less: a vector v of the disc is carried to v − v·upright / n·upright n,
  /// whose square is at least 1 − 2 |v·upright| |v·n| / |n·upright|. All three directions enclose
  /// small angles (`facing_part`).
  double min_scale(const Vec3& axis, const Vec3& upright) const {
    return std::sqrt(1 - 2 * sine_between(axis, upright) * sine_between(axis, n_) /
                             std::abs(dot(upright, n_)));
  }

  /// Adds the point halfway between the surfaces at these heights above a point of the plane.
  void add(const Vec2& p, double height_a, double height_b) const {
    to_.contact.add_point(to_.origin + p.x() * x_ + p.y() * y_ + (height_a + height_b) / 2 * n_,
                          height_b - height_a);
  }
  void add(const Vec2& p, const Surfaces& s) const { add(p, s.a.at(p), s.b.at(p)); }

  /// How much of the slack is left above a clearance that should be the least one, where so large a
  /// part of a cap faces the other body; at least 0. What of a cap lies within it is as wide as its
  /// root.
  double room_above(double clearance, double part) const {
    return std::max(part * part * (to_.margins.slack - (clearance - to_.contact.signed_distance)),
                    0.0);
  }

 private:
  Incline incline(const FacingFeature& f, double inverse_cosine) const {
    return {dot(f.axis, f.middle) * inverse_cosine,
            {dot(f.axis, x_) * -inverse_cosine, dot(f.axis, y_) * -inverse_cosine}};
  }
  /// A vector's products with the plane's own two.
  Vec2 products(const Vec3& v) const { return {dot(v, x_), dot(v, y_)}; }

  const Manifold& to_;
  const Vec3 n_;
  Vec3 x_, y_;                   ///< unit, in the plane; the same whichever body comes first
  Vec3 lift_, dual_x_, dual_y_;  ///< the dual basis of n_, x_ and y_
};

/// The corners of a polygon, carried to the plane, counterclockwise as arms from a place.
class CarriedCorners {
 public:
  CarriedCorners(const ContactPlane& plane, const FacingFeature& polygon, const Vec2& from)
      : plane_(plane),
        polygon_(polygon),
        from_(from),
        keeps_turn_(plane.keeps_turn(polygon.axis)) {}
  int count() const { return polygon_.corner_count(); }
  Vec2 corner(int i) const {
    return plane_.to_plane(polygon_.corner(keeps_turn_ ? i : count() - 1 - i)) - from_;
  }

 private:
  const ContactPlane& plane_;
  const FacingFeature& polygon_;
  Vec2 from_;
  bool keeps_turn_;
};

/// Is so little of a rise within the room that its points would hardly differ?
inline bool is_one_point(double room, double rise) {
  constexpr double alike = 1e-6;
  return room < alike * rise;
}

}  // namespace touchstone
