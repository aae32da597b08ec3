#include "oracle/judge/cast_score.hpp"

#include <gtest/gtest.h>

namespace touchstone {
namespace {

/// A can of 1 m half length is let down by 8 m onto a unit sphere from 5 m: it touches at 3/8,
/// and is through at 7/8.
const Configuration over_sphere{Cylinder(0.5, 1), Pose(Vec3(0, 0, 5)), Sphere(1), Pose()};
const Sweep downwards(Vec3(0, 0, -8)), upwards(Vec3(0, 0, 8));

CastScore scored_cast(CastStatus status, double fraction, const Vec3& normal = Vec3::UnitZ(),
                      const Sweep& sweep = downwards, const Configuration& c = over_sphere) {
  return score_cast(c, sweep, oracle::first_touch(c, sweep), {status, fraction, normal}, Bar());
}

TEST(CastScore, OfTheFirstTouchAgrees) {
  const CastScore score = scored_cast(CastStatus::touch, 0.375);
  EXPECT_EQ(score.outcome, CastOutcome::agree);
  EXPECT_NEAR(*score.distance, 0, 1e-15);
  EXPECT_NEAR(*score.normal_regret, 0, 1e-15);
  // A millimetre of half a metre's radius is beyond a ten-thousandth, a hundredth of that is not.
  EXPECT_EQ(scored_cast(CastStatus::touch, 0.375 + 1e-5 / 8).outcome, CastOutcome::agree);
  EXPECT_EQ(scored_cast(CastStatus::touch, 0.375 - 1e-5 / 8).outcome, CastOutcome::agree);
}

TEST(CastScore, TooLateIsHowDeepItWent) {
  const CastScore score = scored_cast(CastStatus::touch, 0.375 + 0.001 / 8);
  EXPECT_EQ(score.outcome, CastOutcome::late);
  EXPECT_NEAR(*score.distance, -0.001 / 0.5, 1e-12);
  EXPECT_EQ(scored_cast(CastStatus::touch, 0.875).outcome, CastOutcome::late)
      << "on the other side";
  EXPECT_EQ(scored_cast(CastStatus::touch, 1).outcome, CastOutcome::late) << "and beyond";
  EXPECT_LT(*scored_cast(CastStatus::touch, 0.875).distance, -1);
}

TEST(CastScore, TooEarlyIsHowFarItWasAway) {
  const CastScore score = scored_cast(CastStatus::touch, 0.25);
  EXPECT_EQ(score.outcome, CastOutcome::early);
  EXPECT_NEAR(*score.distance, 1 / 0.5, 1e-12);
  EXPECT_EQ(scored_cast(CastStatus::from_start, 0).outcome, CastOutcome::early);
}

TEST(CastScore, NeverIsMissedByTheDepthOfTheWay) {
  const CastScore score = scored_cast(CastStatus::never, 1);
  EXPECT_EQ(score.outcome, CastOutcome::missed);
  EXPECT_NEAR(*score.distance, -1.5 / 0.5, 0.01);  // the sphere deepest in the side
  EXPECT_EQ(scored_cast(CastStatus::never, 1, Vec3::UnitZ(), upwards).outcome, CastOutcome::agree);
}

TEST(CastScore, OfNoTouchIsMadeUp) {
  EXPECT_EQ(scored_cast(CastStatus::touch, 0.5, Vec3::UnitZ(), upwards).outcome,
            CastOutcome::made_up);
  EXPECT_EQ(scored_cast(CastStatus::from_start, 0, Vec3::UnitZ(), upwards).outcome,
            CastOutcome::made_up);
}

TEST(CastScore, OfAnotherNormalIsWrong) {
  const CastScore score = scored_cast(CastStatus::touch, 0.375, Vec3(0.6, 0, 0.8));
  EXPECT_EQ(score.outcome, CastOutcome::wrong_normal);
  EXPECT_GT(*score.normal_regret, 0.1);
}

TEST(CastScore, ANormalThatIsNoneIsNotJudged) {
  const CastScore score = scored_cast(CastStatus::touch, 0.375, Vec3::Zero());
  EXPECT_EQ(score.outcome, CastOutcome::agree);
  EXPECT_FALSE(score.normal_regret);
}

TEST(CastScore, FromTheStartAgreesWhereBodiesOverlap) {
  const Configuration deep{Cylinder(0.5, 1), Pose(Vec3(0, 0, 1.75)), Sphere(1), Pose()};
  EXPECT_EQ(scored_cast(CastStatus::from_start, 0, Vec3::UnitZ(), downwards, deep).outcome,
            CastOutcome::agree);
  EXPECT_EQ(scored_cast(CastStatus::never, 1, Vec3::UnitZ(), downwards, deep).outcome,
            CastOutcome::missed);
  EXPECT_EQ(scored_cast(CastStatus::touch, 0.3, Vec3::UnitZ(), downwards, deep).outcome,
            CastOutcome::late);
}

TEST(CastScore, OfACoinThroughACoinIsLateOnTheOtherSide) {
  const Configuration coins{Cylinder(1, 1e-3), Pose(Vec3(0, 0, 1)), Cylinder(1, 1e-3), Pose()};
  EXPECT_EQ(scored_cast(CastStatus::touch, 0.3, Vec3::UnitZ(), downwards, coins).outcome,
            CastOutcome::late);
  EXPECT_EQ(scored_cast(CastStatus::never, 1, Vec3::UnitZ(), downwards, coins).outcome,
            CastOutcome::missed);
}

}  // namespace
}  // namespace touchstone
