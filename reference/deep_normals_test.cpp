// Where a point faces an ellipse, and how far a proof of deep normals reaches, in numbers worked
// out by hand; then the proofs against the pose classes.
#include "reference/deep_normals.hpp"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <numbers>
#include <rapidcheck.h>
#include <string>

#include "properties/identity.hpp"
#include "reference/box_sides.hpp"
#include "reference/contact_of.hpp"
#include "reference/curves.hpp"
#include "reference/random_bodies_test.hpp"

namespace touchstone {
namespace {

double gap(double a, double b, double x, double y, const Eigen::Vector2d& n) {
  return n.dot(Eigen::Vector2d(x, y)) - std::hypot(a * n.x(), b * n.y());
}

void expect_largest_in_quadrant(double b, double x, double y) {
  const auto n = ellipse_normal(1, b, x, y);
  const double rounding = 1e-15 * std::max(1.0, 0.3 * (x + std::abs(y)));
  double found = std::max(gap(1, b, x, y, {1, 0}), gap(1, b, x, y, {0, 1}));
  if (n) {
    ASSERT_NEAR(n->norm(), 1, 1e-15);
    ASSERT_GE(n->x(), 0);
    ASSERT_GE(n->y(), 0);
    found = std::max(found, gap(1, b, x, y, *n));
  }
  for (int i = 0; i <= 10000; ++i) {
    const double t = std::numbers::pi / 2 * i / 10000;
    ASSERT_LE(gap(1, b, x, y, {std::cos(t), std::sin(t)}), found + rounding)
        << b << " " << x << " " << y;
  }
}

TEST(EllipseNormal, HasTheLargestGapOfItsQuadrant) {
  for (const double b : {1.0, 0.9, 0.5, 1e-3, 1e-9, 0.0}) {
    for (const double x : {0.0, 1e-12, 0.1, 0.75, 1.0, 3.0, 1e3, -0.3}) {
      for (const double y : {0.0, 1e-12, 0.05, 0.5, 1e-3, 2.0, 1e3, -1e-12, -1e-3, -0.2, -3.0}) {
        expect_largest_in_quadrant(b, x, y);
      }
    }
  }
}

TEST(EllipseNormal, OfAnyPointHasTheLargestGapOfItsQuadrant) {
  EXPECT_TRUE(rc::check([] {
    const auto magnitude = [] { return std::pow(10, -1e-2 * *rc::gen::inRange(0, 800)); };
    const double sign = *rc::gen::element(-1.0, 1.0);
    expect_largest_in_quadrant(magnitude(), 3 * magnitude(), sign * 3 * magnitude());
    RC_ASSERT(!testing::Test::HasFatalFailure());
  }));
}

TEST(EllipseNormal, NextToTheCuspOfTheEvoluteHasTheLargestGapOfItsQuadrant) {
  for (const double b : {0.99, 0.5, 1e-3, 1e-9}) {
    for (int i = 0; i <= 16; i += 2) {
      for (int j = 0; j <= 16; j += 2) {
        const double cusp = (1 - b) * (1 + b), away = std::pow(10, -i), y = std::pow(10, -j);
        expect_largest_in_quadrant(b, cusp * (1 + away), cusp * y / b);
        expect_largest_in_quadrant(b, cusp * (1 - away), cusp * y / b);
      }
    }
  }
}

// Of an ellipse that is flat but for rounding, the normal at a point beside its end turns from
// along it to across it within 1e-8 of a quadrant.
TEST(EllipseNormal, BesideTheEndOfAFlatEllipseHasTheLargestGapOfItsQuadrant) {
  for (double b = 1e-13; b < 1e-7; b *= 3) {
    for (double y = 1e-14; y < 1e-7; y *= 3) {
      for (const double beyond : {0.0, 1e-16, -1e-16, 1e-15, -1e-15, 1e-12, -1e-12}) {
        const double x = 1 + beyond;
        const auto n = ellipse_normal(1, b, x, y);
        ASSERT_TRUE(n);
        for (double t = 1e-9; t < 1; t *= 1.1) {
          ASSERT_LE(gap(1, b, x, y, {std::sin(t), std::cos(t)}), gap(1, b, x, y, *n) + 1e-15)
              << b << " " << beyond << " " << y;
        }
      }
    }
  }
}

TEST(EllipseNormal, OnTheMajorAxisBetweenTheCentresOfCurvatureLeansToTheFlatSide) {
  const auto n = ellipse_normal(2, 1, 0.75, 0);
  ASSERT_TRUE(n);
  // The foot is at cos t = a x/(a² − b²) = 1/2.
  EXPECT_NEAR(n->x() / n->y(), std::tan(std::numbers::pi / 6) / 2, 1e-14);
}

/// Two cylinders with r = h = R = H = 1, whose axes lean by this sine and whose centres lie 0.5
/// apart along one of them.
AboutAxis half_way_in(double sine) {
  return {1, 1, 1, 1, std::sqrt(1 - sine * sine), sine, 0.5, 0};
}

TEST(DeepNormals, OffTheAxisAreProvenUpToTheDepthAtItsCone) {
  // At 0.05 from the axis F is at least 0.5 cos + sin + cos (0.05 − γ) + sin (0.05 − γ) = 1.588.
  const AboutAxis nearly_parallel = half_way_in(0.01);
  const double cone = std::asin(0.05), gamma = std::asin(0.01);
  const double bound =
      0.5 * std::cos(cone) + std::sin(cone) + std::cos(cone - gamma) + std::sin(cone - gamma);
  EXPECT_TRUE(no_normal_off_axis_beats(nearly_parallel, bound - 1e-9));
  EXPECT_FALSE(no_normal_off_axis_beats(nearly_parallel, bound + 1e-9));
}

// A thin body about the axis, as long as it lies across it: the least depth is that of its own end.
TEST(DeepNormals, OffTheAxisAreProvenUpToTheDepthOfTheOtherEnd) {
  constexpr double r = 3, h = 0.1, thin = 0.001, s = 0.02;
  const double c = std::sqrt(1 - s * s);
  const AboutAxis about{r, h, thin, 1, c, s, 0, 0};
  const double bound = h * c + r * s + (c * c - s * s) + thin * 2 * s * c;
  EXPECT_TRUE(no_normal_off_axis_beats(about, bound - 1e-9));
  EXPECT_FALSE(no_normal_off_axis_beats(about, bound + 1e-9));
}

TEST(DeepNormals, OffTheAxisAreProvenOnlyOfNearlyParallelAxes) {
  EXPECT_TRUE(no_normal_off_axis_beats(half_way_in(0.11), 1.4));
  EXPECT_FALSE(no_normal_off_axis_beats(half_way_in(0.111), 1.4));
}

// Left over, a slope lowers the proven depth by its square over λ, here 0.5: no more than rounding.
TEST(DeepNormals, OfRimsAreProvenWhereNoSlopeIsLeftThatRoundingShows) {
  const Rim rim{1, 1};
  EXPECT_TRUE(bends_away(rim, rim, 1, 0, 4.4e-9));
  EXPECT_FALSE(bends_away(rim, rim, 1, 0, 4.5e-9));
  constexpr double lean = 0.05, depth = 1.5;
  EXPECT_TRUE(bends_away_near_axis(rim, rim, lean, 1, depth, 0.99e-8, half_way_in(0.01)));
  EXPECT_FALSE(bends_away_near_axis(rim, rim, lean, 1, depth, 1.01e-8, half_way_in(0.01)));
}

TEST(DeepNormals, OfRimsAreProvenUpToTheDepthThatTheyBendAway) {
  const Rim rim{1, 1}, flat{1, 0.1};
  EXPECT_TRUE(bends_away(rim, rim, 1, 0.199, 0));  // 2 λ / 5
  EXPECT_FALSE(bends_away(rim, rim, 1, 0.201, 0));
  EXPECT_TRUE(bends_away(flat, flat, 1, 0.036, 0));  // 0.2 of both half lengths, over 1.1
  EXPECT_FALSE(bends_away(flat, flat, 1, 0.037, 0));
  const AboutAxis about = half_way_in(0.01);
  EXPECT_TRUE(bends_away_near_axis(rim, rim, 0.05, 1, 1.5, 0, about));
  EXPECT_FALSE(bends_away_near_axis(rim, rim, 0.051, 1, 1.5, 0, about));
  EXPECT_TRUE(bends_away_near_axis(rim, rim, 0.05, 0.226, 1.5, 0, about));  // 5 δ 0.06 <= 4 λ
  EXPECT_FALSE(bends_away_near_axis(rim, rim, 0.05, 0.224, 1.5, 0, about));
}

/// A cylinder with r = 1 and h = 4 that leans by 45 degrees over the upper right edge of a cube
/// with half extents of 3, along y, which lies at (1, 1)/√2 from it; the depth there is 1 −
/// `apart`.
CylinderInBoxFrame leaning_over_an_edge(double apart, double along_axis = 0,
                                        double along_edge = 0) {
  const double half = std::sqrt(0.5);
  const Vec3 axis(half, 0, -half), out(half, 0, half), edge(3, 0, 3);
  return CylinderInBoxFrame(1, 4, Vec3(3, 3, 3),
                            edge + apart * out - along_axis * axis + along_edge * Vec3::UnitY(),
                            axis);
}

// Of the ball about the place where edge and side meet, as wide as the bodies overlap: it has to
// lie in the cylinder.
TEST(BoxSides, EdgesAreProvenWithinBothOfThemDownToTheAxis) {
  const auto is_edge_proven = [](const CylinderInBoxFrame& p) {
    const BoxSides sides(p);
    EXPECT_EQ(sides.kind(), BoxSides::Kind::edge);
    return sides.best(p, no_early_exit).is_proven;
  };
  EXPECT_TRUE(is_edge_proven(leaning_over_an_edge(0.2)));
  EXPECT_TRUE(is_edge_proven(leaning_over_an_edge(1e-6)));
  EXPECT_FALSE(is_edge_proven(leaning_over_an_edge(-1e-6)));  // deeper than the radius
  for (const double side : {1.0, -1.0}) {
    EXPECT_TRUE(is_edge_proven(leaning_over_an_edge(0.2, side * 3.1999)));  // h − 0.8
    EXPECT_FALSE(is_edge_proven(leaning_over_an_edge(0.2, side * 3.2001)));
    EXPECT_TRUE(is_edge_proven(leaning_over_an_edge(0.2, 0, side * 2.9999)));
    EXPECT_FALSE(is_edge_proven(leaning_over_an_edge(0.2, 0, side * 3.0001)));
  }
}

// The lowest point of a cylinder with r = h = 1 that leans by 45 degrees lies at (x, y, 3 − depth)
// over a cube's upper face.
TEST(BoxSides, FacesAreProvenAsFarFromTheirEdgesAsTheDepth) {
  const double half = std::sqrt(0.5);
  const auto is_face_proven = [&](double x, double y, double depth) {
    const Vec3 axis(half, 0, half), lowest(x, y, 3 - depth);
    const CylinderInBoxFrame p(1, 1, Vec3(3, 3, 3), lowest + axis + Vec3(-half, 0, half), axis);
    const BoxSides sides(p);
    EXPECT_EQ(sides.kind(), BoxSides::Kind::face);
    return sides.best(p, no_early_exit).is_proven;
  };
  EXPECT_TRUE(is_face_proven(0, 0, 0.5));
  for (const double side : {1.0, -1.0}) {
    EXPECT_TRUE(is_face_proven(side * 2.4999, 0, 0.5));
    EXPECT_TRUE(is_face_proven(0, side * 2.4999, 0.5));
    EXPECT_FALSE(is_face_proven(0, side * 2.9, 0.5));
  }
}

struct Counts {
  int proven = 0, contradicted = 0;
};

/// Along how many random normals is the gap larger than along one that is said to have the largest?
template <class Pair>
int larger_gaps(const Pair& pair, double gap, Random& random) {
  int count = 0;
  for (int i = 0; i < 500; ++i) count += pair.gap(random.direction()) > gap + 1e-13;
  return count;
}

FoldedCylinders folded(const Configuration& x) {
  const auto& b = std::get<Cylinder>(x.b);
  const FoldedAxes f(x.pose_a.axis(), x.pose_b.axis(), x.pose_a.position() - x.pose_b.position());
  return {f, x.a.radius(), x.a.half_length(), b.radius(), b.half_length()};
}

template <class Pair>
void count(const Pair& pair, const Vec3& n, bool proven, Random& random, Counts& counts) {
  if (!proven) return;
  ++counts.proven;
  counts.contradicted += larger_gaps(pair, pair.gap(n), random) > 0;
}

TEST(DeepNormals, AreProvenOnlyWhereNoNormalHasALargerGap) {
  Random random(1);
  Counts cap, crossing;
  for (const char* name : {"general-deep", "concentric", "aspect-coin-deep"}) {
    for (std::uint64_t i = 0; i < 1000; ++i) {
      const Configuration x = make_configuration({Pair::cylinder, name, 3, i});
      const FoldedCylinders pair = folded(x);
      const FoldedAxes& f = pair.axes;
      const Vec3 u1(f.d1 < 0 ? -1 : 1, 0, 0), e3(0, 0, 1);
      count(pair, u1,
            no_normal_beats_cap({pair.r1, pair.h1, pair.r2, pair.h2, f.c, f.s, std::abs(f.d1),
                                 std::hypot(f.d2, f.d3)},
                                -pair.gap(u1)),
            random, cap);
      count(pair, e3, no_normal_beats_crossing(pair), random, crossing);
    }
  }
  EXPECT_GT(cap.proven, 300);
  EXPECT_GT(crossing.proven, 600);
  EXPECT_EQ(cap.contradicted, 0);
  EXPECT_EQ(crossing.contradicted, 0);
}

/// Is there a larger gap than this? The answer takes none of the short cuts.
bool has_larger_gap(const Configuration& x, double gap) {
  return certified_distance(x).value > gap + 1e-13 * larger_size(x);
}

TEST(DeepNormals, OfCapsThatTheirRimHoldsHaveTheLargestGap) {
  int proven = 0, contradicted = 0, unproven = 0;
  for (const char* tilt : {"1e-1", "1e-2", "1e-3", "1e-5", "1e-9", "1e-13"}) {
    for (std::uint64_t i = 0; i < 600; ++i) {
      const std::string name = std::string("parallel+tilted-") + tilt;
      const Configuration x = make_configuration({Pair::cylinder, name, 3, i});
      const FoldedCylinders pair = folded(x);
      const FoldedAxes& f = pair.axes;
      const double side = f.d1 < 0 ? -1 : 1, gap = pair.gap({side, 0, 0});
      if (gap > 0) continue;
      // Of all else at the cap: the other rim's point, as seen along the axis.
      const double slope = std::hypot(f.d2 - side * (pair.h2 * f.s - pair.r2 * f.c), f.d3);
      const AboutAxis about{pair.r1, pair.h1, pair.r2,        pair.h2,
                            f.c,     f.s,     std::abs(f.d1), std::hypot(f.d2, f.d3)};
      if (no_normal_beats_held_cap(about, slope, pair.r1, -gap)) {
        ++proven;
        contradicted += has_larger_gap(x, gap);
      } else {
        unproven += has_larger_gap(x, gap);
      }
    }
  }
  EXPECT_GT(proven, 200);
  EXPECT_GT(unproven, 300);
  EXPECT_EQ(contradicted, 0);
}

void expect_no_larger_gap(Pair pair, const std::vector<const char*>& classes) {
  for (const char* name : classes) {
    for (std::uint64_t i = 0; i < 1000; ++i) {
      const Configuration x = make_configuration({pair, name, 3, i});
      EXPECT_FALSE(has_larger_gap(x, signed_distance(x).value)) << name << " " << i;
    }
  }
}

TEST(DeepNormals, OfRimsThatOverlapDeeplyAreNotMissed) {
  expect_no_larger_gap(Pair::cylinder,
                       {"general+deep", "general+deep+coin", "general+deep+needle", "rim-rim"});
}

/// Cylinders of any sizes and axes whose rims meet at a normal, where the gap has a maximum.
TEST(DeepNormals, OfRimsAreNeverTooDeepForAMaximum) {
  Random random(5);
  int maxima = 0, too_deep_by_10 = 0;
  for (int i = 0; i < 20000; ++i) {
    const Vec3 n = random.direction(), u1 = random.direction(), u2 = random.direction();
    const double r1 = random.power_of_ten(-0.5, 0.5), r2 = random.power_of_ten(-0.5, 0.5);
    const double rho1 = u1.cross(n).norm(), rho2 = u2.cross(n).norm();
    const double k1 = r1 / rho1, k2 = r2 / rho2;
    const double squared = u1.cross(n).cross(u2.cross(n)).squaredNorm() / std::pow(rho1 * rho2, 2);
    // The smaller eigenvalue of the rims' Hessian.
    const double deepest = (k1 + k2 - std::sqrt((k1 + k2) * (k1 + k2) - 4 * k1 * k2 * squared)) / 2;
    const double depth = random.uniform(0, 1) * deepest;
    const auto rim = [&](const Vec3& u, double r) {
      return Vec3(std::copysign(1, u.dot(n)) * u + r * (n - n.dot(u) * u).normalized());
    };
    const FoldedAxes axes(u1, u2, rim(u1, r1) + rim(u2, r2) - depth * n);
    const FoldedCylinders pair{axes, r1, 1, r2, 1};
    const Vec3 folded(n.dot(axes.e1), n.dot(axes.e2), n.dot(axes.e3));
    const bool same_ends = folded.x() * axes.along_u2(folded) > 0;
    ++maxima;
    EXPECT_FALSE(overlap_too_deeply(pair, same_ends, depth));
    too_deep_by_10 += overlap_too_deeply(pair, same_ends, 10 * depth);
  }
  EXPECT_GT(too_deep_by_10, maxima / 50);
}

TEST(DeepNormals, OfRimsOnABoxesEdgeAreNotMissed) {
  expect_no_larger_gap(Pair::box,
                       {"parallel+tilted-1e-2", "parallel+tilted-1e-4", "cap-on-face-offset",
                        "coaxial+tilted-1e-4+aligned+huge+not-quite-unit"});
}

/// The largest gap's normal in the folded frame.
Vec3 best_normal(const Configuration& x, const FoldedAxes& f) {
  const Vec3 n = signed_distance(x).normal;
  return {n.dot(f.e1), n.dot(f.e2), n.dot(f.e3)};
}

TEST(DeepNormals, OfRimsThatBendAwayHaveTheLargestGap) {
  Random random(1);
  Counts shallow, near_axis;
  for (const char* name : {"rim-rim", "near-parallel-1e-2", "near-parallel-1e-6"}) {
    for (std::uint64_t i = 0; i < 1000; ++i) {
      const Configuration x = make_configuration({Pair::cylinder, name, 3, i});
      const FoldedCylinders pair = folded(x);
      const FoldedAxes& f = pair.axes;
      const Vec3 n = best_normal(x, f), d = f.d();
      const double across1 = std::hypot(n.y(), n.z()), along2 = f.along_u2(n);
      const double across2 = std::hypot(f.along_k2(n), n.z());
      if (!(across1 > 0 && across2 > 0 && pair.gap(n) <= 0)) continue;
      const double sine = f.s * n.z() / (across1 * across2);
      const Rim on_a{pair.r1, pair.h1}, on_b{pair.r2, pair.h2};
      const AboutAxis about{pair.r2,
                            pair.h2,
                            pair.r1,
                            pair.h1,
                            f.c,
                            f.s,
                            std::abs(f.along_u2(d)),
                            std::hypot(f.along_k2(d), f.d3)};
      count(pair, n, bends_away(on_a, on_b, sine * sine, -pair.gap(n), 0), random, shallow);
      count(pair, n,
            along2 * f.along_u2(d) >= 0 &&
                bends_away_near_axis(on_a, on_b, std::max(across1, across2), sine * sine,
                                     -pair.gap(n), 0, about),
            random, near_axis);
    }
  }
  EXPECT_GT(shallow.proven, 100);
  EXPECT_GT(near_axis.proven, 50);
  EXPECT_EQ(shallow.contradicted, 0);
  EXPECT_EQ(near_axis.contradicted, 0);
}

/// Cylinders of any sizes and axes whose rims meet at a normal, at depths that can be proven and
/// such as cannot.
TEST(DeepNormals, OfRimsThatBendAwayAreProvenUpToTheirDepth) {
  Random random(2);
  const auto size = [&] { return random.power_of_ten(-1, 1); };
  Counts counts;
  int deeper = 0;
  for (int i = 0; i < 4000; ++i) {
    const Vec3 n = random.direction(), u1 = random.direction(), u2 = random.direction();
    const double r1 = size(), h1 = size(), r2 = std::max(r1, size()), h2 = size();
    const auto rim = [&](const Vec3& u, double r, double h) {
      return Vec3(std::copysign(h, u.dot(n)) * u + r * (n - n.dot(u) * u).normalized());
    };
    const Vec3 t1 = u1.cross(n).normalized(), t2 = u2.cross(n).normalized();
    const double squared = t1.cross(t2).squaredNorm();
    const double depth = random.uniform(0, 2) * r1 * r2 / (r1 + r2) * squared;
    const FoldedAxes axes(u1, u2, rim(u1, r1, h1) + rim(u2, r2, h2) - depth * n);
    const FoldedCylinders pair{axes, r1, h1, r2, h2};
    const Vec3 folded(n.dot(axes.e1), n.dot(axes.e2), n.dot(axes.e3));
    EXPECT_NEAR(pair.gap(folded), -depth, 1e-13 * (r1 + r2 + h1 + h2));
    const Rim a{r1, h1}, b{r2, h2};
    count(pair, folded, bends_away(a, b, squared, depth, 0), random, counts);
    if (!bends_away(a, b, squared, depth, 0)) {
      deeper += larger_gaps(pair, -depth, random) > 0;
    }
  }
  EXPECT_GT(counts.proven, 500);
  EXPECT_EQ(counts.contradicted, 0);
  EXPECT_GT(deeper, 100);
}

/// A cylinder, and a box along the axes about the origin.
struct CylinderAndBox {
  double r, h;
  Vec3 u, e, d;
  double gap(const Vec3& n) const {
    return d.dot(n) - e.dot(n.cwiseAbs()) - h * std::abs(u.dot(n)) - r * u.cross(n).norm();
  }
};

/// An edge that goes on for L beyond the point where it meets a rim counts as a disc of radius 2 L.
TEST(DeepNormals, OfRimsOnEdgesAreProvenUpToTheirDepth) {
  Random random(3);
  const auto size = [&] { return random.power_of_ten(-1, 1); };
  Counts counts;
  int deeper = 0;
  for (int i = 0; i < 6000; ++i) {
    CylinderAndBox pair{size(), size(), {}, {size(), size(), size()}, {}};
    pair.u = random.direction();
    const double heading = random.uniform(-3.1416, 3.1416);
    const Vec3 n(std::cos(heading), std::sin(heading), 0);  // the edge is along z
    const Vec3 on_edge(std::copysign(pair.e.x(), n.x()), std::copysign(pair.e.y(), n.y()),
                       random.uniform(-1, 1) * pair.e.z());
    const double sine = pair.u.cross(n).norm(), beyond = pair.e.z() - std::abs(on_edge.z());
    const double squared = pair.u.z() * pair.u.z() / (sine * sine);
    const double depth =
        random.uniform(0, 2) * pair.r * 2 * beyond / (pair.r + 2 * beyond) * squared;
    pair.d = on_edge - depth * n + std::copysign(pair.h, pair.u.dot(n)) * pair.u +
             pair.r / sine * (n - n.dot(pair.u) * pair.u);
    EXPECT_NEAR(pair.gap(n), -depth, 1e-13 * (pair.r + pair.h + pair.e.sum()));
    const bool proven = bends_away({pair.r, pair.h}, {2 * beyond, std::min(pair.e.x(), pair.e.y())},
                                   squared, depth, 0);
    count(pair, n, proven, random, counts);
    if (!proven) deeper += larger_gaps(pair, -depth, random) > 0;
  }
  EXPECT_GT(counts.proven, 500);
  EXPECT_EQ(counts.contradicted, 0);
  EXPECT_GT(deeper, 100);
}

TEST(DeepNormals, OfBoxesThatProveThemselvesHaveTheLargestGap) {
  Random random(4);
  Counts counts;
  int deep = 0;
  for (const char* name : {"general-shallow", "general-deep", "concentric", "cap-on-face-offset",
                           "side-on-face", "coaxial", "touching"}) {
    for (std::uint64_t i = 0; i < 1000; ++i) {
      const Configuration x = make_configuration({Pair::box, name, 3, i});
      const auto& b = std::get<Box>(x.b);
      const Eigen::Matrix3d to_box = x.pose_b.rotation().transpose();
      const Vec3 d = to_box * (x.pose_a.position() - x.pose_b.position());
      const Vec3 u = to_box * x.pose_a.axis();
      const CylinderInBoxFrame pair(x.a.radius(), x.a.half_length(), b.half_extents(), d, u);
      const StageResult best = BoxSides(pair).best(pair, no_early_exit);
      EXPECT_NEAR(best.gap, pair.gap(best.normal()), 1e-14);
      count(pair, best.normal(), best.is_proven, random, counts);
      deep += best.is_proven && -best.gap > x.a.radius();
    }
  }
  EXPECT_GT(counts.proven, 900);
  EXPECT_GT(deep, 100);
  EXPECT_EQ(counts.contradicted, 0);
}

TEST(DeepNormals, OfCrossedCylindersIsAcrossBothSides) {
  const FoldedAxes f(Vec3::UnitX(), Vec3::UnitY(), Vec3(0, 0, 0.25));
  EXPECT_TRUE(no_normal_beats_crossing({f, 1, 2, 1, 2}));
  // Discs as thin as these are nearer to the way out along an axis.
  EXPECT_FALSE(no_normal_beats_crossing({f, 1, 0.25, 1, 2}));
}

}  // namespace
}  // namespace touchstone
