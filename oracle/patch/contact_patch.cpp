#include "oracle/patch/contact_patch.hpp"

#include <algorithm>
#include <optional>

#include "oracle/patch/feature_overlap.hpp"
#include "oracle/patch/patch_plane.hpp"
#include "oracle/patch/support_feature.hpp"
#include "oracle/resolved.hpp"

namespace touchstone::oracle {
namespace {

using Kind = SupportFeature::Kind;

/// An overlap, and where its coordinates lie in the world.
struct Placement {
  ConvexSet shape;
  Vec3 origin;
  Vec3 e1;  ///< across the normal but for rounding
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

/// Where two segments that are not parallel cross, seen along their common perpendicular; none if
/// they do not.
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

/// How far a point is beside a feature, seen along n, in double.
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

/// Whether a point feature is where its doubles say, and on the other feature.
bool points_are_right(const SupportFeatures& features, const Vec3& n, double tolerance) {
  const auto& [a, b] = features;
  if (!a.point_is_certain || !b.point_is_certain) return false;
  if (a.kind == Kind::point) return distance_beside(b, a.point, n) <= tolerance;
  return b.kind != Kind::point || distance_beside(a, b.point, n) <= tolerance;
}

}  // namespace

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
  const Configuration c = resolved(configuration).configuration;
  const SupportFeatures features = support_features(c, normal);
  const double lengths = larger_size(c) + (c.pose_a.position() - c.pose_b.position()).norm();
  constexpr double beside = 1e-9;     // further off, a point was decided by rounding
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

}  // namespace touchstone::oracle
