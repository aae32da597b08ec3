#include "cap_on_face.hpp"

#include <cmath>
#include <gtest/gtest.h>
#include <numbers>
#include <optional>
#include <rapidcheck.h>
#include <vector>

#include "reference/patch_points_test.hpp"

namespace touchstone {
namespace {

const Circle unit{Vec2(0, 0), 1};

constexpr double far = 2;  // beyond the unit disc

/// What of the unit disc has its coordinates between these.
CapOnFace cut_disc(const Vec2& lower, const Vec2& upper) {
  const auto strip = [&](int i) -> Strip {
    return {Vec2::Unit(i), (lower[i] + upper[i]) / 2, (upper[i] - lower[i]) / 2};
  };
  return {unit, strip(0), strip(1)};
}
CapOnFace disc_in_square(double half_side) {
  return cut_disc(Vec2(-half_side, -half_side), Vec2(half_side, half_side));
}

TEST(CapOnFace, HasThreePointsFourOfAFaceWithinItAndOneMoreForEachEdgeThatCuts) {
  const struct {
    Vec2 lower, upper;
    std::size_t points;
  } rows[] = {{{-far, -far}, {far, far}, 3},   {{-0.5, -0.5}, {0.5, 0.5}, 4},
              {{-far, -far}, {0.3, far}, 5},   {{-0.6, -far}, {0.6, far}, 6},
              {{-0.95, -far}, {0.95, 0.9}, 7}, {{-0.9, -0.9}, {0.9, 0.9}, 8},
              {{-far, -far}, {0.1, 0.1}, 4},   {{-far, -far}, {-0.9, far}, 3}};
  for (const auto& row : rows) {
    const auto points = distinct_points(cut_disc(row.lower, row.upper), Vec2(0, 0), 0);
    EXPECT_EQ(points.size(), row.points) << row.lower.transpose() << ", " << row.upper.transpose();
  }
}

TEST(CapOnFace, ThatAllFourEdgesOfASquareCutHasEightCorners) {
  const CapOnFace patch = disc_in_square(0.9);
  const auto points = distinct_points(patch, Vec2(0, 0), 0);
  ASSERT_EQ(points.size(), 8u);
  for (const Vec2& p : points) {
    EXPECT_NEAR(p.norm(), 1, 1e-14);
    EXPECT_NEAR(p.cwiseAbs().maxCoeff(), 0.9, 1e-15);
  }
  EXPECT_GT(coverage(patch), 0.9);
}

TEST(CapOnFace, BeyondTheFaceIsEmpty) {
  EXPECT_TRUE(cut_disc({-far, -far}, {far, -1.5}).empty());
  const CapOnFace corner = cut_disc({0.8, 0.9}, {far, far});
  EXPECT_TRUE(corner.empty());
  EXPECT_NEAR((corner.nearest() - Vec2(0.8, 0.9)).norm(), 0, 1e-15);
}

/// Strips at right angles, or nearly, that cut the unit disc anywhere, often flush with its rim.
CapOnFace random_patch(int thousandths_off_square) {
  const auto thousandths = [](int lo, int hi) { return 1e-3 * *rc::gen::inRange(lo, hi); };
  const Vec2 x = direction(thousandths(0, 6284));
  const Vec2 y = direction(std::atan2(x.y(), x.x()) + std::numbers::pi / 2 +
                           thousandths(-thousandths_off_square, thousandths_off_square + 1));
  const auto strip = [&](const Vec2& across) -> Strip {
    const double upper = *rc::gen::inRange(0, 3) == 0 ? 1 + std::pow(10, thousandths(-9000, -1000))
                                                      : thousandths(-300, 1500);
    const double width = *rc::gen::inRange(0, 3) == 0 ? 1 + upper : thousandths(50, 2600);
    return {across, upper - width / 2, width / 2};
  };
  const Strip strips[] = {strip(x), strip(y)};
  return {unit, strips[0], strips[1]};
}

TEST(CapOnFace, PointsCoverHalfOfThePatch) {
  EXPECT_TRUE(rc::check([&] {
    const CapOnFace patch = random_patch(0);
    RC_PRE(!patch.empty());
    RC_ASSERT(coverage(patch) >= 0.495);
  }));
}

TEST(CapOnFace, PointsLieInThePatchAndHoldTheDeepestPlaceIfThatIsClear) {
  EXPECT_TRUE(rc::check([&] {
    const CapOnFace patch = random_patch(5);
    RC_PRE(!patch.empty());
    const Vec2 down = direction(1e-3 * *rc::gen::inRange(0, 6284));
    const double clearness = 0.1 * *rc::gen::inRange(0, 11);
    const auto points = distinct_points(patch, down, clearness);
    RC_ASSERT(points.size() <= 8u);
    double deepest = -far;
    for (const Vec2& p : points) {
      for (int i = 0; i < 64; ++i) {
        const Vec2 n = direction(i);
        RC_ASSERT(n.dot(p) <= n.dot(patch.farthest(n)) + 1e-12);
      }
      deepest = std::max(deepest, down.dot(p));
    }
    if (clearness == 1) RC_ASSERT(deepest >= down.dot(patch.farthest(down)) - 1e-12);
  }));
}

TEST(CapOnFace, WhatIsAboveALineComesDownToThePatchOnIt) {
  const CapOnFace patch = cut_disc({-far, -far}, {0.6, far});
  std::array<Vec2, CapOnFace::max_points> points{Vec2(0.2, 0.9), Vec2(0.6, 0.8), Vec2(-1, 0.1),
                                                 Vec2(0, -1)};
  patch.cut_off(Vec2(0, 1), 0, points, 4);
  const Vec2 expected[] = {{0.2, 0}, {0.6, 0}, {-1, 0}, {0, -1}};
  for (int i = 0; i < 4; ++i) EXPECT_NEAR((points[i] - expected[i]).norm(), 0, 1e-15) << i;
}

// Where they cross would be what rounding says.
TEST(CapOnFace, PointsStayOnAnEdgeAlongALine) {
  const CapOnFace patch = cut_disc({-far, -far}, {far, -0.3});
  std::array<Vec2, CapOnFace::max_points> points{Vec2(-0.9, -0.3 + 1e-16), Vec2(0.9, -0.3 + 1e-16)};
  for (const double turn : {-1e-16, 1e-16}) {
    patch.cut_off(Vec2(turn, 1), -0.3, points, 2);
    for (int i = 0; i < 2; ++i) EXPECT_NEAR(points[i].x(), i == 0 ? -0.9 : 0.9, 1e-15) << turn;
  }
}

/// The place of a disc in strips that is farthest along a direction, by trying all that may be: the
/// circle's own, and where edges cross it and each other. None where the disc is not in them.
std::optional<Vec2> farthest_of_all(const Circle& circle, const std::array<Strip, 2>& strips,
                                    const Vec2& unit_vector) {
  std::vector<Vec2> places = {circle.centre + circle.radius * unit_vector};
  struct Edge {
    Vec2 foot, along;
  };
  std::vector<Edge> edges;
  for (const Strip& s : strips) {
    for (const double bound : {s.middle + s.half_width, s.middle - s.half_width}) {
      const double distance = bound - s.across.dot(circle.centre);
      const Edge edge{circle.centre + distance * s.across, turned_left(s.across)};
      const double squared = circle.radius * circle.radius - distance * distance;
      for (const double way : {std::sqrt(squared), -std::sqrt(squared)}) {
        if (squared > 0) places.push_back(edge.foot + way * edge.along);
      }
      for (const Edge& other : edges) {
        const double turn = cross2(edge.along, other.along);
        if (std::abs(turn) < 0.1) continue;
        places.push_back(edge.foot +
                         cross2(other.foot - edge.foot, other.along) / turn * edge.along);
      }
      edges.push_back(edge);
    }
  }
  constexpr double rounding = 1e-12;
  std::optional<Vec2> best;
  for (const Vec2& p : places) {
    bool is_in = (p - circle.centre).norm() <= circle.radius + rounding;
    for (const Strip& s : strips) {
      is_in = is_in && std::abs(s.across.dot(p) - s.middle) <= s.half_width + rounding;
    }
    if (is_in && (!best || unit_vector.dot(p) > unit_vector.dot(*best))) best = p;
  }
  return best;
}

// The strips cross at any angle.
TEST(CapOnFace, ReachesAsFarAsAnyPlaceOfBoth) {
  const auto number = [](int lo, int hi) { return 1e-3 * *rc::gen::inRange(lo, hi) + 0.00037; };
  EXPECT_TRUE(rc::check([&] {
    const Circle circle{Vec2(number(-1000, 1000), number(-1000, 1000)), number(500, 2000)};
    std::array<Strip, 2> strips;
    double angle = number(0, 6283);
    for (Strip& s : strips) {
      s = {direction(angle), number(-2500, 2500), number(1, 2500)};
      angle += (*rc::gen::inRange(0, 2) ? 1 : -1) * number(600, 2500);
    }
    const CapOnFace region(circle, strips[0], strips[1]);
    for (int i = 0; i < 32; ++i) {
      const Vec2 n = direction(i);
      const auto expected = farthest_of_all(circle, strips, n);
      RC_ASSERT(region.empty() == !expected);
      if (region.empty()) return;
      RC_ASSERT(std::abs(n.dot(circle.centre + region.farthest(n) - *expected)) < 1e-9);
    }
  }));
}

}  // namespace
}  // namespace touchstone
