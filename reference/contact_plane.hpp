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

/// p(t) = middle + t along, z(t) = height + t rise, |t| <= half_length.
struct Line {
  Vec2 middle, along;
  double height, rise, half_length, radius;
  Vec2 at(double t) const { return middle + t * along; }
};

/// The plane across the normal of a contact, to which it adds the points where two features face
/// each other (manifold.hpp).
class ContactPlane {
 public:
  ContactPlane(Contact& contact, const Vec3& origin, double slack);

  // In flat_contact.cpp and line_contact.cpp.
  void flat_on_flat(const FacingFeature& a, const FacingFeature& b);
  void line_on_flat(const FacingFeature& line, const FacingFeature& flat, bool line_is_a);
  void line_on_line(const FacingFeature& a, const FacingFeature& b);

 private:
  Vec2 to_plane(const Vec3& v) const { return {v.dot(x_), v.dot(y_)}; }
  Incline incline(const FacingFeature& f) const {
    const double up = f.axis.dot(n_);
    return {f.axis.dot(f.middle) / up, to_plane(f.axis) / -up};
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
  bool add_whole_disc(const Circle& disc, const Vec2& aside, const Incline& a, const Incline& b);
  void add_spread(ArcPolygon region, const Vec2& aside, const Incline& a, const Incline& b);

  Contact& contact_;
  const Vec3 n_;
  const Vec3 origin_;
  const double slack_;
  Vec3 x_, y_;
};

}  // namespace touchstone
