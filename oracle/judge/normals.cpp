#include "oracle/judge/normals.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <variant>

#include "oracle/body.hpp"

namespace touchstone {
namespace {

using oracle::Body, oracle::NormalFamily;

/// Listed members of a curve stand for those within this angle, degrees.
constexpr double near = 1;

/// Regret below which a normal is itself optimal, relative to the larger size: a unit vector of
/// doubles is off by 1e-16.
constexpr double no_regret = 1e-15;

/// The member of a circle or an arc nearest to a unit vector; absent where it is an end, which is
/// listed, or where all are equally near.
std::optional<Vec3> nearest_within(const NormalFamily& family, const Vec3& n) {
  if (family.kind == NormalFamily::Kind::curve) return std::nullopt;
  const Vec3 across = n - n.dot(family.axis) * family.axis;
  if (across.isZero(0)) return std::nullopt;
  Vec3 member = across.normalized();
  if (family.kind == NormalFamily::Kind::circle) return member;
  const Vec3 &first = family.ends[0], &last = family.ends[1];
  const auto beyond = [&](const Vec3& from, const Vec3& to) {
    return from.cross(to).dot(family.axis);
  };
  // Arcs are shorter than half a turn.
  const bool is_within = beyond(first, member) >= 0 && beyond(member, last) >= 0;
  return is_within ? std::optional(member) : std::nullopt;
}

/// Half the extent along a direction, which is given in the body's frame; of a hull, how far it
/// reaches that way from the middle of its extents.
double half_extent(const Body& body, const Vec3& n) {
  const Vec3 middle = body.hull ? body.hull->middle() : Vec3(Vec3::Zero());
  return body.core_reach(n, middle) + body.ball_radius * n.norm();
}

double circumradius(const Body& body) {
  if (!body.hull) {
    const Vec3 half = body.core_half_extents();
    return std::hypot(body.core_radius(), body.is_round() ? half.z() : half.norm()) +
           body.ball_radius;
  }
  double farthest = 0;
  for (const Vec3& v : body.hull->vertices()) {
    farthest = std::max(farthest, (v - body.hull->middle()).norm());
  }
  return farthest + body.ball_radius;
}

/// Regret of n for a body that touches a half-space with the normal m; infinite for a plane, which
/// touches none. With α between them and the half extent h it is h(n) − h(m) cos α + ρ sin α + 2ρ
/// max(0, −cos α): of the half-space the column beneath the body's circumsphere counts, two radii
/// deep.
double regret_on_half_space(const Shape& shape, const Pose& pose, const Vec3& n, const Vec3& m) {
  if (std::holds_alternative<Plane>(shape)) return std::numeric_limits<double>::infinity();
  const Body body(shape);
  const auto along = [&](const Vec3& v) {
    return half_extent(body, pose.rotation().transpose() * v);
  };
  const double cosine = n.dot(m);
  return along(n) - cosine * along(m) +
         circumradius(body) * (n.cross(m).norm() + 2 * std::max(0.0, -cosine));
}

}  // namespace

double angle_between(const Vec3& n, const Vec3& m) {
  return std::atan2(n.cross(m).norm(), n.dot(m)) * 180 / std::numbers::pi;
}

Vec3 nearest_normal(const oracle::Truth& truth, const Vec3& n) {
  const Vec3 unit = n.normalized();
  Vec3 nearest = truth.normals.front().n;
  const auto consider = [&](const Vec3& m) {
    if (angle_between(unit, m) < angle_between(unit, nearest)) nearest = m;
  };
  for (const oracle::OptimalNormal& optimal : truth.normals) consider(optimal.n);
  for (const NormalFamily& family : truth.families) {
    for (const Vec3& end : family.ends) consider(end);
    if (const auto member = nearest_within(family, unit)) consider(*member);
  }
  return nearest;
}

std::optional<double> angle_to_optimal(const Configuration& c, const oracle::Truth& truth,
                                       const Vec3& n, double regret) {
  const double angle = angle_between(n, nearest_normal(truth, n));
  if (truth.ties != oracle::Ties::continuum || angle == 0) return angle;
  if (regret <= no_regret * larger_size(c)) return 0;
  const bool has_curve =
      std::any_of(truth.families.begin(), truth.families.end(),
                  [](const NormalFamily& f) { return f.kind == NormalFamily::Kind::curve; });
  return has_curve && angle > near ? std::nullopt : std::optional(angle);
}

double felt_regret(const Configuration& c, const oracle::Truth& truth, const Vec3& n,
                   double whole_regret) {
  double felt = whole_regret;
  for (const oracle::OptimalNormal& optimal : truth.normals) {
    felt = std::min({felt, regret_on_half_space(c.a, c.pose_a, n, optimal.n),
                     regret_on_half_space(c.b, c.pose_b, n, optimal.n)});
  }
  return std::max(0.0, felt);
}

}  // namespace touchstone
