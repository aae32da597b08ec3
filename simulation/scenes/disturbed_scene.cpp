// A scene as it might as well have been.
#include <cmath>
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
  for (std::size_t i = 0; i < origin.size(); ++i) {
    const Body& from = written.bodies[origin[i]];
    Body& body = scene.bodies[i] = from;
    Vec3 position = from.pose.position();
    Eigen::Quaterniond orientation = from.pose.unit_orientation();
    if (!from.fixed) {
      const double width = 2 * smallest_half_extent(from.shape);
      position += draw_vector(draw, max_shift * width);
      orientation = draw_turn(draw, max_angle) * orientation;
      body.velocity += draw_vector(draw, max_kick * std::sqrt(2 * written.gravity.norm() * width));
    }
    body.pose = Pose(turn * position, turn * orientation);
    body.velocity = turn * body.velocity;
    body.angular_velocity = turn * body.angular_velocity;
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

}  // namespace touchstone
