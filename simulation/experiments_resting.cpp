// A supported body stays where it is, also when it is released with a slight lean.
#include <algorithm>
#include <functional>
#include <string>

#include "simulation/experiment.hpp"
#include "simulation/experiment_setup.hpp"

namespace touchstone {
namespace {

/// Lean at the start: one side is lifted, because in the rest pose itself a single contact point
/// below the centre of mass would do.
constexpr double lean = 0.01;     // rad
constexpr double rest_time = 10;  // s

/// The pose rotated about a point of the world.
Pose turned_about(const Pose& pose, const Vec3& pivot, const Vec3& axis, double angle) {
  const Eigen::Quaterniond turn = about(axis, angle);
  return Pose(pivot + turn * (pose.position() - pivot), turn * pose.orientation());
}

/// Bound on the distance, metres, of any point of a body from its place in the home pose.
double distance_from(const Pose& now, const Pose& home, double reach) {
  const double angle = Eigen::AngleAxisd(now.rotation() * home.rotation().transpose()).angle();
  return (now.position() - home.position()).norm() + reach * angle;
}

/// Runs to the end. In the second half the rocking must be over: the value is the mean kinetic
/// energy that is left, the error the largest distance from where the bodies shall be, in radii.
/// `distance`: that of the states, metres.
Measurement settle(const Scene& scene, const Simulator& simulator, double radius,
                   const std::function<double(const std::vector<BodyState>&)>& distance) {
  Run run(scene, simulator, radius);
  double farthest = 0, energy = 0;
  std::uint64_t counted = 0;
  while (run.step()) {
    if (run.time() < scene.duration / 2) continue;
    farthest = std::max(farthest, distance(run.states()));
    energy += run.kinetic_energy();
    ++counted;
  }
  return {counted > 0 ? energy / static_cast<double>(counted) : 0, farthest / radius, run.tally()};
}

/// The same with the largest distance of any body from its home. `homes`: those of the last bodies
/// of the scene. `reach`: the bodies' half length, metres.
Measurement stay(const Scene& scene, const std::vector<Pose>& homes, const Simulator& simulator,
                 double radius = can_radius, double reach = can_half_length) {
  const std::size_t first = scene.bodies.size() - homes.size();
  return settle(scene, simulator, radius, [&](const std::vector<BodyState>& states) {
    double farthest = 0;
    for (std::size_t i = 0; i < homes.size(); ++i) {
      farthest = std::max(farthest, distance_from(states[first + i].pose, homes[i], reach));
    }
    return farthest;
  });
}

Measurement standing(const Simulator& simulator, double step) {
  Scene scene = scene_for(step, rest_time);
  const Vec3 centre(0.1, -0.2, can_half_length - touching);
  const Pose home(centre, about(Vec3::UnitZ(), 0.3));
  const Vec3 pivot = centre + Vec3(0.6 * can_radius, 0.8 * can_radius, -can_half_length);
  const Pose start = turned_about(home, pivot, Vec3(-0.8, 0.6, 0), lean);
  scene.bodies = {ground(0.5), moving_body("can", can, 0.5, start)};
  return stay(scene, {home}, simulator);
}

/// A quarter of the cap's width hangs over the lower edge of a box whose slope is well within
/// friction. Lifted on that side, the can rocks in one plane and, without slip, returns to its
/// place.
Measurement standing_on_box(const Simulator& simulator, double step) {
  Scene scene = scene_for(step, rest_time);
  const Eigen::Quaterniond turn = about(Vec3::UnitZ(), 0.4) * about(Vec3::UnitY(), radians(3));
  const Vec3 half(0.4, 0.4, 0.3);
  const Vec3 on_box(half.x() - can_radius / 2, 0, half.z() + can_half_length - touching);
  const Pose home(turn * on_box, turn * about(Vec3::UnitZ(), 0.3));
  const Vec3 pivot = turn * (on_box + Vec3(-can_radius, 0, -can_half_length));
  const Pose start = turned_about(home, pivot, turn * Vec3::UnitY(), -lean);
  scene.bodies = {fixed_body("box", Box(half), 0.5, Pose(Vec3::Zero(), turn)),
                  moving_body("can", can, 0.5, start)};
  return stay(scene, {home}, simulator);
}

/// One end is lifted. Until it has landed, the rim of the other end needs a friction of 0.77 to
/// stick.
Measurement lying(const Simulator& simulator, double step) {
  Scene scene = scene_for(step, rest_time);
  const Vec3 centre(0.1, -0.2, can_radius - touching);
  const Eigen::Quaterniond turn = about(Vec3::UnitZ(), 0.4);
  const Pose home(centre, turn * level() * about(Vec3::UnitZ(), 0.7));
  const Vec3 pivot = centre + turn * Vec3(can_half_length, 0, -can_radius);
  const Pose start = turned_about(home, pivot, turn * Vec3::UnitY(), lean);
  scene.bodies = {ground(1), moving_body("can", can, 1, start)};
  return stay(scene, {home}, simulator);
}

constexpr double log_half_length = 4;  // in radii
constexpr double coin_radius = 0.1, coin_half_length = 0.01;

constexpr double stacked_half_length = can_radius;  // as high as wide
constexpr double max_offset = 0.1;                  // m, between stacked axes

Measurement stack(const Simulator& simulator, double step) {
  Scene scene = scene_for(step, rest_time);
  // With 200 the residual of the solver moved the bodies ten thousand times as far.
  scene.solver_iterations = 1000;
  const double half = stacked_half_length;
  scene.bodies = {ground(0.5)};
  const char* names[] = {"lowest", "middle", "highest"};
  const Vec3 offset[] = {Vec3::Zero(), Vec3(0.08, 0.03, 0), Vec3(0.02, -0.05, 0)};
  std::vector<Pose> homes;
  for (int i = 0; i < 3; ++i) {
    const double height = (2 * i + 1) * half - (i + 1) * middle_of_layer(scene);
    homes.emplace_back(offset[i] + height * Vec3::UnitZ(), about(Vec3::UnitZ(), 0.3 + i));
    scene.bodies.push_back(moving_body(names[i], Cylinder(can_radius, half), 0.5, homes.back()));
  }
  return stay(scene, homes, simulator);
}

/// A log, four times as long as wide, lies on a level box, where nothing but its roundness keeps
/// it.
Measurement log_on_box(double radius, const Simulator& simulator, double step) {
  Scene scene = scene_for(step, rest_time);
  const Vec3 half(1, 1, 0.25), centre(0.1, -0.2, half.z() + radius - touching);
  const Pose home(centre, about(Vec3::UnitZ(), 0.4) * level() * about(Vec3::UnitZ(), 0.7));
  scene.bodies = {fixed_body("box", Box(half), 0.5),
                  moving_body("log", Cylinder(radius, log_half_length * radius), 0.5, home)};
  return stay(scene, {home}, simulator, radius, log_half_length * radius);
}

/// Cans as high as wide, in line, upon a level box.
Measurement tower(int count, double radius, const Simulator& simulator, double step) {
  Scene scene = scene_for(step, rest_time);
  scene.solver_iterations = 1000;
  const double top = 0.25;
  scene.bodies = {fixed_body("box", Box(Vec3(1, 1, top)), 0.5)};
  std::vector<Pose> homes;
  for (int i = 0; i < count; ++i) {
    const double height = top + (2 * i + 1) * radius - (i + 1) * touching;
    homes.emplace_back(Vec3(0.1, -0.2, height), about(Vec3::UnitZ(), 0.3 + i));
    scene.bodies.push_back(
        moving_body("can-" + std::to_string(i + 1), Cylinder(radius, radius), 0.5, homes.back()));
  }
  return stay(scene, homes, simulator, radius, radius);
}

// A disc lies across a fixed log, turned with it about the vertical by many angles. It is stable,
// for its centre is nearer to the log than the log's axis.
constexpr double disc_half_length = 0.05, fixed_log_radius = 0.5, fixed_log_half_length = 1;

Measurement disc_on_log(const Simulator& simulator, double step) {
  Measurement worst{0, 0, {}};
  RunTally tally;
  for (int i = 0; i < 12; ++i) {
    Scene scene = scene_for(step, 1);
    const Eigen::Quaterniond turn = about(Vec3::UnitZ(), 0.1 + 0.26 * i);
    const Pose home((fixed_log_radius + disc_half_length - touching) * Vec3::UnitZ(), turn);
    scene.bodies = {fixed_body("log", Cylinder(fixed_log_radius, fixed_log_half_length), 0.5,
                               Pose(Vec3::Zero(), turn * level())),
                    moving_body("disc", Cylinder(can_radius, disc_half_length), 0.5, home)};
    const Measurement one = stay(scene, {home}, simulator);
    tally.add(one.tally);
    worst.value = std::max(worst.value, one.value);
    worst.error = std::max(worst.error, one.error);
  }
  worst.tally = tally;
  return worst;
}

/// A coin is let go with one side lifted by 25°; it falls and must lie flat.
Measurement settling_coin(const Simulator& simulator, double step) {
  Scene scene = scene_for(step, rest_time);
  const double r = coin_radius, h = coin_half_length, lean_of_coin = radians(25);
  const double height = h * std::cos(lean_of_coin) + r * std::sin(lean_of_coin) - touching;
  scene.bodies = {ground(0.5), moving_body("coin", Cylinder(r, h), 0.5,
                                           Pose(height * Vec3::UnitZ(),
                                                about(Vec3(0.8, 0.6, 0), lean_of_coin)))};
  return settle(scene, simulator, r, [&](const std::vector<BodyState>& states) {
    const Pose& now = states[1].pose;
    const double tilt = now.axis().cross(Vec3::UnitZ()).norm();
    return std::abs(now.position().z() - h) + r * tilt;
  });
}

// Resolutions, in radii of the can.

const double layer = Scene{}.surface_layer;

/// Height of the triangle of three equally spaced points around a round support, as a share of its
/// diameter: an exact answer may consist of just these.
constexpr double triangle = 0.75;

/// Standing on a support of this width, on whose far side the can lands.
double on_end(double width, double step) {
  const double gyration = can_gyration(can_radius, can_half_length);
  return (displacement_within_layer(layer, triangle * width, can_half_length, can_half_length) +
          displacement_of_late_landing(lean, can_radius, gyration, width, step)) /
         can_radius;
}

double on_its_side(double step) {
  const double gyration = can_gyration(can_radius, can_half_length), length = 2 * can_half_length;
  return (displacement_within_layer(layer, length, can_radius, can_half_length) +
          displacement_of_late_landing(lean, can_half_length, gyration, length, step)) /
         can_radius;
}

/// The highest cylinder leans with all below it.
double stacked(double) {
  const double width = triangle * (2 * can_radius - max_offset);
  double way = 0;
  for (const int below : {0, 1, 2}) {
    const double height = (2 * below + 1) * stacked_half_length;
    way += displacement_within_layer(layer, width, height, can_half_length);
  }
  return way / can_radius;
}

double log_resolution(double radius) {
  const double reach = log_half_length * radius;
  return displacement_within_layer(layer, 2 * reach, radius, reach) / radius;
}

double tower_resolution(int count, double radius) {
  double way = 0;
  for (int below = 0; below < count; ++below) {
    way +=
        displacement_within_layer(layer, triangle * 2 * radius, (2 * below + 1) * radius, radius);
  }
  return way / radius;
}

}  // namespace

std::vector<Experiment> resting_experiments() {
  const auto zero = [](double) { return 0.0; };
  const auto on_plane = [](double step) { return on_end(2 * can_radius, step); };
  const auto on_box = [](double step) { return on_end(1.5 * can_radius, step); };
  const char* const left = "kinetic energy that stays, in weight x radius";
  const char* const way = "radii from its place";
  return {
      {"standing", "Let go on end on a plane, leaning by 0.6°, it comes to stand where it was.",
       left, way, standing, zero, on_plane, true},
      {"standing-on-box",
       "A nudged cylinder on end, partly over the edges of a box tilted by 3°, stands still "
       "again.",
       left, way, standing_on_box, zero, on_box, true},
      {"lying",
       "On its side on a plane, let go with one end lifted by 0.6°, it comes to lie where it was.",
       left, way, lying, zero, on_its_side, true},
      {"stack", "Three cylinders on end, one upon another and not quite in line, stay for 10 s.",
       left, way, stack, zero, stacked, true}};
}

std::vector<Experiment> resting_in_engines() {
  const auto zero = [](double) { return 0.0; };
  const char* const left = "kinetic energy that stays, in weight x radius";
  const char* const way = "radii from its place";
  const auto log = [&](const char* name, const char* statement, double radius) {
    return Experiment{name,
                      statement,
                      left,
                      way,
                      std::bind_front(log_on_box, radius),
                      zero,
                      [radius](double) { return log_resolution(radius); },
                      true,
                      radius};
  };
  const auto tower_of = [&](const char* name, const char* statement, int count, double radius) {
    return Experiment{name,
                      statement,
                      left,
                      way,
                      std::bind_front(tower, count, radius),
                      zero,
                      [=](double) { return tower_resolution(count, radius); },
                      true,
                      radius};
  };
  const auto disc_resolution = [](double) {
    return displacement_within_layer(layer, 2 * can_radius, disc_half_length, can_radius) /
           can_radius;
  };
  const auto coin_resolution = [](double) { return (layer + 2 * layer) / coin_radius; };
  return {log("log", "A log of 0.3 m radius lies on a level box where it was put.", 0.3),
          log("small-log", "A log of 15 mm radius lies on a level box where it was put.", 0.015),
          tower_of("stack-of-five", "Five cans of 0.1 m radius, one upon another, stay for 10 s.",
                   5, 0.1),
          tower_of("stack-of-ten", "Ten cans of 30 mm radius, one upon another, stay for 10 s.", 10,
                   0.03),
          {"disc-on-log", "A disc across a fixed log stays, whichever way both are turned.", left,
           way, disc_on_log, zero, disc_resolution, true},
          {"settling", "A coin let go with one side lifted by 25° comes to lie flat.", left,
           "radii from lying flat", settling_coin, zero, coin_resolution, true, coin_radius}};
}

}  // namespace touchstone
