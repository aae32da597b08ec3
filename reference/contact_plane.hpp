#pragma once

#include <cmath>

#include "arc_polygon.hpp"
#include "contact.hpp"
#include "facing_feature.hpp"
#include "margins.hpp"

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

/// The points of a plane with |across·p − middle| <= half_width: what lies between two opposite
/// edges of a face.
struct Strip {
  Vec2 across;
  double middle, half_width;
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

/// Adds the point at which two lines cross, or come nearest to each other within both; it needs no
/// frame. False for lines that run side by side, of which the plane knows more. In
/// line_contact.cpp.
bool add_crossing(Contact& contact, const FacingFeature& a, const FacingFeature& b,
                  const Vec3& origin);

/// A plane to which two features that face each other are carried along the contact's normal, and
/// which adds the points where they do (manifold.hpp). It need not be across the normal: in a cap's
/// own plane the cap is a circle, however it leans.
class ContactPlane {
 public:
  /// `upright` is across the plane, of unit length, and not far from the normal or its opposite.
  ContactPlane(Contact& contact, const Vec3& origin, const Margins& margins, const Vec3& upright);

  // In cap_on_face.cpp, cap_on_cap.cpp and line_contact.cpp. The plane is that of the face or cap
  // which a line lies on, of the cap that lies on a face, or of the first of two caps.
  void cap_on_face(const FacingFeature& cap, const FacingFeature& face);
  void cap_on_cap(const FacingFeature& first, const FacingFeature& second, bool first_is_a);
  void line_on_flat(const FacingFeature& line, const FacingFeature& flat, bool line_is_a);
  void line_on_line(const FacingFeature& a, const FacingFeature& b);

 private:
  /// Along the normal, from the plane through the frame's origin.
  double height(const Vec3& v) const { return v.dot(lift_); }
  Vec2 to_plane(const Vec3& v) const { return {v.dot(dual_x_), v.dot(dual_y_)}; }
  /// A vector's products with the plane's own two.
  Vec2 products(const Vec3& v) const { return {v.dot(x_), v.dot(y_)}; }

  Incline incline(const FacingFeature& f) const {
    const double inverse = 1 / f.axis.dot(n_);
    return {f.axis.dot(f.middle) * inverse, products(f.axis) * -inverse};
  }
  Line line(const FacingFeature& f) const {
    return {to_plane(f.middle), to_plane(f.axis), height(f.middle),
            height(f.axis),     f.half_length,    f.radius};
  }
  /// The face's own coordinate along its side i, of what is carried to it along the normal.
  Strip strip(const FacingFeature& face, int i) const {
    const Vec3 e = face.side[i] - face.side[i].dot(n_) / face.axis.dot(n_) * face.axis;
    return {products(e), e.dot(face.middle), face.half_side[i]};
  }
  void add(const Vec2& p, double height_a, double height_b) {
    contact_.add_point(origin_ + p.x() * x_ + p.y() * y_ + (height_a + height_b) / 2 * n_,
                       height_b - height_a);
  }
  void add(const Vec2& p, const Surfaces& s) { add(p, s.a.at(p), s.b.at(p)); }

  /// How much of the slack is left above a clearance that should be the least one.
  double room_above(double clearance) const {
    return margins_.slack - (clearance - contact_.signed_distance);
  }
  /// Is so little of a rise within the room that its points would hardly differ?
  static bool is_one_point(double room, double rise) {
    constexpr double alike = 1e-6;
    return room < alike * rise;
  }
  /// Points of a whole disc, at rest the first along `anchor` (disc_layout.hpp).
  void add_disc(const Circle& disc, const Vec2& anchor, const Surfaces& s);
  /// Of a region over which the clearance has a slope, points of the part that does not rise above
  /// the slack, the deepest among them. False, and no points, where all of it is within.
  bool add_leaning(ArcPolygon region, const Surfaces& s);
  /// A layout of so many points, and the deepest point, that part of the way from their middle.
  void add_layout(std::array<Vec2, 8>& layout, int count, double part, const Vec2& deepest,
                  const Surfaces& s);

  Contact& contact_;
  const Vec3 n_;
  const Vec3 origin_;
  const Margins& margins_;
  Vec3 x_, y_;                   ///< unit, in the plane; the same whichever body comes first
  Vec3 lift_, dual_x_, dual_y_;  ///< the dual basis of n_, x_ and y_
};

}  // namespace touchstone
