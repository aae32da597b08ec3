#include "reports/trends.hpp"

#include <cmath>
#include <gtest/gtest.h>

#include "candidates/candidates.hpp"
#include "reports/make_report.hpp"

namespace touchstone {
namespace {

Configuration turned(double angle, const Shape& b) {
  const Eigen::Quaterniond q(std::cos(angle / 2), std::sin(angle / 2), 0, 0);
  return {Cylinder(0.5, 2), Pose(Vec3(3, 0, 4), q), b, Pose()};
}

TEST(Variables, TiltIsMeasuredFromParallelAndFromPerpendicular) {
  const double quarter = std::acos(0.0);
  const Shape plane = Plane(Vec3(0, 0, 2), 0);
  for (const double tilt : {1e-9, 1e-3, 0.7}) {
    for (const Shape& b : {plane, Shape(Capsule(1, 1)), Shape(Cylinder(1, 1))}) {
      EXPECT_NEAR(*value_of(Variable::tilt, turned(tilt, b), -1), tilt, 1e-15);
      EXPECT_NEAR(*value_of(Variable::tilt, turned(quarter - tilt, b), -1), tilt, 1e-15);
    }
  }
  EXPECT_FALSE(value_of(Variable::tilt, turned(1, Sphere(1)), -1));
  // Of a box's axes the nearest counts: turned about x, the cylinder stays perpendicular to x.
  const Shape box = Box(Vec3(1, 1, 1));
  EXPECT_EQ(*value_of(Variable::tilt, turned(0.7, box), -1), 0);
  const Eigen::Quaterniond skew(1, 0.1, 0.2, 0);
  const Configuration c{Cylinder(0.5, 2), Pose(Vec3(0, 0, 0), skew), box, Pose()};
  EXPECT_NEAR(*value_of(Variable::tilt, c, -1), std::asin(0.2 / 1.05), 1e-15);
}

TEST(Variables, AreRelativeToSize) {
  const Configuration c = turned(0, Box(Vec3(1, 1, 10)));
  EXPECT_DOUBLE_EQ(*value_of(Variable::depth, c, -0.1), 0.2);
  EXPECT_FALSE(value_of(Variable::depth, c, 0.1));
  EXPECT_DOUBLE_EQ(*value_of(Variable::aspect, c, -0.1), 10);
  EXPECT_DOUBLE_EQ(*value_of(Variable::aspect, turned(0, Plane(Vec3(0, 0, 1), 0)), -0.1), 4);
  EXPECT_DOUBLE_EQ(*value_of(Variable::distance, c, -0.1), 0.5);
}

TEST(Trends, HaveTheLastDecadeForWhatIsBeyondTheLargestDouble) {
  Score missed;
  missed.outcome = Outcome::missed;
  missed.severity = 1;
  TrendTally tally;
  tally.add({Cylinder(1e-9, 1e-9), Pose(Vec3(1e300, 0, 0)), Sphere(1e-9), Pose()}, -1e-9, {missed});
  std::vector<int> decades;
  for (const Trend& trend : tally.trends("cylinder-sphere", "extreme", {"far"})) {
    if (trend.variable == "distance") decades.push_back(trend.bins.at(0).decade.value());
  }
  EXPECT_EQ(decades, std::vector{308});
}

TEST(Trends, EveryJudgedAnswerLiesInOneDecade) {
  Campaign campaign;
  campaign.pairs = {Pair::plane, Pair::sphere};
  campaign.classes = {"general-shallow", "far-from-origin"};
  campaign.candidates = find_candidates({"reference", "capsule"});
  campaign.count = 5;
  std::size_t missed = 0;
  for (const Trend& trend : make_report(campaign, "x").trends) {
    EXPECT_FALSE(trend.pair == "cylinder-sphere" && trend.variable == "tilt");
    std::size_t count = 0;
    for (const TrendBin& bin : trend.bins) {
      count += bin.count;
      EXPECT_LE(bin.missed, bin.count);
      EXPECT_LE(bin.median, bin.max);
      if (trend.variable == "distance") missed += bin.missed;
    }
    if (trend.variable != "depth") {
      EXPECT_EQ(count, 5u);  // one class in each group
    }
  }
  // The inscribed capsule misses the shallow contacts at the rim.
  EXPECT_GT(missed, 0u);
}

}  // namespace
}  // namespace touchstone
