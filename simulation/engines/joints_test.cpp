// Joints, motors, rigid assemblies, belts and what does not touch in the engines' own worlds,
// against paper. Contacts are ours, so that what is tested is what the worlds make of a scene.
#include <cmath>
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <numbers>
#include <tuple>

#include "reference/invalid_input.hpp"
#include "simulation/mechanism_scenes.hpp"
#include "simulation/probed_run.hpp"

namespace touchstone {
namespace {

using std::numbers::pi;
constexpr double earth_gravity = 9.81;
/// Of a hinge from its limit or its place on paper, rad: MuJoCo's limits are soft.
constexpr double near_limit = 0.05;

Body ground() { return fixed({.name = "ground", .shape = Plane(Vec3::UnitZ(), 0)}); }
Joint slider(int a, int b, const Vec3& axis) {
  return {"slider", JointKind::slider, a, b, Vec3::Zero(), axis};
}
double mass_of(const Body& body) { return inertia(body.shape, body.density).mass; }

using States = std::vector<BodyState>;

class Joints : public testing::TestWithParam<std::string> {
 protected:
  bool is_mujoco() const { return GetParam() == "mujoco"; }
  bool is_single() const { return GetParam() == "bullet-float"; }

  /// What `probe` says after each step of a run in a process of its own.
  std::vector<double> run(const Scene& scene, const Probe& probe,
                          const EngineSetup& setup = {.cured = true}) const {
    return probed_run(scene, probe, in_engine(GetParam(), setup));
  }
  double end(const Scene& scene, const Probe& probe,
             const EngineSetup& setup = {.cured = true}) const {
    return run(scene, probe, setup).back();
  }
};
INSTANTIATE_TEST_SUITE_P(Each, Joints, testing::ValuesIn(all_engines()), [](const auto& param) {
  std::string name = param.param;
  std::erase(name, '-');
  return name;
});

// Small swings of a box about a hinge at its upper end: ω² = m g l / I (physical pendulum).
TEST_P(Joints, AHingedBoxSwingsWithThePeriodOfAPhysicalPendulum) {
  const double l = 0.5, amplitude = 0.02;
  for (const bool hangs_on_world : {true, false}) {
    Scene scene;
    scene.step = 1.0 / 1000;
    scene.duration = 2;
    scene.bodies = {box("pendulum", Vec3(0.05, 0.05, l), Pose()),
                    fixed(box("ceiling", Vec3(1, 1, 0.1), at(0, 0, 0.05)))};
    scene.bodies[0].pose = Pose(Vec3(l * std::sin(amplitude), 0, -l * std::cos(amplitude)),
                                Eigen::Quaterniond(Eigen::AngleAxisd(-amplitude, Vec3::UnitY())));
    scene.joints = {hinge(0, hangs_on_world ? world_body : 1, Vec3::Zero(), Vec3::UnitY())};
    if (hangs_on_world) scene.bodies.pop_back();
    const std::vector<double> x =
        run(scene, [](const States& s) { return s[0].pose.position().x(); });
    const Inertia i = inertia(scene.bodies[0].shape, 1000);
    const double omega = std::sqrt(i.mass * earth_gravity * l / (i.principal.y() + i.mass * l * l));
    const auto crossed = std::find_if(x.begin(), x.end(), [](double value) { return value <= 0; });
    EXPECT_NEAR(static_cast<double>(crossed - x.begin() + 1) * scene.step, pi / 2 / omega, 3e-3);
    // Back at the end that it came from after a whole period, and not farther.
    const double farthest =
        *std::max_element(x.begin() + std::lround(pi / omega / scene.step), x.end());
    EXPECT_NEAR(farthest, l * std::sin(amplitude), 0.03 * l * amplitude);
  }
}

/// A motor along or about z between two bodies; one may be fixed, the second the world.
struct MotorScene {
  JointKind kind;
  const char* fixed;

  Scene scene() const {
    Scene scene;
    scene.gravity = Vec3::Zero();
    scene.bodies = {box("a", Vec3(0.1, 0.2, 0.1), at(0, 0, 1)),
                    box("b", Vec3(0.2, 0.1, 0.1), at(0, 0, 0))};
    for (Body& body : scene.bodies) body.fixed = body.name == fixed;
    const int b = std::string(fixed) == "world" ? world_body : 1;
    scene.joints = {{"motor", kind, 0, b, Vec3::Zero(), Vec3::UnitZ()}};
    return scene;
  }
  /// Angle or way of the first body relative to the second, or to the world.
  double position(const States& states) const {
    const bool is_world = std::string(fixed) == "world";
    const Pose &a = states[0].pose, b = is_world ? Pose() : states[1].pose;
    return kind == JointKind::hinge ? angle_about_z(a) - angle_about_z(b)
                                    : a.position().z() - b.position().z() - 1;
  }
};

TEST_P(Joints, MotorsMoveTheFirstBodyRelativeToTheSecondWhicheverIsFixed) {
  for (const JointKind kind : {JointKind::hinge, JointKind::slider}) {
    for (const char* fixed : {"none", "a", "b", "world"}) {
      SCOPED_TRACE(fmt::format("{}, {}", joint_kind_name(kind), fixed));
      const MotorScene motor{kind, fixed};
      const auto relative = [&](const States& s) { return motor.position(s); };
      Scene scene = motor.scene();
      // As strong as an acceleration of 50 m/s² or rad/s² asks for; MuJoCo's limits yield to more.
      const Inertia i = inertia(scene.bodies[0].shape, 1000);
      const double force = 50 * (kind == JointKind::hinge ? i.principal.z() : i.mass);
      scene.joints[0].motor = rate(0.5, force);
      EXPECT_NEAR(end(scene, relative), 0.5, 5e-3) << "rate";
      scene.joints[0].motor = position(-0.4, force);
      EXPECT_NEAR(end(scene, relative), -0.4, 1e-3) << "position";
      scene.joints[0].motor = rate(0.5, force);
      scene.joints[0].lower = -0.1;
      scene.joints[0].upper = 0.3;
      EXPECT_NEAR(end(scene, relative), 0.3, 5e-3) << "limit";
    }
  }
}

TEST_P(Joints, HingesKeepTheirLimitsBeyondHalfATurn) {
  for (const auto& limits : far_limits) {
    for (const double speed : {-4.0, 4.0}) {
      for (const char* fixed : {"none", "a", "world"}) {
        SCOPED_TRACE(fmt::format("{} to {}, {}", limits.first, limits.second, fixed));
        const MotorScene motor{JointKind::hinge, fixed};
        Scene scene = motor.scene();
        scene.duration = 2.5;
        scene.joints[0].motor =
            rate(speed, 50 * inertia(scene.bodies[0].shape, 1000).principal.z());
        std::tie(scene.joints[0].lower, scene.joints[0].upper) = limits;
        double angle = 0;
        for (const double within_a_turn :
             run(scene, [&](const States& s) { return motor.position(s); })) {
          angle = nearest_turn(within_a_turn, angle);
        }
        // A start with a constant acceleration costs half of its time. Two free bodies are alike.
        const double acceleration = std::string(fixed) == "none" ? 100 : 50;
        const double free_way = speed * (scene.duration - std::abs(speed) / acceleration / 2);
        EXPECT_NEAR(angle, turned_within(limits, free_way), near_limit);
      }
    }
  }
}

TEST_P(Joints, AMotorFollowsAPositionBeyondHalfATurnTheWayItIsTold) {
  const MotorScene motor{JointKind::hinge, "b"};
  Scene scene = motor.scene();
  scene.joints[0].motor = position(3.6, 50 * inertia(scene.bodies[0].shape, 1000).principal.z());
  scene.joints[0].lower = -0.1;
  EXPECT_NEAR(nearest_turn(end(scene, [&](const States& s) { return motor.position(s); }), 3), 3.6,
              1e-3);
}

// v = F t / m and ω = M t / I.
TEST_P(Joints, AMotorPushesNoHarderThanItCan) {
  for (const JointKind kind : {JointKind::hinge, JointKind::slider}) {
    const bool turns = kind == JointKind::hinge;
    Scene scene = MotorScene{kind, "b"}.scene();
    const Inertia i = inertia(scene.bodies[0].shape, 1000);
    scene.joints[0].motor = rate(1000, 3 * (turns ? i.principal.z() : i.mass));
    const double speed = end(scene, [&](const States& s) {
      return turns ? s[0].angular_velocity.z() : s[0].velocity.z();
    });
    EXPECT_NEAR(speed, 3, 1e-2) << joint_kind_name(kind);
  }
}

TEST_P(Joints, APushHasItsImpulseWhateverTheStep) {
  Scene scene;
  scene.gravity = Vec3::Zero();
  scene.bodies = {box("a", Vec3::Constant(0.1), Pose())};
  const double mass = mass_of(scene.bodies[0]);
  for (const auto& [from, until] : {std::pair{0.1005, 0.1006}, {0.1234, 0.4321}}) {
    scene.pushes = {{.body = 0, .force = Vec3(2 * mass, 0, 0), .from = from, .until = until}};
    EXPECT_NEAR(end(scene, [](const States& s) { return s[0].velocity.x(); }), 2 * (until - from),
                is_single() ? 1e-6 : 1e-12);
  }
}

TEST_P(Joints, CountsThePointsThatTheSolverGets) {
  Scene scene;
  scene.bodies = {ground(),
                  box("brick", Vec3(0.1, 0.2, 0.3), at(5, 0, 0.3 - 5e-5)),
                  {.name = "can", .shape = Cylinder(0.2, 0.3), .pose = at(0, 0, 0.3 - 5e-5)}};
  const Contained ran = run_contained(
      [&] {
        const auto world = in_engine(GetParam(), {.cured = true})(scene);
        for (int i = 0; i < 10; ++i) world->step();  // Bullet finds a box's corners one by one
        return std::to_string(world->contacts().points);
      },
      max_engine_seconds);
  // Of the brick's face four, and of the can's cap three, in MuJoCo six.
  EXPECT_EQ(ran.text, is_mujoco() ? "10" : "7");
}

TEST_P(Joints, ALoadedMotorKeepsItsRate) {
  Scene scene = MotorScene{JointKind::slider, "b"}.scene();
  scene.gravity = Vec3(0, 0, -earth_gravity);
  scene.joints[0].motor = rate(0.2, 2 * earth_gravity * mass_of(scene.bodies[0]));
  const std::vector<double> z =
      run(scene, [](const States& s) { return s[0].pose.position().z(); });
  const std::size_t half = z.size() / 2;
  EXPECT_NEAR(z.back() - z[half - 1], 0.1, 1e-3);
}

// A lift carries a can, and is stronger or weaker than the weight of both by a tenth.
TEST_P(Joints, ABlockedMotorPressesWithItsMaxForce) {
  for (const double share : {0.9, 1.1}) {
    Scene scene;
    scene.duration = 2;
    scene.bodies = {box("lift", Vec3(0.2, 0.2, 0.02), at(0, 0, 1)),
                    {.name = "can", .shape = Cylinder(0.05, 0.1), .pose = at(0, 0, 1.12)}};
    const double weight = earth_gravity * (mass_of(scene.bodies[0]) + mass_of(scene.bodies[1]));
    scene.joints = {slider(0, world_body, Vec3::UnitZ())};
    scene.joints[0].motor = rate(0, share * weight);
    const double height = end(scene, [](const States& s) { return s[1].pose.position().z(); });
    // s = a t² / 2 with a = g / 10 downwards; at rest otherwise.
    const double expected = share < 1 ? 1.12 - earth_gravity / 10 * 2 : 1.12;
    EXPECT_NEAR(height, expected, share < 1 ? 0.2 : 0.02) << share;
  }
}

TEST_P(Joints, LimitsHoldWhatFallsOnThem) {
  Scene scene;
  scene.duration = 3;
  scene.bodies = {box("arm", Vec3(0.3, 0.03, 0.03), at(0.3, 0, 0)),
                  box("bead", Vec3(0.05, 0.05, 0.05), at(0, 2, 0))};
  scene.joints = {hinge(0, world_body, Vec3::Zero(), Vec3::UnitY()),
                  slider(1, world_body, Vec3::UnitZ())};
  scene.joints[0].lower = scene.joints[1].lower = -0.4;
  scene.joints[0].upper = scene.joints[1].upper = 0.4;
  const double angle = end(scene, [](const States& s) {
    return std::atan2(-s[0].pose.position().z(), s[0].pose.position().x());
  });
  EXPECT_NEAR(angle, 0.4, 0.02);
  EXPECT_NEAR(end(scene, [](const States& s) { return s[1].pose.position().z(); }), -0.4, 0.01);
}

// Nothing acts along the rod on which the bead sits.
TEST_P(Joints, ABeadOnARodThatSwingsAlongItselfStays) {
  Scene scene;
  Body rod = box("rod", Vec3(0.5, 0.02, 0.02), at(0, 0, 1));
  rod.drive = Oscillation{.amplitude = Vec3(0.1, 0, 0), .frequency = 2};
  scene.bodies = {box("bead", Vec3(0.05, 0.05, 0.05), at(0, 0, 1)), rod};
  scene.joints = {slider(0, 1, Vec3::UnitX())};
  const std::vector<double> x =
      run(scene, [](const States& s) { return s[0].pose.position().x(); });
  EXPECT_LT(*std::max_element(x.begin(), x.end()), 5e-3);
  EXPECT_GT(*std::min_element(x.begin(), x.end()), -5e-3);
}

TEST_P(Joints, AJoinedPairTumblesAsTheBoxThatItIs) {
  const auto [halves, whole] = TumblingBox();
  const double near = is_single() ? 1e-4 : 1e-8;
  for (int k = 0; k < 3; ++k) {
    const double middle = end(halves, [&](const States& s) {
      return (s[0].pose.position()[k] + s[1].pose.position()[k]) / 2;
    });
    EXPECT_NEAR(middle, end(whole, [&](const States& s) { return s[0].pose.position()[k]; }), near);
    const auto long_axis = [&](const States& s) { return s[0].pose.rotation()(k, 0); };
    EXPECT_NEAR(end(halves, long_axis), end(whole, long_axis), near);
  }
}

// A dumb-bell of two wheels on an axle rolls down a slope: a = g sin α / (1 + I / (m r²)).
TEST_P(Joints, AWheelsetRollsAsOneBody) {
  constexpr double slope = 0.1, radius = 0.1;
  Scene scene;
  scene.gravity = earth_gravity * Vec3(std::sin(slope), 0, -std::cos(slope));
  const Eigen::Quaterniond lying(Eigen::AngleAxisd(-pi / 2, Vec3::UnitX()));
  scene.bodies = {ground()};
  double mass = 0, moment = 0;
  for (const auto& [name, r, half, y] : {std::tuple{"left", radius, 0.02, 0.2},
                                         {"axle", 0.02, 0.18, 0.0},
                                         {"right", radius, 0.02, -0.2}}) {
    scene.bodies.push_back(
        {.name = name, .shape = Cylinder(r, half), .pose = Pose(Vec3(0, y, radius), lying)});
    const Inertia i = inertia(scene.bodies.back().shape, 1000);
    mass += i.mass, moment += i.principal.z();
  }
  scene.joints = {rigid(1, 2), rigid(3, 2)};
  const double acceleration =
      earth_gravity * std::sin(slope) / (1 + moment / (mass * radius * radius));
  const double x = end(scene, [](const States& s) { return s[2].pose.position().x(); });
  EXPECT_NEAR(x, acceleration / 2, 0.01 * acceleration / 2);
}

TEST_P(Joints, EachPartOfWhatIsJoinedHasItsOwnFriction) {
  for (const bool ice_is_below : {true, false}) {
    Scene scene;
    scene.duration = 0.5;
    scene.bodies = {ground(), box("ice", Vec3(0.2, 0.2, 0.05), Pose()),
                    box("rubber", Vec3(0.2, 0.2, 0.05), Pose())};
    for (const int b : {1, 2}) {
      scene.bodies[b].pose = at(0, 0, (b == 1) == ice_is_below ? 0.05 : 0.15);
      scene.bodies[b].velocity = Vec3(1, 0, 0);
    }
    // Of two coefficients the geometric mean, in MuJoCo the larger.
    scene.bodies[0].material.friction = is_mujoco() ? 0 : 1;
    scene.bodies[1].material.friction = 0;
    scene.bodies[2].material.friction = 1;
    scene.joints = {rigid(2, 1)};
    const double speed = end(scene, [](const States& s) { return s[1].velocity.x(); });
    EXPECT_NEAR(speed, ice_is_below ? 1 : 0, 0.02);
  }
}

TEST_P(Joints, WhatIsKeptApartOrDoesNotCollidePassesThrough) {
  Scene scene;
  scene.duration = 0.5;
  scene.gravity = Vec3::Zero();
  scene.bodies = {box("flies", Vec3(0.1, 0.1, 0.1), at(0, 0, 0)),
                  box("tail", Vec3(0.1, 0.1, 0.1), at(-0.2, 0, 0)),
                  fixed(box("wall", Vec3(0.05, 1, 1), at(0.5, 0, 0)))};
  scene.joints = {rigid(1, 0)};
  for (const int b : {0, 1}) scene.bodies[b].velocity = Vec3(4, 0, 0);
  const auto x = [](const States& s) { return s[0].pose.position().x(); };
  const double before_the_wall = 0.4, at_the_wall = 0.6, through = 2;
  EXPECT_LT(end(scene, x), before_the_wall) << "touches";
  scene.apart = {{0, 2}};
  EXPECT_LT(end(scene, x), at_the_wall) << "the tail touches";
  scene.apart = {{0, 2}, {2, 1}};
  EXPECT_NEAR(end(scene, x), through, 1e-5);
  scene.apart.clear();
  scene.bodies[2].collides = false;
  EXPECT_NEAR(end(scene, x), through, 1e-5);
}

TEST_P(Joints, AGrainThatIsTooLightForMujocoIsRefusedThere) {
  const auto grain = [](double radius) {
    Scene scene;
    scene.bodies = {ground(),
                    {.name = "grain", .shape = Cylinder(radius, radius), .pose = at(0, 0, radius)}};
    return scene;
  };
  check_engine_scene(GetParam(), grain(1e-3));
  if (!is_mujoco()) return check_engine_scene(GetParam(), grain(1e-4));
  EXPECT_THAT([&] { check_engine_scene(GetParam(), grain(1e-4)); },
              testing::ThrowsMessage<InvalidInput>(testing::HasSubstr(
                  "bodies[1] is of 6.3e-09 kg and 3.1e-17 kg m²: must not be there")));
}

TEST_P(Joints, ABeltCarriesWhatLiesOnItWhicheverBodyComesFirst) {
  Body belt = fixed(
      box("belt", Vec3(5, 5, 0.1), Pose(Vec3(0, 0, -0.1), Eigen::Quaterniond(0.9, 0, 0, 0.4))));
  belt.surface_velocity = Vec3(0.3, 0.1, 0);
  Body can{.name = "can", .shape = Cylinder(0.05, 0.02), .pose = at(0, 0, 0.02)};
  for (const bool belt_is_first : {true, false}) {
    Scene scene;
    scene.bodies = belt_is_first ? std::vector{belt, can} : std::vector{can, belt};
    if (is_mujoco()) {
      EXPECT_THROW(check_engine_scene(GetParam(), scene), InvalidInput);
      continue;
    }
    const Vec3 expected = belt.pose.rotation() * belt.surface_velocity;
    for (int k = 0; k < 2; ++k) {
      const double speed =
          end(scene, [&](const States& s) { return s[belt_is_first ? 1 : 0].velocity[k]; });
      EXPECT_NEAR(speed, expected[k], 2e-3);
    }
    // Coulomb's friction while it slips.
    scene.bodies[belt_is_first ? 0 : 1].surface_velocity = Vec3(100, 0, 0);
    scene.duration = 0.25;
    const double speed =
        end(scene, [&](const States& s) { return s[belt_is_first ? 1 : 0].velocity.norm(); });
    EXPECT_NEAR(speed, 0.5 * earth_gravity * 0.25, 0.03);
  }
}

TEST_P(Joints, ADrumThatTurnsByMoreThanHalfATurnInAStepDragsTheRightWayOrIsRefused) {
  const Scene scene = fast_drum();
  if (GetParam().starts_with("bullet")) {
    EXPECT_THAT([&] { check_engine_scene(GetParam(), scene); },
                testing::ThrowsMessage<InvalidInput>(testing::HasSubstr(
                    "bodies[0].drive is 4.17 rad in a step: must not be there")));
    return;
  }
  const double speed = end(scene, [](const States& s) { return s[1].velocity.x(); });
  if (is_mujoco()) {
    EXPECT_GT(speed, 0) << "its pyramid of friction presses harder, the faster a surface slips";
  } else {
    EXPECT_NEAR(speed, 0.5 * earth_gravity * 0.1, 0.1);
  }
}

/// Two fingers on a driven hand squeeze a can, and the hand rises by 0.2 m.
Scene gripper(double squeeze) {
  Body hand = box("hand", Vec3(0.1, 0.02, 0.02), at(0, 0, 0.3));
  hand.drive = Waypoints{{0.5, at(0, 0, 0.3)}, {1.5, at(0, 0, 0.5)}};
  Scene scene;
  scene.duration = 1.5;
  scene.bodies = {
      hand,
      box("left", Vec3(0.01, 0.02, 0.05), at(-0.05, 0, 0.15)),
      box("right", Vec3(0.01, 0.02, 0.05), at(0.05, 0, 0.15)),
      {.name = "can", .shape = Cylinder(0.03, 0.06), .density = 500, .pose = at(0, 0, 0.15)},
      fixed(box("table", Vec3(0.2, 0.2, 0.045), at(0, 0, 0.045)))};
  scene.joints = {slider(1, 0, Vec3::UnitX()), slider(2, 0, -Vec3::UnitX())};
  for (Joint& joint : scene.joints) joint.motor = rate(0.2, squeeze);
  return scene;
}

TEST_P(Joints, AGripperHoldsACanByFrictionIfItSqueezesHardEnough) {
  // Friction 0.5 at two fingers must carry the weight.
  const double weight = earth_gravity * inertia(Cylinder(0.03, 0.06), 500).mass;
  const auto height = [](const States& s) { return s[3].pose.position().z(); };
  // Bullet's ten iterations let the can slip through fingers that are lighter than it.
  const bool slips = GetParam().starts_with("bullet");
  const double held = end(gripper(2 * weight), height);
  EXPECT_NEAR(held, slips ? 0.32 : 0.35, 0.01);
  EXPECT_NEAR(end(gripper(2 * weight), height, {.cured = true, .best_solver = true}), 0.35, 0.01);
  EXPECT_NEAR(end(gripper(0.5 * weight), height), 0.15, 0.01);
}

}  // namespace
}  // namespace touchstone
