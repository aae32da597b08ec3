#include "point_ellipse.hpp"

#include <cmath>
#include <gtest/gtest.h>
#include <limits>
#include <numbers>

namespace touchstone {
namespace {

double distance(double a, double b, double x, double y, double t) {
  return std::hypot(x - a * std::cos(t), y - b * std::sin(t));
}

TEST(PointEllipse, NearestFootIsNearerThanAnySample) {
  for (const double b : {1.0, 0.9, 0.5, 1e-3, 1e-9, 0.0}) {
    for (const double x : {0.0, 1e-12, 0.1, 0.75, 1.0, 3.0, -0.3}) {
      for (const double y : {0.0, 1e-12, 0.05, 0.5, 2.0, -0.2}) {
        const EllipseFeet feet = feet_on_ellipse(1, b, x, y);
        ASSERT_GE(feet.count, 1);
        double nearest = std::numeric_limits<double>::infinity();
        for (int k = 0; k < feet.count; ++k) {
          nearest = std::min(nearest, distance(1, b, x, y, feet.angle[k]));
        }
        for (int i = 0; i < 10000; ++i) {
          const double t = 2 * std::numbers::pi * i / 10000;
          ASSERT_LE(nearest, distance(1, b, x, y, t) + 1e-15) << b << " " << x << " " << y;
        }
      }
    }
  }
}

TEST(PointEllipse, PointOnTheMajorAxisBetweenTheCentresOfCurvatureHasTwo) {
  const EllipseFeet feet = feet_on_ellipse(2, 1, 0.75, 0);
  ASSERT_EQ(feet.count, 2);
  // cos t = a x / (a² − b²) = 1/2
  EXPECT_NEAR(std::abs(feet.angle[0]), std::numbers::pi / 3, 1e-15);
  EXPECT_EQ(feet.angle[0], -feet.angle[1]);
}

TEST(PointEllipse, PointInsideAlsoHasTheFootAcrossTheMajorAxis) {
  const EllipseFeet feet = feet_on_ellipse(2, 1, 0.3, 0.1);
  EXPECT_EQ(feet.count, 3);
}

}  // namespace
}  // namespace touchstone
