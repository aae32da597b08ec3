#include "manifold.hpp"

#include <cmath>
#include <tuple>
#include <utility>

#include "contact_plane.hpp"

namespace touchstone {
namespace {

using Kind = FacingFeature::Kind;

bool is_flat(const FacingFeature& f) { return f.kind == Kind::disc || f.kind == Kind::rectangle; }

/// Two unit vectors that make a right-handed frame with the unit normal (Duff et al., "Building an
/// orthonormal basis, revisited", 2017).
std::pair<Vec3, Vec3> across(const Vec3& n) {
  const double sign = std::copysign(1.0, n.z());
  const double a = -1 / (sign + n.z());
  const double b = n.x() * n.y() * a;
  return {Vec3(1 + sign * n.x() * n.x() * a, sign * b, -sign * n.x()),
          Vec3(b, sign + n.y() * n.y() * a, -n.y())};
}

}  // namespace

ContactPlane::ContactPlane(Contact& contact, const Vec3& origin, const Margins& margins,
                           const Vec3& upright)
    : contact_(contact), n_(contact.normal), origin_(origin), margins_(margins) {
  std::tie(x_, y_) = across(points_onward(upright) ? upright : Vec3(-upright));
  lift_ = upright / upright.dot(n_);
  dual_x_ = x_ - x_.dot(n_) * lift_;
  dual_y_ = y_ - y_.dot(n_) * lift_;
}

void add_manifold(Contact& contact, const FacingFeature& a, const FacingFeature& b,
                  const Vec3& origin, const Margins& margins) {
  const bool a_is_point = a.kind == Kind::point, b_is_point = b.kind == Kind::point;
  if (a_is_point || b_is_point) {
    // Of two points, the one that the normal's rounding moves less.
    const bool take_a = a_is_point && (!b_is_point || a.sine >= b.sine);
    const Vec3 half = contact.signed_distance / 2 * contact.normal;
    contact.add_point(origin + (take_a ? Vec3(a.middle - half) : Vec3(b.middle + half)),
                      -contact.signed_distance);
    return;
  }
  if (!is_flat(a) && !is_flat(b) && add_crossing(contact, a, b, origin)) return;
  const auto plane = [&](const Vec3& upright) {
    return ContactPlane(contact, origin, margins, upright);
  };
  if (!is_flat(a)) {
    return is_flat(b) ? plane(b.axis).line_on_flat(a, b, true)
                      : plane(contact.normal).line_on_line(a, b);
  }
  if (!is_flat(b)) return plane(a.axis).line_on_flat(b, a, false);
  if (b.kind == Kind::rectangle) return plane(a.axis).cap_on_face(a, b);
  const bool a_is_first =
      a.radius != b.radius ? a.radius < b.radius : points_onward(contact.normal);
  a_is_first ? plane(a.axis).cap_on_cap(a, b, true) : plane(b.axis).cap_on_cap(b, a, false);
}

}  // namespace touchstone
