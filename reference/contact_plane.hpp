#pragma once

#include <cmath>

#include "arc_polygon.hpp"
#include "contact.hpp"
#include "facing_feature.hpp"

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

/// The plane across the normal of a contact, to which it adds the points where two features face
/// each other (manifold.hpp).
class ContactPlane {
 public:
  ContactPlane(Contact& contact, const Vec3& origin, double slack);

  // In flat_contact.cpp, cap_on_face.cpp, cap_on_cap.cpp and line_contact.cpp.
  void flat_on_flat(const FacingFeature& a, const FacingFeature& b);
  void line_on_flat(const FacingFeature& line, const FacingFeature& flat, bool line_is_a);
  void line_on_line(const FacingFeature& a, const FacingFeature& b);

 private:
  Vec2 to_plane(const Vec3& v) const { return {v.dot(x_), v.dot(y_)}; }
  Incline incline(const FacingFeature& f) const {
    const double inverse = 1 / f.axis.dot(n_);
    return {f.axis.dot(f.middle) * inverse, to_plane(f.axis) * -inverse};
  }
  Line line(const FacingFeature& f) const {
    return {to_plane(f.middle), to_plane(f.axis), f.middle.dot(n_),
            f.axis.dot(n_),     f.half_length,    f.radius};
  }
  /// A leaning disc is seen as an ellipse; the circle within it keeps its points on the body.
  Circle circle(const FacingFeature& f) const {
    return {to_plane(f.middle), f.radius * std::abs(f.axis.dot(n_))};
  }
  void add(const Vec2& p, double height_a, double height_b) {
    contact_.add_point(origin_ + p.x() * x_ + p.y() * y_ + (height_a + height_b) / 2 * n_,
                       height_b - height_a);
  }
  void add(const Vec2& p, const Surfaces& s) { add(p, s.a.at(p), s.b.at(p)); }

  void cap_on_face(const FacingFeature& cap, const FacingFeature& face, const Surfaces& s);
  void cap_on_cap(const FacingFeature& a, const FacingFeature& b, const Surfaces& s);
  /// Points of a whole disc, at rest the first along `anchor` (disc_layout.hpp).
  void add_disc(const Circle& disc, const Vec2& anchor, const Surfaces& s);
  /// Of a region over which the clearance has a slope, points of the part that does not rise above
  /// the slack, the deepest among them. False where none of it does.
  bool add_leaning(ArcPolygon region, const Surfaces& s);
  /// A layout of so many points, and the deepest point, that part of the way from their middle.
  void add_layout(std::array<Vec2, 8>& layout, int count, double part, const Vec2& deepest,
                  const Surfaces& s);

  Contact& contact_;
  const Vec3 n_;
  const Vec3 origin_;
  const double slack_;
  Vec3 x_, y_;  ///< the same whichever body comes first
};

}  // namespace touchstone
