// Thresholds, each known on paper and found by bisection: up to which angle does a can stand?
#include <algorithm>
#include <cmath>

#include "simulation/experiment.hpp"
#include "simulation/experiment_setup.hpp"

namespace touchstone {
namespace {

constexpr int halvings = 12;

/// Bisects the interval from `holds` to `fails` for the value at which `test` turns from true to
/// false; assumes without a test that it does so in between.
template <class Test>
double threshold(double holds, double fails, const Test& test) {
  for (int i = 0; i < halvings; ++i) {
    const double middle = (holds + fails) / 2;
    (test(middle) ? holds : fails) = middle;
  }
  return (holds + fails) / 2;
}

/// Runs while `still` holds; true if it held to the end.
template <class Still>
bool lasts(const Scene& scene, const Simulator& simulator, RunTally& tally, const Still& still) {
  Run run(scene, simulator, can_radius);
  bool held = true;
  while (held && run.step()) held = still(run.states());
  tally.add(run.tally());
  return held && !run.tally().unsound && !run.tally().unsupported;
}

double angle_between(const Vec3& a, const Vec3& b) {
  return std::atan2(a.cross(b).norm(), a.dot(b));
}

// The centre of mass is above the rim where tan θ = r / h.
double tipping_angle(double) { return std::atan2(can_radius, can_half_length); }

Measurement tipping(const Simulator& simulator, double step) {
  RunTally tally;
  const auto stands = [&](double slope) {
    Scene scene = scene_for(step, 2);
    constexpr double friction = 2;  // enough to tip before sliding
    const Eigen::Quaterniond turn = about(Vec3::UnitZ(), 0.4) * about(Vec3::UnitY(), slope);
    const Vec3 up = turn * Vec3::UnitZ();
    const Vec3 centre = (can_half_length - touching) * up;
    scene.bodies = {
        fixed_body("slope", Plane(Vec3::UnitZ(), 0), friction, Pose(Vec3::Zero(), turn)),
        moving_body("can", can, friction, Pose(centre, turn * about(Vec3::UnitZ(), 0.3)))};
    return lasts(scene, simulator, tally, [&](const std::vector<BodyState>& states) {
      const Pose& pose = states[1].pose;
      return angle_between(pose.axis(), up) < radians(3) &&
             (pose.position() - centre).norm() < can_radius / 4;
    });
  };
  const double expected = tipping_angle(step);
  const double found = threshold(0, 2 * expected, stands);
  return {found, std::abs(found / expected - 1), tally};
}

/// Any three points on the rim are an exact answer. Where the rim's lowest point lies between two
/// of them, the can rotates with angular acceleration α about the line through both, half a radius
/// nearer to its axis, for one step, until a point there is found; the speed gained carries it over
/// if the energy that is left to climb is at most (gyration × α × step)² / 2. The can may also lean
/// on the surface layer.
double tipping_resolution(double step) {
  const double angle = tipping_angle(step), to_rim = std::hypot(can_radius, can_half_length);
  const double about_line = can_gyration(can_radius / 2, can_half_length);
  const double acceleration =
      gravity * std::cos(angle) * can_radius / 2 / (about_line * about_line);
  const double gyration = can_gyration(can_radius, can_half_length);
  const double carried = acceleration * step * gyration / std::sqrt(gravity * to_rim);
  const double leaning = lean_within_layer(Scene{}.surface_layer, 1.5 * can_radius);
  return (carried + leaning) / angle + 2 * bisected(halvings);
}

// Two logs a little apart carry a third: each lower one is in equilibrium if the friction at its
// two contacts is tan(φ/2) times the normal force, φ being the angle between the line of centres
// and the vertical. At the ground the friction force is the same and the normal force larger.
constexpr double half_spacing = 1.1 * can_radius;
constexpr double pile_time = 1;                              // s
constexpr double max_pile_displacement = 0.02 * can_radius;  // m, of a pile that holds
double pile_friction(double) { return std::tan(std::asin(half_spacing / (2 * can_radius)) / 2); }

Measurement log_pile(const Simulator& simulator, double step) {
  RunTally tally;
  const auto holds = [&](double friction) {
    Scene scene = scene_for(step, pile_time);
    scene.solver_iterations = 500;
    const double depth = middle_of_layer(scene), low = can_radius - depth;
    const double between = 2 * can_radius - depth;
    const double high = low + std::sqrt(between * between - half_spacing * half_spacing);
    const auto log = [&](const char* name, double y, double z) {
      return moving_body(name, can, friction, Pose(Vec3(0, y, z), level()));
    };
    scene.bodies = {ground(friction), log("left", -half_spacing, low),
                    log("right", half_spacing, low), log("top", 0, high)};
    return lasts(scene, simulator, tally, [&](const std::vector<BodyState>& states) {
      for (int i = 1; i <= 3; ++i) {
        if ((states[i].pose.position() - scene.bodies[i].pose.position()).norm() >
            max_pile_displacement) {
          return false;
        }
      }
      return true;
    });
  };
  const double expected = pile_friction(step);
  const double found = threshold(4 * expected, 0, holds);
  return {found, std::abs(found / expected - 1), tally};
}

/// A pile that slides less than `max_pile_displacement` in the time counts as holding. Where the
/// friction is too small by Δμ, a lower log rolls away with acceleration g (1 + cos φ) Δμ / 3.
double pile_resolution(double step) {
  const double cosine = std::cos(std::asin(half_spacing / (2 * can_radius)));
  const double lacking =
      6 * max_pile_displacement / (pile_time * pile_time * gravity * (1 + cosine));
  return lacking / pile_friction(step) + 4 * bisected(halvings);
}

// A can on its side across the edge of a box stays as long as its centre is above the box.
constexpr double edge_time = 2;     // s
const double toppled = radians(3);  // of lean

/// In half lengths. With its centre x beyond the edge, the can leans by g x t² / (2 gyration²),
/// which must reach `toppled` within the time.
double edge_resolution(double) {
  const double gyration = can_gyration(can_radius, 0);
  const double unseen = 2 * toppled * gyration * gyration / (gravity * edge_time * edge_time);
  return unseen / can_half_length + 2 * bisected(halvings);
}

Measurement across_edge(const Simulator& simulator, double step) {
  RunTally tally;
  const auto stays = [&](double overhang) {
    Scene scene = scene_for(step, edge_time);
    const Vec3 half(0.6, 0.5, 0.3);
    const Eigen::Quaterniond turn = about(Vec3::UnitZ(), 0.4);
    const Vec3 centre(half.x() + overhang, 0, half.z() + can_radius - touching);
    scene.bodies = {fixed_body("box", Box(half), 0.5, Pose(Vec3::Zero(), turn)),
                    moving_body("can", can, 0.5, Pose(turn * centre, turn * level()))};
    return lasts(scene, simulator, tally, [&](const std::vector<BodyState>& states) {
      return std::abs(states[1].pose.axis().z()) < std::sin(toppled);
    });
  };
  const double found = threshold(-can_half_length, can_half_length, stays);
  return {found / can_half_length, std::abs(found) / can_half_length, tally};
}

// A can that flies end first at a plate is in contact with it, its centre still on the near side of
// the plate's middle, over a way of half length + half thickness; up to that way per step, at least
// one step ends in contact.
constexpr double plate_half_thickness = 0.01;
constexpr double min_phase = 0.001;  // distance from touching at the start, in steps
double tunnelling_speed(double step) { return (can_half_length + plate_half_thickness) / step; }

Measurement tunnelling(const Simulator& simulator, double step) {
  RunTally tally;
  const double expected = tunnelling_speed(step);
  const auto is_stopped = [&](double speed) {
    for (const double phase : {min_phase, 0.25, 0.5, 0.75}) {
      Scene scene;
      scene.step = step;
      scene.gravity = Vec3::Zero();
      const double ahead = can_half_length + plate_half_thickness + phase * speed * step;
      scene.duration = 3 * ahead / speed + 4 * step;
      const Eigen::Quaterniond turn = about(Vec3(1, 2, 0.5).normalized(), 0.7);
      Body flying = moving_body("can", can, 0.5, Pose(turn * Vec3(0.1, 0.2, ahead), turn));
      flying.velocity = turn * Vec3(0, 0, -speed);
      scene.bodies = {
          fixed_body("plate", Box(Vec3(2, 2, plate_half_thickness)), 0.5, Pose(Vec3::Zero(), turn)),
          flying};
      if (!lasts(scene, simulator, tally, [&](const std::vector<BodyState>& states) {
            return states[1].pose.position().dot(turn * Vec3::UnitZ()) > -can_half_length;
          })) {
        return false;
      }
    }
    return true;
  };
  const double found = threshold(0, 2 * expected, is_stopped);
  return {found, std::max(0.0, 1 - found / expected), tally};
}

}  // namespace

std::vector<Experiment> threshold_experiments() {
  return {
      {"tipping", "On a rising slope a cylinder on end tips where tan θ = r / h.",
       "angle at which it tips, radians", "relative", tipping, tipping_angle, tipping_resolution},
      {"log-pile",
       "Two logs carry a third if friction is at least tan(φ/2), φ being the slope of the line "
       "of centres to the vertical.",
       "least friction that holds", "relative", log_pile, pile_friction, pile_resolution},
      {"across-edge", "On its side across a box's edge it topples once its centre is beyond.",
       "overhang at which it topples, half lengths", "half lengths", across_edge,
       [](double) { return 0.0; }, edge_resolution},
      {"tunnelling",
       "A cylinder that flies end first at a thin plate is stopped up to (half length + half "
       "thickness) / step.",
       "speed at which it passes through, m/s", "relative, slower only", tunnelling,
       tunnelling_speed, [](double) { return min_phase + 2 * bisected(halvings); }}};
}

}  // namespace touchstone
