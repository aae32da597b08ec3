#include "simulation/scenes/passing.hpp"

#include <map>
#include <optional>
#include <utility>
#include <variant>

#include "properties/moves.hpp"
#include "reference/cast.hpp"
#include "reference/support.hpp"

namespace touchstone {
namespace {

/// Seconds for which A overlaps B as it passes with this velocity relative to B; none where it does
/// not, starts in an overlap, or never leaves B.
std::optional<double> seconds_of_overlap(const Configuration& c, const Vec3& velocity) {
  const double speed = velocity.norm();
  if (!(speed > 0) || std::holds_alternative<Plane>(c.b)) return {};
  const Vec3 ahead = velocity / speed;
  const double past = support(c.b, c.pose_b, ahead) + support(c.a, c.pose_a, -ahead);
  const double seconds = (past + larger_size(c)) / speed;  // until A has left all of B behind
  const Vec3 way = seconds * velocity;
  const Cast there = cast(c, way);
  if (there.status != CastStatus::touch) return {};
  const Cast back = cast(with_a_moved(c, way), -way);
  if (back.status != CastStatus::touch) return {};
  return seconds * (1 - there.fraction - back.fraction);
}

}  // namespace

std::optional<Passing> shortest_passing(const Scene& scene, const Trajectory& run) {
  std::optional<Passing> shortest;
  std::map<std::pair<int, int>, int> last_contact;  // frame
  for (const JudgedAnswer& answer : run.answers) {
    if (!(answer.depth > 0)) continue;
    const auto [last, is_first] = last_contact.try_emplace({answer.a, answer.b}, -1);
    const bool goes_on = !is_first && last->second == answer.frame - 1;
    last->second = answer.frame;
    if (goes_on || answer.frame == 0) continue;
    JudgedAnswer before = answer;
    --before.frame;
    const Configuration c = run.configuration(scene, before);
    const auto& states = run.frames[before.frame];
    const Vec3 velocity = states[answer.a].velocity - states[answer.b].velocity;
    const std::optional<double> seconds = seconds_of_overlap(c, velocity);
    if (!seconds || (shortest && *seconds >= shortest->seconds)) continue;
    shortest = {*seconds, answer.a, answer.b, run.step * before.frame};
  }
  return shortest;
}

}  // namespace touchstone
