// A cylinder against a hull: boxes given as hulls, a search for larger gaps in long double, closed
// forms, and laws.
//
// TOUCHSTONE_COUNT sets how many configurations of each kind are tried.
#include <algorithm>
#include <array>
#include <cmath>
#include <gtest/gtest.h>
#include <limits>
#include <numbers>
#include <string>
#include <vector>

#include "oracle/hull.hpp"
#include "properties/identity.hpp"
#include "properties/moves.hpp"
#include "reference/contact_of.hpp"
#include "reference/convex_tables.hpp"
#include "reference/largest_gap.hpp"
#include "reference/random_hulls_test.hpp"

namespace touchstone {
namespace {

using Real = long double;
using Real3 = Eigen::Matrix<Real, 3, 1>;

/// A cylinder in a hull's frame, in long double.
struct Exactly {
  explicit Exactly(const Configuration& c)
      : hull(std::get<Convex>(c.b)), r(c.a.radius()), h(c.a.half_length()) {
    const auto rotation = [](const Pose& p) -> Eigen::Matrix<Real, 3, 3> {
      return p.orientation().cast<Real>().normalized().toRotationMatrix();
    };
    const Eigen::Matrix<Real, 3, 3> back = rotation(c.pose_b).transpose();
    d = back * (c.pose_a.position().cast<Real>() - c.pose_b.position().cast<Real>());
    u = back * rotation(c.pose_a).col(2);
  }
  Real reach(const Real3& n) const { return h * std::abs(u.dot(n)) + r * u.cross(n).norm(); }
  /// Along a vector of any length but zero.
  Real gap(const Real3& way) const {
    const Real3 n = way.normalized();
    Real support = -std::numeric_limits<Real>::infinity();
    for (const Vec3& v : hull.vertices()) support = std::max(support, n.dot(v.cast<Real>()));
    return d.dot(n) - reach(n) - support;
  }
  /// The largest gap of many: of faces and caps, across each edge (the crossing, and what a search
  /// around the edge finds), of each vertex beside the side and off the rims.
  Real largest() const {
    Real best = -std::numeric_limits<Real>::infinity();
    const auto offer = [&](const Real3& n) {
      if (n.norm() > 1e-30L) best = std::max({best, gap(n)});
    };
    offer(u), offer(-u);
    const auto at = [&](int i) -> Real3 {
      return hull.vertices()[static_cast<std::size_t>(i)].cast<Real>();
    };
    for (const auto& f : hull.faces()) {
      const auto& v = f.vertices;
      Real3 area = Real3::Zero();
      for (std::size_t i = 2; i < v.size(); ++i)
        area += (at(v[i - 1]) - at(v[0])).cross(at(v[i]) - at(v[0]));
      offer(area);
    }
    for (const Vec3& v : hull.vertices()) {
      const Real3 arm = d - v.cast<Real>();
      const Real height = arm.dot(u);
      const Real3 across = arm - height * u;
      offer(across);
      const Real above = std::abs(height) - h, beside = across.norm() - r;
      if (above > 0 && beside > 0)
        offer(std::copysign(above, height) * u + beside * across.normalized());
    }
    for (const auto& e : hull.edges()) {
      const Real3 along = (at(e.vertices[1]) - at(e.vertices[0])).normalized();
      Real3 x = u - u.dot(along) * along;
      if (!(x.norm() > 1e-15L)) x = along.unitOrthogonal();
      x.normalize();
      const Real3 y = along.cross(x);
      offer(y), offer(-y);
      const Real3 arm = d - at(e.vertices[0]);
      const auto normal = [&](Real angle) -> Real3 {
        return std::cos(angle) * x + std::sin(angle) * y;
      };
      const auto of_edge = [&](Real angle) {
        const Real3 n = normal(angle);
        return arm.dot(n) - reach(n);
      };
      constexpr int samples = 90;
      std::array<Real, samples> values;
      constexpr Real step = 2 * std::numbers::pi_v<Real> / samples;
      for (int i = 0; i < samples; ++i) values[static_cast<std::size_t>(i)] = of_edge(i * step);
      for (int i = 0; i < samples; ++i) {
        const Real value = values[static_cast<std::size_t>(i)];
        if (value < values[static_cast<std::size_t>((i + 1) % samples)] ||
            value < values[static_cast<std::size_t>((i + samples - 1) % samples)] ||
            !(value + 0.03L * (r + h) > best)) {
          continue;
        }
        Real lo = (i - 1) * step, hi = (i + 1) * step;
        for (int k = 0; k < 70; ++k) {  // ternary search
          const Real a = lo + (hi - lo) / 3, b = hi - (hi - lo) / 3;
          of_edge(a) < of_edge(b) ? lo = a : hi = b;
        }
        offer(normal((lo + hi) / 2));
      }
    }
    return best;
  }

  const Convex& hull;
  Real r, h;
  Real3 d, u;
};

/// The answer's value is the gap of its normal, no other normal has a larger one, and the other
/// three questions agree.
void expect_largest(const Configuration& c) {
  const Exactly exactly(c);
  const SignedDistance found = signed_distance(c);
  const double rounding = promised * lengths_of(c);
  ASSERT_NEAR(found.normal.norm(), 1, 4e-15);
  const Eigen::Matrix<Real, 3, 3> back =
      c.pose_b.orientation().cast<Real>().normalized().toRotationMatrix().transpose();
  ASSERT_NEAR(static_cast<double>(exactly.gap(back * found.normal.cast<Real>()) - found.value), 0,
              rounding);
  ASSERT_GE(found.value, static_cast<double>(exactly.largest()) - rounding);
  const CertifiedDistance certified = certified_distance(c);
  ASSERT_LE(std::abs(certified.value - found.value), certified.error_bound + rounding);
  if (std::abs(found.value) > rounding) {
    ASSERT_EQ(overlaps(c), found.value <= 0);
  }
}

class Hulls : public testing::TestWithParam<HullKind> {};

TEST_P(Hulls, NoNormalHasALargerGap) {
  Random random(1);
  for (std::uint64_t i = 0; i < tried_of_each(100); ++i) {
    SCOPED_TRACE(i);
    const Configuration c = with_hull(GetParam(), random);
    expect_largest(c);
    if (HasFatalFailure()) return;
    const Configuration shallow = moved_to_depth(c, random.power_of_ten(-12, -1) * smaller_size(c));
    expect_largest(shallow);
    if (HasFatalFailure()) return;
  }
}

TEST_P(Hulls, AreTheSameWhateverTheUnitOfLength) {
  Random random(2);
  for (std::uint64_t i = 0; i < tried_of_each(100); ++i) {
    SCOPED_TRACE(i);
    const Configuration c = with_hull(GetParam(), random);
    const SignedDistance one = signed_distance(c);
    const Contact points = contact(c, 0);
    for (const double factor : {0x1p40, 0x1p-40}) {
      const Configuration other = scaled(c, factor);
      const SignedDistance two = signed_distance(other);
      ASSERT_EQ(two.value, factor * one.value);
      ASSERT_EQ(two.normal, one.normal);
      const Contact more = contact(other, 0);
      ASSERT_EQ(more.points().size(), points.points().size());
      for (std::size_t k = 0; k < points.points().size(); ++k) {
        ASSERT_EQ(more.points()[k].position, factor * points.points()[k].position);
      }
    }
    for (const double factor : {0x1p-670, 0x1p+890}) {  // beyond what powers of lengths may be
      const double rounding = promised * lengths_of(c);
      const SignedDistance two = signed_distance(scaled(c, factor));
      ASSERT_NEAR(two.value / factor, one.value, rounding);
      const Contact more = contact(scaled(c, factor), 0);
      ASSERT_EQ(more.points().size(), points.points().size());
      for (std::size_t k = 0; k < points.points().size(); ++k) {
        ASSERT_NEAR(more.points()[k].depth / factor, points.points()[k].depth, rounding);
      }
    }
  }
}

TEST_P(Hulls, AreProvenToWithinRounding) {
  Random random(3);
  for (std::uint64_t i = 0; i < tried_of_each(100); ++i) {
    SCOPED_TRACE(i);
    const Configuration c = with_hull(GetParam(), random);
    const CertifiedDistance certified = certified_distance(c);
    ASSERT_LE(certified.error_bound, promised * lengths_of(c));
    ASSERT_LE(static_cast<double>(Exactly(c).largest()), certified.value + certified.error_bound);
  }
}

// Where a rim and an edge face each other, rounding leaves open whether another normal is better by
// a little: without that no bound would be a quarter above what lengths are rounded by.
TEST(CertifiedHulls, BoundsCountWhatRimsLeaveOpen) {
  Random random(8);
  int count = 0, counted = 0;
  for (const HullKind kind : hull_kinds) {
    for (int i = 0; i < 500; ++i, ++count) {
      const Configuration c = with_hull(kind, random);
      const double lengths = (c.pose_a.position() - c.pose_b.position()).cwiseAbs().sum() +
                             c.a.radius() + c.a.half_length() + std::get<Convex>(c.b).tables().far;
      const double bound = certified_distance(c).error_bound / (rounding_part * lengths);
      EXPECT_GE(bound, 1 - 1e-12);
      counted += bound > 1.25;
    }
  }
  EXPECT_GE(counted, 0.085 * count);
}

// A side that touches an edge nearly along its axis: what is compared there is mostly rounding, by
// which the crossing was ruled out, for an error of up to 1e-9.
TEST_P(Hulls, AreExactWhereTheSideCrossesAnEdgeByAHair) {
  Random random(4);
  for (std::uint64_t i = 0; i < tried_of_each(100); ++i) {
    SCOPED_TRACE(i);
    Configuration c = with_hull(GetParam(), random);
    const Convex& hull = std::get<Convex>(c.b);
    const auto& edge = hull.edges()[static_cast<std::size_t>(
        random.one_of(static_cast<int>(hull.edges().size())))];
    const Vec3 from = hull.vertices()[edge.vertices[0]], to = hull.vertices()[edge.vertices[1]];
    const Vec3 along = (to - from).stableNormalized();
    const Vec3 out =
        (hull.faces()[static_cast<std::size_t>(edge.faces[0])].normal +
         random.uniform(0, 1) * hull.faces()[static_cast<std::size_t>(edge.faces[1])].normal);
    const Vec3 n = (out - out.dot(along) * along).stableNormalized();
    const double crossing = random.power_of_ten(-9, -4);
    const Vec3 axis = along + crossing * along.cross(n);
    const Vec3 place = from + random.uniform(0, 1) * (to - from);
    const Cylinder a(random.power_of_ten(-3, 0), c.a.half_length());
    c = {a, Pose(place + a.radius() * n, turn_between(Vec3::UnitZ(), axis)), hull, Pose()};
    expect_largest(c);
    if (HasFatalFailure()) return;
  }
}

INSTANTIATE_TEST_SUITE_P(, Hulls, testing::ValuesIn(hull_kinds), [](const auto& kind) {
  return hull_kind_names[static_cast<int>(kind.param)];
});

/// The box of a configuration as a hull, in its own frame or in another one.
Configuration with_box_as_hull(const Configuration& c, const Pose& frame) {
  std::vector<Vec3> corners = corners_of(std::get<Box>(c.b));
  for (Vec3& p : corners) p = frame.position() + frame.rotation() * p;
  const Eigen::Quaterniond turn = c.pose_b.unit_orientation() * frame.unit_orientation().inverse();
  return {c.a, c.pose_a, oracle::convex_hull(corners),
          Pose(c.pose_b.position() - turn * frame.position(), turn)};
}

TEST(BoxesAsHulls, HaveTheBoxesDistances) {
  Random random(1);
  for (const std::string& name : pose_classes(Pair::box)) {
    for (std::uint64_t i = 0; i < tried_of_each(10); ++i) {
      const Configuration c = make_configuration({Pair::box, name, 31, i});
      SCOPED_TRACE(name + "/31/" + std::to_string(i));
      const SignedDistance box = signed_distance(c);
      const Configuration same = with_box_as_hull(c, Pose());
      const Configuration moved =
          with_box_as_hull(c, Pose(larger_size(c) * random.direction(), random.turn()));
      for (const Configuration& hull : {same, moved}) {
        // Positions are rounded where the box is far away.
        const double rounding = promised * lengths_of(hull) + 1e-15 * hull.pose_b.position().norm();
        const SignedDistance found = signed_distance(hull);
        ASSERT_NEAR(found.value, box.value, rounding);
        ASSERT_NEAR(certified_distance(hull).value, box.value, rounding);
        const double threshold = std::max(found.value, 0.0) + 1e-6 * smaller_size(c);
        const Contact points = contact(hull, threshold);
        ASSERT_FALSE(points.points().empty());
      }
    }
  }
}

TEST(Triangles, HaveTheDistancesOnPaper) {
  const Convex triangle = oracle::convex_hull({Vec3(-1, -1, 0), Vec3(2, -1, 0), Vec3(-1, 2, 0)});
  const Cylinder a(0.5, 1);
  struct Case {
    Vec3 centre;
    Eigen::Quaterniond turn;
    double distance;
    Vec3 normal;
  };
  const double diagonal = std::sqrt(0.5);
  const Case cases[] = {
      {{0, 0, 1.25}, upright, 0.25, Vec3::UnitZ()},       // a cap above the face
      {{0, 0, -0.75}, upright, -0.25, -Vec3::UnitZ()},    // below it, deep
      {{0.1, 0, 0.4}, along_x, -0.1, Vec3::UnitZ()},      // a side on the face
      {{-1.25, 0, 0.2}, upright, -0.25, -Vec3::UnitX()},  // an edge across the side
      {{-1.75, 0.5, 0}, along_y, 0.25, -Vec3::UnitX()},   // edge-on
      {{0.75, 0.75, 0}, upright, 0.5 * std::sqrt(0.5) - 0.5, Vec3(diagonal, diagonal, 0)},
      {{-1.3, -1.4, 0}, upright, 0, Vec3(-0.6, -0.8, 0)},  // a corner touches the side
  };
  for (const Case& x : cases) {
    SCOPED_TRACE(x.centre.transpose());
    const Configuration c{a, Pose(x.centre, x.turn), triangle, Pose()};
    const SignedDistance found = signed_distance(c);
    EXPECT_NEAR(found.value, x.distance, 1e-15);
    EXPECT_LT((found.normal - x.normal).norm(), 1e-14);
  }
}

// Deep in a cylinder's end the shortest way out is past the cap, deep in its middle past the side.
TEST(Triangles, DeepInACylinderComeFreeTheShorterWay) {
  const Convex small = oracle::convex_hull({Vec3(0, 0, 0), Vec3(0.1, 0, 0), Vec3(0, 0.1, 0)});
  const Cylinder a(1, 2);
  EXPECT_NEAR(signed_distance({a, Pose(Vec3(0, 0, -1.5)), small, Pose()}).value, -0.5, 1e-15);
  // From the axis: the side at a right angle to the hypotenuse, or past the corner at the origin.
  const double beside = signed_distance({a, Pose(), small, Pose()}).value;
  EXPECT_NEAR(beside, -1, 1e-15);
}

// Next to the axis, and along it, what rounding leaves along an edge decided that its ends are no
// nearest vertices: by most of their distance from the axis too deep.
TEST(Triangles, WithAnEdgeNextToTheAxisAreAsDeepAsThat) {
  for (std::uint64_t i = 0; i < 500; ++i) {
    Random random(i);
    const double beside = random.power_of_ten(-11, -6);
    const Eigen::Quaterniond turn = random.turn();
    const auto at = [&](double x, double y) -> Vec3 {
      return turn * Vec3(x, y, random.uniform(-1, 1));
    };
    const Convex triangle = oracle::convex_hull(
        {at(beside, 0), at(beside, 0), at(random.uniform(0.1, 1), random.uniform(-1, 1))});
    const Configuration c{Cylinder(1, 3), Pose(Vec3::Zero(), turn), triangle, Pose()};
    EXPECT_NEAR(signed_distance(c).value, beside - 1, promised) << i;
    EXPECT_NEAR(certified_distance(c).value, beside - 1, promised) << i;
  }
}

// The wheel that Jolt#1008 is about: beside a triangle's edge by a hair.
TEST(Triangles, BesideAnEdgeAreApart) {
  const Convex floor = oracle::convex_hull({Vec3(-1, -1, 0), Vec3(1, -1, 0), Vec3(0, 1, 0)});
  const Cylinder wheel(0.4, 0.1);
  const double apart = 0.000176;
  const Configuration c{wheel, Pose({0, -1 - 0.1 - apart, 0.2}, along_y), floor, Pose()};
  EXPECT_NEAR(signed_distance(c).value, apart, 1e-15);
  EXPECT_FALSE(overlaps(c));
}

}  // namespace
}  // namespace touchstone
