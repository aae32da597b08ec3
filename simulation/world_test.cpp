#include <cmath>
#include <gmock/gmock.h>
#include <limits>
#include <utility>

#include "reference/error_of_test.hpp"
#include "simulation/each_world.hpp"

namespace touchstone {
namespace {

using testing::HasSubstr;

Pose at(double x, double y, double z) { return {Vec3(x, y, z), Eigen::Quaterniond::Identity()}; }
Body world_ground() { return {"ground", Plane(Vec3::UnitZ(), 0), 1000, {}, {}, {}, {}, true}; }

struct WorldTest : WorldFixture {
  /// Why a world is refused in which this is changed, or that it is accepted.
  template <class Spoil>
  std::string refusal(Spoil spoil) {
    Scene scene;
    scene.bodies = {world_ground(), {"can", Cylinder(0.2, 0.3)}};
    spoil(scene);
    return error_text_of([&] { World(scene, model).step(); });
  }

  /// Angular momentum and energy stay in a second, but for these shares.
  void expect_free_turning_keeps(const Body& body, double step, double of_spin, double of_energy) {
    Scene scene;
    scene.gravity = Vec3::Zero();
    scene.step = step;
    scene.bodies = {body};
    World world(scene, model);
    const Vec3 spin = world.angular_momentum();
    const double energy = world.kinetic_energy();
    for (int i = 0; i < std::lround(1 / step); ++i) world.step();
    EXPECT_LT((world.angular_momentum() - spin).norm(), of_spin * spin.norm());
    EXPECT_NEAR(world.kinetic_energy(), energy, of_energy * energy);
  }
};

TEST_F(WorldTest, FreeFlightKeepsMomentumAndStraightLines) {
  Scene scene;
  scene.gravity = Vec3::Zero();
  Body stick{"stick", Cylinder(0.2, 0.7)};
  stick.velocity = Vec3(1, -2, 0.5);
  stick.angular_velocity = Vec3(2, 1, 3);
  scene.bodies = {stick};
  World world(scene, model);
  const Vec3 before = world.momentum();
  for (int i = 0; i < 240; ++i) world.step();
  EXPECT_LT((world.momentum() - before).norm(), 1e-12 * before.norm());
  EXPECT_LT((world.states()[0].pose.position() - stick.velocity).norm(), 1e-12);
}

TEST_F(WorldTest, SpinAboutAPrincipalAxisKeepsItsEnergyAndMomentum) {
  Body wheel{"wheel", Cylinder(0.5, 0.1)};
  wheel.angular_velocity = Vec3(0, 0, 7);
  expect_free_turning_keeps(wheel, 1 / 240.0, 1e-10, 1e-10);
}

// ODE's own gyroscopic term loses 4e-3 of the angular momentum and 1e-3 of the energy here.
TEST_F(WorldTest, TumblingKeepsItsAngularMomentumAndNearlyItsEnergy) {
  Body stick{"stick", Cylinder(0.2, 0.7)};
  stick.angular_velocity = Vec3(2, 1, 3);
  expect_free_turning_keeps(stick, 1e-3, 1e-9, 1e-6);
}

// Semi-implicit Euler: after n steps v = -g h n and z = -g h² n (n + 1) / 2.
TEST_F(WorldTest, FallIsThatOfSemiImplicitEuler) {
  Scene scene;
  scene.bodies = {{"can", Cylinder(0.2, 0.3)}};
  const World world = run(scene);
  const double h = scene.step, n = 240;
  EXPECT_NEAR(world.states()[0].velocity.z(), -9.81 * h * n, 1e-10);
  EXPECT_NEAR(world.states()[0].pose.position().z(), -9.81 * h * h * n * (n + 1) / 2, 1e-10);
}

TEST_F(WorldTest, SphereBouncesWithItsRestitution) {
  Scene scene;
  scene.step = 1e-3;
  Body ball{"ball", Sphere(0.1), 1000, {0.5, 0.8}, at(0, 0, 0.6)};
  scene.bodies = {world_ground(), ball};
  World world(scene, model);
  double before = 0;
  while (world.states()[1].velocity.z() <= 0) {
    before = world.states()[1].velocity.z();
    world.step();
    ASSERT_LT(world.time(), 1);
  }
  EXPECT_NEAR(world.states()[1].velocity.z(), -0.8 * before, 1e-6);
}

TEST_F(WorldTest, StandingCylinderStays) {
  Scene scene;
  scene.duration = 10;
  scene.bodies = {world_ground(), {"can", Cylinder(0.3, 0.5), 1000, {}, at(0, 0, 0.49995)}};
  const BodyState end = run(scene).states()[1];
  EXPECT_LT((end.pose.position() - scene.bodies[1].pose.position()).norm(), 1e-6);
  EXPECT_LT((end.pose.axis() - Vec3::UnitZ()).norm(), 1e-6);
}

TEST_F(WorldTest, ContactsNameTheCylinderFirst) {
  Scene scene;
  scene.bodies = {world_ground(), {"can", Cylinder(0.3, 0.5), 1000, {}, at(0, 0, 0.4999)}};
  World world(scene, model);
  world.step();
  ASSERT_EQ(world.contacts().size(), 1U);
  EXPECT_EQ(world.contacts()[0].a, 1);
  EXPECT_EQ(world.contacts()[0].b, 0);
  EXPECT_EQ(world.contacts()[0].answer.point_count, 3);
}

TEST_F(WorldTest, SameSceneGivesTheSameBits) {
  Scene scene;
  scene.duration = 1;
  scene.bodies = {world_ground(),
                  {"can", Cylinder(0.2, 0.3), 1000, {}, at(0, 0, 0.7)},
                  {"box", Box(Vec3(0.2, 0.1, 0.1)), 1000, {}, at(0.1, 0.05, 0.2)}};
  const World first = run(scene), second = run(scene);
  for (int i = 1; i < 3; ++i) {
    EXPECT_EQ(first.states()[i].pose.position(), second.states()[i].pose.position());
    EXPECT_EQ(first.states()[i].angular_velocity, second.states()[i].angular_velocity);
  }
}

TEST_F(WorldTest, BadScenesAreRefusedByTheirField) {
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THAT(refusal([](Scene& s) { s.bodies.clear(); }), HasSubstr("bodies is empty"));
  EXPECT_THAT(refusal([](Scene& s) { s.bodies[1].density = 0; }), HasSubstr("bodies[1].density"));
  EXPECT_THAT(refusal([](Scene& s) { s.bodies[0].fixed = false; }), HasSubstr("bodies[0].fixed"));
  EXPECT_THAT(refusal([](Scene& s) { s.bodies[1].name = "ground"; }), HasSubstr("bodies[1].name"));
  EXPECT_THAT(refusal([](Scene& s) { s.bodies[1].velocity.y() = nan; }),
              HasSubstr("bodies[1].velocity[1] is nan"));
  EXPECT_THAT(refusal([](Scene& s) { s.bodies[1].material.friction = -1; }),
              HasSubstr("bodies[1].friction is -1"));
  EXPECT_THAT(refusal([](Scene& s) { s.bodies[1].material.restitution = 1.5; }),
              HasSubstr("bodies[1].restitution is 1.5"));
  EXPECT_THAT(refusal([](Scene& s) { s.gravity.x() = nan; }), HasSubstr("gravity[0] is nan"));
  EXPECT_THAT(refusal([](Scene& s) { s.step = 0; }), HasSubstr("step is 0"));
  EXPECT_THAT(refusal([](Scene& s) { s.duration = -1; }), HasSubstr("duration is -1"));
  EXPECT_THAT(refusal([](Scene& s) { s.surface_layer = -1; }), HasSubstr("surface_layer is -1"));
  EXPECT_THAT(refusal([](Scene& s) { s.solver_iterations = 0; }),
              HasSubstr("solver_iterations is 0"));
}

// Finite but absurd: ODE would end the process.
TEST_F(WorldTest, RefusesNumbersThatNoWorldHas) {
  const auto field = [&](auto spoil) {
    const std::string said = refusal(spoil);
    return said.substr(0, said.find(" is "));
  };
  const auto turned = [](double length) {
    return Pose(Vec3::Zero(), Eigen::Quaterniond(length, 0, 0, 0));
  };
  for (const double absurd : {1e200, 1e308, 1e16}) {
    EXPECT_EQ(field([&](Scene& s) { s.bodies[1].angular_velocity.x() = absurd; }),
              "bodies[1].angular_velocity[0]");
    EXPECT_EQ(field([&](Scene& s) { s.bodies[1].velocity.z() = -absurd; }),
              "bodies[1].velocity[2]");
    EXPECT_EQ(field([&](Scene& s) { s.bodies[1].pose = Pose(Vec3(0, absurd, 0)); }),
              "bodies[1].pose.position[1]");
    EXPECT_EQ(field([&](Scene& s) { s.gravity.y() = absurd; }), "gravity[1]");
    EXPECT_EQ(field([&](Scene& s) { s.step = absurd; }), "step");
    EXPECT_EQ(field([&](Scene& s) { s.step = 1 / absurd; }), "step");
    EXPECT_EQ(field([&](Scene& s) { s.surface_layer = absurd; }), "surface_layer");
    EXPECT_EQ(field([&](Scene& s) { s.bodies[1].density = absurd; }), "bodies[1].density");
    EXPECT_EQ(field([&](Scene& s) { s.bodies[1].density = 1 / absurd; }), "bodies[1].density");
    EXPECT_EQ(field([&](Scene& s) { s.bodies[1].shape = Sphere(absurd); }), "bodies[1].shape");
    EXPECT_EQ(field([&](Scene& s) { s.bodies[1].shape = Sphere(1 / absurd); }), "bodies[1].shape");
    EXPECT_EQ(field([&](Scene& s) { s.bodies[1].material.friction = absurd; }),
              "bodies[1].friction");
    EXPECT_EQ(field([&](Scene& s) { s.bodies[0].shape = Plane(Vec3(0, 0, 1), absurd); }),
              "bodies[0].shape.displacement");
  }
  // A rod whose moment of inertia about its axis is zero beside the others.
  EXPECT_EQ(field([](Scene& s) { s.bodies[1].shape = Box(Vec3(1e6, 1e-6, 1e-6)); }),
            "bodies[1].shape");
  EXPECT_EQ(field([&](Scene& s) { s.bodies[1].pose = turned(1e200); }),
            "bodies[1].pose.orientation");
  EXPECT_EQ(field([&](Scene& s) { s.bodies[1].pose = turned(1e-200); }),
            "bodies[1].pose.orientation");
  EXPECT_EQ(field([&](Scene& s) { s.bodies[1].pose = turned(1e80); }), "accepted");
  EXPECT_EQ(field([](Scene& s) { s.bodies[1].shape = Cylinder(1e6, 1e6); }), "accepted");
}

Scene two_cans_on_the_ground() {
  Scene scene;
  scene.bodies = {world_ground(),
                  {"left", Cylinder(0.2, 0.3), 1000, {}, at(-1, 0, 0.29995)},
                  {"right", Cylinder(0.2, 0.3), 1000, {}, at(1, 0, 0.29995)}};
  return scene;
}

/// Another model, and every question and answer in order.
class RecordingModel : public ContactModel {
 public:
  explicit RecordingModel(ContactModel& model) : model_(model) {}
  void begin() override { model_.begin(); }
  std::vector<Answer> answers(std::span<const PairQuestion> questions) override {
    auto result = model_.answers(questions);
    for (std::size_t i = 0; i < questions.size(); ++i) {
      record.emplace_back(questions[i], result[i]);
    }
    return result;
  }
  std::vector<std::pair<PairQuestion, Answer>> record;

 private:
  ContactModel& model_;
};

TEST_F(WorldTest, AsksWithTheNormalOfTheStepBefore) {
  RecordingModel recording(model);
  World world(two_cans_on_the_ground(), recording);
  for (int i = 0; i < 3; ++i) world.step();
  ASSERT_EQ(recording.record.size(), 6U);
  EXPECT_FALSE(recording.record[0].first.previous_normal.has_value());
  for (std::size_t i = 2; i < 6; ++i) {
    const auto& [question, answer] = recording.record[i];
    ASSERT_TRUE(question.previous_normal.has_value());
    EXPECT_LT((*question.previous_normal - Vec3::UnitZ()).norm(), 1e-12);
    EXPECT_EQ(answer.status, TS_CONTACT);
  }
}

/// Answers every question with the same single point.
class MadeUpModel : public ContactModel {
 public:
  explicit MadeUpModel(const ts_point& point) : point_(point) {}
  void begin() override {}
  std::vector<Answer> answers(std::span<const PairQuestion> questions) override {
    Answer answer{};
    answer.status = TS_CONTACT;
    answer.point_count = 1;
    answer.points[0] = point_;
    return std::vector<Answer>(questions.size(), answer);
  }

 private:
  ts_point point_;
};

TEST_F(WorldTest, IgnoresPointsThatAreNotNumbersAndCountsThem) {
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  for (const ts_point& point : {ts_point{{nan, 0, 0}, {0, 0, 1}, 0}, ts_point{{}, {0, 0, nan}, 0},
                                ts_point{{}, {0, 0, 0}, 0}, ts_point{{}, {0, 0, 1}, nan}}) {
    MadeUpModel made_up(point);
    World world(two_cans_on_the_ground(), made_up);
    world.step();
    EXPECT_EQ(world.unusable_points(), 2U);
    EXPECT_NEAR(world.states()[1].velocity.z(), -9.81 / 240, 1e-12);  // falls freely
  }
}

TEST_F(WorldTest, DoesNotStopWhatIsStillApart) {
  MadeUpModel made_up({{-1, 0, 0}, {0, 0, 1}, -1e-9});
  World world(two_cans_on_the_ground(), made_up);
  world.step();
  EXPECT_NEAR(world.states()[1].velocity.z(), -9.81 / 240, 1e-12);
}

/// A box and a can stand beside each other on the ground.
Scene box_and_can() {
  Scene scene = two_cans_on_the_ground();
  scene.bodies.pop_back();
  Body brick{"brick", Box(Vec3(0.1, 0.2, 0.3))};
  brick.pose = Pose(Vec3(5, 0, 0.3 - 1e-9));
  scene.bodies.push_back(brick);
  return scene;
}

TEST_F(WorldTest, CountsThePointsThatTheSolverGets) {
  World world(box_and_can(), model);
  world.step();
  EXPECT_EQ(world.points(), 4U + 3U) << "of the box's face and the can's cap";
  MadeUpModel apart({{-1, 0, 0}, {0, 0, 1}, -1e-9});
  World other(box_and_can(), apart);
  other.step();
  EXPECT_EQ(other.points(), 4U) << "the can's point is still apart";
  Scene flying = box_and_can();
  for (Body& body : flying.bodies) body.pose = Pose(body.pose.position() + Vec3(0, 0, 9));
  flying.bodies[0].pose = Pose();
  World above(flying, model);
  above.step();
  EXPECT_EQ(above.points(), 0U);
}

TEST_F(WorldTest, EndsAMotionBeyondAllBounds) {
  MadeUpModel made_up({{-1, 0, 0}, {0, 0, 1}, 1e9});
  World world(two_cans_on_the_ground(), made_up);
  world.step();
  world.step();
  EXPECT_FALSE(world.sound());
  EXPECT_TRUE(world.states()[1].pose.position().allFinite());
  world.step();
  EXPECT_NEAR(world.time(), 3.0 / 240, 1e-12);
}

}  // namespace
}  // namespace touchstone
