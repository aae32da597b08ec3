#include "oracle/judge/score.hpp"

#include <array>
#include <cmath>
#include <gtest/gtest.h>
#include <limits>
#include <numbers>
#include <random>
#include <set>
#include <string>

#include "oracle/as_hull.hpp"
#include "oracle/judge/made_answers.hpp"
#include "properties/identity.hpp"

namespace touchstone {
namespace {

// Of the rim of `standing`, leaning by 45°, a rounding of 0.04 takes 0.04 (√2 − 1).
TEST(Score, OfAnEngineThatRoundsEdgesIsSplitInWhatItModelsAndHowItSolves) {
  const double reach = (standing.a.radius() + standing.a.half_length()) / std::numbers::sqrt2;
  const double lost = 0.04 * (std::numbers::sqrt2 - 1), off = 1e-3;
  const double size = smaller_size(standing);
  const Eigen::Quaterniond leaning(std::cos(std::numbers::pi / 8), std::sin(std::numbers::pi / 8),
                                   0, 0);
  for (const double depth : {0.1, 0.01}) {
    const Configuration c{standing.a, Pose({0, 0, reach - depth}, leaning), Plane({0, 0, 1}, 0),
                          Pose()};
    Answer answer{contact(-(depth - lost) + off, up), {}, {}, std::array{0.04, 0.0}};
    if (depth < lost) static_cast<ts_answer&>(answer) = none();
    const Score s = score(c, oracle::truth(c), answer, {});
    EXPECT_EQ(s.outcome, depth < lost ? Outcome::missed : Outcome::shallow);
    ASSERT_TRUE(s.model_error && s.solver_error);
    EXPECT_NEAR(*s.model_error, lost / size, 1e-12);
    EXPECT_NEAR(*s.solver_error, depth < lost ? 0 : off / size, 1e-12);
    answer.roundings = std::array{0.04, 7.0};  // a plane has none
    EXPECT_NEAR(*score(c, oracle::truth(c), answer, {}).model_error, lost / size, 1e-12);
    answer.roundings = std::array{40.0, 0.0};  // no such cylinder exists
    EXPECT_FALSE(score(c, oracle::truth(c), answer, {}).model_error);
  }
}

TEST(PointDistance, OfRoundedBodiesIsThatOfWhatTheyAre) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> place(-4, 4);
  for (int i = 0; i < 1000; ++i) {
    const Vec3 p(place(random), place(random), place(random));
    const auto distance = [&](const Shape& s) { return point_distance(s, Pose(), p); };
    EXPECT_NEAR(distance(Cylinder(1, 3, 1)), distance(Capsule(1, 2)), 1e-14);
    EXPECT_NEAR(distance(Box({1, 1, 1}, 1)), distance(Sphere(1)), 1e-14);
    const Convex core = as_hull(Box({0.5, 1.5, 2.5}));
    EXPECT_NEAR(distance(Box({1, 2, 3}, 0.5)), distance(core.rounded(0.5)), 1e-14);
    // Against faces the rounded body is the sharp one, and behind its edges less.
    EXPECT_GE(distance(Cylinder(2, 1, 0.25)), distance(Cylinder(2, 1)) - 1e-14);
  }
}

TEST(Score, TheRightAnswerAgreesWithNoError) {
  const Score s = scored(standing, contact(-1e-3, up));
  EXPECT_EQ(s.outcome, Outcome::agree);
  EXPECT_NEAR(*s.depth_error, 0, 1e-12);
  EXPECT_NEAR(*s.normal_regret, 0, 1e-12);
  EXPECT_NEAR(*s.normal_angle, 0, 1e-12);
  EXPECT_EQ(s.points, 1);
}

struct Judged {
  const char* what;
  Configuration c;
  ts_answer answer;
  Outcome outcome;
  double severity = 0;
  Bar bar = {};
};

constexpr double bar = Bar{}.tolerance;

ts_answer with_status(ts_status status) {
  ts_answer a{};
  a.status = status;
  return a;
}

/// The right contact of `standing` with a second point.
ts_answer and_point(const ts_point& point) {
  ts_answer a = contact(-1e-3, up);
  a.points[a.point_count++] = point;
  return a;
}

/// Points of these depths, and the contact's own signed distance.
ts_answer with_depths(const std::vector<double>& depths, double signed_distance = -1e-3,
                      const Vec3& normal = up) {
  ts_answer a = contact(signed_distance, normal);
  a.point_count = static_cast<int>(depths.size());
  for (std::size_t i = 0; i < depths.size(); ++i) {
    a.points[i] = {{0, 0, 1}, {0, 0, 1}, depths[i]};
  }
  return a;
}

constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr double infinite = std::numeric_limits<double>::infinity();

// The can is 1e-3 deep; its size is 0.5.
const Judged judged[] = {
    {"no contact inside", standing, none(), Outcome::missed, 2e-3},
    {"no contact within the bar", lifted(1e-3 - 2e-5), none(), Outcome::unseen},
    {"no contact beyond a bar", lifted(1e-3 - 2e-5), none(), Outcome::missed, 4e-5, {1e-6, 0}},
    {"what doubles tell from a touch", lifted(1e-3 - 1e-12), none(), Outcome::unseen},
    {"what they do not", lifted(1e-3 - 1e-14), none(), Outcome::agree},
    {"no contact of a touch", lifted(1e-3), none(), Outcome::agree},
    {"no contact apart", lifted(0.1), none(), Outcome::agree},
    {"half the depth", standing, contact(-0.5e-3, up), Outcome::shallow, 1e-3},
    {"twice the depth", standing, contact(-2e-3, up), Outcome::overdeep, 2e-3},
    {"a reversed normal", standing, contact(-1e-3, -up), Outcome::wrong_normal, 8 - 4e-3},
    {"a normal of length two", standing, contact(-1e-3, 2 * up), Outcome::wrong_normal},
    {"no normal", standing, contact(-1e-3, Vec3::Zero()), Outcome::wrong_normal},
    {"a contact apart", lifted(0.011), contact(0.01, up), Outcome::phantom},
    {"within the threshold", lifted(0.011), contact(0.01, up), Outcome::agree, 0, {bar, 0.02}},
    {"a failure", standing, with_status(TS_FAILED), Outcome::failed},
    {"no routine", standing, with_status(TS_UNSUPPORTED), Outcome::unsupported},
    {"a depth of NaN", standing, contact(nan, up), Outcome::not_finite},
    {"a normal of NaN", standing, contact(-1e-3, Vec3(0, nan, 1)), Outcome::not_finite},
    {"a point at infinity", standing, and_point({{0, infinite, 0}, {0, 0, 1}, 1e-3}),
     Outcome::not_finite},
    {"one point of three deep enough", standing, with_depths({0, 1e-3, 2e-4}), Outcome::agree},
    {"none deep enough", standing, with_depths({0, 4e-4}), Outcome::shallow_points, 1.2e-3},
    {"one too deep", standing, with_depths({1e-3, 3e-3}), Outcome::overdeep_points, 4e-3},
    {"lacking less than the bar", standing, with_depths({1e-3 - 2e-5}), Outcome::agree, 4e-5},
    {"more than a bar",
     standing,
     with_depths({1e-3 - 2e-5}),
     Outcome::shallow_points,
     4e-5,
     {1e-5, 0}},
    {"no point", standing, with_depths({}), Outcome::no_points, 2e-3},
    {"no point of a touch", lifted(1e-3), with_depths({}, 0), Outcome::no_points},
    {"no point apart", lifted(0.011), with_depths({}, 0.01), Outcome::agree, 0, {bar, 0.02}},
    {"depth before points", standing, with_depths({0}, -0.5e-3), Outcome::shallow, 2e-3},
    {"normal before points", standing, with_depths({0}, -1e-3, Vec3::UnitX()),
     Outcome::wrong_normal, 1 + std::sqrt(5)},
    {"a point beyond the threshold", standing, with_depths({1e-3, -2e-3}), Outcome::phantom_points,
     4e-3},
    {"a point within it", standing, with_depths({1e-3, -2e-3}), Outcome::agree, 0, {bar, 2e-3}},
    {"a point above the box", standing, and_point({{0.2, 0, 1 + 6e-5}, {0, 0, 1}, 0}),
     Outcome::off_body, 1.2e-4},
    {"by less than its depth and the bar", standing,
     and_point({{0.2, 0, 1 + 6e-5}, {0, 0, 1}, 2e-5}), Outcome::agree},
    {"a point within both", standing, and_point({{0.2, 0, 0.9995}, {0, 0, 1}, 0}), Outcome::agree},
    {"a point far away", standing, and_point({{12.6, 0, 1}, {0, 0, 1}, 1e-3}), Outcome::off_body,
     (12.1 - 1e-3) / 0.5},
    {"far away, but for the bar",
     standing,
     and_point({{12.6, 0, 1}, {0, 0, 1}, 1e-3}),
     Outcome::agree,
     0,
     {100, 0}},
};

TEST(Score, NamesOutcomesAfterTheSymptomWithTheSizeOfTheFailure) {
  constexpr double rounding = 1e-12;
  for (const Judged& row : judged) {
    SCOPED_TRACE(row.what);
    const Score s = scored(row.c, row.answer, row.bar);
    EXPECT_STREQ(outcome_name(s.outcome), outcome_name(row.outcome));
    EXPECT_NEAR(s.severity, row.severity, rounding);
  }
  EXPECT_TRUE(agrees(Outcome::unseen));
}

TEST(Score, OfDeepestPointsIsSignedAsTheDepthIs) {
  EXPECT_NEAR(*scored(standing, with_depths({0, 4e-4})).deepest_error, -1.2e-3, 1e-12);
  EXPECT_NEAR(*scored(standing, with_depths({1e-3, 3e-3})).deepest_error, 4e-3, 1e-12);
  EXPECT_NEAR(*scored(standing, contact(-0.5e-3, up)).depth_error, 1e-3, 1e-12);
  EXPECT_FALSE(scored(standing, with_depths({})).deepest_error);
}

TEST(Score, SaysHowFarPointsAreOffTheBodies) {
  EXPECT_EQ(*scored(standing, contact(-1e-3, up)).point_error, 0);
  ts_answer off = contact(-1e-3, up);
  off.point_count = 2;
  off.points[1] = {{0, 0, 1.1}, {0, 0, 1}, 1e-3};  // 0.1 above the box, 1e-3 of it allowed
  const Score s = scored(standing, off);
  EXPECT_NEAR(*s.point_error, (0.1 - 1e-3) / 0.5, 1e-12);
  off.point_count = 0;
  EXPECT_FALSE(scored(standing, off).point_error);
  EXPECT_FALSE(scored(standing, none()).point_error);
}

TEST(Score, ErrorsBeyondTheLargestDoubleAreTheLargestDouble) {
  const Configuration small{Cylinder(1e-3, 1e-3), Pose(), Sphere(1e-3), Pose()};
  Answer answer{contact(-1e308, up), {}, 1e308, {}};
  answer.points[0].position[0] = 1e308;
  const Score s = score(small, oracle::truth(small), answer, Bar{});
  constexpr double largest = std::numeric_limits<double>::max();
  EXPECT_EQ(s.depth_error, -largest);
  EXPECT_EQ(s.deepest_error, largest);
  EXPECT_EQ(s.model_error, largest);
  EXPECT_EQ(s.solver_error, -largest);
  EXPECT_EQ(s.severity, largest);
  EXPECT_EQ(s.outcome, Outcome::overdeep);
}

// Parallel sides that a tilt of 0.03 makes cross: signed distance and normal are right to the last
// digits, but a solver sees no depth.
TEST(DeepestPoint, IsLackingWhereOurOwnCapsuleOnceHadPointsAtTheEndsOnly) {
  const Configuration c{Cylinder(0x1p-2, 5),
                        Pose(Vec3(0x1.1745d1745d174p-2, -0x1.ac37dac37dac4p-2, 0x1.bed61bed61bfp-6),
                             Eigen::Quaterniond(0x1.041c6a547a96ep+1, -0x1.78c73ac4b8bf4p+1,
                                                -0x1.1fa452869f12cp-7, -0x1.847b2902f586dp+1)),
                        Capsule(0x1p-2, 5), Pose(Vec3::Zero(), Eigen::Quaterniond(2, -3, 0, -3))};
  const oracle::Truth truth = oracle::truth(c);
  ts_answer a = contact(truth.signed_distance.midpoint(), truth.normals.front().n);
  const Vec3 middle = oracle::contact_patch(c, truth.normals.front()).centroid();
  for (int i = 0; i < 3; ++i) a.points[0].position[i] = middle[i];
  a.points[1] = a.points[0];
  EXPECT_EQ(score(c, truth, a, {}).outcome, Outcome::agree);
  a.point_count = 2;
  a.points[0].depth = a.points[1].depth = 3e-17;
  const Score s = score(c, truth, a, {});
  EXPECT_EQ(s.outcome, Outcome::shallow_points);
  EXPECT_NEAR(*s.deepest_error, -0.00244 / 0.25, 1e-4);
}

TEST(Score, EveryOutcomeIsListedOnceInItsPlaceWithANameOfItsOwn) {
  std::set<std::string> names;
  for (std::size_t i = 0; i < all_outcomes.size(); ++i) {
    EXPECT_EQ(static_cast<std::size_t>(all_outcomes[i]), i);  // statistics count by it
    EXPECT_TRUE(names.insert(outcome_name(all_outcomes[i])).second);
  }
}

TEST(Score, ErrorsAreRelativeToAShareOfTheLargerSizeWhereDoublesSayNoMore) {
  const Configuration needle{Cylinder(1e-3, 1e9), Pose(), Sphere(1), Pose()};
  EXPECT_EQ(error_size(needle, {}), 1);  // 1e-13 over the tolerance of 1e-4
  EXPECT_EQ(error_size(needle, {.tolerance = 1e-13, .threshold = 0}), 1e9);
  EXPECT_EQ(error_size(needle, {.tolerance = 0, .threshold = 0}), 1e9);
  EXPECT_EQ(error_size(standing, {}), 0.5);
  // A plane has no end: the cylinder's distance along it counts.
  const Configuration aside{Cylinder(0.5, 1), Pose(Vec3(1e12, 0, 0)), Plane(up, 0), Pose()};
  EXPECT_DOUBLE_EQ(error_size(aside, {}), 1e3);
}

TEST(Score, ReversedNormalRegretsTheWholeWayThrough) {
  // Along −z the bodies overlap by 2·1 + 2·1 − 1e-3.
  EXPECT_NEAR(*scored(standing, contact(-1e-3, -up)).normal_regret, (4 - 2e-3) / 0.5, 1e-9);
}

TEST(PointDistance, OfEveryShape) {
  const Pose at({1, 2, 3}, {1, 0, 0, 0});
  const auto distance = [&](const Shape& s, const Vec3& p) { return point_distance(s, at, p); };
  EXPECT_DOUBLE_EQ(distance(Cylinder(1, 2), {4, 2, 3}), 2);
  EXPECT_DOUBLE_EQ(distance(Cylinder(1, 2), {5, 2, 9}), 5);
  EXPECT_DOUBLE_EQ(distance(Cylinder(1, 2), {1.25, 2, 3}), -0.75);
  EXPECT_DOUBLE_EQ(distance(Cylinder(1, 2), {1, 2, 4.5}), -0.5);
  EXPECT_DOUBLE_EQ(distance(Capsule(1, 2), {1, 2, 7}), 1);
  EXPECT_DOUBLE_EQ(distance(Capsule(1, 2), {1, 2, 3}), -1);
  EXPECT_DOUBLE_EQ(distance(Sphere(1), {1, 2, 5}), 1);
  EXPECT_DOUBLE_EQ(distance(Box({1, 1, 1}), {5, 2, 7}), std::hypot(3, 3));
  EXPECT_DOUBLE_EQ(distance(Box({1, 2, 3}), {1, 2, 3}), -1);
  EXPECT_DOUBLE_EQ(distance(Plane({0, 0, 2}, 2), {0, 0, 5}), 1);
}

TEST(PointDistance, OfATetrahedronIsThatOnPaper) {
  // The corner of a cube, cut by x + y + z = 1.
  const Convex corner =
      oracle::convex_hull(std::vector<Vec3>{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}});
  const Pose at({1, 2, 3}, {1, 0, 0, 0});
  const auto distance = [&](double x, double y, double z) {
    return point_distance(corner, at, Vec3(1 + x, 2 + y, 3 + z));
  };
  constexpr double rounding = 1e-15;
  const double root3 = std::sqrt(3);
  EXPECT_NEAR(distance(0.25, 0.25, 0.25), -0.25 / root3, rounding);  // below the slanted face
  EXPECT_NEAR(distance(0.125, 0.25, 0.25), -0.125, rounding);
  EXPECT_NEAR(distance(1, 1, 1), 2 / root3, rounding);  // off a face
  EXPECT_NEAR(distance(0.25, -3, 0.25), 3, rounding);   // off another
  EXPECT_NEAR(distance(0.5, -3, -4), 5, rounding);      // off an edge
  EXPECT_NEAR(distance(-2, -1, -2), 3, rounding);       // off a corner
  EXPECT_NEAR(distance(0.25, 0.25, 0), 0, rounding);    // on a face
  EXPECT_NEAR(distance(0.5, 0, 0), 0, rounding);        // on an edge
  EXPECT_EQ(distance(0, 1, 0), 0);                      // at a corner
}

TEST(PointDistance, OfAFlatPolygonIsPositiveOnBothSides) {
  const Convex square =
      oracle::convex_hull(std::vector<Vec3>{{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}});
  for (const double side : {-1.0, 1.0}) {
    EXPECT_EQ(point_distance(square, Pose(), Vec3(0.5, 0.25, 0.125 * side)), 0.125);
    EXPECT_EQ(point_distance(square, Pose(), Vec3(4, 0, 4 * side)), 5);
  }
  EXPECT_EQ(point_distance(square, Pose(), Vec3(0.5, 0.25, 0)), 0);
  EXPECT_EQ(point_distance(square, Pose(), Vec3(3, 0.25, 0)), 2);
}

TEST(PointDistance, OfAHullOfTheSmallestOrLargestDoublesIsANumber) {
  for (const double size : {5e-324, 1e-310, 1e308, 1.7e308}) {
    const Convex hull =
        oracle::convex_hull(std::vector<Vec3>{{size, 0, 0}, {-size, 0, 0}, {0, size, 0}});
    EXPECT_EQ(point_distance(hull, Pose(), Vec3::Zero()), 0);
    EXPECT_NEAR(point_distance(hull, Pose(), Vec3(0, 0, size)) / size, 1, 1e-15);
  }
}

TEST(PointDistance, OfABoxAsAHullIsThatOfTheBox) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> symmetric(-1, 1);
  const Box box({1, 0.5, 0.25});
  const Convex hull = as_hull(box);
  const Pose pose({0.5, -1, 2}, {1, 0.3, -0.2, 0.5});
  for (int i = 0; i < 2000; ++i) {
    const double reach = i % 2 ? 1 : 3;
    const Vec3 p =
        pose.position() + reach * Vec3(symmetric(random), symmetric(random), symmetric(random));
    EXPECT_NEAR(point_distance(hull, pose, p), point_distance(box, pose, p), 1e-14);
  }
  for (const double far : {1e6, 1e9, 1e12, 1e15, 1e16, 1e300}) {
    const Vec3 p = far * Vec3(symmetric(random), symmetric(random), 1);
    EXPECT_NEAR(point_distance(hull, pose, p) / point_distance(box, pose, p), 1, 1e-15) << far;
  }
}

TEST(Score, ErrorsAreRelativeToTheSizesOfAHullToo) {
  const Configuration hull = with_hull(standing);
  EXPECT_EQ(error_size(hull, {}), error_size(standing, {}));
  const ts_point point{{0.2, 0, 1 + 6e-5}, {0, 0, 1}, 2e-5};
  EXPECT_NEAR(point_outside(hull, point), point_outside(standing, point), 1e-15);
}

/// Two crossed cans; two coaxial ones, along whose sides all radial normals tie; and one in the
/// middle of a cube, where caps and sides tie, along which patches differ.
const Configuration crossed{Cylinder(0.5, 1), Pose(), Cylinder(0.4, 1.5),
                            Pose({0.1, 0.7, 0.2}, {1, 0.3, 0.1, 0.5})},
    coaxial{Cylinder(0.5, 1), Pose(), Cylinder(0.4, 1), Pose({0, 0, 0.25}, {1, 0, 0, 0})},
    tied{Cylinder(0.5, 0.5), Pose(), Box({2, 2, 2}), Pose()};

TEST(Judge, SaysOfEachOfManyAnswersWhatItSaysOfThatAlone) {
  for (const Configuration& c : {standing, crossed, coaxial, tied, lifted(1)}) {
    const oracle::Truth truth = oracle::truth(c);
    const double distance = truth.signed_distance.midpoint();
    std::vector<ts_answer> answers = {none()};
    std::vector<Vec3> normals;
    for (const double turn : {0.0, 0.3, 1e-5, 2.0, 0.3}) {
      for (const oracle::OptimalNormal& optimal : truth.normals) {
        normals.push_back(Eigen::AngleAxisd(turn, Vec3::UnitZ()) * optimal.n);
      }
    }
    for (const Vec3& n : normals) {
      answers.push_back(contact(distance / 2, Vec3(n.y(), -n.z(), n.x())));
      ts_answer spread = contact(distance, n);
      spread.point_count = 4;
      for (int i = 0; i < 4; ++i) {
        spread.points[i] = spread.points[0];
        spread.points[i].position[i % 2] += i < 2 ? 0.2 : -0.3;
      }
      answers.push_back(spread);
    }
    Judge judge(c, truth, {});
    for (const ts_answer& answer : answers) {
      const Score together = judge.score(answer), alone = score(c, truth, answer, Bar{});
      EXPECT_EQ(together.outcome, alone.outcome);
      EXPECT_EQ(together.normal_regret, alone.normal_regret);
      EXPECT_EQ(together.whole_regret, alone.whole_regret);
      EXPECT_EQ(together.coverage, alone.coverage);
      EXPECT_EQ(together.severity, alone.severity);
    }
  }
}

TEST(Judge, MeasuresTheWholeRegretByTheCertifiedGap) {
  for (const Configuration& c : {standing, crossed, coaxial}) {
    const oracle::Truth truth = oracle::truth(c);
    Judge judge(c, truth, {});
    for (const Vec3& n : {Vec3(0.6, 0, 0.8), Vec3(0, 0, 1), Vec3(0.36, 0.48, -0.8)}) {
      const double regret =
          truth.signed_distance.midpoint() - oracle::certified_gap(c, n).midpoint();
      const double relative = std::max(0.0, regret) / error_size(c, {});
      // Doubles, each rounded towards zero.
      EXPECT_NEAR(*judge.score(contact(-0.1, n)).whole_regret, relative, 1e-15 * (1 + relative));
    }
  }
}

/// An answer with a normal some degrees off, and points of the patch, of which one is off the
/// bodies.
ts_answer nearly_right(const Configuration& c, const oracle::Truth& truth, double degrees) {
  const oracle::OptimalNormal& optimal = truth.normals.front();
  const Eigen::AngleAxisd turn(degrees / 180 * std::numbers::pi, optimal.n.unitOrthogonal());
  ts_answer answer = contact(truth.signed_distance.midpoint(), turn * optimal.n);
  const std::vector<Vec3> outline = oracle::contact_patch(c, optimal).outline();
  const std::size_t count = std::min<std::size_t>(outline.size(), 3) + (degrees > 0 ? 1 : 0);
  answer.point_count = static_cast<int>(count);
  for (std::size_t i = 0; i < count; ++i) {
    answer.points[i] = answer.points[0];
    Vec3 p = outline[i * outline.size() / count];
    if (degrees > 0 && i == 0) p += 0.1 * smaller_size(c) * Vec3(1, -1, 1);
    for (int k = 0; k < 3; ++k) answer.points[i].position[k] = p[k];
  }
  return answer;
}

TEST(Score, OfABoxAsAHullIsThatOfTheBox) {
  int compared = 0;
  for (const auto& name : pose_classes(Pair::box)) {
    const Identity id{Pair::box, name, 20261126, 1};
    SCOPED_TRACE(to_string(id));
    const Configuration box = make_configuration(id), hull = with_hull(box);
    const oracle::Truth truth = oracle::truth(box), of_hull = oracle::truth(hull);
    for (const double degrees : {0.0, 1e-3, 2.0}) {
      const ts_answer answer = nearly_right(box, truth, degrees);
      const Score s = score(box, truth, answer, Bar{}), h = score(hull, of_hull, answer, Bar{});
      const double rounding = 1e-13 * (1 + larger_size(box) / error_size(box, {}));
      EXPECT_EQ(h.outcome, s.outcome);
      EXPECT_NEAR(*h.normal_regret, *s.normal_regret, rounding);
      EXPECT_NEAR(*h.whole_regret, *s.whole_regret, rounding);
      EXPECT_NEAR(*h.point_error, *s.point_error, rounding);
      EXPECT_NEAR(h.severity, s.severity, rounding);
      EXPECT_EQ(h.coverage.has_value(), s.coverage.has_value());
      if (h.coverage && s.coverage) {
        EXPECT_NEAR(*h.coverage, *s.coverage, 1e-9);
      }
      ++compared;
    }
  }
  EXPECT_GT(compared, 300);
}

/// A can that stands 0.2 deep in a half-space.
const Configuration in_half_space{Cylinder(1, 2), Pose({0, 0, 1.8}, {1, 0, 0, 0}),
                                  Plane({0, 0, 1}, 0), Pose()};

double excess(const Vec3& p, double depth) {
  return point_excess(in_half_space, {{p.x(), p.y(), p.z()}, {0, 0, 1}, depth});
}

TEST(PointExcess, IsNoneBetweenTheSurfacesWhereverInTheDepth) {
  for (const double z : {-0.2, -0.1, 0.0}) EXPECT_LE(excess({0.5, 0, z}, 0.2), 0) << z;
  EXPECT_LT(excess({0.5, 0, -0.1}, 0.2), 0);
}

TEST(PointExcess, MeasuresFromTheFartherSurface) {
  constexpr double rounding = 1e-14;
  EXPECT_NEAR(excess({3, 0, 0}, 0.2), std::hypot(2, 0.0) - 0.2, rounding);
  // 0.7 above the half-space, 0.9 from the cap below it.
  EXPECT_NEAR(excess({0, 0, 0.7}, 0.2), 0.7, rounding);
  EXPECT_NEAR(excess({0, 0, 0.7}, -0.2), 0.7, rounding);  // points apart have negative depths
}

TEST(PointExcess, LeavesAPointWhatItsCoordinatesRoundTo) {
  const Configuration far{Cylinder(1, 1), Pose(Vec3(1e12, 0, 0)), Sphere(1),
                          Pose(Vec3(1e12, 0, 1.75), {1, 0, 0, 0})};
  EXPECT_LE(point_excess(far, {{1e12, 0, 1.001}, {0, 0, 1}, 0.25}), 0);
}

}  // namespace
}  // namespace touchstone
