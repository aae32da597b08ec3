#include "oracle/patch/contact_patch.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <stdexcept>

#include "oracle/patch/convex_set.hpp"
#include "oracle/patch/feature_overlap.hpp"
#include "oracle/patch/support_feature.hpp"
#include "oracle/rounding.hpp"

namespace touchstone::oracle {
namespace {

// Support of a body about its position along the unit vector n of its own frame; for a plane the
// height of its surface, whatever n is (Ericson, "Real-Time Collision Detection", 4.3 and 9.5).
double reach(const Cylinder& s, const Vec3& n) {
  return s.half_length() * std::abs(n.z()) + s.radius() * std::hypot(n.x(), n.y());
}
double reach(const Capsule& s, const Vec3& n) {
  return s.half_length() * std::abs(n.z()) + s.radius();
}
double reach(const Sphere& s, const Vec3&) { return s.radius(); }
double reach(const Box& s, const Vec3& n) { return s.half_extents().dot(n.cwiseAbs()); }
double reach(const Convex&, const Vec3&) { throw std::logic_error("convex: later stage"); }
double reach(const Plane& s, const Vec3&) { return s.unit_displacement(); }

double reach(const Shape& shape, const Pose& pose, const Vec3& n) {
  const Vec3 local = pose.rotation().transpose() * n;
  return std::visit([&](const auto& s) { return reach(s, local); }, shape);
}

/// The plane across the unit vector n, halfway between the two support planes. Its origin is the
/// projection of `through` along n; its first direction is nearest to `e1` (of any length).
ContactPatch::Plane patch_plane(const Configuration& c, const Vec3& n, const Vec3& through,
                                const Vec3& e1) {
  const double height_a = (c.pose_a.position() - through).dot(n) - reach(c.a, c.pose_a, -n);
  const double height_b = (c.pose_b.position() - through).dot(n) + reach(c.b, c.pose_b, n);
  const Vec3 unit = e1.normalized();
  const Vec3 across = (unit - unit.dot(n) * n).normalized();
  return {through + (height_a + height_b) / 2 * n, across, n.cross(across)};
}

using Kind = SupportFeature::Kind;

/// An overlap, and the world frame of its coordinates.
struct Placement {
  ConvexSet shape;
  Vec3 origin;
  Vec3 e1;  ///< perpendicular to the normal up to rounding
};

Placement at_point(const Vec3& p, const Vec3& n) {
  return {ConvexSet::point(Vec2::Zero()), p, n.unitOrthogonal()};
}

/// Coordinate of `w` along an axis of length `norm`.
mpq_class along(const RationalVector& w, const RationalVector& axis, const mpq_class& norm) {
  return dot(w, axis) / norm;
}

Placement discs(const SupportFeature& first, const SupportFeature& second, const Vec3& n) {
  const RationalVector w = second.centre - first.centre;
  const RationalVector across = w - dot(w, first.u) / (first.norm * first.norm) * first.u;
  const Vec3 direction = rounded(across);
  return {overlap_of_discs(first.radius, second.radius, dot(across, across)), rounded(first.centre),
          direction.isZero(0) ? n.unitOrthogonal() : direction};
}

Placement disc_and_rectangle(const SupportFeature& disc, const SupportFeature& face,
                             const Vec3& n) {
  const RationalVector w = disc.centre - face.centre;
  const Vec3 e1 = rounded(face.u);
  const int handed = n.cross(e1).dot(rounded(face.v)) < 0 ? -1 : 1;
  return {overlap_of_disc_and_rectangle(along(w, face.u, face.norm),
                                        handed * along(w, face.v, face.norm), disc.radius,
                                        face.half_u, face.half_v),
          rounded(face.centre), e1};
}

Placement segment_and_disc(const SupportFeature& segment, const SupportFeature& disc) {
  const RationalVector w = disc.centre - segment.centre;
  const mpq_class x = along(w, segment.u, segment.norm), z = along(w, disc.u, disc.norm);
  return {overlap_of_disc_and_segment(x, dot(w, w) - x * x - z * z, disc.radius, segment.half_u),
          rounded(segment.centre), rounded(segment.u)};
}

Placement segment_and_rectangle(const SupportFeature& segment, const SupportFeature& face,
                                const Vec3& n) {
  const RationalVector w = segment.centre - face.centre;
  const Vec3 e1 = rounded(face.u);
  const int handed = n.cross(e1).dot(rounded(face.v)) < 0 ? -1 : 1;
  const mpq_class norms = segment.norm * face.norm;
  return {overlap_of_segment_and_rectangle(
              along(w, face.u, face.norm), handed * along(w, face.v, face.norm),
              along(segment.u, face.u, norms), handed * along(segment.u, face.v, norms),
              segment.half_u, face.half_u, face.half_v),
          rounded(face.centre), e1};
}

/// The point where two segments that are not parallel cross, seen along their common perpendicular;
/// none if they miss each other.
std::optional<Placement> crossing(const SupportFeature& first, const SupportFeature& second,
                                  const RationalVector& perpendicular, const Vec3& n) {
  const RationalVector w = second.centre - first.centre;
  const mpq_class square = dot(perpendicular, perpendicular);
  const mpq_class s = dot(cross(w, second.u), perpendicular) / square;
  const mpq_class t = dot(cross(w, first.u), perpendicular) / square;
  if (abs(s) * first.norm > first.half_u || abs(t) * second.norm > second.half_u) {
    return std::nullopt;
  }
  return at_point(rounded(first.centre + s * first.u), n);
}

std::optional<Placement> segments(const SupportFeature& first, const SupportFeature& second,
                                  const Vec3& n) {
  const RationalVector perpendicular = cross(first.u, second.u);
  if (dot(perpendicular, perpendicular) != 0) return crossing(first, second, perpendicular, n);
  const RationalVector w = second.centre - first.centre;
  return Placement{overlap_of_segments(first.half_u, along(w, first.u, first.norm), second.half_u),
                   rounded(first.centre), rounded(first.u)};
}

std::optional<Placement> alone(const SupportFeature& f, const Vec3& n) {
  if (f.kind == Kind::disc) return discs(f, f, n);
  return segments(f, f, n);
}

std::optional<Placement> overlap(const SupportFeature& a, const SupportFeature& b, const Vec3& n) {
  if (a.kind == Kind::point && b.kind == Kind::point) return at_point((a.point + b.point) / 2, n);
  if (a.kind == Kind::point) return at_point(a.point, n);
  if (b.kind == Kind::point) return at_point(b.point, n);
  if (b.kind == Kind::plane) return alone(a, n);
  if (a.kind == Kind::segment) {
    if (b.kind == Kind::segment) return segments(a, b, n);
    return b.kind == Kind::disc ? segment_and_disc(a, b) : segment_and_rectangle(a, b, n);
  }
  if (b.kind == Kind::segment) return segment_and_disc(b, a);
  return b.kind == Kind::disc ? discs(a, b, n) : disc_and_rectangle(a, b, n);
}

/// Distance of a point from a feature, seen along n, in double.
double distance_beside(const SupportFeature& f, const Vec3& p, const Vec3& n) {
  if (f.kind == Kind::plane) return 0;
  const Vec3 w = p - (f.kind == Kind::point ? f.point : rounded(f.centre));
  const Vec3 across = w - w.dot(n) * n;
  if (f.kind == Kind::point) return across.norm();
  if (f.kind == Kind::disc) return std::max(0.0, across.norm() - f.radius.get_d());
  const auto without = [&](const Vec3& v, const RationalVector& axis, const mpq_class& half) {
    const Vec3 unit = rounded(axis) / f.norm.get_d();
    const double limit = half.get_d();
    return Vec3(v - std::clamp(v.dot(unit), -limit, limit) * unit);
  };
  const Vec3 beside_u = without(across, f.u, f.half_u);
  return (f.kind == Kind::segment ? beside_u : without(beside_u, f.v, f.half_v)).norm();
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
  return {with_sizes(c.a), moved(c.pose_a),
          plane ? Plane(plane->unit_normal(), length(plane->unit_displacement())) : with_sizes(c.b),
          moved(c.pose_b)};
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
  const Configuration c = rounded_configuration(configuration).configuration;
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
    return convex_hull(seen);
  };
  const std::vector<Vec2> part_a = seen_along_n(c.a, c.pose_a, -n);
  if (std::holds_alternative<Plane>(c.b)) return {plane, ConvexSet::polygon(part_a)};
  const std::vector<Vec2> part_b = seen_along_n(c.b, c.pose_b, n);
  const std::vector<Vec2> common = intersection(part_a, part_b);
  if (common.empty()) return {plane, ConvexSet::point(halfway(part_a, part_b))};
  return {plane, ConvexSet::polygon(common)};
}

}  // namespace touchstone::oracle
