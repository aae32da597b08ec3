// A scene as it might as well have been.
#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>
#include <rapidcheck.h>
#include <utility>

#include "properties/draw.hpp"
#include "simulation/scenes/choose.hpp"

namespace touchstone {
namespace {

constexpr double max_shift = 1e-4;  // of the smallest width
constexpr double max_angle = 1e-3;  // radians
constexpr double max_kick = 1e-3;   // of the speed after a fall by the smallest width

Vec3 draw_vector(Draw& draw, double max) { return draw.uniform(0, max) * draw.direction(); }

Eigen::Quaterniond draw_turn(Draw& draw, double max) {
  const double half = draw.uniform(0, max) / 2;
  const Vec3 axis = std::sin(half) * draw.direction();
  return {std::cos(half), axis.x(), axis.y(), axis.z()};
}

/// A small motion of what is joined, as one.
struct Disturbance {
  Vec3 centre, shift = Vec3::Zero();
  Eigen::Quaterniond turn = Eigen::Quaterniond::Identity();  ///< about the centre
  Vec3 kick = Vec3::Zero();                                  ///< m/s

  Vec3 moved(const Vec3& point) const { return centre + shift + turn * (point - centre); }
};

/// By body: a body that stands for all that joints connect it with, except through the world.
std::vector<int> mechanisms(const Scene& scene) {
  std::vector<int> group(scene.bodies.size());
  std::iota(group.begin(), group.end(), 0);
  const auto root = [&](int i) {
    while (group[i] != i) i = group[i];
    return i;
  };
  for (const Joint& joint : scene.joints) {
    if (joint.b != world_body) group[root(joint.a)] = root(joint.b);
  }
  for (int& g : group) g = root(g);
  return group;
}

/// By mechanism: is it held by the world, or by a body that forces do not move?
std::vector<bool> held_mechanisms(const Scene& scene, const std::vector<int>& mechanism) {
  std::vector<bool> held(scene.bodies.size());
  for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
    if (!scene.bodies[i].is_free()) held[mechanism[i]] = true;
  }
  for (const Joint& joint : scene.joints) {
    if (joint.b == world_body) held[mechanism[joint.a]] = true;
  }
  return held;
}

/// Smallest width of the bodies of a mechanism.
double smallest_width(const Scene& scene, const std::vector<int>& mechanism, int which) {
  double width = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
    if (mechanism[i] != which) continue;
    width = std::min(width, 2 * smallest_half_extent(scene.bodies[i].shape));
  }
  return width;
}

struct TurnDrive {
  const Eigen::Quaterniond& turn;

  Drive operator()(const SteadyMotion& m) const {
    return SteadyMotion{turn * m.velocity, turn * m.angular_velocity};
  }
  Drive operator()(const Oscillation& o) const {
    return Oscillation{turn * o.amplitude, turn * o.turn, o.frequency};
  }
  Drive operator()(const Waypoints& waypoints) const {
    Waypoints result;
    for (const auto& [time, pose] : waypoints) {
      result.push_back({time, Pose(turn * pose.position(), turn * pose.unit_orientation())});
    }
    return result;
  }
};

}  // namespace

DisturbedScene::DisturbedScene(const Scene& written, std::uint64_t seed, std::size_t disturbance)
    : scene(written), turn(Eigen::Quaterniond::Identity()), origin(written.bodies.size()) {
  std::iota(origin.begin(), origin.end(), 0);
  if (disturbance == 0) return;
  // Every disturbance has a stream of its own, whatever their number.
  Draw draw(rc::Random(rc::Random::Key{seed, disturbance, 0, 0}));
  turn = draw.orientation();
  for (std::size_t i = origin.size(); i > 1; --i) {
    std::swap(origin[i - 1],
              origin[static_cast<std::size_t>(draw.integer(0, static_cast<std::int64_t>(i) - 1))]);
  }
  const std::vector<int> mechanism = mechanisms(written);
  const std::vector<bool> held = held_mechanisms(written, mechanism);
  std::map<int, Disturbance> disturbances;  // by mechanism
  std::vector<int> place(origin.size());    // the inverse of origin
  for (std::size_t i = 0; i < origin.size(); ++i) {
    place[origin[i]] = static_cast<int>(i);
    const Body& from = written.bodies[origin[i]];
    Body& body = scene.bodies[i] = from;
    const int which = mechanism[origin[i]];
    const auto [found, is_new] = disturbances.try_emplace(which);
    Disturbance& d = found->second;
    if (is_new) d.centre = from.pose.position();
    if (is_new && !held[which]) {
      const double width = smallest_width(written, mechanism, which);
      d.shift = draw_vector(draw, max_shift * width);
      d.turn = draw_turn(draw, max_angle);
      d.kick = draw_vector(draw, max_kick * std::sqrt(2 * written.gravity.norm() * width));
    }
    if (!held[which]) body.velocity += d.kick;
    body.pose =
        Pose(turn * d.moved(from.pose.position()), turn * d.turn * from.pose.unit_orientation());
    body.velocity = turn * body.velocity;
    body.angular_velocity = turn * body.angular_velocity;
    if (body.drive) body.drive = std::visit(TurnDrive{turn}, *from.drive);
  }
  for (Joint& joint : scene.joints) {
    const Disturbance& d = disturbances.at(mechanism[joint.a]);
    joint.anchor = turn * d.moved(joint.anchor);
    joint.axis = (turn * d.turn * joint.axis).normalized();
    joint.a = place[joint.a];
    if (joint.b != world_body) joint.b = place[joint.b];
  }
  for (auto& [a, b] : scene.apart) a = place[a], b = place[b];
  for (Push& push : scene.pushes) {
    push.body = place[push.body];
    push.force = turn * push.force;
    push.torque = turn * push.torque;
  }
  scene.gravity = turn * written.gravity;
}

Trajectory DisturbedScene::turned_back(const Trajectory& run) const {
  const Eigen::Quaterniond back = turn.conjugate();
  Trajectory result = run;
  for (std::size_t f = 0; f < run.frames.size(); ++f) {
    for (std::size_t i = 0; i < origin.size(); ++i) {
      const BodyState& s = run.frames[f][i];
      result.frames[f][origin[i]] = {
          Pose(back * s.pose.position(), back * s.pose.unit_orientation()), back * s.velocity,
          back * s.angular_velocity};
    }
  }
  for (JudgedAnswer& a : result.answers) a.a = origin[a.a], a.b = origin[a.b];
  return result;
}

Trajectory run_disturbed(const Scene& scene, ContactModel& model, const Trials& trials) {
  Trajectory result = run_scene(scene, model);
  for (std::size_t d = 1; d <= trials.disturbances; ++d) {
    const DisturbedScene disturbed(scene, trials.seed, d);
    const Trajectory run = disturbed.turned_back(run_scene(disturbed.scene, model));
    result.answers.insert(result.answers.end(), run.answers.begin(), run.answers.end());
  }
  return result;
}

}  // namespace touchstone
