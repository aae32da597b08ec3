// Needs on motions that are made up, so that every value is known beforehand.
#include "simulation/scenes/need.hpp"

#include <cmath>
#include <gtest/gtest.h>
#include <numbers>

namespace touchstone {
namespace {

constexpr double degree = std::numbers::pi / 180;

Scene scene_of_two() {
  Scene scene;
  scene.duration = 1;
  scene.bodies = {{"ground", Plane(Vec3::UnitZ(), 0)},
                  {"can", Cylinder(0.1, 0.2)},
                  {"pot", Cylinder(0.1, 0.2)}};
  scene.bodies[0].fixed = true;
  return scene;
}

/// Eleven frames of a tenth of a second; `move` gives a body's state by body and time.
template <class Move>
Trajectory motion(Move move) {
  Trajectory t;
  t.step = 0.1;
  for (int i = 0; i <= 10; ++i) {
    std::vector<BodyState> frame;
    for (int body = 0; body < 3; ++body) frame.push_back(move(body, 0.1 * i));
    t.frames.push_back(frame);
  }
  return t;
}

BodyState tilted(double degrees, const Vec3& position = Vec3::Zero()) {
  const double half = degrees * degree / 2;
  return {{position, Eigen::Quaterniond(std::cos(half), std::sin(half), 0, 0)},
          Vec3::Zero(),
          Vec3::Zero()};
}

Verdict measured(const Need& need, const Trajectory& run, const Trajectory& exact) {
  return measure(need, scene_of_two(), run, exact);
}
Verdict measured(const Need& need, const Trajectory& run) { return measured(need, run, run); }

const Trajectory still = motion([](int, double) { return tilted(0); });

TEST(Needs, StandsMeasuresTheTiltWithinItsTime) {
  const Trajectory tilting = motion([](int, double t) { return tilted(10 * t); });
  const Verdict all = measured(Stands{1, 5, 0, 1}, tilting);
  EXPECT_NEAR(all.value, 10, 1e-9);
  EXPECT_NEAR(all.time, 0.6, 1e-9);  // first beyond 5°
  EXPECT_FALSE(all.holds());
  EXPECT_NEAR(measured(Stands{1, 5, 0, 0.4}, tilting).value, 4, 1e-9);
  EXPECT_TRUE(measured(Stands{1, 5, 0, 0.4}, tilting).holds());
  EXPECT_NEAR(measured(Stands{1, 20, 0.8, 1}, tilting).value, 10, 1e-9);
}

TEST(Needs, StandsUpsideDownToo) {
  const Trajectory turned = motion([](int, double) { return tilted(177); });
  EXPECT_NEAR(measured(Stands{1, 5, 0, 1}, turned).value, 3, 1e-9);
}

TEST(Needs, RollsIsAShareOfTheHorizontalDistance) {
  const Trajectory rolling = motion([](int, double t) { return tilted(0, Vec3(3 * t, 4 * t, t)); });
  EXPECT_NEAR(measured(Rolls{1, 4, 0.1}, rolling).value, 0.25, 1e-12);
  EXPECT_NEAR(measured(Rolls{1, {}, 0.1}, rolling).value, 0, 1e-12);
  const Trajectory further = motion([](int, double t) { return tilted(0, Vec3(6 * t, 8 * t, 0)); });
  EXPECT_NEAR(measured(Rolls{1, {}, 0.1}, further, rolling).value, 1, 1e-12);
}

TEST(Needs, RestsCountsSpeedAndSpinFromItsTime) {
  const Trajectory slowing = motion([](int body, double t) {
    BodyState s = tilted(0);
    if (body == 1) s.velocity = Vec3(1 - t, 0, 0);
    if (body == 2) s.angular_velocity = Vec3(0, 0, 2);
    return s;
  });
  EXPECT_NEAR(measured(Rests{{1}, 0.1, 0.5}, slowing).value, 0.5, 1e-12);
  EXPECT_NEAR(measured(Rests{{1, 2}, 0.1, 1}, slowing).value, 0.4, 1e-12);  // 2 rad/s on 0.2 m
}

TEST(Needs, FallsInOrderCountsThoseOutOfPlace) {
  const Trajectory falling =
      motion([](int body, double t) { return tilted(t > 0.2 * body + 0.05 ? 90 : 0); });
  EXPECT_TRUE(measured(FallsInOrder{{1, 2}, 45}, falling).holds());
  const Verdict reversed = measured(FallsInOrder{{2, 1}, 45}, falling);
  EXPECT_EQ(reversed.value, 1);
  EXPECT_NEAR(reversed.time, 0.3, 1e-9);
  EXPECT_EQ(measured(FallsInOrder{{1, 2}, 45}, still).value, 2);
}

TEST(Needs, PenetrationAndNormalsAreOfThePairThatTheyName) {
  Trajectory run = still;
  run.asked = {{2, 1, 0, 0.01, TS_CONTACT, -0.01, 3.0, 1},
               {4, 1, 2, 0.02, TS_NONE, 0, std::nullopt, 0},
               {6, 1, 0, 0.03, TS_CONTACT, -0.01, 7.0, 1}};
  EXPECT_EQ(measured(Penetration{{}, 0.005, 0}, run).value, 0.03);
  EXPECT_NEAR(measured(Penetration{{}, 0.005, 0}, run).time, 0.2, 1e-9);
  EXPECT_EQ(measured(Penetration{{2, 1}, 0.005, 0}, run).value, 0.02);
  EXPECT_EQ(measured(Penetration{{1, 2}, 0.005, 0.5}, run).value, 0);
  EXPECT_EQ(measured(Normals{{0, 1}, 5}, run).value, 7);
  EXPECT_EQ(measured(Normals{{1, 2}, 5}, run).value, 0);
}

TEST(Needs, EndsAreHeldAgainstTheExactRun) {
  const Trajectory moved = motion([](int, double t) { return tilted(20 * t, Vec3(0, 0, t)); });
  EXPECT_NEAR(measured(EndsNear{1, 0.1}, moved, still).value, 1, 1e-12);
  EXPECT_NEAR(measured(EndsTilted{1, 1}, moved, still).value, 20, 1e-9);
  EXPECT_EQ(measured(EndsNear{1, 0.1}, moved, moved).value, 0);
}

TEST(Needs, StaysInMeasuresHowFarOutside) {
  const Trajectory leaving = motion([](int, double t) { return tilted(0, Vec3(t, 0, 0)); });
  const StaysIn need{1, Vec3(-1, -1, -1), Vec3(0.45, 1, 1), 0, 0};
  const Verdict verdict = measured(need, leaving);
  EXPECT_NEAR(verdict.value, 0.55, 1e-12);
  EXPECT_NEAR(verdict.time, 0.5, 1e-9);
}

TEST(Needs, AreBrokenByAMotionThatBecomesAbsurdOrNoNumber) {
  Trajectory absurd = still;
  absurd.sound = false;
  EXPECT_FALSE(measured(Stands{1, 5, 0, 1}, absurd).holds());
  const Trajectory no_number = motion([](int, double) {
    BodyState s = tilted(0);
    s.velocity.x() = std::nan("");
    return s;
  });
  EXPECT_FALSE(measured(Rests{{1}, 1, 0}, no_number).holds());
}

TEST(Verdicts, ShareOfALimitOfZeroIsAboveOneWhenBroken) {
  EXPECT_EQ((Verdict{0, 0, 0}.share()), 0);
  EXPECT_EQ((Verdict{2, 0, 0}.share()), 3);
  EXPECT_EQ((Verdict{1, 2, 0}.share()), 0.5);
}

}  // namespace
}  // namespace touchstone
