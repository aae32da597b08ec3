// The law "hull": bodies at rest move by less than anybody sees from frame to frame, by what a
// solver leaves or by rounding alone. Where that moves the contact points by a part of the body,
// the points were chosen by rounding, and a solver's warm start is lost with them.
#include <algorithm>
#include <cmath>
#include <fmt/format.h>

#include "oracle/judge/hull.hpp"
#include "properties/laws/law.hpp"
#include "properties/moves.hpp"

namespace touchstone {
namespace {

/// Steps that nobody sees: of the smaller size, and radians, which move an end of the larger body
/// by less than that.
constexpr double unseen_shift = 1e-9, unseen_turn = 1e-12;

/// A jump that everybody sees, of the larger size. Bodies that lean by little more than rounding
/// move their points by a part of it when they lean otherwise, and rightly so.
constexpr double seen_jump = 0.01;

/// An overlap less deep than this part of the smaller size may end by such a step.
constexpr double least_depth = 1e-6;

/// A normal that turns by more, radians, has been chosen anew: of several that tie, a step makes
/// one the best.
constexpr double same_normal_angle = 1e-3;

std::vector<Configuration> ask_unseen_steps(const Configuration& c, const Bar&) {
  std::vector<Configuration> result;
  for (const Vec3& direction : {Vec3(1, 0, 0), Vec3(-0.6, 0.8, 0), Vec3(0, -0.6, 0.8)}) {
    result.push_back(with_a_moved(c, unseen_shift * smaller_size(c) * direction));
  }
  const double angle = unseen_turn * (smaller_size(c) / larger_size(c));
  for (const Vec3& axis : {Vec3(1, 0, 0), Vec3(-0.6, 0.8, 0), Vec3(0, -0.6, 0.8)}) {
    const Eigen::Quaterniond turn = about(axis, angle);
    Configuration turned = c;
    turned.pose_a = Pose(c.pose_a.position(), turn * c.pose_a.orientation());
    result.push_back(turned);
  }
  return result;
}

/// Is it a contact whose points such a step has to leave where they are?
bool has_points(const Configuration& c, const Answer& a, const Bar& bar) {
  return a.status == TS_CONTACT && is_finite(a) && a.point_count > 0 && !Vec3(a.normal).isZero(0) &&
         a.signed_distance < bar.threshold - least_depth * smaller_size(c);
}

double angle_between(const Answer& a, const Answer& b) {
  const Vec3 n = Vec3(a.normal).normalized(), m = Vec3(b.normal).normalized();
  return std::atan2(n.cross(m).norm(), n.dot(m));
}

/// The hull of the points, in multiples of the larger size.
oracle::ContactPatch hull_in_sizes(const Configuration& c, const ts_answer& answer) {
  ts_answer a = answer;
  for (int i = 0; i < a.point_count; ++i) {
    Eigen::Map<Vec3> position(a.points[i].position);
    position = (position - c.pose_a.position()).eval() / larger_size(c);
  }
  return hull_of_points(a);
}

std::optional<Violation> judge_hull(const Configuration& c, std::span<const Answer> answers,
                                    const Bar& bar) {
  const double jump = hull_jump(c, answers, bar);
  if (jump <= seen_jump) return std::nullopt;
  return Violation{
      "jump", jump,
      fmt::format("the hull of the points moves by {:.3g} of the larger size where A moves by less "
                  "than {} of the smaller one",
                  jump, unseen_shift)};
}

}  // namespace

double hull_jump(const Configuration& c, std::span<const Answer> answers, const Bar& bar) {
  if (!has_points(c, answers[0], bar)) return 0;
  double largest = 0;
  for (const Answer& stepped : answers.subspan(1)) {
    if (!has_points(c, stepped, bar)) continue;
    const double turn = angle_between(answers[0], stepped);
    if (turn > same_normal_angle) continue;
    // No point is farther than two sizes from what the normal turns about.
    const double carried = 2 * turn;
    const double moved = movement(hull_in_sizes(c, answers[0]), hull_in_sizes(c, stepped));
    largest = std::max(largest, moved - carried);
  }
  return largest;
}

Law hull_law(bool (*applies)(const Configuration& configuration)) {
  return {"hull",
          "A move of A by less than 1e-9 of the smaller size leaves the hull of the contact points "
          "where it is, to 0.01 of the larger size.",
          applies, ask_unseen_steps, judge_hull};
}

}  // namespace touchstone
