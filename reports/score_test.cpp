#include "reports/score.hpp"

#include <cmath>
#include <gtest/gtest.h>
#include <limits>

#include "reports/statistics.hpp"

namespace touchstone {
namespace {

/// A can of size 0.5 standing on a box, 1e-3 deep: truth −1e-3 along z, −2e-3 of the size.
const Configuration standing{Cylinder(0.5, 1),
                             Pose(Vec3(0, 0, 1.999), Eigen::Quaterniond::Identity()),
                             Box(Vec3(2, 2, 1)), Pose()};

ts_answer contact(double signed_distance, const Vec3& normal) {
  ts_answer a{};
  a.status = TS_CONTACT;
  a.signed_distance = signed_distance;
  for (int i = 0; i < 3; ++i) a.normal[i] = normal[i];
  a.point_count = 1;
  a.points[0] = {{0, 0, 1}, {normal.x(), normal.y(), normal.z()}, -signed_distance};
  return a;
}

ts_answer none() {
  ts_answer a{};
  a.status = TS_NONE;
  return a;
}

Score scored(const Configuration& c, const ts_answer& a, const Bar& bar = {}) {
  return score(c, oracle::truth(c), a, bar);
}

Configuration lifted(double by) {
  return {standing.a,
          Pose(standing.pose_a.position() + Vec3(0, 0, by), standing.pose_a.orientation()),
          standing.b, standing.pose_b};
}

const Vec3 up(0, 0, 1);

TEST(Score, TheRightAnswerAgreesWithNoError) {
  const Score s = scored(standing, contact(-1e-3, up));
  EXPECT_EQ(s.outcome, Outcome::agree);
  EXPECT_NEAR(*s.depth_error, 0, 1e-12);
  EXPECT_NEAR(*s.normal_regret, 0, 1e-12);
  EXPECT_NEAR(*s.normal_angle, 0, 1e-12);
  EXPECT_EQ(s.points, 1);
}

TEST(Score, OutcomesAreNamedAfterTheSymptom) {
  EXPECT_EQ(scored(standing, none()).outcome, Outcome::missed);
  EXPECT_EQ(scored(standing, contact(-0.5e-3, up)).outcome, Outcome::shallow);
  EXPECT_EQ(scored(standing, contact(-2e-3, up)).outcome, Outcome::overdeep);
  EXPECT_EQ(scored(standing, contact(-1e-3, -up)).outcome, Outcome::wrong_normal);
  EXPECT_EQ(scored(standing, contact(-1e-3, Vec3(0, 0, 2))).outcome, Outcome::wrong_normal);
  EXPECT_EQ(scored(standing, contact(-1e-3, Vec3::Zero())).outcome, Outcome::wrong_normal);
  EXPECT_EQ(scored(lifted(0.1), contact(-1e-3, up)).outcome, Outcome::phantom);
  EXPECT_EQ(scored(lifted(0.1), none()).outcome, Outcome::agree);
  ts_answer broken = none();
  broken.status = TS_FAILED;
  EXPECT_EQ(scored(standing, broken).outcome, Outcome::failed);
  broken.status = TS_UNSUPPORTED;
  EXPECT_EQ(scored(standing, broken).outcome, Outcome::unsupported);
}

TEST(Score, NotANumberAnywhereIsNotFinite) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(scored(standing, contact(nan, up)).outcome, Outcome::not_finite);
  EXPECT_EQ(scored(standing, contact(-1e-3, Vec3(0, nan, 1))).outcome, Outcome::not_finite);
  ts_answer in_point = contact(-1e-3, up);
  in_point.points[0].position[1] = std::numeric_limits<double>::infinity();
  EXPECT_EQ(scored(standing, in_point).outcome, Outcome::not_finite);
}

TEST(Score, ErrorsAreRelativeToTheSmallerSize) {
  const Score s = scored(standing, contact(-0.5e-3, up));
  EXPECT_NEAR(*s.depth_error, 0.5e-3 / 0.5, 1e-12);
  EXPECT_NEAR(s.severity, 1e-3, 1e-12);
}

TEST(Score, ReversedNormalRegretsTheWholeWayThrough) {
  // Along −z the bodies overlap by 2·1 + 2·1 − 1e-3.
  EXPECT_NEAR(*scored(standing, contact(-1e-3, -up)).normal_regret, (4 - 2e-3) / 0.5, 1e-9);
}

TEST(Score, WhatIsWithinTheBarMayBeMissed) {
  const Configuration touching = lifted(1e-3 - 2e-5);  // 4e-5 of the size deep
  EXPECT_EQ(scored(touching, none()).outcome, Outcome::agree);
  EXPECT_EQ(scored(touching, none(), {.tolerance = 1e-6, .threshold = 0}).outcome, Outcome::missed);
}

TEST(Score, ThresholdAllowsContactsThatFarApart) {
  const Configuration apart = lifted(0.011);
  EXPECT_EQ(scored(apart, contact(0.01, up)).outcome, Outcome::phantom);
  EXPECT_EQ(scored(apart, contact(0.01, up), {.tolerance = 1e-4, .threshold = 0.02}).outcome,
            Outcome::agree);
}

TEST(Statistics, QuantilesAreNearestRank) {
  std::vector<double> values;
  for (int i = 200; i >= 1; --i) values.push_back(i);
  const Quantiles q = *quantiles(values);
  EXPECT_EQ(q.median, 100);
  EXPECT_EQ(q.p99, 198);
  EXPECT_EQ(q.max, 200);
  EXPECT_EQ(quantiles({7})->p99, 7);
  EXPECT_FALSE(quantiles({}));
}

TEST(Statistics, CountsOutcomesAndPoints) {
  const Statistics s = statistics({scored(standing, contact(-1e-3, up)),
                                   scored(standing, contact(-2e-3, up)), scored(standing, none())});
  EXPECT_EQ(s.count, 3u);
  EXPECT_EQ(s.of(Outcome::agree), 1u);
  EXPECT_EQ(s.of(Outcome::overdeep), 1u);
  EXPECT_EQ(s.of(Outcome::missed), 1u);
  EXPECT_EQ(s.points.at(1), 2u);
  EXPECT_NEAR(s.depth_error->max, 2e-3, 1e-12);
}

}  // namespace
}  // namespace touchstone
