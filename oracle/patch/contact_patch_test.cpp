#include "oracle/patch/contact_patch.hpp"

#include <cmath>
#include <gtest/gtest.h>
#include <string>

#include "oracle/as_hull.hpp"
#include "oracle/patch/support_feature.hpp"
#include "oracle/truth.hpp"
#include "properties/identity.hpp"
#include "properties/moves.hpp"

namespace touchstone::oracle {
namespace {

// Closed forms. B's top is at z = 0 and A touches it from above, so that patches lie at z = 0.

constexpr double rounding = 1e-14;
constexpr auto oblique = Alignment::oblique;
constexpr auto parallel = Alignment::parallel;
constexpr auto perpendicular = Alignment::perpendicular;
using Kind = ContactPatch::Kind;

const Vec3 up(0, 0, 1);
const std::array<Alignment, 3> unaligned{};
const std::array<Alignment, 3> of_cap{oblique, oblique, parallel};
const std::array<Alignment, 3> of_side{oblique, oblique, perpendicular};
const std::array<Alignment, 3> of_face{perpendicular, perpendicular, parallel};

/// A contact along z.
struct Contact {
  Configuration c;
  Alignment to_a;
  std::array<Alignment, 3> to_b;
  std::vector<int> support_b = {};

  ContactPatch patch() const { return contact_patch(c, {up, to_a, to_b, support_b}); }
};

/// An upright cylinder with its lower cap's middle there.
Contact standing(double radius, const Vec3& on, const Shape& b, const Pose& pose_b,
                 const std::array<Alignment, 3>& to_b) {
  return {{Cylinder(radius, 1), Pose(on + up, upright), b, pose_b}, parallel, to_b};
}
Contact standing_on_disc(double radius, double other, double x, double y) {
  return standing(radius, {x, y, 0}, Cylinder(other, 2), Pose(-2 * up, upright), of_cap);
}
Contact standing_on_box(double radius, double x, double y, double half_x = 3, double half_y = 3) {
  return standing(radius, {x, y, 0}, Box({half_x, half_y, 1}), Pose(-up, upright), of_face);
}

/// A cylinder along x with its lowest line's middle at x, y.
Contact lying(double radius, double half_length, double x, double y, const Shape& b,
              const Pose& pose_b, const std::array<Alignment, 3>& to_b) {
  return {{Cylinder(radius, half_length), Pose({x, y, radius}, along_x), b, pose_b},
          perpendicular,
          to_b};
}
Contact lying_on_disc(double x, double y) {
  return lying(0.25, 5, x, y, Cylinder(1, 2), Pose(-2 * up, upright), of_cap);
}
Contact lying_on_box(double x, double y) {
  return lying(0.5, 4, x, y, Box({3, 2, 1}), Pose(-up, upright), of_face);
}
Contact lying_beside(double x) {
  return lying(0.5, 2, 0, 0, Cylinder(1, 3), Pose({x, 0, -1}, along_x), of_side);
}

/// On a hull of these points, of which those listed are at z = 0.
Contact standing_on_hull(double radius, double x, double y, const std::vector<Vec3>& points,
                         const std::vector<int>& highest) {
  Contact contact = standing(radius, {x, y, 0}, convex_hull(points), Pose(), unaligned);
  contact.support_b = highest;
  return contact;
}
Contact lying_on_hull(double x, double y, const std::vector<Vec3>& points,
                      const std::vector<int>& highest) {
  Contact contact = lying(0.5, 4, x, y, convex_hull(points), Pose(), unaligned);
  contact.support_b = highest;
  return contact;
}
/// A triangle with a right angle, legs along x and y, and the hypotenuse x + y = 3.
const std::vector<Vec3> large_one{{-3, -2, 0}, {5, -2, 0}, {-3, 6, 0}};
/// 3-4-5, with the hypotenuse 3 x + 4 y = 12.
const std::vector<Vec3> small_one{{0, 0, 0}, {4, 0, 0}, {0, 3, 0}};
/// Triangles that stand on a corner, their upper edges along x and y.
const std::vector<Vec3> edge_along_x{{0, 0, 0}, {4, 0, 0}, {1, 0, -2}};
const std::vector<Vec3> edge_along_y{{1, -2, 0}, {1, 2, 0}, {1, 0, -1}};
const std::vector<Vec3> pyramid{{0.25, 0.5, 0}, {1, 1, -1}, {-1, 1, -1}, {0, -1, -1}};
const std::vector<int> all_three{0, 1, 2};

void expect_near(const Vec3& a, const Vec3& b, double tolerance = rounding) {
  EXPECT_LE((a - b).norm(), tolerance) << a.transpose() << " | " << b.transpose();
}

struct Measures {
  Kind kind;
  double area, perimeter;
  Vec3 centroid;  ///< a coordinate that is not looked at is NaN
};
Measures region(double area, double perimeter, double x, double y, double z = 0) {
  return {Kind::region, area, perimeter, {x, y, z}};
}
Measures segment(double length, double x, double y) {
  return {Kind::segment, 0, length, {x, y, 0}};
}
Measures point(double x, double y) { return {Kind::point, 0, 0, {x, y, 0}}; }

struct ClosedForm {
  const char* name;
  Contact contact;
  Measures on_paper;
};

const double unknown = std::nan("");
const double root3 = std::sqrt(3);
const double half = 4 / (3 * pi);  // from a half disc's straight side to its centroid
// Radii 15 and 13, 14 apart: the circles meet at height 12, by the triangle 13-14-15.
const double alpha = std::asin(12.0 / 15), beta = std::asin(12.0 / 13);
const double strip = pi / 6 + root3 / 4;  // the half x <= 0 of |y| <= 0.5 in the unit disc
const double corner = std::acos(0.8);

const ClosedForm closed_forms[] = {
    {"CapInsideCapIsTheSmallerDisc", standing_on_disc(0.5, 2, 1, 0.5), region(pi / 4, pi, 1, 0.5)},
    {"SameCapsAreTheWholeDisc", standing_on_disc(1, 1, 0, 0), region(pi, 2 * pi, 0, 0)},
    {"CapsBesideEachOtherShareALens", standing_on_disc(1, 1, 0, 1),
     region(2 * pi / 3 - root3 / 2, 4 * pi / 3, 0, 0.5)},
    {"LensOfUnequalDiscs", standing_on_disc(15, 13, 14, 0),
     region(225 * alpha + 169 * beta - 14 * 12, 2 * (15 * alpha + 13 * beta), unknown, 0)},
    {"CapsTangentFromOutsideShareAPoint", standing_on_disc(0.75, 0.5, 0.75, 1), point(0.3, 0.4)},
    {"CapTangentFromInsideIsWhole", standing_on_disc(2, 0.75, 0.75, 1),
     region(pi * 0.75 * 0.75, 1.5 * pi, 0, 0)},
    {"CapsThatDoNotMeetGiveTheNearestPoint", standing_on_disc(1, 1, 5, 0), point(1, 0)},
    {"DiscWithinAFace", standing_on_box(1, 1, -2), region(pi, 2 * pi, 1, -2)},
    {"DiscThatTouchesEdgesFromWithinIsWhole", standing_on_box(1, 2, 2), region(pi, 2 * pi, 2, 2)},
    {"DiscCutByOneEdgeInTheMiddle", standing_on_box(1, 3, 0), region(pi / 2, 2 + pi, 3 - half, 0)},
    {"DiscCutByTwoEdgesAtACornerInTheMiddle", standing_on_box(1, 3, 3),
     region(pi / 4, 2 + pi / 2, 3 - half, 3 - half)},
    {"DiscCutByTwoOppositeEdges", standing_on_box(1, 0, 0, 0.5),
     region(pi - 2 * (pi / 3 - root3 / 4), 2 * root3 + 2 * pi / 3, 0, 0)},
    {"DiscCutByThreeEdges", standing_on_box(1, 2.5, 0, 3, 0.5),
     region(strip + 0.5, 1 + 2 * (0.5 + root3 / 2) + pi / 3, unknown, 0)},
    {"DiscCutByFourEdges", standing_on_box(1, 0, 0, 0.8, 0.8),
     region(pi - 4 * (corner - 0.8 * 0.6), 4.8 + 2 * pi - 8 * corner, 0, 0)},
    // 3-4-5: every corner lies exactly on the circle.
    {"DiscThroughTheCornersOfAFaceIsTheFace", standing_on_box(5, 0, 0, 3, 4), region(48, 28, 0, 0)},
    {"DiscThatTouchesAnEdgeFromOutsideIsAPoint", standing_on_box(1, 4, 1), point(3, 1)},
    {"DiscThatTouchesACornerFromOutsideIsAPoint", standing_on_box(5, 6, 7), point(3, 3)},
    {"DiscBeyondAFaceIsTheNearestPoint", standing_on_box(1, 5, 0), point(3, 0)},
    {"SideAcrossACapIsTheChord", lying_on_disc(0.5, 0.5), segment(root3, 0, 0.5)},
    {"SideThatEndsInsideTheCap", lying_on_disc(5, 0), segment(1, 0.5, 0)},
    {"SideTangentToTheRimIsAPoint", lying_on_disc(0.5, 1), point(0, 1)},
    {"SideThatEndsOnTheRimIsAPoint", lying_on_disc(6, 0), point(1, 0)},
    {"CapOnACapsulesSide",
     standing(1, Vec3::Zero(), Capsule(0.5, 3), Pose({2.5, 0, -0.5}, along_x), of_side),
     segment(1.5, 0.25, 0)},
    {"ParallelSidesShareWhatOverlaps", lying_beside(4), segment(1, 1.5, 0)},
    {"ParallelSidesEndToEndShareAPoint", lying_beside(5), point(2, 0)},
    {"SideOnAFaceIsCutByTheFace", lying_on_box(2, 1), segment(5, 0.5, 1)},
    {"SideAlongAFacesEdgeIsWhole", lying_on_box(0, 2), segment(6, 0, 2)},
    {"SideJustBeyondAFacesEdgeIsAPoint", lying_on_box(0, std::nextafter(2, 3)), point(0, 2)},
    {"StandingOnAPlane", standing(0.5, {3, 4, 0}, Plane(up, 0), Pose(), unaligned),
     region(pi / 4, pi, 3, 4)},
    {"LyingOnAPlane", lying(0.5, 2, 3, 4, Plane(up, 0), Pose(), unaligned), segment(4, 3, 4)},
    {"OverlappingHalfwayBetweenTheSurfaces",
     standing(1, -0.1 * up, Box({3, 3, 1}), Pose(-up, upright), of_face),
     region(pi, 2 * pi, 0, 0, -0.05)},
    {"ApartHalfwayBetweenTheSurfaces", standing(1, 0.5 * up, Plane(2 * up, -1), Pose(), unaligned),
     region(pi, 2 * pi, 0, 0)},
    {"DiscWithinATriangle", standing_on_hull(1, 0, 0, large_one, all_three),
     region(pi, 2 * pi, 0, 0)},
    {"TriangleWithinADisc", standing_on_hull(5, 1, 1, small_one, all_three),
     region(6, 12, 4.0 / 3, 1)},
    {"DiscThroughTheCornersOfATriangleIsTheTriangle",
     standing_on_hull(2.5, 2, 1.5, small_one, all_three), region(6, 12, 4.0 / 3, 1)},
    {"DiscCutByATrianglesEdgeInTheMiddle", standing_on_hull(1, 0, -2, large_one, all_three),
     region(pi / 2, 2 + pi, 0, -2 + half)},
    {"DiscCutByATrianglesSlantedEdge", standing_on_hull(1, 1, 2, large_one, all_three),
     region(pi / 2, 2 + pi, 1 - half / std::sqrt(2), 2 - half / std::sqrt(2))},
    {"DiscCutByTwoEdgesAtATrianglesCorner", standing_on_hull(1, -3, -2, large_one, all_three),
     region(pi / 4, 2 + pi / 2, -3 + half, -2 + half)},
    {"DiscThatTouchesATrianglesSlantedEdgeFromOutsideIsAPoint",
     standing_on_hull(5, 5, 5.5, small_one, all_three), point(2, 1.5)},
    {"DiscBeyondATriangleIsTheNearestPoint", standing_on_hull(5, 8, 9.5, small_one, all_three),
     point(2, 1.5)},
    {"SideOnATriangleIsCutByIt", lying_on_hull(0, 1, small_one, all_three),
     segment(8.0 / 3, 4.0 / 3, 1)},
    {"SideThatEndsInATriangle", lying_on_hull(-3, 1, small_one, all_three), segment(1, 0.5, 1)},
    {"SideThroughATrianglesCornerIsAPoint", lying_on_hull(0, 3, small_one, all_three), point(0, 3)},
    {"SideAlongATrianglesEdgeIsTheEdge", lying_on_hull(2, 0, small_one, all_three),
     segment(4, 2, 0)},
    {"CapOnATrianglesEdge", standing_on_hull(1, 0, 0, edge_along_x, {0, 1}), segment(1, 0.5, 0)},
    {"SideAlongATriangleThatStandsOnItsCorner", lying_on_hull(6, 0, edge_along_x, {0, 1}),
     segment(2, 3, 0)},
    {"SideAcrossATriangleThatStandsOnItsCorner", lying_on_hull(0, 0.5, edge_along_y, {0, 1}),
     point(1, 0.5)},
    {"CapOnAPyramidsTop", standing_on_hull(1, 0, 0, pyramid, {0}), point(0.25, 0.5)},
    {"SphereMeetsInAPoint",
     standing(1, Vec3::Zero(), Sphere(0.5), Pose({0.25, 0.5, -0.5}, upright), unaligned),
     point(0.25, 0.5)},
};

class Patches : public testing::TestWithParam<ClosedForm> {};

TEST_P(Patches, HaveTheAreaPerimeterAndCentroidOnPaper) {
  const Measures& expected = GetParam().on_paper;
  const ContactPatch p = GetParam().contact.patch();
  EXPECT_EQ(p.kind(), expected.kind);
  EXPECT_NEAR(p.area(), expected.area, rounding * (1 + expected.area));
  EXPECT_NEAR(p.perimeter(), expected.perimeter, rounding * (1 + expected.perimeter));
  for (int i = 0; i < 3; ++i) {
    if (!std::isnan(expected.centroid[i])) {
      EXPECT_NEAR(p.centroid()[i], expected.centroid[i], rounding) << i;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(, Patches, testing::ValuesIn(closed_forms),
                         [](const auto& form) { return std::string(form.param.name); });

TEST(Patch, OfDiscsHasTheirExtents) {
  const ContactPatch disc = standing_on_disc(0.5, 2, 1, 0.5).patch();
  EXPECT_NEAR(disc.extent(Vec3(1, 0, 0)), 1, rounding);
  EXPECT_EQ(disc.distance(Vec3(1, 0.5, 7)), 0);
  EXPECT_NEAR(disc.distance(Vec3(1, 2, 7)), 1, rounding);
  const ContactPatch lens = standing_on_disc(15, 13, 14, 0).patch();
  EXPECT_NEAR(lens.extent(Vec3(0, 1, 0)), 24, 1e-13);
  EXPECT_NEAR(lens.extent(Vec3(1, 0, 0)), 15 + 13 - 14, 1e-13);
}

TEST(Patch, OfADiscOnAFaceHasASideForEachEdgeAndArc) {
  EXPECT_EQ(standing_on_box(1, 0, 0, 0.8, 0.8).patch().shape().sides().size(), 8u);
  EXPECT_EQ(standing_on_box(5, 0, 0, 3, 4).patch().shape().sides().size(), 4u);
}

TEST(Patch, CapsOneRoundingFromTangentShareALens) {
  const double r = std::nextafter(0.75, 1);
  const ContactPatch p = standing_on_disc(r, 0.5, 0.75, 1).patch();
  EXPECT_EQ(p.kind(), Kind::region);
  EXPECT_GT(p.area(), 0);
  EXPECT_NEAR(p.extent(Vec3(0.6, 0.8, 0)), 1.1e-16, 1e-16);
  // Its chord is 2 √(2 h R), with 1/R = 1/0.75 + 1/0.5, many times its width.
  EXPECT_NEAR(p.extent(Vec3(-0.8, 0.6, 0)), 2 * std::sqrt(2 * (r - 0.75) * 0.3), 1e-15);
}

TEST(Patch, CrossedSidesShareAPointHowEverSmallTheAngle) {
  // Axes along x and along (1, tilt, 0), crossing above (1, 0).
  for (const double tilt : {1.0, 1e-3, 1e-15}) {
    const Eigen::Quaterniond turn(1, 0, 0, tilt / 2);
    const Configuration c{Cylinder(0.5, 2), Pose(Vec3(0, 0, 0.5), along_x), Cylinder(1, 3),
                          Pose(Vec3(1, 0, -1), turn * along_x)};
    const ContactPatch p = contact_patch(c, {up, perpendicular, of_side});
    EXPECT_EQ(p.kind(), Kind::point);
    expect_near(p.centroid(), Vec3(1, 0, 0));
  }
}

TEST(Patch, CapOnABoxesEdge) {
  // The box stands on its edge along y, turned by 45° about y.
  const double d = std::sqrt(0.5);
  const Configuration c{
      Cylinder(1, 1), Pose(up, upright), Box(Vec3(1, 3, 1)),
      Pose(Vec3(0, 2.5, -2 * d), Eigen::Quaterniond(std::cos(pi / 8), 0, std::sin(pi / 8), 0))};
  const ContactPatch p = contact_patch(c, {up, parallel, {oblique, perpendicular, oblique}});
  EXPECT_EQ(p.kind(), Kind::segment);
  EXPECT_NEAR(p.perimeter(), 1.5, 1e-13);
  expect_near(p.centroid(), Vec3(0, 0.25, 0), 1e-13);
}

TEST(Patch, ARimsLowestPointIsFoundHoweverSmallTheTilt) {
  for (const double tilt : {0.5, 1e-6, 1e-15, 1e-30}) {
    // Leans towards +x: its lowest point is on that side.
    const Eigen::Quaterniond q(1, 0, tilt, 0);
    const Vec3 axis = q.normalized() * up;
    const Vec3 lowest = -2 * axis + 0.5 * Vec3(axis.z(), 0, -axis.x());
    const Configuration c{Cylinder(0.5, 2), Pose(-lowest, q), Plane(up, 0), Pose()};
    const ContactPatch p = contact_patch(c, {up, oblique, unaligned});
    EXPECT_EQ(p.kind(), Kind::point);
    expect_near(p.centroid(), Vec3::Zero(), 1e-14);
  }
}

TEST(Patch, TangentCapsStayTangentInAnyOrientationAndAnywhere) {
  // |q|² = 25, so that every vector of multiples of 25 turns into integers: the circles touch
  // exactly although no direction is along a coordinate.
  const Eigen::Quaterniond q(1, 2, 2, 4);
  const auto turned = [&](const Vec3& v) {
    return Vec3((q.normalized() * v).array().round() + Vec3(1000, -300, 7).array());
  };
  for (const double more : {0.0, 1e-14}) {
    const Configuration c{Cylinder(75 + more, 25), Pose(turned(Vec3(75, 100, 25)), q),
                          Cylinder(50, 25), Pose(turned(Vec3(0, 0, -25)), q)};
    const ContactPatch p = contact_patch(c, {(q.normalized() * up).normalized(), parallel, of_cap});
    EXPECT_EQ(p.kind(), more > 0 ? Kind::region : Kind::point);
    expect_near(p.centroid(), q.normalized() * Vec3(30, 40, 0) + Vec3(1000, -300, 7), 1e-12);
  }
}

TEST(Patch, ADiscThatTouchesATrianglesEdgeDoesSoInAnyOrientation) {
  // As above: coordinates that are multiples of 25 stay integers.
  const Eigen::Quaterniond q(1, 2, 2, 4);
  const auto turned = [&](const Vec3& v) { return Vec3((q.normalized() * v).array().round()); };
  const Convex triangle = convex_hull(std::vector<Vec3>{{0, 0, 0}, {200, 0, 0}, {0, 150, 0}});
  const Vec3 n = (q.normalized() * up).normalized();
  for (const double more : {0.0, 1e-12}) {
    const Configuration c{Cylinder(250 + more, 25), Pose(turned(Vec3(250, 275, 25)), q), triangle,
                          Pose(Vec3::Zero(), q)};
    const ContactPatch p = contact_patch(c, {n, parallel, unaligned, all_three});
    EXPECT_EQ(p.kind(), more > 0 ? Kind::region : Kind::point);
    expect_near(p.centroid(), q.normalized() * Vec3(100, 75, 0), 1e-10);
  }
}

TEST(Patch, OfAHullNearTheEndsOfTheDoublesIsThatOfAnOrdinaryOneScaled) {
  const auto outline = [](int exponent) {
    const double unit = std::ldexp(1, exponent);
    std::vector<Vec3> points = large_one;
    for (Vec3& p : points) p *= unit;
    const Configuration c{Cylinder(unit, unit), Pose(unit * Vec3(0, -2, 1), upright),
                          convex_hull(points), Pose()};
    std::vector<Vec3> result = contact_patch(c, {up, parallel, unaligned, all_three}).outline();
    for (Vec3& p : result) p /= unit;
    return result;
  };
  EXPECT_EQ(outline(0).size(), 17u);
  for (const int exponent : {-1000, 1000}) {
    const std::vector<Vec3> expected = outline(0), found = outline(exponent);
    ASSERT_EQ(found.size(), expected.size());
    for (std::size_t i = 0; i < found.size(); ++i) expect_near(found[i], expected[i]);
  }
}

TEST(Patch, OfAHullOfTheSmallestDoublesExists) {
  const Convex speck = convex_hull(std::vector<Vec3>{{0, 0, 0}, {5e-324, 0, 0}, {0, 5e-324, 0}});
  const Configuration c{Cylinder(1, 1), Pose(up, upright), speck, Pose()};
  EXPECT_LE(contact_patch(c, {up, parallel, unaligned, all_three}).centroid().norm(), 1e-300);
}

TEST(Patch, OfAHullIsAlsoFoundWithoutItsVerticesWhereAnAxisTellsTheNormal) {
  Contact contact = standing_on_hull(1, 0, -2, large_one, {});
  EXPECT_NEAR(contact.patch().area(), pi / 2, rounding);
}

/// The corners of a box that are farthest along a normal with this alignment to its axes, of which
/// doubles tell the ends.
std::vector<int> highest_corners(const Configuration& c, const OptimalNormal& normal) {
  std::vector<int> corners;
  for (int k = 0; k < 8; ++k) {
    bool is_highest = true;
    for (int i = 0; i < 3; ++i) {
      const bool is_upper = (k >> i & 1) != 0;
      is_highest = is_highest && (normal.to_b[i] == perpendicular ||
                                  is_upper == (c.pose_b.rotation().col(i).dot(normal.n) > 0));
    }
    if (is_highest) corners.push_back(k);
  }
  return corners;
}

TEST(PatchOfABoxAsAHull, IsThatOfTheBox) {
  int compared = 0;
  for (const auto& name : pose_classes(Pair::box)) {
    const Identity id{Pair::box, name, 20261126, 0};
    SCOPED_TRACE(to_string(id));
    const Configuration c = make_configuration(id), hull = with_hull(c);
    for (const OptimalNormal& n : truth(c).normals) {
      const SupportFeatures features = support_features(c, n);
      if (!features.a.point_is_certain || !features.b.point_is_certain) continue;
      ++compared;
      const double size = larger_size(c), far = size + c.pose_a.position().norm();
      const ContactPatch of_box = contact_patch(c, n);
      // Along the cylinder's axis the hull finds its corners itself, exactly.
      const std::vector<int> corners =
          n.to_a == parallel ? std::vector<int>() : highest_corners(c, n);
      const ContactPatch of_hull = contact_patch(hull, {n.n, n.to_a, unaligned, corners});
      EXPECT_EQ(of_hull.kind(), of_box.kind());
      EXPECT_NEAR(of_hull.perimeter(), of_box.perimeter(), 1e-12 * size);
      EXPECT_NEAR(of_hull.area(), of_box.area(), 1e-12 * size * size);
      expect_near(of_hull.centroid(), of_box.centroid(), 1e-12 * far);
      const double epsilon = 1e-6 * smaller_size(c);
      const ContactPatch wide = contact_patch(hull, n.n, epsilon);
      const ContactPatch expected = contact_patch(c, n.n, epsilon);
      EXPECT_NEAR(wide.perimeter(), expected.perimeter(), 1e-12 * size);
      expect_near(wide.centroid(), expected.centroid(), 1e-12 * far);
      const auto width = width_from_epsilon(hull.b, hull.pose_b, n.n, epsilon);
      const auto width_of_box = width_from_epsilon(c.b, c.pose_b, n.n, epsilon);
      EXPECT_EQ(width.is_a_corner, width_of_box.is_a_corner);
      EXPECT_NEAR(width.largest, width_of_box.largest, epsilon);
    }
  }
  EXPECT_GT(compared, 300);
}

}  // namespace
}  // namespace touchstone::oracle
