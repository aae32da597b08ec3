// Rolling and spinning bodies obey their laws of motion.
#include <algorithm>
#include <cmath>
#include <string>

#include "reference/cast.hpp"
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
  Scene scene = scene_for(step, rolling_time);
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
  const Inertia i = inertia(coin, steel).inertia;
  const double r = coin.radius(), h = coin.half_length(), s = std::sin(lean), c = std::cos(lean);
  return std::sqrt(i.mass * gravity * (r * c - h * s) /
                   (s * (i.principal.x() * c - i.principal.z() * h / r * s)));
}

/// Steps are finer than in other experiments: a revolution takes less than half a second.
constexpr int coin_substeps = 8;
constexpr double coin_time = 2;  // s

Measurement spinning_coin(const Simulator& simulator, double step) {
  Scene scene = scene_for(step / coin_substeps, coin_time);
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

// A can slides on end over a level box, along a direction in which a friction pyramid is exact,
// until friction has stopped it. It does not tip: friction times height is less than its radius.
constexpr double sliding_friction = 0.3, sliding_speed = 2;  // m/s
constexpr double sliding_half_length = 0.25;

/// Semi-implicit Euler: each step's way is with the speed at its end.
double sliding_distance(double step) {
  double way = 0, speed = sliding_speed;
  while ((speed -= sliding_friction * gravity * step) > 0) way += speed * step;
  return way;
}

Measurement sliding(const Simulator& simulator, double step) {
  Scene scene = scene_for(step, 2);
  const Vec3 half(3, 1, 0.25), start(-0.5, 0.2, half.z() + sliding_half_length - touching);
  Body can = moving_body("can", Cylinder(can_radius, sliding_half_length), sliding_friction,
                         Pose(start, about(Vec3::UnitZ(), 0.3)));
  can.velocity = sliding_speed * Vec3::UnitX();
  scene.bodies = {fixed_body("box", Box(half), sliding_friction), can};
  Run run(scene, simulator, can_radius);
  while (run.step()) {
  }
  const Vec3 way = run.states()[1].pose.position() - start;
  const double expected = sliding_distance(step);
  return {way.x(), (way - expected * Vec3::UnitX()).norm() / expected, run.tally()};
}

/// The can may lean and sink in the surface layer, and stops within a step.
double sliding_resolution(double step) {
  const double leaning = displacement_within_layer(Scene{}.surface_layer, 1.5 * can_radius,
                                                   sliding_half_length, sliding_half_length);
  return (leaning + sliding_friction * gravity * step * step) / sliding_distance(step);
}

// A wheel rolls up three steps of height s. At each it turns about the step's edge, about which its
// angular momentum stays: its speed v becomes v (1 − 2 s / (3 r)) at the impact; then it climbs,
// and its energy 3/4 m v² loses m g s. It is slow enough not to leave the edge: v² < g (r − s).
constexpr double wheel_radius = 0.3, wheel_half_length = 0.06, wheel_speed = 1.2;  // m, m, m/s
constexpr double step_height = 0.015, step_distance = 0.4;                         // m
constexpr int road_steps = 3;

/// Speeds before each step, and after the last.
std::vector<double> wheel_speeds() {
  std::vector<double> speeds = {wheel_speed};
  for (int i = 0; i < road_steps; ++i) {
    const double left = speeds.back() * (1 - 2 * step_height / (3 * wheel_radius));
    speeds.push_back(std::sqrt(left * left - 4.0 / 3 * gravity * step_height));
  }
  return speeds;
}

Measurement wheel(const Simulator& simulator, double step) {
  Scene scene = scene_for(step, 2);
  const Vec3 start(0, 0, wheel_radius - touching);
  Body body = moving_body("wheel", Cylinder(wheel_radius, wheel_half_length), 0.9,
                          Pose(start, about(Vec3::UnitX(), -std::numbers::pi / 2)));
  body.velocity = wheel_speed * Vec3::UnitX();
  body.angular_velocity = wheel_speed / wheel_radius * Vec3::UnitY();
  scene.bodies = {ground(0.9)};
  for (int i = 1; i <= road_steps; ++i) {
    const Vec3 half(1.5, 0.5, i * step_height / 2);
    scene.bodies.push_back(fixed_body("step-" + std::to_string(i), Box(half), 0.9,
                                      Pose(Vec3(i * step_distance + half.x(), 0, half.z()))));
  }
  scene.bodies.push_back(body);
  Run run(scene, simulator, wheel_radius);
  while (run.step()) {
  }
  const Vec3 velocity = run.states().back().velocity;
  const double expected = wheel_speeds().back();
  return {velocity.x(), (velocity - expected * Vec3::UnitX()).norm() / expected, run.tally()};
}

/// An edge is met up to one step late, at an angle φ that is less by v step / (r cos φ), and the
/// turn about it consists of chords; the overlap is pushed apart at a fifth of its depth per step.
double wheel_resolution(double step) {
  const double cosine = 1 - step_height / wheel_radius, angle = std::acos(cosine);
  const std::vector<double> speeds = wheel_speeds();
  double squares = 0;  // errors of v²
  for (int i = 0; i < road_steps; ++i) {
    const double v = speeds[i], late = v * step / wheel_radius, push = 0.2 * v * std::sin(angle);
    squares += (4.0 / 3 * std::tan(angle) + angle) * late * v * v + push * push;
  }
  return squares / (2 * speeds.back() * speeds.back());
}

// A cylinder rolls without slip over a level box, straight and at constant speed, whatever the
// triangles that an engine's own world makes of the box: they lie in one plane. A contact with
// another normal at a seam, or one that is missed, lifts it, turns it or takes of its speed.
constexpr double seams_speed = 1, seams_time = 2;  // m/s, s
constexpr int seams_squares = 12;
const Cylinder seams_wheel(0.3, 0.06);

/// `heading`: of the way, from the seams' direction.
Measurement over_seams(const Simulator& simulator, double step, const Cylinder& rolling,
                       double heading) {
  Scene scene = scene_for(step, seams_time);
  const Vec3 half(1.5, 1.5, 0.25);
  const Eigen::Quaterniond turn = about(Vec3::UnitZ(), heading);
  const Vec3 along = turn * Vec3::UnitX();
  const Vec3 start = (half.z() + rolling.radius() - touching) * Vec3::UnitZ() -
                     seams_speed * seams_time / 2 * along;
  Body body = moving_body("cylinder", rolling, 0.9,
                          Pose(start, turn * about(Vec3::UnitX(), -std::numbers::pi / 2)));
  body.velocity = seams_speed * along;
  body.angular_velocity = seams_speed / rolling.radius() * (turn * Vec3::UnitY());
  scene.bodies = {fixed_body("floor", Box(half), 0.9), body};
  scene.bodies[0].squares = seams_squares;
  Run run(scene, simulator, rolling.radius());
  double farthest = 0, highest = 0;
  Vec3 way = Vec3::Zero();
  while (run.step()) {
    way = run.states()[1].pose.position() - start;
    farthest = std::max(farthest, (way - run.time() * seams_speed * along).norm());
    highest = std::max(highest, way.z());
  }
  const double expected = seams_speed * seams_time;
  return {along.dot(way), farthest / expected, run.tally(), {{"lift", highest}}};
}

/// It sinks; a shorter lever changes its speed by two thirds of that share; and it may lean by as
/// much over its length, and then rolls about where its axis meets the ground, r / lean away.
double seams_resolution(const Cylinder& rolling) {
  const double sunk = touching + sinking(seams_time), way = seams_speed * seams_time;
  const double lean = sunk / (2 * rolling.half_length());
  return sunk / way + (2.0 / 3 * sunk + lean * way / 2) / rolling.radius();
}

Experiment seams_experiment(const char* name, const char* statement, const Cylinder& rolling,
                            double heading) {
  return {name,
          statement,
          "distance, m",
          "of the path, relative",
          [rolling, heading](const Simulator& simulator, double step) {
            return over_seams(simulator, step, rolling, heading);
          },
          [](double) { return seams_speed * seams_time; },
          [rolling](double) { return seams_resolution(rolling); }};
}

// A thrown can flies end first at a wall, so fast that after one step it is before the wall and
// after the next one behind it: what looks at these moments alone lets it through. On paper it is
// stopped where a cast says that it touches.
const Cylinder thrown_can(0.05, 0.1);
const Box thin_wall(Vec3(2, 2, 0.01));
constexpr double way_in_step = 0.3;  // m, longer than can and wall together
/// Distance, metres, from the wall before the step that leads through it: beyond what engines look
/// ahead for contacts.
constexpr double ahead_of_wall = 0.04;
constexpr int steps_to_wall = 4;
constexpr double flight_time = 0.5;  // s

struct Throw {
  Pose wall, can;
  Vec3 velocity;
};
Throw throw_at_wall(double step) {
  const Eigen::Quaterniond turn = about(Vec3(1, 2, 0.5).normalized(), 0.7);
  const double start = thin_wall.half_extents().z() + thrown_can.half_length() + ahead_of_wall +
                       steps_to_wall * way_in_step;
  return {Pose(Vec3::Zero(), turn), Pose(turn * Vec3(0.1, 0.2, start), turn),
          turn * Vec3(0, 0, -way_in_step / step)};
}
double way_to_wall(double step) {
  const Throw t = throw_at_wall(step);
  const Vec3 sweep = flight_time * t.velocity;
  return cast(thrown_can, t.can, sweep, thin_wall, t.wall).fraction * sweep.norm();
}

Measurement fast_can(const Simulator& simulator, double step) {
  const Throw t = throw_at_wall(step);
  Scene scene = scene_for(step, flight_time);
  scene.gravity = Vec3::Zero();
  Body can = moving_body("can", thrown_can, 0.5, t.can);
  can.velocity = t.velocity;
  scene.bodies = {fixed_body("wall", thin_wall, 0.5, t.wall), can};
  Run run(scene, simulator, thrown_can.radius());
  const Vec3 along = t.velocity.normalized();
  double farthest = 0;
  while (run.step()) {
    farthest = std::max(farthest, along.dot(run.states()[1].pose.position() - t.can.position()));
  }
  const double beyond = std::max(0.0, farthest - way_to_wall(step));
  return {farthest, beyond / thrown_can.half_length(), run.tally()};
}

/// Up to where its centre passes the middle of the wall, contacts push it back to its own side.
double fast_can_resolution(double) {
  return 1 + thin_wall.half_extents().z() / thrown_can.half_length();
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

std::vector<Experiment> moving_in_engines() {
  return {
      {"sliding", "A can that slides on end over a box stops after v²/(2 μ g), straight.",
       "distance, m", "relative", sliding, sliding_distance, sliding_resolution},
      {"wheel",
       "A wheel that rolls up three low steps loses 2 s/(3 r) of its speed at each edge, and the "
       "energy of its climb.",
       "speed at the end, m/s", "relative", wheel, [](double) { return wheel_speeds().back(); },
       wheel_resolution},
      seams_experiment("log-over-seams",
                       "A log rolls over a level box of triangles, straight, at constant speed.",
                       can, 0),
      seams_experiment("wheel-over-seams",
                       "A wheel rolls likewise, askew to the seams of the triangles.", seams_wheel,
                       0.3),
      {"fast-can", "A can that flies at a thin wall, 0.3 m in a step, is stopped by it.",
       "farthest way, m", "beyond the touch, half lengths", fast_can, way_to_wall,
       fast_can_resolution}};
}

}  // namespace touchstone
