#include <algorithm>
#include <array>
#include <cmath>
#include <span>

#include "reference/support.hpp"
#include "reports/idioms/cases.hpp"

namespace touchstone {
namespace {

/// The largest b.n over the points b of B. Of a half-space, which is unbounded, the column beneath
/// the cylinder's circumsphere is taken, two circumradii deep.
double reach_of_b(const Configuration& c, const Vec3& n) {
  const auto* const plane = std::get_if<Plane>(&c.b);
  if (!plane) return support(c.b, c.pose_b, n);
  const Vec3 up = c.pose_b.rotation() * plane->unit_normal(), a = c.pose_a.position();
  const double height = up.dot(a - c.pose_b.position()) - plane->unit_displacement();
  const double cosine = up.dot(n), radius = std::hypot(c.a.radius(), c.a.half_length());
  return a.dot(n) - height * cosine + radius * (up.cross(n).norm() + 2 * std::max(0.0, -cosine));
}

bool is_off_body(const Configuration& c, const Vec3& n, const ts_point& deepest, double tolerance) {
  const Vec3 p(deepest.position[0], deepest.position[1], deepest.position[2]);
  const double outside = std::abs(deepest.depth) + tolerance;
  for (const Vec3& m : std::array<Vec3, 4>{n, Vec3::UnitX(), Vec3::UnitY(), Vec3::UnitZ()}) {
    for (const Vec3& way : std::array<Vec3, 2>{m, -m}) {
      const double reach = std::min(support(c.a, c.pose_a, way), reach_of_b(c, way));
      if (!(way.dot(p) <= reach + outside)) return true;
    }
  }
  return false;
}

}  // namespace

std::string idiom_verdict(const Configuration& c, double true_distance, double tolerance,
                          const Answer& answer) {
  if (answer.status == TS_NONE) return true_distance < -tolerance ? "missed" : "right";
  if (answer.status != TS_CONTACT) return outcome_name(Outcome::failed);
  const Vec3 n(answer.normal[0], answer.normal[1], answer.normal[2]);
  if (!std::isfinite(answer.signed_distance + n.norm())) return "not-finite";
  if (true_distance > tolerance) return "phantom";
  if (answer.signed_distance > true_distance + tolerance) return "shallow";
  if (answer.signed_distance < true_distance - tolerance) return "overdeep";
  const double clearance = -support(c.a, c.pose_a, -n) - reach_of_b(c, n);
  if (std::abs(n.norm() - 1) > 1e-6 || clearance < true_distance - tolerance) return "wrong-normal";
  const std::span points(answer.points, static_cast<std::size_t>(answer.point_count));
  if (points.empty()) return "no-points";
  const auto deepest = std::max_element(
      points.begin(), points.end(), [](const auto& p, const auto& q) { return p.depth < q.depth; });
  return is_off_body(c, n, *deepest, tolerance) ? "off-body" : "right";
}

}  // namespace touchstone
