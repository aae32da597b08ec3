#pragma once

#include <limits>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "reference/pose.hpp"

// What moves the bodies of a scene beside gravity and contacts: drives, joints, pushes.

namespace touchstone {

/// Motion at constant velocities. Of the body's centre, world frame.
struct SteadyMotion {
  Vec3 velocity = Vec3::Zero();          ///< m/s
  Vec3 angular_velocity = Vec3::Zero();  ///< rad/s
};

/// Swing about the initial pose: at time t the centre is displaced by sin(2πft)·amplitude and the
/// body turned by the rotation vector sin(2πft)·turn. World frame.
struct Oscillation {
  Vec3 amplitude = Vec3::Zero();  ///< m
  Vec3 turn = Vec3::Zero();       ///< rad
  double frequency = 1;           ///< f, Hz
};

struct Waypoint {
  double time;  ///< s, positive
  Pose pose;
};

/// Poses in the order of their times, with the initial pose before them. The body rests in each,
/// and for good in the last; between two, position and angle follow 3s² − 2s³ of the share s of the
/// time, on a straight line and about one axis.
using Waypoints = std::vector<Waypoint>;

/// Motion of a body that nothing can stop.
using Drive = std::variant<SteadyMotion, Oscillation, Waypoints>;

/// Pose at a time, seconds, of a body that starts at a pose.
Pose driven_pose(const Drive& drive, const Pose& start, double time);

/// Mean angular velocity, rad/s, from one time to another. Whole turns within a step count; between
/// waypoints there are none.
Vec3 driven_spin(const Drive& drive, const Pose& start, double from, double to);

enum class JointKind {
  fixed,   ///< both bodies are one
  hinge,   ///< turns about an axis
  slider,  ///< slides along an axis
};
const char* joint_kind_name(JointKind kind);

/// Motor in a joint. Rates and positions are of body a relative to body b, about or along the axis.
struct Motor {
  enum class Target { rate, position };
  Target target = Target::rate;
  /// Times (s, ascending) and targets: rad/s or m/s, rad or m; linear between two, constant before
  /// the first and after the last.
  std::vector<std::pair<double, double>> course;
  double max_force = 0;  ///< N; of a hinge, N m

  double target_at(double time) const;
};

/// Body index of the world, to which a joint may hold a body.
inline constexpr int world_body = -1;

/// Joint of two bodies, which then do not touch each other. Its position is zero at the start; that
/// of a hinge counts all turns.
struct Joint {
  std::string name;
  JointKind kind = JointKind::fixed;
  int a = 0, b = world_body;   ///< indices of bodies; a is a body
  Vec3 anchor = Vec3::Zero();  ///< of a hinge: a point of its axis; world frame, at the start
  Vec3 axis = Vec3::UnitZ();   ///< of unit length; world frame, at the start
  double lower = -std::numeric_limits<double>::infinity();  ///< of the position, rad or m
  double upper = std::numeric_limits<double>::infinity();
  std::optional<Motor> motor = {};
};

/// The angle, in radians, nearest to an expected one of those that differ from this one by whole
/// turns: engines know a hinge's angle within one.
double nearest_turn(double angle, double expected);

/// Rate at which the motor of a joint that is at a position shall turn or move it in the step that
/// begins at a time. A motor that holds a position follows it at the position's own rate and
/// corrects a fifth of the error in a step, as contacts do.
double motor_rate(const Joint& joint, double position, double time, double step);

/// Force and torque on a body for a time. World frame.
struct Push {
  int body = 0;
  Vec3 force = Vec3::Zero();                                         ///< N, at its centre
  Vec3 torque = Vec3::Zero();                                        ///< N m
  double from = 0, until = std::numeric_limits<double>::infinity();  ///< s

  /// Share of the step from `begin` on in which it acts, 0 … 1: with that share of its force, a
  /// push has its impulse whatever the step.
  double share(double begin, double step) const;
};

}  // namespace touchstone
