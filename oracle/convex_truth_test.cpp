// The truth against convex bodies: boxes given as hulls have the box's truth, triangles one on
// paper, and no direction that a search finds beats it.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <gtest/gtest.h>
#include <random>
#include <string>
#include <vector>

#include "oracle/as_hull.hpp"
#include "oracle/hull.hpp"
#include "oracle/rounding.hpp"
#include "oracle/truth.hpp"
#include "properties/draw.hpp"
#include "properties/identity.hpp"
#include "properties/moves.hpp"
#include "reference/invalid_input.hpp"
#include "reference/support.hpp"

namespace touchstone::oracle {
namespace {

using Quaternion = Eigen::Quaterniond;

/// Of gaps in double: a few ulp of the lengths that enter them.
constexpr double gap_rounding = 1e-14;

double lengths_of(const Configuration& c) {
  return larger_size(c) + (c.pose_a.position() - c.pose_b.position()).norm();
}

bool has_normal(const Truth& t, const OptimalNormal& wanted) {
  return std::any_of(t.normals.begin(), t.normals.end(), [&](const OptimalNormal& n) {
    return (n.n - wanted.n).norm() < 1e-15 && n.to_a == wanted.to_a;
  });
}

/// The corners that the box's truth says to be in the support plane: those on the normal's side of
/// every axis that is not across it. None where doubles do not tell the side.
std::vector<int> box_support(const Pose& pose, const OptimalNormal& normal) {
  std::vector<int> result;
  for (int corner = 0; corner < 8; ++corner) {
    bool is_highest = true;
    for (int i = 0; i < 3; ++i) {
      const double side = pose.rotation().col(i).dot(normal.n);
      if (normal.to_b[i] == Alignment::perpendicular) continue;
      if (std::abs(side) < gap_rounding) return {};
      is_highest = is_highest && (side > 0) == ((corner >> i & 1) != 0);
    }
    if (is_highest) result.push_back(corner);
  }
  return result;
}

void expect_the_boxs_truth(const Configuration& box) {
  const Configuration hull = with_hull(box);
  const Truth was = truth(box), is = truth(hull);
  EXPECT_EQ(was.signed_distance.lo, is.signed_distance.lo);
  EXPECT_EQ(was.signed_distance.hi, is.signed_distance.hi);
  EXPECT_EQ(was.ties, is.ties);
  EXPECT_EQ(was.families.size(), is.families.size());
  if (was.ties == Ties::continuum) return;  // other members may stand for the family
  EXPECT_EQ(was.normals.size(), is.normals.size());
  for (const OptimalNormal& n : was.normals) EXPECT_TRUE(has_normal(is, n)) << n.n.transpose();
  for (const OptimalNormal& n : is.normals) EXPECT_TRUE(has_normal(was, n)) << n.n.transpose();
  if (was.normals.size() != 1) return;
  const std::vector<int> support = box_support(box.pose_b, was.normals[0]);
  if (!support.empty()) {
    EXPECT_EQ(is.normals[0].support_b, support);
  }
}

TEST(ConvexTruth, OfABoxGivenAsAHullIsTheBoxs) {
  const char* const text = std::getenv("TOUCHSTONE_COUNT");
  const std::uint64_t count = text ? static_cast<std::uint64_t>(std::atoi(text)) : 1;
  for (const std::string& name : pose_classes(Pair::box)) {
    for (std::uint64_t i = 0; i < count; ++i) {
      SCOPED_TRACE(to_string(Identity{Pair::box, name, 21, i}));
      expect_the_boxs_truth(make_configuration({Pair::box, name, 21, i}));
    }
  }
}

/// Small integers and halves, whose poses are often degenerate.
class GridPoses {
 public:
  explicit GridPoses(unsigned seed) : random_(seed) {}
  double integer(int lo, int hi) { return std::uniform_int_distribution<int>(lo, hi)(random_); }
  double length() { return integer(1, 4) / 2; }
  Vec3 place(int reach) {
    return {integer(-reach, reach) / 2, integer(-reach, reach) / 2, integer(-reach, reach) / 2};
  }
  Quaternion orientation() {
    for (;;) {
      Quaternion q(integer(-2, 2), integer(-2, 2), integer(-2, 2), integer(-2, 2));
      if (q.squaredNorm() > 0) return q;
    }
  }
  Configuration against(const Shape& b) {
    return {Cylinder(length(), length()), Pose(place(4), orientation()), b,
            Pose(Vec3::Zero(), orientation())};
  }

 private:
  std::mt19937 random_;
};

TEST(ConvexTruth, OfABoxGivenAsAHullIsTheBoxsInDegeneratePoses) {
  GridPoses poses(1);
  for (int i = 0; i < 300; ++i) {
    SCOPED_TRACE(i);
    expect_the_boxs_truth(poses.against(Box({poses.length(), poses.length(), poses.length()})));
  }
}

// A hull's own frame means nothing: vertices turned one way, and the pose the other, are the body.
TEST(ConvexTruth, IsTheSameInAnyFrameOfTheVertices) {
  GridPoses poses(2);
  const Quaternion third(1, 1, 1, 1);  // x to y to z
  for (int i = 0; i < 100; ++i) {
    SCOPED_TRACE(i);
    std::vector<Vec3> points;
    for (int k = 0; k < 8; ++k) points.push_back(poses.place(3));
    const Vec3 shift = poses.place(4);
    Configuration c = poses.against(Sphere(1));
    c.pose_b = Pose(Vec3::Zero(), upright);
    std::vector<Vec3> moved;
    for (const Vec3& p : points) moved.push_back(Vec3(p.z(), p.x(), p.y()) - shift);
    Configuration turned = c;
    try {
      c.b = convex_hull(points);
      turned.b = convex_hull(moved);
    } catch (const InvalidInput&) {
      continue;  // on one line
    }
    // A point p + shift of the moved frame lies at the same place as p of the first.
    turned.pose_b = Pose(Vec3(shift.y(), shift.z(), shift.x()), third.conjugate());
    const Truth was = truth(c), is = truth(turned);
    EXPECT_EQ(was.signed_distance.lo, is.signed_distance.lo);
    EXPECT_EQ(was.signed_distance.hi, is.signed_distance.hi);
    EXPECT_EQ(was.ties, is.ties);
  }
}

struct OnPaper {
  const char* name;
  Configuration c;
  mpq_class distance;
  Vec3 normal;
  std::vector<int> support;
};

Shape hull(const std::vector<Vec3>& points) { return convex_hull(points); }

/// A right-angled one in the plane z = 0, with legs of 4 along x and y.
Shape triangle() { return hull({{0, 0, 0}, {4, 0, 0}, {0, 4, 0}}); }

const Cylinder can(1, 1);

/// Against a body in the world's frame.
Configuration with_can(const Vec3& place, const Quaternion& turn = upright,
                       const Shape& b = triangle(), const Cylinder& a = can) {
  return {a, Pose(place, turn), b, Pose()};
}

std::vector<OnPaper> on_paper() {
  return {
      {"ACapOverATriangle", with_can({1, 1, 3}), 2, {0, 0, 1}, {0, 1, 2}},
      {"ACapInATriangle", with_can({1, 1, 0.75}), {-1, 4}, {0, 0, 1}, {0, 1, 2}},
      {"ACapInATriangleFromBelow", with_can({1, 1, -0.75}), {-1, 4}, {0, 0, -1}, {0, 1, 2}},
      {"ACapTouchesATriangle", with_can({1, 1, 1}), 0, {0, 0, 1}, {0, 1, 2}},
      // The cylinder lies along x, one below the triangle.
      {"ASideOnATriangle", with_can({1, 1, 1.5}, along_x), {1, 2}, {0, 0, 1}, {0, 1, 2}},
      // The leg along x is 3 from the axis in y.
      {"ASideBesideAnEdge", with_can({2, -3, 0}, along_x), 2, {0, -1, 0}, {0, 1}},
      {"ASideOverAnEdge", with_can({2, -3, 4}, along_x), 4, {0, -0.6, 0.8}, {0, 1}},
      {"ASideTouchesAnEdge",
       with_can({2, -3, 4}, along_x, triangle(), Cylinder(5, 1)),
       0,
       {0, -0.6, 0.8},
       {0, 1}},
      {"ASideBesideACorner", with_can({7, -4, 0}), 4, {0.6, -0.8, 0}, {1}},
      // From the corner at (4, 0, 0) to the rim's point (8, 0, 3) of a can whose axis is at x = 9.
      {"ARimOverACorner", with_can({9, 0, 4}), 5, {0.8, 0, 0.6}, {1}},
      // Edge-on: the plane of the triangle holds the axis.
      {"ATriangleEdgeOnASide",
       with_can({-2, 2, 0}, Quaternion(1, -1, 0, 0)),
       1,
       {-1, 0, 0},
       {0, 2}},
      {"ACapOnATetrahedronsCorner",
       with_can({0.25, 0, 1.5}, upright, hull({{0, 0, 0}, {1, 0, -2}, {-1, 1, -2}, {-1, -1, -2}})),
       {1, 2},
       {0, 0, 1},
       {0}},
  };
}

TEST(ConvexTruth, IsWhatPaperSays) {
  for (const OnPaper& form : on_paper()) {
    SCOPED_TRACE(form.name);
    const Truth t = truth(form.c);
    EXPECT_LE(t.signed_distance.lo, form.distance);
    EXPECT_GE(t.signed_distance.hi, form.distance);
    if (form.distance == 0) {
      EXPECT_EQ(t.signed_distance.lo, 0);
      EXPECT_EQ(t.signed_distance.hi, 0);
    }
    ASSERT_EQ(t.normals.size(), 1u);
    EXPECT_LT((t.normals[0].n - form.normal).norm(), 1e-15);
    EXPECT_EQ(t.normals[0].support_b, form.support);
    const std::array<Alignment, 3> oblique{};
    EXPECT_EQ(t.normals[0].to_b, oblique);
  }
}

TEST(ConvexTruth, KnowsTheAlignmentToTheCylinder) {
  const auto to_a = [](const Configuration& c) { return truth(c).normals.at(0).to_a; };
  EXPECT_EQ(to_a(with_can({1, 1, 3})), Alignment::parallel);
  EXPECT_EQ(to_a(with_can({1, 1, 3}, along_x)), Alignment::perpendicular);
  EXPECT_EQ(to_a(with_can({1, 1, 3}, Quaternion(4, 0, 3, 0))), Alignment::oblique);
}

// On the axis, this corner of the polygon has only the faces' normals across the axis: the polygon
// lies on both sides of it.
TEST(ConvexTruth, OfAPolygonAcrossTheAxisHasNoHalfCircleOfNormals) {
  const Configuration c{Cylinder(1, 3), Pose(), hull({{0, 0, 0}, {4, 0, 2}, {-4, 0, 2}}), Pose()};
  const Truth t = truth(c);
  EXPECT_EQ(t.normals.size(), 2u);
  EXPECT_EQ(t.ties, Ties::finite);
  // On one side of it there is one.
  const Truth half =
      truth({Cylinder(1, 3), Pose(), hull({{0, 0, 0}, {4, 0, 2}, {4, 0, -2}}), Pose()});
  ASSERT_EQ(half.families.size(), 1u);
  const NormalFamily& arc = half.families[0];
  EXPECT_LT((arc.axis.cross(arc.ends.at(0)) - Vec3(-1, 0, 0)).norm(), 1e-15);
}

/// The largest gap that is found in double: from random directions, and steps from the best.
double largest_gap_found(const Configuration& c, std::mt19937& random) {
  std::normal_distribution<double> normal;
  const auto any = [&] { return Vec3(normal(random), normal(random), normal(random)); };
  double best = -HUGE_VAL;
  for (int start = 0; start < 4; ++start) {
    Vec3 n = any().normalized();
    double here = gap(c, n);
    for (int i = 0; i < 30; ++i) {
      const Vec3 other = any().normalized();
      if (const double there = gap(c, other); there > here) n = other, here = there;
    }
    for (double step = 0.3; step > 1e-9; step *= 0.8) {
      for (int i = 0; i < 4; ++i) {
        const Vec3 other = (n + step * any()).normalized();
        if (const double there = gap(c, other); there > here) n = other, here = there;
      }
    }
    best = std::max(best, here);
  }
  return best;
}

void expect_unbeaten(const Configuration& c, std::mt19937& random) {
  const Truth t = truth(c);
  const double sigma = t.signed_distance.midpoint(), rounding = gap_rounding * lengths_of(c);
  ASSERT_FALSE(t.normals.empty());
  for (const OptimalNormal& n : t.normals) EXPECT_NEAR(gap(c, n.n), sigma, rounding);
  EXPECT_LE(largest_gap_found(c, random), sigma + rounding);
  for (const OptimalNormal& n : t.normals) {
    const Convex& body = std::get<Convex>(c.b);
    const Vec3 local = c.pose_b.rotation().transpose() * n.n;
    double highest = -HUGE_VAL;
    for (const Vec3& v : body.vertices()) highest = std::max(highest, v.dot(local));
    EXPECT_FALSE(n.support_b.empty());
    for (const int v : n.support_b) {
      EXPECT_NEAR(body.vertices().at(v).dot(local), highest, rounding) << v;
    }
  }
}

TEST(ConvexTruth, IsNotBeatenByAnyDirection) {
  GridPoses poses(3);
  std::mt19937 random(4);
  std::normal_distribution<double> normal;
  for (int i = 0; i < 400; ++i) {
    SCOPED_TRACE(i);
    // Random points or those of a small grid; flat ones; needles and slabs.
    const Vec3 sizes = std::array{Vec3(1, 1, 1), Vec3(1, 1, 0), Vec3(1, 1, 20),
                                  Vec3(3, 3, 0.01)}[static_cast<std::size_t>(i % 4)];
    std::vector<Vec3> points;
    for (int k = 0; k < 3 + i % 30; ++k) {
      const Vec3 p =
          i % 3 == 0 ? poses.place(3) : Vec3(normal(random), normal(random), normal(random));
      points.push_back(sizes.cwiseProduct(p));
    }
    Configuration c = poses.against(Sphere(1));
    try {
      c.b = convex_hull(points);
    } catch (const InvalidInput&) {
      continue;
    }
    if (i % 2 != 0) {
      c.pose_a = Pose(Vec3(normal(random), normal(random), 2 * normal(random)),
                      Quaternion(normal(random), normal(random), normal(random), normal(random)));
    }
    expect_unbeaten(c, random);
  }
}

TEST(ConvexTruth, HoldsWhereFacesAreNearlyOne) {
  std::mt19937 random(5);
  for (int exponent = 3; exponent <= 15; ++exponent) {
    SCOPED_TRACE(exponent);
    const double bulge = std::pow(10, -exponent);
    const Shape roof = hull({{-2, -2, 0},
                             {2, -2, 0},
                             {-2, 2, 0},
                             {2, 2, 0},
                             {0, 0, bulge},
                             {0.5, 0.25, bulge},
                             {0, 0, -1}});
    for (const Quaternion& turn : {upright, along_x, Quaternion(4, 0, 3, 0),
                                   Quaternion(1, bulge, 0, 0), Quaternion(1, 0.7, 0.1, bulge)}) {
      for (const double height : {0.5, 1.0, 1.5}) {
        expect_unbeaten(with_can({0.25, 0.125, height}, turn, roof), random);
      }
    }
  }
}

Convex prism(int sides, double half_length) {
  std::vector<Vec3> points;
  for (int i = 0; i < sides; ++i) {
    const double angle = 2 * M_PI * i / sides;
    for (const double z : {-half_length, half_length}) {
      points.emplace_back(std::cos(angle), std::sin(angle), z);
    }
  }
  return convex_hull(points);
}

TEST(ConvexTruth, OfAPrismOfFourHundredSides) {
  std::mt19937 random(6);
  const Shape b = prism(400, 1);
  for (const Quaternion& turn :
       {upright, along_x, Quaternion(4, 0, 3, 0), Quaternion(1, 2, 3, 4)}) {
    for (const Vec3& place : {Vec3(1.5, 0.75, 0.5), Vec3(0.5, 0, 1.75), Vec3(3, 2, 2)}) {
      expect_unbeaten(with_can(place, turn, b), random);
    }
  }
  // All sides of a coaxial one tie, to within the rounding of its vertices.
  const Truth inside = truth({Cylinder(1, 8), Pose(), prism(8, 8), Pose()});
  EXPECT_LT(inside.signed_distance.hi, -1);
}

TEST(ConvexTruth, OfTheSameSolidInTinyAndHugeUnits) {
  for (const double unit : {0x1p-1000, 0x1p-40, 0x1p900}) {
    std::vector<Vec3> points = corners_of_box({1, 0.5, 0.25});
    points.emplace_back(0, 0, 2);
    const auto at = [&](double scale) {
      std::vector<Vec3> scaled_points = points;
      for (Vec3& p : scaled_points) p *= scale;
      return truth({Cylinder(scale, scale),
                    Pose(scale * Vec3(1, 0.5, 1.25), Quaternion(1, 2, 3, 4)), hull(scaled_points),
                    Pose(scale * Vec3(0.25, 0.5, 0), Quaternion(1, 1, 0, 3))})
          .signed_distance;
    };
    const Enclosure one = at(1), is = at(unit);
    EXPECT_EQ(one.lo * mpq_class(unit), is.lo);
    EXPECT_EQ(one.hi * mpq_class(unit), is.hi);
  }
}

TEST(ConvexTruth, OfWhatRoundingWouldMakeALineIsAsSharp) {
  // A triangle that is thinner than 2^-192 of its length, and one that is so far from its origin.
  const Shape thin = hull({{0, 0, 0}, {4, 0, 0}, {2, 1e-300, 0}});
  const Truth t = truth(with_can({2, 0, 3}, upright, thin));
  EXPECT_LE(t.signed_distance.lo, 2);
  EXPECT_GE(t.signed_distance.hi, 2);
  EXPECT_LT(t.signed_distance.width(), 1e-29);
  const Shape far = hull({{0x1p60, 0, 0}, {0x1p60, 4, 0}, {0x1p60, 0, 4}});
  const Truth u = truth(with_can({0x1p60, 1, 1}, along_x, far));
  EXPECT_LE(u.signed_distance.lo, -1);
  EXPECT_GE(u.signed_distance.hi, -1);
}

TEST(ConvexTruth, NamesTheVerticesAsGivenWhereRoundingMergesSome) {
  const Convex body =
      convex_hull({{-1e-300, -2e-300, 0}, {-2e-300, -1e-300, 0}, {4, 0, 0}, {0, 4, 0}});
  ASSERT_EQ(body.vertices().size(), 4u);
  const Configuration c = with_can({1, 1, 3}, upright, body);
  EXPECT_EQ(std::get<Convex>(rounded_configuration(c).configuration.b).vertices().size(), 3u);
  const std::vector<int> one_of_the_merged{0, 2, 3};
  EXPECT_EQ(truth(c).normals.at(0).support_b, one_of_the_merged);
}

TEST(ConvexTruth, NamesTheEdgeOfAPrismThatIsNearest) {
  const Convex wheel = prism(400, 1);
  for (int first = 0; first < 800; first += 114) {
    const Vec3 corner = wheel.vertices()[static_cast<std::size_t>(first)];
    const Configuration c{Cylinder(0x1p-40, 1),
                          Pose(Vec3(3 * corner.x(), 3 * corner.y(), 0), upright), wheel, Pose()};
    const Truth t = truth(c);
    ASSERT_EQ(t.normals.size(), 1u);
    const std::vector<int> edge{first, first + 1};
    EXPECT_EQ(t.normals[0].support_b, edge);
  }
}

TEST(ConvexTruth, OfABodyWithFacesToWithinRoundingIsThatOfItsVertices) {
  const Convex box = convex_hull(corners_of_box({1, 1, 1}));
  std::vector<std::vector<int>> faces;
  for (const Convex::Face& face : box.faces()) faces.push_back(face.vertices);
  std::vector<Vec3> points = corners_of_box({1, 1, 1});
  points[7].z() = std::nextafter(1.0, 2.0);
  const auto distance = [](const Shape& b) {
    return truth(with_can({0, 0, 2.5}, Quaternion(4, 0, 3, 0), b)).signed_distance;
  };
  const Enclosure is = distance(Convex(points, faces)), hull_is = distance(convex_hull(points));
  EXPECT_EQ(is.lo, hull_is.lo);
  EXPECT_EQ(is.hi, hull_is.hi);
}

TEST(ConvexTruth, TwoOppositeNormalsThatNothingTellsFromATouchAreNoArc) {
  const Convex huge = convex_hull({{1.7e308, 0, 0}, {-1.7e308, 0, 0}, {0, 1.7e308, 0}});
  for (const NormalFamily& family : truth({can, Pose(), huge, Pose()}).families) {
    EXPECT_NEAR(family.axis.norm(), 1, 1e-15);
  }
}

TEST(ConvexTruth, ErrorBoundsWhatRoundingChanges) {
  GridPoses poses(8);
  std::mt19937 random(9);
  std::normal_distribution<double> normal;
  for (int i = 0; i < 40; ++i) {
    SCOPED_TRACE(i);
    std::vector<Vec3> points;
    for (int k = 0; k < 9; ++k) points.emplace_back(normal(random), normal(random), normal(random));
    Configuration c = poses.against(convex_hull(points));
    c.pose_b = Pose(Vec3(0.1, 0.2, 0.3), Quaternion(normal(random), 0.3, 0.7, normal(random)));
    for (const int bits : {6, 12, 30}) {
      const auto [rounded, error] = rounded_configuration(c, bits);
      const Enclosure exact = truth(c).signed_distance, is = truth(rounded).signed_distance;
      EXPECT_LE(exact.lo, is.hi + error);
      EXPECT_GE(exact.hi, is.lo - error);
      EXPECT_LE(error, 80 * std::ldexp(larger_size(c), -bits)) << bits;
    }
  }
}

TEST(ConvexTruth, GapsAndRegretsAreThoseOfTheHull) {
  const Configuration c = with_can({1, 1, 3});
  // Along (−3, 0, 4)/5: d·n − h·4/5 − r·3/5 − max v·n, with 0 for the leg along y.
  const Enclosure g = certified_gap(c, {-3, 0, 4});
  EXPECT_LE(g.lo, mpq_class(9, 5) - mpq_class(7, 5));
  EXPECT_GE(g.hi, mpq_class(9, 5) - mpq_class(7, 5));
  const Truth t = truth(c);
  EXPECT_NEAR(normal_regret(c, t, {-3, 0, 4}), 2 - 0.4, 1e-14);
  EXPECT_EQ(normal_regret(c, t, {0, 0, 1}), 0);
  EXPECT_NEAR(normal_regret(c, t, {0, 0, -1}), 2 + 4, 1e-14);
}

}  // namespace
}  // namespace touchstone::oracle
