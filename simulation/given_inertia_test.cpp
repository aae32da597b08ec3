// Bodies whose mass is not spread evenly over their shapes, in our own world and in the engines',
// against paper.
#include <algorithm>
#include <cmath>
#include <gmock/gmock.h>
#include <numbers>

#include "simulation/assembly.hpp"
#include "simulation/each_world.hpp"
#include "simulation/mechanism_scenes.hpp"

namespace touchstone {
namespace {

using std::numbers::pi;
using testing::HasSubstr;
constexpr double gravity_on_earth = 9.81;

Eigen::Quaterniond about(const Vec3& axis, double angle) {
  return Eigen::Quaterniond(Eigen::AngleAxisd(angle, axis));
}
/// The local x axis of the result lies along y.
Eigen::Quaterniond x_to_y() { return about(Vec3::UnitZ(), pi / 2); }

Eigen::Matrix3d moments(const Eigen::Matrix3d& axes, const Vec3& principal) {
  return axes * principal.asDiagonal() * axes.transpose();
}

TEST(GivenInertia, IsInTheFrameOfTheBody) {
  Scene scene;
  scene.bodies = {box("a", Vec3(0.3, 0.2, 0.1), {Vec3(1, 2, 3), {0.5, 0.1, -0.7, 0.3}})};
  const PosedInertia given{{2, Vec3(0.3, 0.4, 0.5)}, {Vec3(0.1, -0.2, 0.05), {0.8, 0.4, 0, 0.1}}};
  scene.bodies[0].inertia = given;
  const Assembly all = assemblies(scene).at(0);
  const Pose& X_WB = scene.bodies[0].pose;
  EXPECT_NEAR(all.inertia.mass, 2, 1e-15);
  const Vec3 centre = X_WB.position() + X_WB.rotation() * given.X_BC.position();
  EXPECT_LT((all.X_WF.position() - centre).norm(), 1e-15);
  EXPECT_LT((moments(all.X_WF.rotation(), all.inertia.principal) -
             moments(X_WB.rotation() * given.X_BC.rotation(), given.inertia.principal))
                .norm(),
            1e-15);
  const BodyState back = state_within(start_of(all, scene), all.X_FB[0]);
  EXPECT_LT((back.pose.position() - X_WB.position()).norm(), 1e-15);
  EXPECT_LT((back.pose.rotation() - X_WB.rotation()).norm(), 1e-14);
}

TEST(GivenInertia, OfTheFirstBodyStandsForAllThatIsJoinedToIt) {
  Scene scene;
  scene.bodies = {box("hull", Vec3(0.3, 0.2, 0.1), at(0, 0, 1)),
                  box("mast", Vec3(0.1, 0.1, 0.5), at(0, 0, 2))};
  scene.joints = {rigid(1, 0)};
  scene.bodies[0].inertia = {{5, Vec3(0.3, 0.4, 0.5)}, at(0, 0, -0.2)};
  scene.bodies[1].inertia = PosedInertia{{0, Vec3::Zero()}};
  check_scene(scene);
  const Assembly all = assemblies(scene).at(0);
  EXPECT_NEAR(all.inertia.mass, 5, 1e-15);
  EXPECT_LT((all.X_WF.position() - Vec3(0, 0, 0.8)).norm(), 1e-15);
  EXPECT_LT((moments(all.X_WF.rotation(), all.inertia.principal) -
             moments(Eigen::Matrix3d::Identity(), Vec3(0.3, 0.4, 0.5)))
                .norm(),
            1e-15);
}

/// Why a scene of one body with this inertia is refused.
std::string refusal(const PosedInertia& given) {
  Scene scene;
  scene.bodies = {box("a", Vec3::Constant(0.1), Pose())};
  scene.bodies[0].inertia = given;
  return refusal_of(scene);
}

TEST(GivenInertia, ThatNoBodyCanHaveIsRefused) {
  const auto of_moments = [](double x, double y, double z) {
    return refusal({{1, Vec3(x, y, z)}});
  };
  EXPECT_EQ(of_moments(1, 1, 1), "accepted");
  EXPECT_EQ(of_moments(1, 1, 2.01), "accepted");  // a flat plate's, rounded
  EXPECT_EQ(of_moments(1, 1, 3),
            "bodies[0].inertia.moments is [1, 1, 3]: must be principal moments that a body can "
            "have: they are not if one is larger than the sum of the others");
  EXPECT_THAT(of_moments(1, 0, 1), HasSubstr("not if one is not positive"));
  EXPECT_THAT(of_moments(1, std::nan(""), 1), HasSubstr("not if one is not finite"));
  EXPECT_THAT(of_moments(1, 1e-13, 1), HasSubstr("next to nothing beside another"));
  EXPECT_THAT(of_moments(1e37, 1e37, 1e37), HasSubstr("must lie between 1e-36 and 1e+36"));
  EXPECT_THAT(refusal({{-1, Vec3(1, 1, 1)}}), HasSubstr("bodies[0].inertia.mass is -1: must lie"));
  EXPECT_THAT(refusal({{0, Vec3(1, 1, 1)}}), HasSubstr("bodies[0].inertia.mass is 0: must lie"));
  EXPECT_EQ(refusal({{0, Vec3::Zero()}}),
            "bodies[0].inertia.mass is 0: must be positive, unless a fixed joint makes a one with "
            "a body that has mass");
  EXPECT_THAT(refusal({{1, Vec3(1, 1, 1)}, at(0, 0, 1e7)}),
              HasSubstr("bodies[0].inertia.pose.position[2] is 10000000: must lie"));
}

using GivenInertiaIn = EachWorld;
INSTANTIATE_TEST_SUITE_P(Each, GivenInertiaIn, testing::ValuesIn(GivenInertiaIn::all()),
                         GivenInertiaIn::plain_name);

/// Right-handed angle about y.
double angle_about_y(const BodyState& s) {
  return std::atan2(s.pose.rotation()(0, 2), s.pose.rotation()(0, 0));
}

/// A small box about the origin, whose mass of 2 kg is 0.4 m below; of its principal moments the
/// first counts for a turn about y, and the last is a little larger than the sum of the others, as
/// rounding to two digits may make it.
Body weight_below() {
  Body body = box("pendulum", Vec3::Constant(0.05), Pose());
  body.inertia = {{2, Vec3(0.02, 0.3, 0.323)}, {Vec3(0, 0, -0.4), x_to_y()}};
  return body;
}
constexpr double weight_about_hinge = 0.02 + 2 * 0.4 * 0.4;

// ω² = m g l / I (physical pendulum).
TEST_P(GivenInertiaIn, MakesThePeriodOfAPendulumThatHangsAtItsShapesCentre) {
  for (const bool has_case : {false, true}) {
    Scene scene;
    scene.step = 1.0 / 1000;
    scene.bodies = {weight_below(), box("case", Vec3(0.1, 0.1, 0.3), at(0, 0, 0.2))};
    scene.bodies[1].inertia = PosedInertia{{0, Vec3::Zero()}};
    const Eigen::Quaterniond turn = about(Vec3::UnitY(), 0.02);
    for (Body& b : scene.bodies) b.pose = Pose(turn * b.pose.position(), turn);
    scene.joints = {hinge(0, world_body, Vec3::Zero(), Vec3::UnitY()), rigid(1, 0)};
    if (!has_case) scene.bodies.pop_back(), scene.joints.pop_back();
    const double omega = std::sqrt(2 * gravity_on_earth * 0.4 / weight_about_hinge);
    const double quarter =
        zero_crossing(run(scene), scene, [](const States& s) { return angle_about_y(s[0]); });
    EXPECT_NEAR(quarter, pi / 2 / omega, 3e-3) << has_case;
  }
}

// ω = M t / I about the hinge.
TEST_P(GivenInertiaIn, IsWhatAMotorTurns) {
  Scene scene;
  scene.gravity = Vec3::Zero();
  scene.duration = 0.5;
  scene.bodies = {weight_below()};
  scene.joints = {hinge(0, world_body, Vec3::Zero(), Vec3::UnitY())};
  scene.joints[0].motor = rate(1000, 2 * weight_about_hinge);
  EXPECT_NEAR(end(scene)[0].angular_velocity.y(), 1, 1e-2);
}

// The centre of mass moves straight on, and the shape's centre about it.
TEST_P(GivenInertiaIn, KeepsTheCentreOfMassOfASpinningBodyOnALine) {
  Scene scene;
  scene.gravity = Vec3::Zero();
  Body body = box("body", Vec3(0.2, 0.1, 0.1), Pose(Vec3(0, 0, 5), about(Vec3::UnitX(), 0.5)));
  const Vec3 arm(0.3, 0, 0.1), spin = body.pose.rotation() * Vec3(0, 6, 0), way(1, 0.5, -0.2);
  body.inertia = {{2, Vec3(0.1, 0.2, 0.25)}, {arm, x_to_y()}};
  body.angular_velocity = spin;
  body.velocity = way - spin.cross(body.pose.rotation() * arm);
  scene.bodies = {body};
  const Vec3 start = body.pose.position() + body.pose.rotation() * arm;
  const std::vector<States> all = run(scene);
  for (const States& states : all) {
    const Vec3 moved = states[0].pose.position() + states[0].pose.rotation() * arm - start;
    EXPECT_LT((moved - moved.dot(way) / way.squaredNorm() * way).norm(), 1e-3);
  }
  const BodyState& last = all.back()[0];
  EXPECT_LT((last.angular_velocity - spin).norm(), 0.02);  // Bullet's explicit gyroscopic term
  const Vec3 now = last.pose.rotation() * arm;
  EXPECT_LT((last.velocity + last.angular_velocity.cross(now) - way).norm(), 5e-3);
}

// A push acts at the shape's centre: v = F t / m of the centre of mass, ω = r × F t / I.
TEST_P(GivenInertiaIn, AnswersAPushAtTheShapesCentre) {
  constexpr double time = 0.025;
  Scene scene;
  scene.gravity = Vec3::Zero();
  scene.duration = 6 * scene.step;
  scene.bodies = {weight_below()};
  scene.pushes = {{0, Vec3(4, 0, 0), Vec3::Zero(), 0, time}};
  const BodyState pushed = end(scene)[0];
  const Vec3 arm = pushed.pose.rotation() * Vec3(0, 0, -0.4);
  const Vec3 of_centre = pushed.velocity + pushed.angular_velocity.cross(arm);
  EXPECT_NEAR(of_centre.x(), 4 * time / 2, 1e-3);
  EXPECT_NEAR(pushed.angular_velocity.y(), 0.4 * 4 * time / 0.02, 0.03);
}

/// A cylinder that lies on the ground, with its mass at a distance from its axis.
struct EccentricRoller {
  static constexpr double radius = 0.1, off = 0.04, mass = 3, moment = 0.02;

  /// Turned by this angle from where the mass is lowest.
  static Scene scene(double angle) {
    Scene scene;
    scene.step = 1.0 / 1000;
    scene.bodies = {fixed({.name = "ground", .shape = Plane(Vec3::UnitZ(), 0)}),
                    {.name = "roller", .shape = Cylinder(radius, 0.1)}};
    // Its axis along y; then x of the body is x of the world, and y of the body points down.
    const Eigen::Quaterniond lying = about(Vec3::UnitX(), -pi / 2);
    Body& roller = scene.bodies[1];
    roller.pose = Pose(Vec3(0, 0, radius), about(Vec3::UnitY(), angle) * lying);
    roller.inertia = {{mass, Vec3(0.03, 0.03, moment)}, at(0, off, 0)};
    for (Body& b : scene.bodies) b.material.friction = 1;
    return scene;
  }
  /// How far the mass is from below the axis, along x.
  static double aside(const States& s) { return s[1].pose.rotation()(0, 1); }
};

// Rolling about the line of contact, from which the mass is R − e away: ω² = m g e / (I + m (R −
// e)²).
TEST_P(GivenInertiaIn, RocksARollerAboutTheLowestPlaceOfItsMass) {
  using R = EccentricRoller;
  const double below = R::radius - R::off;
  const double omega =
      std::sqrt(R::mass * gravity_on_earth * R::off / (R::moment + R::mass * below * below));
  // The mass is on the side of −x, and rolls back to below the axis.
  const Scene scene = R::scene(0.05);
  const double quarter =
      zero_crossing(run(scene), scene, [](const States& s) { return -R::aside(s); });
  EXPECT_NEAR(quarter, pi / 2 / omega, 0.02 * pi / 2 / omega);
}

/// A can on a slope, with its mass at a height above its foot.
struct SlopingCan {
  static constexpr double radius = 0.05, half = 0.12;

  static Scene scene(double height_of_mass, double slope) {
    Scene scene;
    scene.duration = 2;
    scene.gravity = gravity_on_earth * Vec3(std::sin(slope), 0, -std::cos(slope));
    scene.bodies = {fixed({.name = "slope", .shape = Plane(Vec3::UnitZ(), 0)}),
                    {.name = "can", .shape = Cylinder(radius, half), .pose = at(0, 0, half)}};
    scene.bodies[1].inertia = {{1, Vec3(0.003, 0.003, 0.001)}, at(0, 0, height_of_mass - half)};
    for (Body& b : scene.bodies) b.material.friction = 2;
    return scene;
  }
  /// Radians.
  static double lean(const States& s) { return std::acos(std::min(1.0, s[1].pose.axis().z())); }
};

// A can tips where the mass is no longer above its foot: tan θ = r / h.
TEST_P(GivenInertiaIn, TipsACanAtTheAngleOfItsCentreOfMass) {
  const double share = is_mujoco() ? 0.2 : 0.05;  // its contacts are soft
  constexpr double stands = 0.03, tips = 0.5;     // rad
  for (const double height : {0.05, 0.2}) {
    const double paper = std::atan(SlopingCan::radius / height);
    const auto lean = [&](double angle) {
      return SlopingCan::lean(end(SlopingCan::scene(height, angle)));
    };
    EXPECT_LT(lean((1 - share) * paper), stands) << height;
    EXPECT_GT(lean((1 + share) * paper), tips) << height;
  }
}

using GivenInertiaInOurWorld = WorldFixture;

TEST_F(GivenInertiaInOurWorld, EnergyAndMomentumAreThoseOfTheMass) {
  Scene scene;
  scene.bodies = {weight_below()};
  scene.bodies[0].velocity = Vec3(0, 1, 0);
  scene.bodies[0].angular_velocity = Vec3(0, 3, 0);
  const World world(scene, model);
  const Vec3 v(-3 * 0.4, 1, 0);
  EXPECT_NEAR(world.kinetic_energy(), (2 * v.squaredNorm() + 0.02 * 9) / 2, 1e-12);
  EXPECT_LT((world.momentum() - 2 * v).norm(), 1e-12);
  const Vec3 about_origin = Vec3(0, 0, -0.4).cross(2 * v) + Vec3(0, 0.02 * 3, 0);
  EXPECT_LT((world.angular_momentum() - about_origin).norm(), 1e-12);
}

TEST_F(GivenInertiaInOurWorld, ARunOfATumblingBodyGainsNoEnergy) {
  Scene scene;
  scene.bodies = {weight_below()};
  scene.bodies[0].angular_velocity = Vec3(2, 3, 1);
  touchstone::Run fall(scene, in_our_world(model), 0.1);
  while (fall.step()) {
  }
  EXPECT_LT(fall.tally().energy_gained, 1e-4);
}

}  // namespace
}  // namespace touchstone
