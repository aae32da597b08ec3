#include "reference/reduce_points.hpp"

#include <bit>
#include <gtest/gtest.h>
#include <random>
#include <vector>

namespace touchstone {
namespace {

/// The area of the convex hull of points of a plane (Andrew's monotone chain, 1979).
double hull_area(std::vector<Eigen::Vector2d> points) {
  std::sort(points.begin(), points.end(), [](const auto& p, const auto& q) {
    return std::pair(p.x(), p.y()) < std::pair(q.x(), q.y());
  });
  double area = 0;
  for (const double side : {1.0, -1.0}) {
    std::vector<Eigen::Vector2d> chain;
    for (const auto& p : points) {
      const auto turns = [&] {
        const Eigen::Vector2d a = chain.back() - chain[chain.size() - 2], b = p - chain.back();
        return side * (a.x() * b.y() - a.y() * b.x()) > 0;
      };
      while (chain.size() > 1 && !turns()) chain.pop_back();
      chain.push_back(p);
    }
    for (std::size_t i = 1; i < chain.size(); ++i) {
      area += side * (chain[i - 1].x() * chain[i].y() - chain[i - 1].y() * chain[i].x()) / 2;
    }
  }
  return area;
}

std::vector<Eigen::Vector2d> flat(const Contact& contact) {
  std::vector<Eigen::Vector2d> points;
  for (const ContactPoint& p : contact.points()) points.push_back(p.position.head<2>());
  return points;
}

Contact corners(int count, double depth_of_last = 0.1) {
  Contact contact;
  contact.normal = Vec3::UnitZ();
  contact.signed_distance = -0.1;
  for (int i = 0; i < count; ++i) {
    const double angle = 2 * M_PI * i / count;
    contact.add_point({std::cos(angle), std::sin(angle), 0}, i == count - 1 ? depth_of_last : 0.1);
  }
  return contact;
}

TEST(ReducePoints, KeepsFewEnoughAsTheyAre) {
  Contact contact = corners(4);
  reduce_points(contact, 4);
  ASSERT_EQ(contact.points().size(), 4u);
  for (int i = 0; i < 4; ++i)
    EXPECT_EQ(contact.points()[i].position, corners(4).points()[i].position);
}

TEST(ReducePoints, KeepsTheLargestHullThatHasADeepestPoint) {
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> uniform(-1, 1);
  for (int i = 0; i < 2000; ++i) {
    Contact all;
    all.normal = Vec3::UnitZ();
    const int count = 5 + i % 4;
    const bool has_inner = i % 2 == 0;
    for (int k = has_inner ? 1 : 0; k < count; ++k) {  // on an ellipse
      const double angle = 2 * M_PI * (k + uniform(random) / 4) / (count - 1);
      all.add_point({std::cos(angle), 0.3 * std::sin(angle), 0}, uniform(random));
    }
    if (has_inner) all.add_point({uniform(random) / 5, uniform(random) / 20, 0}, 1);  // and deepest
    double deepest = -1;
    for (const ContactPoint& p : all.points()) deepest = std::max(deepest, p.depth);
    for (int limit = 3; limit < count; ++limit) {
      double best = 0;
      for (unsigned subset = 0; subset < 1u << count; ++subset) {
        if (std::popcount(subset) != limit) continue;
        std::vector<Eigen::Vector2d> points;
        bool has_deepest = false;
        for (int k = 0; k < count; ++k) {
          if ((subset >> k & 1u) == 0) continue;
          points.push_back(all.points()[k].position.head<2>());
          has_deepest |= all.points()[k].depth == deepest;
        }
        if (has_deepest) best = std::max(best, hull_area(points));
      }
      Contact kept = all;
      reduce_points(kept, limit);
      ASSERT_EQ(static_cast<int>(kept.points().size()), limit);
      EXPECT_GE(hull_area(flat(kept)), 0.998 * best);
      EXPECT_TRUE(std::any_of(kept.points().begin(), kept.points().end(),
                              [&](const ContactPoint& p) { return p.depth == deepest; }));
    }
  }
}

TEST(ReducePoints, KeepsTheOrder) {
  Contact contact = corners(8);
  reduce_points(contact, 4);
  const auto points = flat(contact);
  ASSERT_EQ(points.size(), 4u);
  for (int i = 0; i < 4; ++i) {  // every second one, from the first on
    EXPECT_NEAR((points[i] - flat(corners(4))[i]).norm(), 0, 1e-12);
  }
}

// Areas of lengths above 1e154 overflow, those below 1e-162 vanish.
TEST(ReducePoints, KeepsTheSameAtEveryScale) {
  for (const double level : {0.0, 1e-9}) {
    for (int limit = 1; limit < 8; ++limit) {
      Contact exact = corners(8, 0.2);
      reduce_points(exact, limit, level);
      for (const int exponent : {-900, -600, -500, 250, 500, 600, 900}) {
        const double by = std::ldexp(1, exponent);
        Contact scaled;
        scaled.normal = Vec3::UnitZ();
        const Contact all = corners(8, 0.2);
        for (const ContactPoint& p : all.points()) scaled.add_point(by * p.position, by * p.depth);
        reduce_points(scaled, limit, level);
        ASSERT_EQ(scaled.points().size(), exact.points().size()) << exponent;
        for (int k = 0; k < limit; ++k) {
          EXPECT_EQ(scaled.points()[k].position, by * exact.points()[k].position) << exponent;
          EXPECT_EQ(scaled.points()[k].depth, by * exact.points()[k].depth) << exponent;
        }
      }
    }
  }
}

// A lean that counts as level may be much of a thin body's depth.
TEST(ReducePoints, KeepsAPointThatLacksNoMoreThanIsSaid) {
  constexpr double lower = 0.1 + 3e-10;
  for (int limit = 1; limit < 8; ++limit) {
    Contact contact = corners(8, lower);
    reduce_points(contact, limit, 1e-9, 1e-11);
    double deepest = 0;
    for (const ContactPoint& p : contact.points()) deepest = std::max(deepest, p.depth);
    EXPECT_EQ(deepest, lower) << limit;
  }
}

TEST(ReducePoints, KeepsTheEndsOfALineAndTheDeepestAlone) {
  Contact line;
  line.normal = Vec3::UnitY();
  for (const double x : {-1.0, 0.0, 1.0}) line.add_point({x, 0, 0}, 0.1);
  reduce_points(line, 2);
  ASSERT_EQ(line.points().size(), 2u);
  EXPECT_EQ(line.points()[0].position.x(), -1);
  EXPECT_EQ(line.points()[1].position.x(), 1);

  Contact one = corners(5, 0.2);
  reduce_points(one, 1);
  ASSERT_EQ(one.points().size(), 1u);
  EXPECT_EQ(one.points()[0].depth, 0.2);
}

TEST(ReducePoints, RoundingExchangesNoPoint) {
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> hair(-1e-10, 1e-10);
  for (int limit = 1; limit < 8; ++limit) {
    Contact exact = corners(8);
    reduce_points(exact, limit);
    for (int i = 0; i < 100; ++i) {
      Contact moved;
      moved.normal = Vec3::UnitZ();
      const Contact all = corners(8);
      for (const ContactPoint& p : all.points()) {
        moved.add_point(p.position + Vec3(hair(random), hair(random), 0), p.depth + hair(random));
      }
      reduce_points(moved, limit);
      for (int k = 0; k < limit; ++k) {
        EXPECT_LT((moved.points()[k].position - exact.points()[k].position).norm(), 1e-8);
      }
    }
  }
}

}  // namespace
}  // namespace touchstone
