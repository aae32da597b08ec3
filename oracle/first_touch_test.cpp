// When a moving cylinder touches first: on paper, proven from both sides, and by the second oracle.
//
// TOUCHSTONE_COUNT sets how many random sweeps of each pair are tried, by default 60.
#include "oracle/first_touch.hpp"

#include <cmath>
#include <gtest/gtest.h>
#include <limits>
#include <vector>

#include "oracle/audit/enclose.hpp"
#include "oracle/hull.hpp"
#include "reference/invalid_input.hpp"
#include "reference/random_casts_test.hpp"
#include "reference/support.hpp"

namespace touchstone::oracle {
namespace {

using Status = FirstTouch::Status;

const Eigen::Quaterniond as_given = Eigen::Quaterniond::Identity();
const Eigen::Quaterniond lying_along_y(1, -1, 0, 0);

/// The can of 1 m half length and half a metre's radius.
Configuration can_at(const Vec3& position, const Shape& b) {
  return {Cylinder(0.5, 1), Pose(position, as_given), b, Pose()};
}

const char* name_of(Status status) {
  constexpr const char* names[] = {"touch", "never", "from the start", "undecided"};
  return names[static_cast<int>(status)];
}

void expect_touch(const FirstTouch& found, const mpq_class& fraction) {
  ASSERT_EQ(found.status, Status::touch) << name_of(found.status);
  EXPECT_LE(found.fraction.lo, fraction);
  EXPECT_GE(found.fraction.hi, fraction);
  EXPECT_LE(found.fraction.width(), 1e-20);
}

TEST(SimplestFraction, IsTheOneOfTheLeastDenominator) {
  EXPECT_EQ(simplest_between(mpq_class(3, 10), mpq_class(4, 10)), mpq_class(1, 3));
  EXPECT_EQ(simplest_between(mpq_class(0), mpq_class(1, 10)), 0);
  EXPECT_EQ(simplest_between(mpq_class(9, 10), mpq_class(11, 10)), 1);
  EXPECT_EQ(simplest_between(mpq_class(7, 5), mpq_class(3, 2)), mpq_class(3, 2));
  EXPECT_EQ(simplest_between(mpq_class(314, 100), mpq_class(315, 100)), mpq_class(22, 7));
}

TEST(FirstTouch, OfACanLetDownIsExact) {
  // From 5 m, onto what reaches up to 1 m, by 9 m: at exactly a third.
  const Shape bodies[] = {
      Plane({0, 0, 2}, 2),
      Sphere(1),
      Capsule(0.5, 0.5),
      Cylinder(2, 1),
      Box({0.5, 0.5, 1}),
      convex_hull(std::vector<Vec3>{{-1, -1, 0}, {1, -1, 0}, {0, 1, 0}, {0, 0, 1}})};
  for (const Shape& b : bodies) {
    SCOPED_TRACE(shape_name(b));
    const FirstTouch found = first_touch(can_at({0, 0, 5}, b), Sweep({0, 0, -9}));
    expect_touch(found, mpq_class(1, 3));
    ASSERT_TRUE(found.there);
    ASSERT_EQ(found.there->normals.size(), 1U);
    EXPECT_EQ(found.there->normals[0].n, Vec3::UnitZ());
  }
}

TEST(FirstTouch, AtAnIrrationalTimeIsEnclosed) {
  // A rim at the height 1/2 above the middle of a unit sphere: at 5 − √3/2 of 8 m.
  const Configuration c{Cylinder(0.5, 0.25), Pose({-5.5, 0, 0.75}, as_given), Sphere(1), Pose()};
  const FirstTouch found = first_touch(c, Sweep({8, 0, 0}));
  ASSERT_EQ(found.status, Status::touch);
  EXPECT_LE(found.fraction.width(), 1e-20);
  // (5 − 8 t)² = 3/4
  const auto beyond = [](const mpq_class& t) -> mpq_class {
    return (5 - 8 * t) * (5 - 8 * t) - mpq_class(3, 4);
  };
  EXPECT_GE(beyond(found.fraction.lo), 0);
  EXPECT_LE(beyond(found.fraction.hi), 0);
  EXPECT_NEAR(found.there->normals[0].n.x(), -std::sqrt(0.75), 1e-15);
}

TEST(FirstTouch, NeverNeedsAProof) {
  const auto status = [](const Vec3& from, const Vec3& sweep) {
    return first_touch(can_at(from, Sphere(1)), Sweep(sweep)).status;
  };
  EXPECT_EQ(status({0, 0, 5}, {0, 0, 1}), Status::never) << "away";
  EXPECT_EQ(status({0, 0, 5}, {0, 0, 0}), Status::never) << "not at all";
  EXPECT_EQ(status({0, 0, 5}, {7, 0, 0}), Status::never) << "along a cap";
  EXPECT_EQ(status({0, 0, 5}, {0, 0, -2.9999999999999996}), Status::never) << "too short";
  EXPECT_EQ(status({0, 0, 5}, {0, 0, -3}), Status::touch) << "just long enough";
  EXPECT_EQ(status({0, 0, std::nextafter(2, 3)}, {1e300, 0, 0}), Status::never) << "by a hair";
}

TEST(FirstTouch, FromTheStartIsATouchOrAnOverlapThere) {
  for (const double height : {0.0, 1.5, 2.0}) {
    const FirstTouch found = first_touch(can_at({0, 0, height}, Sphere(1)), Sweep({0, 0, 4}));
    EXPECT_EQ(found.status, Status::from_start) << height;
    EXPECT_EQ(found.fraction.hi, 0);
    EXPECT_TRUE(found.there);
  }
}

TEST(FirstTouch, OfOneMomentIsDecidedAtSimpleTimes) {
  // A lying can passes over a sphere and is level with its top for one moment, at a third.
  const auto passing = [](double height) {
    const Configuration c{Cylinder(0.5, 1), Pose({-3, 0, height}, lying_along_y), Sphere(1),
                          Pose()};
    return first_touch(c, Sweep({9, 0, 0}));
  };
  expect_touch(passing(1.5), mpq_class(1, 3));
  EXPECT_EQ(passing(std::nextafter(1.5, 2)).status, Status::never);
  EXPECT_EQ(passing(std::nextafter(1.5, 1)).status, Status::touch);
}

TEST(FirstTouch, OfOneMomentAtNoSimpleTimeSaysThatItIsNotDecided) {
  // Level with the top of a sphere for one moment, at a fraction whose numerator has fifty digits.
  const Configuration c{Cylinder(0.5, 1), Pose({-3, 0, 1.5}, lying_along_y), Sphere(1),
                        Pose({1e-3, 0, 0}, as_given)};
  const FirstTouch level = first_touch(c, Sweep({7, 0.1, 0}));
  EXPECT_EQ(level.status, Status::undecided);
  EXPECT_LE(level.fraction.width(), 1e-20);
  EXPECT_NEAR(level.fraction.midpoint(), 3.001 / 7, 1e-15);
}

TEST(FirstTouch, SlidingAlongAFaceEndsAtTheFirstEdge) {
  // A box slides, level with the other's top, until its side would be beyond the edge: touching
  // from that moment on, for as long as it is above.
  const Configuration c{Cylinder(0.5, 1), Pose({-4, 0, 2}, as_given), Box({1, 1, 1}), Pose()};
  expect_touch(first_touch(c, Sweep({10, 0, 0})), mpq_class(1, 4));
}

TEST(FirstTouch, OfJoltIssue2103IsFromTheStart) {
  // A cylinder along y that Jolt's cast reported 7.25 m deep; it starts 4.4e-6 m deep.
  const Configuration c{
      Cylinder(0.4975, 0.3),
      Pose({-.951660156, -2.09155273, -7.63574218}, Eigen::Quaterniond(1, -1, 0, 0)),
      Capsule(7.19732189, 2.03114343), Pose(Vec3::Zero(), Eigen::Quaterniond(1, -1, 0, 0))};
  const FirstTouch found = first_touch(c, Sweep({.00244140625, -.0068359375, .0029296875}));
  ASSERT_EQ(found.status, Status::from_start);
  EXPECT_NEAR(found.there->signed_distance.midpoint(), -4.4e-6, 0.1e-6);
}

TEST(FirstTouch, RefusesAWidthThatIsNone) {
  const Configuration c = can_at({0, 0, 5}, Sphere(1));
  EXPECT_THROW(first_touch(c, Sweep({0, 0, 1}), 0), InvalidInput);
  EXPECT_THROW(first_touch(c, Sweep({0, 0, 1}), NAN), InvalidInput);
}

TEST(TruthAfterASweep, IsThatOfThePoseItself) {
  Random random(5);
  for (const Pair pair : all_pairs) {
    for (int i = 0; i < 20; ++i) {
      const Configuration c = any_pose(pair, random);
      const Vec3 sweep = larger_size(c) * random.direction();
      const Truth moved = truth_at(c, sweep, mpq_class(0));
      const Truth given = truth(c);
      EXPECT_EQ(moved.signed_distance.lo, given.signed_distance.lo);
      EXPECT_EQ(moved.signed_distance.hi, given.signed_distance.hi);
      if (pair == Pair::plane) continue;  // whose gap doubles do not have
      const Truth third = truth_at(c, sweep, mpq_class(1, 3));
      const double from = gap(c, third.normals[0].n) + third.normals[0].n.dot(sweep) / 3;
      EXPECT_NEAR(from, third.signed_distance.midpoint(), 1e-13 * scale_of(c));
    }
  }
}

class FirstTouchOf : public testing::TestWithParam<Pair> {};

TEST_P(FirstTouchOf, RandomSweepsIsProvenFromBothSides) {
  Random random(static_cast<std::uint64_t>(GetParam()) + 11);
  const std::uint64_t count = tried_of_each(60);
  int touches = 0, nevers = 0, undecided = 0;
  for (std::uint64_t i = 0; i < count; ++i) {
    const CastIdentity identity = any_cast(GetParam(), random);
    const CastQuestion given = make_cast(identity);
    const Configuration& c = given.configuration;
    const Vec3& sweep = given.sweep;
    const FirstTouch found = first_touch(c, Sweep(sweep));
    SCOPED_TRACE(to_string(identity) + ": " + name_of(found.status) + " at " +
                 std::to_string(found.fraction.midpoint()));
    const auto distance = [&](const mpq_class& t) { return truth_at(c, sweep, t).signed_distance; };
    const auto second = [&](double t) {
      return audit::enclose({c.a, Sweep(sweep).moved(c.pose_a, t), c.b, c.pose_b});
    };
    // The second oracle has the pose in doubles, far from the origin in some classes.
    const double rounding =
        1e-13 * (scale_of(c) + sweep.norm()) + 1e-15 * c.pose_a.position().norm();
    if (found.status == Status::touch) {
      EXPECT_LE(found.fraction.width(), 1e-20);
      EXPECT_GE(distance(found.fraction.lo).hi, 0);
      EXPECT_LE(distance(found.fraction.hi).lo, 0);
      ASSERT_TRUE(found.there);
      EXPECT_FALSE(found.there->normals.empty());
      EXPECT_GE(second(found.fraction.hi.get_d()).hi, -rounding);
      EXPECT_LE(second(found.fraction.hi.get_d()).lo, rounding);
      ++touches;
    }
    nevers += found.status == Status::never;
    undecided += found.status == Status::undecided;
    // Apart until then, says the second oracle, too.
    if (found.status == Status::from_start) continue;
    for (const double part : {0.1, 0.5, 0.9}) {
      EXPECT_GE(second(part * found.fraction.lo.get_d()).hi, -rounding) << part;
    }
  }
  EXPECT_GT(touches, static_cast<int>(count / 10));
  EXPECT_GT(nevers, static_cast<int>(count / 20));
  EXPECT_LE(undecided, static_cast<int>(count / 20));
}

INSTANTIATE_TEST_SUITE_P(Pairs, FirstTouchOf, testing::ValuesIn(all_pairs), name_of_other);

// With a spin.

TEST(FirstTouch, OfATurningCanIsWhereTrigonometryPutsIt) {
  // Standing at the height 1.1 over a floor, it tips over by a quarter turn about x: its lowest
  // point is h cos α + r sin α below its centre, which is 1.1 at sin(α + atan 2) = 1.1/√1.25.
  const Configuration c = can_at({0, 0, 1.1}, Plane({0, 0, 1}, 0));
  const double quarter = std::acos(0.0);
  const FirstTouch found = first_touch(c, Sweep({0, 0, 0}, {quarter, 0, 0}));
  ASSERT_EQ(found.status, Status::touch);
  const double angle = std::asin(1.1 / std::sqrt(1.25)) - std::atan(2.0);
  EXPECT_NEAR(found.fraction.midpoint(), angle / quarter, 1e-12);
  EXPECT_LE(found.fraction.width(), 1e-11);
}

TEST(FirstTouch, OfASlowTurnIsAlmostThatOfNone) {
  Random random(7);
  for (const Pair pair : all_pairs) {
    for (int i = 0; i < 5; ++i) {
      Configuration c = any_pose(pair, random);
      const Vec3 sweep = 8 * larger_size(c) * random.direction();
      c.pose_a = Pose(c.pose_a.position() - 0.7 * sweep, c.pose_a.orientation());
      const FirstTouch straight = first_touch(c, Sweep(sweep));
      const FirstTouch turned = first_touch(c, Sweep(sweep, 1e-13 * random.direction()));
      if (straight.status != Status::touch || turned.status != Status::touch) continue;
      const mpq_class at = turned.fraction.lo;
      EXPECT_NEAR(truth_at(c, sweep, at).signed_distance.midpoint(), 0,
                  1e-11 * (scale_of(c) + sweep.norm()));
    }
  }
}

TEST(FirstTouch, OfACanThatTurnsInItsOwnPlaceIsNever) {
  // About its axis, beside a box and with a hair between them.
  const Configuration c = can_at({1.5 + 1e-9, 0, 0}, Box({1, 1, 1}));
  EXPECT_EQ(first_touch(c, Sweep({0, 0, 0}, {0, 0, 7})).status, Status::never);
  EXPECT_EQ(first_touch(c, Sweep({0, 0, 0}, {0, 1e-6, 0})).status, Status::touch);
}

}  // namespace
}  // namespace touchstone::oracle
