#include "oracle/patch/contact_patch.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "oracle/body.hpp"
#include "oracle/patch/convex_set.hpp"
#include "oracle/patch/feature_overlap.hpp"
#include "oracle/patch/support_feature.hpp"
#include "oracle/rounding.hpp"

namespace touchstone::oracle {
namespace {

/// Support of a body about its position along the unit vector n; for a plane the height of its
/// surface, whatever n is.
double reach(const Shape& shape, const Pose& pose, const Vec3& n) {
  if (const auto* const plane = std::get_if<Plane>(&shape)) return plane->unit_displacement();
  const Body body(shape);
  return body.core_reach(pose.rotation().transpose() * n) + body.ball_radius;
}

/// The plane across the unit vector n, halfway between the two support planes. Its origin is the
/// projection of `through` along n; its first direction is nearest to `e1` (of any length).
ContactPatch::Plane patch_plane(const Configuration& c, const Vec3& n, const Vec3& through,
                                const Vec3& e1) {
  const double height_a = (c.pose_a.position() - through).dot(n) - reach(c.a, c.pose_a, -n);
  const double height_b = (c.pose_b.position() - through).dot(n) + reach(c.b, c.pose_b, n);
  const Vec3 unit = e1.stableNormalized();
  const Vec3 across = (unit - unit.dot(n) * n).normalized();
  return {through + (height_a + height_b) / 2 * n, across, n.cross(across)};
}

using Kind = SupportFeature::Kind;

/// Distance of a point from a feature, seen along n, in double.
double distance_beside(const SupportFeature& f, const Vec3& p, const Vec3& n) {
  const Vec3 e1 = n.unitOrthogonal(), e2 = n.cross(e1);
  const auto seen = [&](const Vec3& v) { return Vec2((v - p).dot(e1), (v - p).dot(e2)); };
  switch (f.kind) {
    case Kind::plane:
      return 0;
    case Kind::point:
      return seen(f.point).norm();
    case Kind::disc:
      return std::max(0.0, seen(rounded(f.centre)).norm() - f.radius.get_d());
    case Kind::segment:
      return ConvexSet::segment(seen(rounded(f.centre - f.u)), seen(rounded(f.centre + f.u)))
          .distance(Vec2::Zero());
    case Kind::polygon:
      break;
  }
  std::vector<Vec2> corners;
  for (const RationalVector& corner : f.corners) corners.push_back(seen(rounded(corner)));
  return ConvexSet::polygon(corners).distance(Vec2::Zero());
}

/// Are the point features certain, and do they lie on the other feature?
bool points_are_right(const SupportFeatures& features, const Vec3& n, double tolerance) {
  const auto& [a, b] = features;
  if (!a.point_is_certain || !b.point_is_certain) return false;
  if (a.kind == Kind::point) return distance_beside(b, a.point, n) <= tolerance;
  return b.kind != Kind::point || distance_beside(a, b.point, n) <= tolerance;
}

// Squares of lengths near either end of the doubles overflow or vanish. They are brought into range
// by a power of two, which rounds nothing, and the patch back.

/// The exponent of the largest length where squares would leave the range; otherwise 0.
int exponent_out_of_range(const Configuration& c) {
  const auto* const plane = std::get_if<Plane>(&c.b);
  const double largest = std::max({larger_size(c), c.pose_a.position().cwiseAbs().maxCoeff(),
                                   c.pose_b.position().cwiseAbs().maxCoeff(),
                                   plane ? std::abs(plane->unit_displacement()) : 0});
  constexpr int in_range = 300;
  const int exponent = std::ilogb(largest);
  return std::abs(exponent) <= in_range ? 0 : exponent;
}

/// As in rounding.hpp, but for a hull: normals name the vertices as given.
Configuration rounded(const Configuration& c) {
  if (!std::holds_alternative<Convex>(c.b)) return rounded_configuration(c).configuration;
  const double size = std::max(largest_half_extent(c.b), std::numeric_limits<double>::denorm_min());
  Configuration result =
      rounded_configuration({c.a, c.pose_a, Cylinder(size, size), c.pose_b}).configuration;
  result.b = c.b;
  return result;
}

/// Times a power of two.
Configuration scaled(const Configuration& c, int exponent) {
  const auto length = [&](double x) { return std::scalbn(x, exponent); };
  // What vanishes against the largest length has the least size that there is.
  const Resized with_sizes{
      [&](double x) { return std::max(length(x), std::numeric_limits<double>::min()); }};
  const auto moved = [&](const Pose& pose) {
    return Pose(pose.position().unaryExpr(length), pose.orientation());
  };
  const auto* const plane = std::get_if<Plane>(&c.b);
  const auto* const hull = std::get_if<Convex>(&c.b);
  const Shape b = plane  ? Plane(plane->unit_normal(), length(plane->unit_displacement()))
                  : hull ? hull->scaled(exponent)
                         : with_sizes(c.b);
  return {with_sizes(c.a), moved(c.pose_a), b, moved(c.pose_b)};
}

}  // namespace

ContactPatch ContactPatch::scaled(int exponent) const {
  Plane plane = plane_;
  plane.origin = plane.origin.unaryExpr([&](double x) { return std::scalbn(x, exponent); });
  return {plane, shape_.scaled(exponent)};
}

double ContactPatch::extent(const Vec3& direction) const {
  const Vec2 d(direction.dot(plane_.e1), direction.dot(plane_.e2));
  return shape_.support(d) + shape_.support(-d);
}

Vec2 ContactPatch::in_plane(const Vec3& point) const {
  const Vec3 p = point - plane_.origin;
  return {p.dot(plane_.e1), p.dot(plane_.e2)};
}

std::vector<Vec3> ContactPatch::outline(int per_quarter) const {
  std::vector<Vec3> points;
  for (const Vec2& p : shape_.outline(per_quarter)) points.push_back(in_world(p));
  return points;
}

ContactPatch contact_patch(const Configuration& configuration, const OptimalNormal& normal) {
  const Configuration c = rounded(configuration);
  if (const int exponent = exponent_out_of_range(c)) {
    return contact_patch(scaled(c, -exponent), normal).scaled(exponent);
  }
  const SupportFeatures features = support_features(c, normal);
  const double lengths = larger_size(c) + (c.pose_a.position() - c.pose_b.position()).norm();
  constexpr double beside = 1e-9;     // farther away, rounding has decided where the point is
  constexpr double rounding = 1e-15;  // of the support planes
  if (points_are_right(features, normal.n, beside * lengths)) {
    if (auto found = overlap(features.a, features.b, normal.n)) {
      return {patch_plane(c, normal.n, found->origin, found->e1), std::move(found->shape)};
    }
  }
  const Vec3 middle = contact_patch(c, normal.n, rounding * lengths).centroid();
  return {patch_plane(c, normal.n, middle, normal.n.unitOrthogonal()),
          ConvexSet::point(Vec2::Zero())};
}

ContactPatch contact_patch(const Configuration& c, const Vec3& n, double epsilon) {
  if (const int exponent = exponent_out_of_range(c)) {
    return contact_patch(scaled(c, -exponent), n, std::scalbn(epsilon, -exponent)).scaled(exponent);
  }
  // Relative to a body, so that the distance from the world's origin costs no digits.
  const Vec3 origin = c.pose_a.position();
  const ContactPatch::Plane plane = patch_plane(c, n, origin, n.unitOrthogonal());
  const auto seen_along_n = [&](const Shape& shape, const Pose& pose, const Vec3& outward) {
    std::vector<Vec2> seen;
    for (const Vec3& p : support_part(shape, pose, outward, epsilon, origin)) {
      seen.emplace_back(p.dot(plane.e1), p.dot(plane.e2));
    }
    return plane_hull(seen);
  };
  const std::vector<Vec2> part_a = seen_along_n(c.a, c.pose_a, -n);
  if (std::holds_alternative<Plane>(c.b)) return {plane, ConvexSet::polygon(part_a)};
  const std::vector<Vec2> part_b = seen_along_n(c.b, c.pose_b, n);
  const std::vector<Vec2> common = intersection(part_a, part_b);
  if (common.empty()) return {plane, ConvexSet::point(halfway(part_a, part_b))};
  return {plane, ConvexSet::polygon(common)};
}

}  // namespace touchstone::oracle
