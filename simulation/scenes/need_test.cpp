// Needs on made-up motions, whose values are known beforehand.
#include "simulation/scenes/need.hpp"

#include <cmath>
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <numbers>

#include "reference/invalid_input.hpp"
#include "simulation/scenes/scene_file.hpp"

namespace touchstone {
namespace {

constexpr double degree = std::numbers::pi / 180;

/// A ground (body 0) and two cylinders, can and pot (1 and 2), with one need.
SceneFile scene_with(const std::string& need) {
  return scene_from_text(fmt::format(R"({{
    "duration": 1,
    "bodies": [
      {{"name": "ground", "shape": {{"shape": "plane", "normal": [0, 0, 1], "displacement": 0}},
       "fixed": true}},
      {{"name": "can", "shape": {{"shape": "cylinder", "radius": 0.1, "half_length": 0.2}}}},
      {{"name": "pot", "shape": {{"shape": "cylinder", "radius": 0.1, "half_length": 0.2}}}}],
    "needs": [{{{}}}]}})",
                                     need),
                         "two.json");
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

/// A direction that leans from the vertical.
Vec3 upright(double degrees) { return {0, std::sin(degrees * degree), std::cos(degrees * degree)}; }

Verdict judged(const std::string& need, const Trajectory& run, const Trajectory& exact) {
  const SceneFile file = scene_with(need);
  return file.needs[0]->judge({file.scene, run, exact});
}
Verdict judged(const std::string& need, const Trajectory& run) { return judged(need, run, run); }

const Trajectory still = motion([](int, double) { return tilted(0); });

TEST(Needs, StandsMeasuresTheTiltWithinItsTime) {
  const Trajectory tilting = motion([](int, double t) { return tilted(10 * t); });
  const Verdict all = judged(R"("need":"stands","body":"can","degrees":5)", tilting);
  EXPECT_NEAR(all.value, 10, 1e-9);
  EXPECT_NEAR(all.time, 0.6, 1e-9);  // first beyond 5°
  EXPECT_FALSE(all.holds());
  EXPECT_NEAR(judged(R"("need":"stands","body":"can","degrees":5,"until":0.4)", tilting).value, 4,
              1e-9);
  EXPECT_TRUE(judged(R"("need":"stands","body":"can","degrees":5,"until":0.4)", tilting).holds());
  EXPECT_NEAR(judged(R"("need":"stands","body":"can","degrees":20,"from":0.8)", tilting).value, 10,
              1e-9);
}

TEST(Needs, StandsUpsideDownToo) {
  const Trajectory turned = motion([](int, double) { return tilted(177); });
  EXPECT_NEAR(judged(R"("need":"stands","body":"can","degrees":5)", turned).value, 3, 1e-9);
}

TEST(Needs, RollsIsAShareOfTheHorizontalDistance) {
  const Trajectory rolling = motion([](int, double t) { return tilted(0, Vec3(3 * t, 4 * t, t)); });
  EXPECT_NEAR(judged(R"("need":"rolls","body":"can","distance":4,"share":0.1)", rolling).value,
              0.25, 1e-12);
  EXPECT_NEAR(judged(R"("need":"rolls","body":"can","share":0.1)", rolling).value, 0, 1e-12);
  const Trajectory further = motion([](int, double t) { return tilted(0, Vec3(6 * t, 8 * t, 0)); });
  EXPECT_NEAR(judged(R"("need":"rolls","body":"can","share":0.1)", further, rolling).value, 1,
              1e-12);
}

TEST(Needs, WhatExactlyRollsNowhereMustNotRollEither) {
  const std::string rolls = R"("need":"rolls","body":"can","share":0.1)";
  EXPECT_EQ(judged(rolls, still).value, 0);
  const Trajectory rolling = motion([](int, double t) { return tilted(0, Vec3(0.01 * t, 0, 0)); });
  const Verdict verdict = judged(rolls, rolling, still);
  EXPECT_FALSE(verdict.holds());
  EXPECT_NEAR(verdict.value, 0.01 / (1e-6 * 0.2), 1e-6) << "of a millionth of its width";
}

TEST(Needs, RestsCountsSpeedAndSpinFromItsTime) {
  const Trajectory slowing = motion([](int body, double t) {
    BodyState s = tilted(0);
    if (body == 1) s.velocity = Vec3(1 - t, 0, 0);
    if (body == 2) s.angular_velocity = Vec3(0, 0, 2);
    return s;
  });
  EXPECT_NEAR(judged(R"("need":"rests","bodies":["can"],"speed":0.1,"by":0.5)", slowing).value, 0.5,
              1e-12);
  EXPECT_NEAR(judged(R"("need":"rests","bodies":["can","pot"],"speed":0.1,"by":1)", slowing).value,
              0.4, 1e-12);  // 2 rad/s on 0.2 m
}

TEST(Needs, RestsIsBrokenWhenTheFirstOfItsBodiesIsTooFast) {
  const Trajectory falling = motion([](int body, double t) {
    BodyState s = tilted(0);
    s.velocity = Vec3(0, 0, body == 1 ? -10 * t : -10 * t - 2);  // the pot is ahead of the can
    return s;
  });
  const Verdict verdict = judged(R"("need":"rests","bodies":["can","pot"],"speed":3.5)", falling);
  EXPECT_NEAR(verdict.time, 0.2, 1e-9);
  EXPECT_NEAR(verdict.value, 12, 1e-9);
  EXPECT_EQ(verdict.bodies, (std::array{2, -1})) << "the pot, first";
}

TEST(Needs, FallsInOrderCountsThoseOutOfPlace) {
  const Trajectory falling =
      motion([](int body, double t) { return tilted(t > 0.2 * body + 0.05 ? 90 : 0); });
  EXPECT_TRUE(judged(R"("need":"falls-in-order","bodies":["can","pot"])", falling).holds());
  const Verdict reversed = judged(R"("need":"falls-in-order","bodies":["pot","can"])", falling);
  EXPECT_EQ(reversed.value, 1);
  EXPECT_NEAR(reversed.time, 0.3, 1e-9);
  EXPECT_EQ(reversed.bodies, (std::array{1, -1})) << "the can, which had to wait for the pot";
  EXPECT_EQ(judged(R"("need":"falls-in-order","bodies":["can","pot"])", still).value, 2);
}

TEST(Needs, PenetrationAndNormalsAreOfThePairThatTheyName) {
  Trajectory run = still;
  run.answers = {{2, 1, 0, 0.01, TS_CONTACT, -0.01, upright(3), 1},
                 {4, 1, 2, 0.02, TS_NONE, 0, std::nullopt, 0},
                 {6, 1, 0, 0.03, TS_CONTACT, -0.01, upright(7), 1}};
  EXPECT_EQ(judged(R"("need":"penetration","metres":0.005)", run).value, 0.03);
  EXPECT_NEAR(judged(R"("need":"penetration","metres":0.005)", run).time, 0.2, 1e-9);
  EXPECT_EQ(judged(R"("need":"penetration","metres":0.005)", run).bodies, (std::array{1, 0}));
  EXPECT_EQ(judged(R"("need":"penetration","bodies":["pot","can"],"metres":0.005)", run).bodies,
            (std::array{-1, -1}))
      << "the need says it";
  EXPECT_EQ(judged(R"("need":"penetration","bodies":["pot","can"],"metres":0.005)", run).value,
            0.02);
  EXPECT_EQ(
      judged(R"("need":"penetration","bodies":["can","pot"],"metres":0.005,"from":0.5)", run).value,
      0);
  EXPECT_NEAR(judged(R"("need":"normals","bodies":["ground","can"],"degrees":5)", run).value, 7,
              1e-9);
  EXPECT_EQ(judged(R"("need":"normals","bodies":["can","pot"],"degrees":5)", run).value, 0);
}

// Out of a cylinder around the same axis every way across it is as short as any other.
TEST(Needs, AnglesOfNormalsAreToTheNearestOfAFamily) {
  for (int turn = 0; turn < 360; turn += 45) {
    Trajectory run = still;
    const Vec3 off(Eigen::AngleAxisd(turn * degree, Vec3::UnitZ()) * upright(87));
    run.answers = {{2, 1, 2, 0.2, TS_CONTACT, -0.2, off, 1}};
    const Verdict verdict = judged(R"("need":"normals","bodies":["can","pot"],"degrees":5)", run);
    EXPECT_NEAR(verdict.value, 3, 1e-9) << turn;
  }
}

// An exact run compared with itself meets any limit, and nothing else meets a tiny one.
TEST(Needs, RelativeOnesAllowWhatNobodyKnowsOfTheStart) {
  for (const char* limit :
       {R"("ends-near","body":"can","metres")", R"("ends-tilted","body":"can","degrees")",
        R"("rolls","body":"can","share")"}) {
    for (const double value : {0.0, 1e-300, 1e-6}) {
      const std::string need = fmt::format(R"("need":{}:{})", limit, value);
      EXPECT_THROW(scene_with(need), InvalidInput) << need;
    }
    EXPECT_NO_THROW(scene_with(fmt::format(R"("need":{}:0.1)", limit)));
  }
  EXPECT_NO_THROW(scene_with(R"("need":"rolls","body":"can","distance":1,"share":0)"));
}

TEST(Needs, EndsAreHeldAgainstTheExactRun) {
  const Trajectory moved = motion([](int, double t) { return tilted(20 * t, Vec3(0, 0, t)); });
  EXPECT_NEAR(judged(R"("need":"ends-near","body":"can","metres":0.1)", moved, still).value, 1,
              1e-12);
  EXPECT_NEAR(judged(R"("need":"ends-tilted","body":"can","degrees":1)", moved, still).value, 20,
              1e-9);
  EXPECT_EQ(judged(R"("need":"ends-near","body":"can","metres":0.1)", moved, moved).value, 0);
}

TEST(Needs, StaysInMeasuresHowFarOutside) {
  const Trajectory leaving = motion([](int, double t) { return tilted(0, Vec3(t, 0, 0)); });
  const Verdict verdict =
      judged(R"("need":"stays-in","body":"can","lower":[-1,-1,-1],"upper":[0.45,1,1])", leaving);
  EXPECT_NEAR(verdict.value, 0.55, 1e-12);
  EXPECT_NEAR(verdict.time, 0.5, 1e-9);
}

TEST(Needs, AreBrokenByAMotionThatIsUnsoundOrNotANumber) {
  Trajectory absurd = still;
  absurd.sound = false;
  EXPECT_FALSE(judged(R"("need":"stands","body":"can","degrees":5)", absurd).holds());
  const Trajectory no_number = motion([](int, double) {
    BodyState s = tilted(0);
    s.velocity.x() = std::nan("");
    return s;
  });
  EXPECT_FALSE(judged(R"("need":"rests","bodies":["can"],"speed":1)", no_number).holds());
}

TEST(Needs, AnUnsoundRunBreaksWhatHeldAtItsEnd) {
  Trajectory absurd = motion([](int body, double t) { return tilted(body == 1 ? 10 * t : 0); });
  absurd.sound = false;
  const Verdict broken_before = judged(R"("need":"stands","body":"can","degrees":5)", absurd);
  EXPECT_NEAR(broken_before.time, 0.6, 1e-9);
  EXPECT_FALSE(broken_before.holds());
  for (const char* held : {R"("need":"stands","body":"pot","degrees":5)",
                           R"("need":"stands","body":"can","degrees":5,"until":0.3)",
                           R"("need":"penetration","metres":1)"}) {
    const Verdict verdict = judged(held, absurd);
    EXPECT_NEAR(verdict.time, absurd.end(), 1e-9) << held;
    EXPECT_FALSE(verdict.holds()) << held;
  }
}

TEST(Verdicts, ShareOfALimitOfZeroIsAboveOneWhenBroken) {
  EXPECT_EQ((Verdict{0, 0, 0}.share()), 0);
  EXPECT_EQ((Verdict{2, 0, 0}.share()), 3);
  EXPECT_EQ((Verdict{1, 2, 0}.share()), 0.5);
}

}  // namespace
}  // namespace touchstone
