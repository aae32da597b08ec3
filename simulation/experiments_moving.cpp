// Rolling and spinning bodies obey their laws of motion.
#include <algorithm>
#include <cmath>

#include "simulation/experiment.hpp"
#include "simulation/experiment_setup.hpp"
#include "simulation/world.hpp"

namespace touchstone {
namespace {

// Down a slope θ without slip the acceleration is a = 2/3 g sin θ. Contacts are compared with the
// distance that semi-implicit Euler makes of it in n steps h from rest: a h² n (n + 1) / 2.
const double slope = radians(10);
constexpr double rolling_time = 3;  // s

double rolling_distance(double step) {
  const double n = std::round(rolling_time / step);
  return 2.0 / 3 * gravity * std::sin(slope) * step * step * n * (n + 1) / 2;
}

/// A lever that is shorter by some share reduces the acceleration by two thirds of that share.
double rolling_resolution(double) {
  return 2.0 / 3 * (touching + sinking(rolling_time)) / can_radius;
}

/// Largest deviation of the speed from constant acceleration, as a share of the final speed.
double ripple(const std::vector<double>& speeds) {
  double largest = 0;
  for (std::size_t i = 0; i < speeds.size(); ++i) {
    const double constant =
        speeds.back() * static_cast<double>(i + 1) / static_cast<double>(speeds.size());
    largest = std::max(largest, std::abs(speeds[i] - constant));
  }
  return speeds.empty() || speeds.back() == 0 ? 0 : largest / std::abs(speeds.back());
}

Measurement rolling(const Simulator& simulator, double step) {
  Scene scene;
  scene.step = step;
  scene.duration = rolling_time;
  // x is down the slope, z its normal, the axis along y.
  const Eigen::Quaterniond turn = about(Vec3::UnitZ(), 0.4) * about(Vec3::UnitY(), slope);
  const Vec3 down = turn * Vec3::UnitX();
  const Eigen::Quaterniond across = about(Vec3::UnitX(), std::numbers::pi / 2);
  const Vec3 start = (can_radius - touching) * (turn * Vec3::UnitZ());
  scene.bodies = {fixed_body("slope", Plane(Vec3::UnitZ(), 0), 0.5, Pose(Vec3::Zero(), turn)),
                  moving_body("can", Cylinder(can_radius, can_half_length), 0.5,
                              Pose(start, turn * across * about(Vec3::UnitZ(), 0.7)))};
  Run run(scene, simulator, can_radius);
  std::vector<double> speeds;
  while (run.step()) speeds.push_back(down.dot(run.states()[1].velocity));
  const Vec3 way = run.states()[1].pose.position() - start;
  const double expected = rolling_distance(step), found = down.dot(way);
  return {
      found, (way - expected * down).norm() / expected, run.tally(), {{"ripple", ripple(speeds)}}};
}

// A disc that rolls on its rim about a resting centre, inclined by α from lying flat, precesses at
// the rate Ω of Ω² sin α (Iₜ cos α − Iₐ h/r sin α) = m g (r cos α − h sin α): the torque of the
// support equals the rate of change of the angular momentum, and the angular velocity points along
// the line from the centre to the contact, because the disc rolls without slip.
const Cylinder coin(0.5, 0.02);
const double coin_lean = radians(25);

double coin_rate(double lean) {
  const Inertia i = inertia(coin, steel);
  const double r = coin.radius(), h = coin.half_length(), s = std::sin(lean), c = std::cos(lean);
  return std::sqrt(i.mass * gravity * (r * c - h * s) /
                   (s * (i.principal.x() * c - i.principal.z() * h / r * s)));
}

/// Steps are finer than in other experiments: a revolution takes less than half a second.
constexpr int coin_substeps = 8;
constexpr double coin_time = 2;  // s

Measurement spinning_coin(const Simulator& simulator, double step) {
  Scene scene;
  scene.step = step / coin_substeps;
  scene.duration = coin_time;
  const double r = coin.radius(), h = coin.half_length(), rate = coin_rate(coin_lean);
  const Eigen::Quaterniond lean = about(Vec3::UnitY(), coin_lean);
  const Vec3 axis = lean * Vec3::UnitZ(), to_lowest = lean * Vec3::UnitX();
  const double height = h * std::cos(coin_lean) + r * std::sin(coin_lean) - touching;
  Body body = moving_body("coin", coin, 1, Pose(height * Vec3::UnitZ(), lean));
  body.angular_velocity = -rate * std::sin(coin_lean) / r * (r * to_lowest - h * axis);
  scene.bodies = {ground(1), body};

  Run run(scene, simulator, r);
  double angle = 0;
  Vec3 last = axis;
  while (run.step()) {
    const Vec3 now = run.states()[1].pose.axis();
    angle += std::atan2(last.x() * now.y() - last.y() * now.x(),
                        last.x() * now.x() + last.y() * now.y());
    last = now;
  }
  const double turned = angle / (rate * coin_time) - 1;
  const double lean_kept = std::acos(std::clamp(last.z(), -1.0, 1.0)) / coin_lean - 1;
  return {
      angle, std::max(std::abs(turned), std::abs(lean_kept)), run.tally(), {{"lean", lean_kept}}};
}

/// Closed form of the single contact between an inclined cylinder and the ground z = 0.
class LowestPoint : public ContactModel {
 public:
  void begin() override {}
  std::vector<Answer> answers(std::span<const PairQuestion> questions) override {
    std::vector<Answer> result;
    for (const PairQuestion& q : questions) {
      const Configuration& c = q.configuration;
      const Vec3 u = c.pose_a.axis(), down = -Vec3::UnitZ();
      const Vec3 low = c.pose_a.position() + (u.dot(down) > 0 ? 1 : -1) * c.a.half_length() * u +
                       c.a.radius() * (down - u.dot(down) * u).normalized();
      Answer answer{};
      answer.status = low.z() <= 0 ? TS_CONTACT : TS_NONE;
      answer.normal[2] = 1;
      answer.signed_distance = low.z();
      answer.point_count = 1;
      answer.points[0] = {{low.x(), low.y(), low.z() / 2}, {0, 0, 1}, -low.z()};
      result.push_back(answer);
    }
    return result;
  }
};

/// Twice the error of the integrator, which is measured with the closed form.
double coin_resolution(double step) {
  LowestPoint exact;
  return 2 * spinning_coin(in_our_world(exact), step).error;
}

}  // namespace

std::vector<Experiment> moving_experiments() {
  return {{"rolling", "Down a slope of 10° it rolls with 2/3 g sin θ, straight, for 3 s.",
           "distance, m", "relative", rolling, rolling_distance, rolling_resolution},
          {"coin",
           "A leaning coin rolls on its rim about a resting centre at the rate that gravity sets "
           "and keeps its lean.",
           "angle gone round in 2 s, radians", "relative, of angle or lean", spinning_coin,
           [](double) { return coin_rate(coin_lean) * coin_time; }, coin_resolution}};
}

}  // namespace touchstone
