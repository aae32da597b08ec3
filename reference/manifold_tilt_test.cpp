// How contact points follow a body that leans, from level to where one point is left: a step of the
// tilt moves their hull by little, however deep the bodies are in each other.
#include <algorithm>
#include <cmath>
#include <functional>
#include <gtest/gtest.h>
#include <vector>

#include "reference/contact_of.hpp"
#include "reference/hull_movement_test.hpp"
#include "reference/points_on_both_test.hpp"

namespace touchstone {
namespace {

/// A body above another one, turned and raised.
struct Leaning {
  const char* name;
  std::function<Configuration(const Quaternion& turn, double height)> posed;
  double size;              ///< of what draws together, metres
  std::size_t on_edge = 1;  ///< points that are left where it leans about its y axis
};

std::vector<Leaning> leaning_bodies() {
  const Cylinder can(1, 2), table(3, 1);
  const Plane ground({0, 0, 1}, 0);
  const Box slab({3, 3, 1});
  const auto cylinder_on = [](const Cylinder& a, const Quaternion& base, const Shape& b,
                              double x = 0.1, double y = 0.2) {
    return [=](const Quaternion& turn, double height) -> Configuration {
      return {a, Pose({x, y, height}, turn * base.normalized()), b, Pose()};
    };
  };
  const auto can_along = [=](const Shape& b) {
    return [=](const Quaternion& turn, double height) -> Configuration {
      return {can, Pose({0.1, 0, height}, turn * along_x.normalized()), b,
              Pose({0, 0, 0}, along_x)};
    };
  };
  const auto on_table = [=](const Shape& b, const Quaternion& base) {
    return [=](const Quaternion& turn, double height) -> Configuration {
      return {table, Pose(), b, Pose({0.1, 0.2, height}, turn * base.normalized())};
    };
  };
  return {
      {"standing on a plane", cylinder_on(can, upright, ground), 1},
      {"lying on a plane", cylinder_on(can, along_x, ground), 2},
      {"standing on a box", cylinder_on(can, upright, slab), 1},
      {"lying on a box", cylinder_on(can, along_x, slab), 2},
      {"standing on a cap", cylinder_on(can, upright, table), 1},
      {"lying on a cap", cylinder_on(can, along_x, table), 2},
      {"lying along a side", can_along(Cylinder(1, 3)), 2},
      {"lying along a capsule", can_along(Capsule(1, 3)), 2},
      {"a capsule that lies on a cap", on_table(Capsule(0.5, 2), along_x), 2},
      {"a box on a cap", on_table(Box({1, 0.8, 0.6}), upright), 1, 2},
      {"a needle that stands on a plane", cylinder_on(Cylinder(0.02, 2), upright, ground), 0.02},
      {"a needle that stands on a box", cylinder_on(Cylinder(0.02, 2), upright, slab), 0.02},
      {"over a box's edge", cylinder_on(can, upright, slab, 2.7, 0.2), 1, 2},
      {"over a box's corner", cylinder_on(can, upright, slab, 2.7, 2.8), 1, 2},
      {"over two edges of a box", cylinder_on(can, upright, Box({0.6, 3, 1}), 0.02, 0.2), 1, 2},
      {"over three edges of a box", cylinder_on(can, upright, Box({0.95, 1.2, 1}), 0, 0.31), 1},
      {"over four edges of a box", cylinder_on(can, upright, Box({0.9, 0.88, 1}), 0.02, 0.01), 1},
      {"on a small box", cylinder_on(can, upright, Box({0.4, 0.5, 1}), 0.02, 0.01), 1, 2},
      {"caps that overlap in part", cylinder_on(can, upright, Cylinder(1.2, 1), 0.7, 0.2), 1},
      {"caps that overlap a little", cylinder_on(can, upright, Cylinder(2, 1), 2.7, 0.2), 1},
      {"nearly coaxial caps", cylinder_on(can, upright, can, 0.004, 0.002), 1},
      {"a coin on its edge", cylinder_on(Cylinder(1, 0.02), along_x, slab), 0.02},
  };
}

/// Above the largest tilt of which more than one point is left.
constexpr double steepest = 0.2;

/// The contact where the bodies are so deep in each other; sides part along a normal that leans.
Contact at_depth(const Leaning& body, const Quaternion& turn, double depth) {
  double height = 5;
  for (int i = 0; i < 6; ++i) height -= signed_distance(body.posed(turn, height)).value + depth;
  return contact(body.posed(turn, height), 0);
}

// A tilt that grows by a part of itself changes the hull by some multiple of that part: layouts are
// handed over to each other while it grows by a half, and what is left is drawn together while it
// grows by a quarter. The bodies themselves move by what it grows over their length.
TEST(ManifoldTilt, HullNeverJumpsFromLevelToOnePoint) {
  constexpr double step = 0.005, most_per_step = 11, length = 3;
  for (const Leaning& body : leaning_bodies()) {
    for (const double depth : {1e-9, 1e-6, 1e-3}) {
      for (const double heading : {0.0, 0.7, 2.2}) {
        const Vec3 axis(std::sin(heading), std::cos(heading), 0);
        const auto leaning = [&](double tilt) {
          return at_depth(body, Quaternion(Eigen::AngleAxisd(tilt, axis)), depth);
        };
        Contact before = leaning(0);
        EXPECT_GT(before.points().size(), 1u);
        for (double tilt = 0.05 * std::min(depth, 1e-6);
             tilt < steepest && before.points().size() > 1; tilt *= 1 + step) {
          const Contact after = leaning(tilt);
          EXPECT_LE(hull_movement(before, after),
                    step * (most_per_step * body.size + tilt * length))
              << body.name << ", depth " << depth << ", heading " << heading << ", tilt " << tilt;
          before = after;
        }
        EXPECT_EQ(before.points().size(), heading == 0 ? body.on_edge : 1u)
            << body.name << ", depth " << depth << ", heading " << heading;
      }
    }
  }
}

}  // namespace
}  // namespace touchstone
