#include <cmath>
#include <gtest/gtest.h>
#include <random>
#include <vector>

#include "oracle/as_hull.hpp"
#include "oracle/patch/contact_patch.hpp"
#include "oracle/patch/convex_set.hpp"
#include "oracle/patch/support_feature.hpp"
#include "properties/moves.hpp"

namespace touchstone::oracle {
namespace {

/// Relative width by which inscribed polygons may be too narrow, as contact_patch.hpp promises.
constexpr double inscribed = 5e-3;
using Kind = ContactPatch::Kind;

const Vec3 upward(0, 0, 1);

Eigen::Quaterniond leaning(double angle) {
  return Eigen::Quaterniond(std::cos(angle / 2), 0, std::sin(angle / 2), 0);
}

ContactPatch over_plane(const Cylinder& cylinder, const Eigen::Quaterniond& q, double epsilon) {
  return contact_patch({cylinder, Pose(Vec3(0, 0, 3), q), Plane(upward, 0), Pose()}, upward,
                       epsilon);
}

TEST(TiltedPatch, OfATiltedCapIsADiscSegment) {
  // Over the lowest rim point to the line that is epsilon higher: half opening angle t.
  for (const double tilt : {1e-3, 1e-6}) {
    for (const double t : {0.05, 1.0, 2.5}) {
      const double r = 0.5, height = r * (1 - std::cos(t));
      const ContactPatch p = over_plane(Cylinder(r, 1), leaning(tilt), height * std::sin(tilt));
      const double area = r * r * (t - std::sin(2 * t) / 2);
      const double s = std::sin(t);
      const double lowest = -4 * r * s * s * s / (3 * (2 * t - std::sin(2 * t)));
      EXPECT_NEAR(p.area() / area, 1, 3e-3);
      EXPECT_NEAR(p.extent(Vec3(1, 0, 0)) / height, 1, 1e-3);
      EXPECT_NEAR(p.extent(Vec3(0, 1, 0)) / (2 * r * (t < pi / 2 ? s : 1)), 1, 1e-3);
      // The rim dips on the side of +x; the cap's middle is the cylinder's, moved by the tilt.
      EXPECT_NEAR(p.centroid().x(), -std::sin(tilt) - lowest, 2e-3 * r);
    }
  }
}

TEST(TiltedPatch, OfASideIsABand) {
  const double r = 0.5, h = 2, epsilon = 1e-6;
  const ContactPatch p = over_plane(Cylinder(r, h), along_x, epsilon);
  EXPECT_EQ(p.kind(), Kind::region);
  EXPECT_NEAR(p.extent(Vec3(1, 0, 0)), 2 * h, 1e-12);
  EXPECT_NEAR(p.extent(Vec3(0, 1, 0)) / (2 * std::sqrt(epsilon * (2 * r - epsilon))), 1, 1e-9);
  EXPECT_NEAR(p.distance(Vec3(0, 0, 0)), 0, 0);
}

// Where the squares of lengths overflow or vanish.
TEST(TiltedPatch, OfATinyCylinderAndAPlaneFarFromItsOriginExists) {
  const Configuration c{Cylinder(0x1p-600, 0x1p-600), Pose(Vec3(0, 0, 1e300), along_x),
                        Plane(upward, 1e300), Pose()};
  EXPECT_FALSE(contact_patch(c, upward, 0x1p-640).outline().empty());
}

TEST(TiltedPatch, OfLengthsNearTheEndsOfTheDoublesIsThatOfOrdinaryOnesScaled) {
  const auto outline = [](double unit) {
    const Configuration c{Cylinder(unit, unit / 4), Pose(unit * Vec3(0.25, 0, 3.2), along_x),
                          Sphere(3 * unit), Pose()};
    return contact_patch(c, upward, unit / 128).outline();
  };
  const std::vector<Vec3> expected = outline(1);
  for (const double unit : {0x1p1022, 0x1p-1000}) {
    const std::vector<Vec3> found = outline(unit);
    ASSERT_EQ(found.size(), expected.size());
    for (std::size_t i = 0; i < found.size(); ++i) EXPECT_EQ(found[i] / unit, expected[i]);
  }
}

TEST(TiltedPatch, OfASphereIsADisc) {
  const double epsilon = 1e-4;
  const ContactPatch p = contact_patch(
      {Cylinder(1, 1), Pose(upward, upright), Sphere(0.5), Pose(-0.5 * upward, upright)}, upward,
      epsilon);
  const double radius = std::sqrt(epsilon * (1 - epsilon));
  EXPECT_NEAR(p.area() / (pi * radius * radius), 1, 2e-3);
}

TEST(TiltedPatch, HoldsAsLongAsEpsilonDoesEvenBeyondTheBody) {
  // The whole of both bodies: the projection of the smaller one.
  const ContactPatch p = contact_patch(
      {Cylinder(0.5, 1), Pose(upward, along_x), Box(Vec3(5, 5, 5)), Pose(-5 * upward, upright)},
      upward, 100);
  EXPECT_NEAR(p.area(), 2, 1e-9);
}

// An independent way to compute the part: its support along t is the minimum over λ >= 0 of h(t + λ
// n) − λ (h(n) − ε), where h is the body's support (Lagrange duality).
/// Support of a body along a vector of its own frame.
double body_support(const Shape& shape, const Vec3& n) {
  if (const auto* s = std::get_if<Cylinder>(&shape)) {
    return s->half_length() * std::abs(n.z()) + s->radius() * std::hypot(n.x(), n.y());
  }
  if (const auto* s = std::get_if<Capsule>(&shape)) {
    return s->half_length() * std::abs(n.z()) + s->radius() * n.norm();
  }
  if (const auto* s = std::get_if<Sphere>(&shape)) return s->radius() * n.norm();
  if (const auto* s = std::get_if<Convex>(&shape)) {
    double highest = s->vertices()[0].dot(n);
    for (const Vec3& v : s->vertices()) highest = std::max(highest, v.dot(n));
    return highest;
  }
  return std::get<Box>(shape).half_extents().dot(n.cwiseAbs());
}

/// In the body's own frame, too.
double part_support(const Shape& shape, const Vec3& n, double epsilon, const Vec3& t) {
  const double level = body_support(shape, n) - epsilon;
  const auto value = [&](double lambda) {
    return body_support(shape, t + lambda * n) - lambda * level;
  };
  // Convex in λ: ternary search over its logarithm; λ = 0 is tried separately. 80 steps leave 3e-13
  // of λ.
  double lo = std::log(1e-9), hi = std::log(1e9);
  for (int i = 0; i < 80; ++i) {
    const double a = lo + (hi - lo) / 3, b = hi - (hi - lo) / 3;
    if (value(std::exp(a)) < value(std::exp(b))) {
      hi = b;
    } else {
      lo = a;
    }
  }
  return std::min(value(0), value(std::exp(lo)));
}

const std::vector<Vec3> wedge{{1, 0.5, 0.25},    {-1, 0.75, 0.25}, {1, -0.5, 0},
                              {-1, -0.5, 0.125}, {0.75, 0, -0.25}, {-1, 0, -0.5}};
const std::vector<Vec3> triangle{{1, 0.5, 0.25}, {-1, 0.75, 0.25}, {0.5, -0.5, 0}};

TEST(TiltedPatch, PartsHaveTheSupportThatDualityGivesThem) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> symmetric(-1, 1), exponent(-5, 0.5);
  const Shape shapes[] = {Cylinder(0.5, 1),     Cylinder(1, 0.1),       Sphere(0.7),
                          Capsule(0.4, 1),      Box(Vec3(1, 0.5, 0.2)), convex_hull(wedge),
                          convex_hull(triangle)};
  for (int i = 0; i < 300; ++i) {
    for (const Shape& shape : shapes) {
      const Eigen::Quaterniond q(symmetric(random), symmetric(random), symmetric(random),
                                 symmetric(random));
      const Pose pose(Vec3::Zero(), q);
      const Eigen::Matrix3d& axes = pose.rotation();
      // Every third nearly aligned with an axis, every third nearly across it.
      Vec3 n = Vec3(symmetric(random), symmetric(random), symmetric(random)).normalized();
      const double tilt = std::pow(10, exponent(random) - 2);
      if (i % 3 == 1) n = (axes.col(2) + tilt * n).normalized();
      if (i % 3 == 2) n = (n - n.dot(axes.col(2)) * axes.col(2) + tilt * axes.col(2)).normalized();
      const double epsilon = std::pow(10, exponent(random));
      std::vector<Vec2> seen;
      const Vec3 e1 = n.unitOrthogonal(), e2 = n.cross(e1);
      const Vec3 own_n = axes.transpose() * n;
      const double top = body_support(shape, own_n);
      for (const Vec3& p : support_part(shape, pose, n, epsilon, Vec3::Zero())) {
        const bool is_round =
            std::holds_alternative<Sphere>(shape) || std::holds_alternative<Capsule>(shape);
        EXPECT_TRUE(is_round || p.dot(n) >= top - epsilon * (1 + 1e-9) - 1e-14);
        seen.emplace_back(p.dot(e1), p.dot(e2));
      }
      const ConvexSet part = ConvexSet::polygon(plane_hull(seen));
      for (int k = 0; k < 8; ++k) {
        const Vec2 d(std::cos(k * pi / 8), std::sin(k * pi / 8));
        const Vec3 t = axes.transpose() * (d.x() * e1 + d.y() * e2);
        const double width =
            part_support(shape, own_n, epsilon, t) + part_support(shape, own_n, epsilon, -t);
        const double ours = part.support(d) + part.support(-d);
        EXPECT_LE(ours, width * (1 + 1e-6) + 1e-12) << shape_name(shape);
        EXPECT_GE(ours, width * (1 - inscribed) - 1e-12)
            << shape_name(shape) << " epsilon " << epsilon << " cos " << axes.col(2).dot(n);
      }
    }
  }
}

TEST(TiltedPatch, OverlapIsWhatIsInBothParts) {
  // Monte Carlo over the plane: inside the patch if within both parts' hulls.
  std::mt19937 random(4);
  std::uniform_real_distribution<double> symmetric(-1, 1);
  for (int i = 0; i < 30; ++i) {
    const Vec3 n = (upward + 0.02 * Vec3(symmetric(random), symmetric(random), 0)).normalized();
    const Configuration c{Cylinder(0.5, 1), Pose(Vec3(0.3 * symmetric(random), 0, 1), upright),
                          Box(Vec3(0.4, 0.6, 1)), Pose(-upward, upright)};
    const double epsilon = 0.01;
    const ContactPatch p = contact_patch(c, n, epsilon);
    const Vec3 e1 = n.unitOrthogonal(), e2 = n.cross(e1);
    const auto part = [&](const Shape& shape, const Pose& pose, const Vec3& outward) {
      std::vector<Vec2> seen;
      for (const Vec3& x : support_part(shape, pose, outward, epsilon, Vec3::Zero())) {
        seen.emplace_back(x.dot(e1), x.dot(e2));
      }
      return ConvexSet::polygon(plane_hull(seen));
    };
    const ConvexSet a = part(c.a, c.pose_a, -n), b = part(c.b, c.pose_b, n);
    int inside = 0;
    constexpr int count = 20000;
    for (int k = 0; k < count; ++k) {
      const Vec2 x(symmetric(random), symmetric(random));
      const bool in_both = a.distance(x) == 0 && b.distance(x) == 0;
      inside += in_both ? 1 : 0;
      if (in_both) {
        EXPECT_LE(p.distance(x.x() * e1 + x.y() * e2), 1e-12);
      }
    }
    EXPECT_NEAR(4.0 * inside / count, p.area(), 4 * 4.5 * 0.5 / std::sqrt(count));
  }
}

constexpr auto flat = Alignment::parallel;
constexpr auto across = Alignment::perpendicular;
constexpr auto slanting = Alignment::oblique;

/// Exactly degenerate contacts along z, in units of `s` metres.
struct Exact {
  Configuration c;
  OptimalNormal n;
};
std::vector<Exact> exact_contacts(double s) {
  const auto upright_at = [&](double x, double y, double z) {
    return Pose(s * Vec3(x, y, z), upright);
  };
  const Cylinder can(0.5 * s, s), other(0.75 * s, s);
  const Box box(s * Vec3(1, 1, 1));
  const std::array<Alignment, 3> of_cap{slanting, slanting, flat}, of_face{across, across, flat};
  return {
      {{can, upright_at(0.75, 0.25, 1), other, upright_at(0, 0, -1)}, {upward, flat, of_cap}},
      {{can, upright_at(0.75, 0.9, 1), box, upright_at(0, 0, -1)}, {upward, flat, of_face}},
      {{can, upright_at(0.25, 0.25, 1), box, upright_at(0, 0, -1)}, {upward, flat, of_face}},
      {{can, Pose(s * Vec3(0.75, 0.25, 0.5), along_x), box, upright_at(0, 0, -1)},
       {upward, across, of_face}},
      {{can, Pose(s * Vec3(0.75, 0.25, 0.5), along_x), other, upright_at(0, 0, -1)},
       {upward, across, of_cap}},
  };
}

TEST(TiltedPatch, TendsToTheExactPatchWithEpsilonAtAnyScale) {
  for (const double s : {1e-6, 1.0, 1e6}) {
    for (const auto& [c, n] : exact_contacts(s)) {
      const ContactPatch exact = contact_patch(c, n);
      for (const double epsilon : {1e-4, 1e-8, 1e-12}) {
        const ContactPatch wider = contact_patch(c, upward, epsilon * s);
        // A side's band is 2 √(2 ε r) wide; a disc is inscribed.
        const double band = 2 * std::sqrt(epsilon) * s;
        for (const double angle : {0.0, 0.5, 1.0, 1.5, 2.0, 2.5}) {
          const Vec3 direction(std::cos(angle), std::sin(angle), 0);
          const double width = exact.extent(direction);
          EXPECT_LE(wider.extent(direction), width + band + 1e-12 * s);
          EXPECT_GE(wider.extent(direction), width * (1 - inscribed) - 1e-12 * s);
        }
        EXPECT_LE((wider.centroid() - exact.centroid()).norm(), band + 1e-3 * s);
      }
    }
  }
}

TEST(TiltedPatch, AnyNormalAndEpsilonGiveAFinitePatch) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> symmetric(-1, 1), exponent(-18, 3);
  const auto length = [&] { return std::pow(10, exponent(random) / 3); };
  const auto pose = [&] {
    const double lean = std::pow(10, exponent(random));
    return Pose(Vec3(symmetric(random), symmetric(random), symmetric(random)),
                Eigen::Quaterniond(1, lean * symmetric(random), lean * symmetric(random), 0));
  };
  for (int i = 0; i < 4000; ++i) {
    const Shape others[] = {Cylinder(length(), length()),
                            Plane(upward, length()),
                            Sphere(length()),
                            Capsule(length(), length()),
                            Box(Vec3(length(), length(), length())),
                            as_hull(Box(Vec3(length(), length(), length()))),
                            convex_hull(triangle)};
    const Configuration c{Cylinder(length(), length()), pose(),
                          others[i % static_cast<int>(std::size(others))], pose()};
    const double tilt = std::pow(10, exponent(random));
    const Vec3 n = (upward + tilt * Vec3(symmetric(random), symmetric(random), 0)).normalized();
    const ContactPatch p = contact_patch(c, n, std::pow(10, exponent(random)));
    EXPECT_TRUE(p.centroid().allFinite());
    EXPECT_GE(p.area(), -1e-12 * p.perimeter() * p.perimeter());
    EXPECT_LE(p.distance(p.centroid()), 1e-9 * (1 + p.perimeter()));
  }
}

TEST(TiltedPatch, PartsThatDoNotMeetGiveThePointBetweenThem) {
  const ContactPatch p = contact_patch(
      {Cylinder(1, 1), Pose(Vec3(4, 0, 1), upright), Box(Vec3(1, 1, 1)), Pose(-upward, upright)},
      upward, 1e-3);
  EXPECT_EQ(p.kind(), Kind::point);
  EXPECT_NEAR(p.centroid().x(), 2, 1e-12);
}

constexpr double e = 1e-6;
WidthFromEpsilon width(const Shape& shape, const Eigen::Quaterniond& q) {
  return width_from_epsilon(shape, Pose(Vec3::Zero(), q), upward, e);
}

TEST(WidthFromEpsilon, IsThatOfWhatIsNotFlat) {
  EXPECT_EQ(width(Cylinder(0.5, 1), upright).largest, 0);
  EXPECT_NEAR(width(Cylinder(0.5, 1), leaning(1e-7)).largest, 0, 1e-12);
  EXPECT_NEAR(width(Cylinder(0.5, 1), along_x).largest, 2 * std::sqrt(e * (1 - e)), 1e-15);
  EXPECT_NEAR(width(Sphere(0.5), upright).largest, 2 * std::sqrt(e * (1 - e)), 1e-15);
  EXPECT_EQ(width(Box(Vec3(1, 1, 1)), upright).largest, 0);
  EXPECT_NEAR(width(Box(Vec3(1, 1, 1)), leaning(1e-4)).largest, 1e-2, 1e-6);
}

TEST(WidthFromEpsilon, CornersHaveNoOther) {
  EXPECT_TRUE(width(Sphere(0.5), upright).is_a_corner);
  EXPECT_TRUE(width(Cylinder(0.5, 1), leaning(0.5)).is_a_corner);
  EXPECT_FALSE(width(Cylinder(0.5, 1), leaning(1e-7)).is_a_corner);
  EXPECT_FALSE(width(Cylinder(0.5, 1), along_x).is_a_corner);
  EXPECT_TRUE(width(Capsule(0.5, 1), upright).is_a_corner);
  EXPECT_FALSE(width(Capsule(0.5, 1), along_x).is_a_corner);
  EXPECT_FALSE(width(Box(Vec3(1, 1, 1)), leaning(0.5)).is_a_corner);  // an edge
  EXPECT_TRUE(width(Box(Vec3(1, 1, 1)), Eigen::Quaterniond(1, 0.3, 0.2, 0)).is_a_corner);
}

TEST(WidthFromEpsilon, OfATriangleIsThatOfItsEdges) {
  const Convex hull = convex_hull(std::vector<Vec3>{{0, 0, 0}, {4, 0, 0}, {0, 3, 0}});
  EXPECT_EQ(width(hull, upright).largest, 0);
  EXPECT_FALSE(width(hull, upright).is_a_corner);
  // Its edge along y is down at a slope of 1e-4.
  EXPECT_NEAR(width(hull, leaning(1e-4)).largest, 1e-2, 1e-6);
  EXPECT_FALSE(width(hull, leaning(1e-4)).is_a_corner);
  EXPECT_TRUE(width(hull, Eigen::Quaterniond(1, 0.3, 0.2, 0)).is_a_corner);
  // On edge, with a side up: nothing but that side.
  EXPECT_LE(width(hull, about(Vec3(0, 1, 0), pi / 2)).largest, e);
  EXPECT_FALSE(width(hull, about(Vec3(0, 1, 0), pi / 2)).is_a_corner);
}

}  // namespace
}  // namespace touchstone::oracle
