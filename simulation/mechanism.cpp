#include "simulation/mechanism.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <numbers>

namespace touchstone {
namespace {

Eigen::Quaterniond turned_by(const Vec3& rotation_vector) {
  const double angle = rotation_vector.norm();
  if (angle == 0) return Eigen::Quaterniond::Identity();
  return Eigen::Quaterniond(Eigen::AngleAxisd(angle, rotation_vector / angle));
}

/// Share of its amplitude at which an oscillation is at a time.
double swing(const Oscillation& o, double time) {
  return std::sin(2 * std::numbers::pi * o.frequency * time);
}

struct PoseAt {
  const Pose& start;
  double time;

  Pose operator()(const SteadyMotion& m) const {
    return {start.position() + time * m.velocity,
            turned_by(time * m.angular_velocity) * start.unit_orientation()};
  }
  Pose operator()(const Oscillation& o) const {
    const double s = swing(o, time);
    return {start.position() + s * o.amplitude, turned_by(s * o.turn) * start.unit_orientation()};
  }
  Pose operator()(const Waypoints& waypoints) const {
    Waypoint from{0, start};
    for (const Waypoint& to : waypoints) {
      if (time < to.time) {
        const double share = std::max(0.0, (time - from.time) / (to.time - from.time));
        const double s = share * share * (3 - 2 * share);
        return {from.pose.position() + s * (to.pose.position() - from.pose.position()),
                from.pose.unit_orientation().slerp(s, to.pose.unit_orientation())};
      }
      from = to;
    }
    return from.pose;
  }
};

struct MeanSpin {
  const Pose& start;
  double from, to;

  Vec3 operator()(const SteadyMotion& m) const { return m.angular_velocity; }
  Vec3 operator()(const Oscillation& o) const {
    return (swing(o, to) - swing(o, from)) / (to - from) * o.turn;
  }
  Vec3 operator()(const Waypoints& waypoints) const {
    const Pose before = PoseAt{start, from}(waypoints), after = PoseAt{start, to}(waypoints);
    const Eigen::AngleAxisd turn(after.unit_orientation() * before.unit_orientation().conjugate());
    // An angle of up to 2π about some axis: the shorter way is meant.
    const double angle = std::remainder(turn.angle(), 2 * std::numbers::pi);
    return angle / (to - from) * turn.axis();
  }
};

}  // namespace

Pose driven_pose(const Drive& drive, const Pose& start, double time) {
  return std::visit(PoseAt{start, time}, drive);
}

Vec3 driven_spin(const Drive& drive, const Pose& start, double from, double to) {
  return std::visit(MeanSpin{start, from, to}, drive);
}

const char* joint_kind_name(JointKind kind) {
  constexpr std::array names = {"fixed", "hinge", "slider"};
  return names[static_cast<std::size_t>(kind)];
}

double Motor::target_at(double time) const {
  const auto after = std::find_if(course.begin(), course.end(),
                                  [&](const auto& entry) { return time < entry.first; });
  if (after == course.begin()) return after->second;
  const auto before = std::prev(after);
  if (after == course.end()) return before->second;
  const double share = (time - before->first) / (after->first - before->first);
  return before->second + share * (after->second - before->second);
}

double Push::share(double begin, double step) const {
  const double first = std::max(from, begin), last = std::min(until, begin + step);
  return std::max(0.0, (last - first) / step);
}

double nearest_turn(double angle, double expected) {
  constexpr double turn = 2 * std::numbers::pi;
  return angle + turn * std::round((expected - angle) / turn);
}

double motor_rate(const Joint& joint, double position, double time, double step) {
  constexpr double error_reduction = 0.2;  // per step
  const Motor& motor = *joint.motor;
  const double now = motor.target_at(time);
  if (motor.target == Motor::Target::rate) return now;
  return (motor.target_at(time + step) - now + error_reduction * (now - position)) / step;
}

}  // namespace touchstone
