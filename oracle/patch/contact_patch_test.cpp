#include "oracle/patch/contact_patch.hpp"

#include <cmath>
#include <gtest/gtest.h>

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
const std::array<Alignment, 3> of_face{perpendicular, perpendicular, parallel};

ContactPatch standing_on_disc(double radius, double other, const Vec3& offset) {
  const Configuration c{Cylinder(radius, 1), Pose(offset + up, upright), Cylinder(other, 2),
                        Pose(-2 * up, upright)};
  return contact_patch(c, {up, parallel, {oblique, oblique, parallel}});
}

ContactPatch standing_on_box(double radius, const Vec3& offset, const Vec3& half_extents) {
  const Configuration c{Cylinder(radius, 1), Pose(offset + up, upright), Box(half_extents),
                        Pose(-half_extents.z() * up, upright)};
  return contact_patch(c, {up, parallel, of_face});
}

void expect_near(const Vec3& a, const Vec3& b, double tolerance = rounding) {
  EXPECT_LE((a - b).norm(), tolerance) << a.transpose() << " | " << b.transpose();
}

TEST(Patch, CapInsideCapIsTheSmallerDisc) {
  const ContactPatch p = standing_on_disc(0.5, 2, Vec3(1, 0.5, 0));
  EXPECT_EQ(p.kind(), Kind::region);
  EXPECT_NEAR(p.area(), pi / 4, rounding);
  EXPECT_NEAR(p.perimeter(), pi, rounding);
  expect_near(p.centroid(), Vec3(1, 0.5, 0));
  EXPECT_NEAR(p.extent(Vec3(1, 0, 0)), 1, rounding);
  EXPECT_EQ(p.distance(Vec3(1, 0.5, 7)), 0);
  EXPECT_NEAR(p.distance(Vec3(1, 2, 7)), 1, rounding);
}

TEST(Patch, SameCapsAreTheWholeDisc) {
  const ContactPatch p = standing_on_disc(1, 1, Vec3::Zero());
  EXPECT_NEAR(p.area(), pi, rounding);
  expect_near(p.centroid(), Vec3::Zero());
}

TEST(Patch, CapsBesideEachOtherShareALens) {
  // Two unit discs a distance 1 apart: area 2π/3 − √3/2, perimeter 4π/3.
  const ContactPatch p = standing_on_disc(1, 1, Vec3(0, 1, 0));
  EXPECT_EQ(p.kind(), Kind::region);
  EXPECT_NEAR(p.area(), 2 * pi / 3 - std::sqrt(3) / 2, rounding);
  EXPECT_NEAR(p.perimeter(), 4 * pi / 3, rounding);
  expect_near(p.centroid(), Vec3(0, 0.5, 0));
  EXPECT_NEAR(p.extent(Vec3(0, 1, 0)), 1, rounding);
  EXPECT_NEAR(p.extent(Vec3(1, 0, 0)), std::sqrt(3), rounding);
}

TEST(Patch, LensOfUnequalDiscs) {
  // Radii 15 and 13, 14 apart: the circles meet at height 12, by the triangle 13-14-15.
  const ContactPatch p = standing_on_disc(15, 13, Vec3(14, 0, 0));
  const double alpha = std::asin(12.0 / 15), beta = std::asin(12.0 / 13);
  EXPECT_NEAR(p.area(), 225 * alpha + 169 * beta - 14 * 12, 1e-12);
  EXPECT_NEAR(p.extent(Vec3(0, 1, 0)), 24, 1e-13);
  EXPECT_NEAR(p.extent(Vec3(1, 0, 0)), 15 + 13 - 14, 1e-13);
}

TEST(Patch, TangentCapsShareAPointOutsideAndADiscInside) {
  const ContactPatch outside = standing_on_disc(0.75, 0.5, Vec3(0.75, 1, 0));
  EXPECT_EQ(outside.kind(), Kind::point);
  expect_near(outside.centroid(), Vec3(0.3, 0.4, 0));
  const ContactPatch inside = standing_on_disc(2, 0.75, Vec3(0.75, 1, 0));
  EXPECT_EQ(inside.kind(), Kind::region);
  EXPECT_NEAR(inside.area(), pi * 0.75 * 0.75, rounding);
}

TEST(Patch, CapsOneRoundingFromTangentShareALens) {
  const double r = std::nextafter(0.75, 1);
  const ContactPatch p = standing_on_disc(r, 0.5, Vec3(0.75, 1, 0));
  EXPECT_EQ(p.kind(), Kind::region);
  EXPECT_GT(p.area(), 0);
  EXPECT_NEAR(p.extent(Vec3(0.6, 0.8, 0)), 1.1e-16, 1e-16);
  // Its chord is 2 √(2 h R), with 1/R = 1/0.75 + 1/0.5, many times its width.
  EXPECT_NEAR(p.extent(Vec3(-0.8, 0.6, 0)), 2 * std::sqrt(2 * (r - 0.75) * 0.3), 1e-15);
}

TEST(Patch, DiscWithinAFace) {
  const ContactPatch p = standing_on_box(1, Vec3(1, -2, 0), Vec3(3, 3, 1));
  EXPECT_NEAR(p.area(), pi, rounding);
  expect_near(p.centroid(), Vec3(1, -2, 0));
}

TEST(Patch, DiscThatTouchesAnEdgeFromWithinIsWhole) {
  EXPECT_NEAR(standing_on_box(1, Vec3(2, 2, 0), Vec3(3, 3, 1)).area(), pi, rounding);
}

TEST(Patch, DiscCutByOneEdgeInTheMiddle) {
  const ContactPatch p = standing_on_box(1, Vec3(3, 0, 0), Vec3(3, 3, 1));
  EXPECT_NEAR(p.area(), pi / 2, rounding);
  expect_near(p.centroid(), Vec3(3 - 4 / (3 * pi), 0, 0));
}

TEST(Patch, DiscCutByTwoEdgesAtACornerInTheMiddle) {
  const ContactPatch p = standing_on_box(1, Vec3(3, 3, 0), Vec3(3, 3, 1));
  EXPECT_NEAR(p.area(), pi / 4, rounding);
  expect_near(p.centroid(), Vec3(3 - 4 / (3 * pi), 3 - 4 / (3 * pi), 0));
  EXPECT_NEAR(p.perimeter(), 2 + pi / 2, rounding);
}

TEST(Patch, DiscCutByTwoOppositeEdges) {
  const ContactPatch p = standing_on_box(1, Vec3::Zero(), Vec3(0.5, 3, 1));
  EXPECT_NEAR(p.area(), pi - 2 * (pi / 3 - std::sqrt(3) / 4), rounding);
  expect_near(p.centroid(), Vec3::Zero());
}

TEST(Patch, DiscCutByThreeEdges) {
  // The half x <= 0.5 of a strip |y| <= 0.5 of the unit disc.
  const ContactPatch p = standing_on_box(1, Vec3(2.5, 0, 0), Vec3(3, 0.5, 1));
  const double strip = pi / 6 + std::sqrt(3) / 4;  // one half of it, x <= 0
  EXPECT_NEAR(p.area(), strip + 0.5, rounding);
  EXPECT_NEAR(p.perimeter(), 1 + 2 * (0.5 + std::sqrt(3) / 2) + pi / 3, rounding);
}

TEST(Patch, DiscCutByFourEdges) {
  const ContactPatch p = standing_on_box(1, Vec3::Zero(), Vec3(0.8, 0.8, 1));
  const double cut = std::acos(0.8) - 0.8 * 0.6;
  EXPECT_NEAR(p.area(), pi - 4 * cut, rounding);
  EXPECT_EQ(p.shape().sides().size(), 8u);
}

TEST(Patch, DiscThroughTheCornersOfAFaceIsTheFace) {
  // 3-4-5: every corner lies exactly on the circle.
  const ContactPatch p = standing_on_box(5, Vec3::Zero(), Vec3(3, 4, 1));
  EXPECT_EQ(p.area(), 48);
  EXPECT_EQ(p.shape().sides().size(), 4u);
}

TEST(Patch, DiscThatTouchesAnEdgeOrACornerFromOutsideIsAPoint) {
  const ContactPatch edge = standing_on_box(1, Vec3(4, 1, 0), Vec3(3, 3, 1));
  EXPECT_EQ(edge.kind(), Kind::point);
  expect_near(edge.centroid(), Vec3(3, 1, 0));
  const ContactPatch corner = standing_on_box(5, Vec3(6, 7, 0), Vec3(3, 3, 1));
  EXPECT_EQ(corner.kind(), Kind::point);
  expect_near(corner.centroid(), Vec3(3, 3, 0));
}

TEST(Patch, SideAcrossACapIsTheChord) {
  // A lies along x, half a radius off the middle of the disc.
  const Configuration c{Cylinder(0.25, 5), Pose(Vec3(0.5, 0.5, 0.25), along_x), Cylinder(1, 2),
                        Pose(-2 * up, upright)};
  const ContactPatch p = contact_patch(c, {up, perpendicular, {oblique, oblique, parallel}});
  EXPECT_EQ(p.kind(), Kind::segment);
  EXPECT_NEAR(p.perimeter(), std::sqrt(3), rounding);
  expect_near(p.centroid(), Vec3(0, 0.5, 0));
}

TEST(Patch, SideThatEndsInsideTheCap) {
  const Configuration c{Cylinder(0.25, 5), Pose(Vec3(5, 0, 0.25), along_x), Cylinder(1, 2),
                        Pose(-2 * up, upright)};
  const ContactPatch p = contact_patch(c, {up, perpendicular, {oblique, oblique, parallel}});
  EXPECT_EQ(p.kind(), Kind::segment);
  EXPECT_NEAR(p.perimeter(), 1, rounding);
  expect_near(p.centroid(), Vec3(0.5, 0, 0));
}

TEST(Patch, SideThatTouchesTheRimIsAPoint) {
  const std::array<Alignment, 3> to_b{oblique, oblique, parallel};
  // Tangent to the rim, then with its end on the rim.
  for (const Vec3& centre : {Vec3(0.5, 1, 0.25), Vec3(6, 0, 0.25)}) {
    const Configuration c{Cylinder(0.25, 5), Pose(centre, along_x), Cylinder(1, 2),
                          Pose(-2 * up, upright)};
    const ContactPatch p = contact_patch(c, {up, perpendicular, to_b});
    EXPECT_EQ(p.kind(), Kind::point);
    EXPECT_NEAR(p.centroid().norm(), 1, rounding);
  }
}

TEST(Patch, CapOnACapsulesSide) {
  const Configuration c{Cylinder(1, 1), Pose(up, upright), Capsule(0.5, 3),
                        Pose(Vec3(2.5, 0, -0.5), along_x)};
  const ContactPatch p = contact_patch(c, {up, parallel, {oblique, oblique, perpendicular}});
  EXPECT_EQ(p.kind(), Kind::segment);
  EXPECT_NEAR(p.perimeter(), 1.5, rounding);
  expect_near(p.centroid(), Vec3(0.25, 0, 0));
}

TEST(Patch, ParallelSidesShareWhatOverlaps) {
  const Configuration c{Cylinder(0.5, 2), Pose(Vec3(0, 0, 0.5), along_x), Cylinder(1, 3),
                        Pose(Vec3(4, 0, -1), along_x)};
  const ContactPatch p = contact_patch(c, {up, perpendicular, {oblique, oblique, perpendicular}});
  EXPECT_EQ(p.kind(), Kind::segment);
  EXPECT_NEAR(p.perimeter(), 1, rounding);
  expect_near(p.centroid(), Vec3(1.5, 0, 0));
}

TEST(Patch, ParallelSidesEndToEndShareAPoint) {
  const Configuration c{Cylinder(0.5, 2), Pose(Vec3(0, 0, 0.5), along_x), Cylinder(1, 3),
                        Pose(Vec3(5, 0, -1), along_x)};
  const ContactPatch p = contact_patch(c, {up, perpendicular, {oblique, oblique, perpendicular}});
  EXPECT_EQ(p.kind(), Kind::point);
  expect_near(p.centroid(), Vec3(2, 0, 0));
}

TEST(Patch, CrossedSidesShareAPointHowEverSmallTheAngle) {
  // Axes along x and along (1, tilt, 0), crossing above (1, 0).
  for (const double tilt : {1.0, 1e-3, 1e-15}) {
    const Eigen::Quaterniond turn(1, 0, 0, tilt / 2);
    const Configuration c{Cylinder(0.5, 2), Pose(Vec3(0, 0, 0.5), along_x), Cylinder(1, 3),
                          Pose(Vec3(1, 0, -1), turn * along_x)};
    const ContactPatch p = contact_patch(c, {up, perpendicular, {oblique, oblique, perpendicular}});
    EXPECT_EQ(p.kind(), Kind::point);
    expect_near(p.centroid(), Vec3(1, 0, 0));
  }
}

TEST(Patch, SideOnAFaceIsCutByTheFace) {
  const Configuration c{Cylinder(0.5, 4), Pose(Vec3(2, 1, 0.5), along_x), Box(Vec3(3, 2, 1)),
                        Pose(-up, upright)};
  const ContactPatch p = contact_patch(c, {up, perpendicular, of_face});
  EXPECT_EQ(p.kind(), Kind::segment);
  EXPECT_NEAR(p.perimeter(), 5, rounding);
  expect_near(p.centroid(), Vec3(0.5, 1, 0));
}

TEST(Patch, SideAlongAFacesEdgeIsWholeAndJustBeyondAPoint) {
  const auto at = [](double y) {
    const Configuration c{Cylinder(0.5, 4), Pose(Vec3(0, y, 0.5), along_x), Box(Vec3(3, 2, 1)),
                          Pose(-up, upright)};
    return contact_patch(c, {up, perpendicular, of_face});
  };
  EXPECT_EQ(at(2).kind(), Kind::segment);
  EXPECT_NEAR(at(2).perimeter(), 6, rounding);
  EXPECT_EQ(at(std::nextafter(2, 3)).kind(), Kind::point);
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

TEST(Patch, OnAPlaneItIsTheCylindersOwnFeature) {
  const auto on_plane = [](const Eigen::Quaterniond& q, double height, Alignment to_a) {
    const Configuration c{Cylinder(0.5, 2), Pose(Vec3(3, 4, height), q), Plane(up, 0), Pose()};
    return contact_patch(c, {up, to_a, unaligned});
  };
  const ContactPatch standing = on_plane(upright, 2, parallel);
  EXPECT_NEAR(standing.area(), pi / 4, rounding);
  expect_near(standing.centroid(), Vec3(3, 4, 0));
  const ContactPatch lying = on_plane(along_y, 0.5, perpendicular);
  EXPECT_EQ(lying.kind(), Kind::segment);
  EXPECT_EQ(lying.perimeter(), 4);
  EXPECT_EQ(lying.extent(Vec3(1, 0, 0)), 0);
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

TEST(Patch, LiesHalfwayBetweenTheSurfaces) {
  const Configuration deep{Cylinder(1, 1), Pose(0.9 * up, upright), Box(Vec3(3, 3, 1)),
                           Pose(-up, upright)};
  EXPECT_NEAR(contact_patch(deep, {up, parallel, of_face}).centroid().z(), -0.05, rounding);
  const Configuration apart{Cylinder(1, 1), Pose(1.5 * up, upright), Plane(2 * up, -1), Pose()};
  EXPECT_NEAR(contact_patch(apart, {up, parallel, unaligned}).centroid().z(), 0, rounding);
}

TEST(Patch, SphereMeetsInAPoint) {
  const Configuration c{Cylinder(1, 1), Pose(up, upright), Sphere(0.5),
                        Pose(Vec3(0.25, 0.5, -0.5), upright)};
  const ContactPatch p = contact_patch(c, {up, parallel, unaligned});
  EXPECT_EQ(p.kind(), Kind::point);
  EXPECT_EQ(p.area(), 0);
  expect_near(p.centroid(), Vec3(0.25, 0.5, 0));
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
    const ContactPatch p = contact_patch(
        c, {(q.normalized() * up).normalized(), parallel, {oblique, oblique, parallel}});
    EXPECT_EQ(p.kind(), more > 0 ? Kind::region : Kind::point);
    expect_near(p.centroid(), q.normalized() * Vec3(30, 40, 0) + Vec3(1000, -300, 7), 1e-12);
  }
}

TEST(Patch, FeaturesThatDoNotMeetGiveTheNearestPoint) {
  EXPECT_EQ(standing_on_disc(1, 1, Vec3(5, 0, 0)).kind(), Kind::point);
  const ContactPatch p = standing_on_box(1, Vec3(5, 0, 0), Vec3(3, 3, 1));
  EXPECT_EQ(p.kind(), Kind::point);
  expect_near(p.centroid(), Vec3(3, 0, 0));
}

}  // namespace
}  // namespace touchstone::oracle
