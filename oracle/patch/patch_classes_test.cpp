// Properties of the contact patch on every pair and pose class, at every optimal normal.
#include <cmath>
#include <gtest/gtest.h>
#include <numbers>

#include "oracle/patch/contact_patch.hpp"
#include "oracle/patch/support_feature.hpp"
#include "oracle/rounded.hpp"
#include "oracle/truth.hpp"
#include "properties/identity.hpp"
#include "properties/moves.hpp"
#include "reference/random_bodies_test.hpp"
#include "reference/support.hpp"

namespace touchstone::oracle {
namespace {

constexpr std::uint64_t patches_per_class = 1;

Alignment alignment(const Vec3& axis, const Vec3& n, double tolerance) {
  if (std::abs(axis.dot(n)) <= tolerance) return Alignment::perpendicular;
  return axis.cross(n).norm() <= tolerance ? Alignment::parallel : Alignment::oblique;
}

/// An optimal normal, its alignment decided in double.
OptimalNormal optimal(const Configuration& c, const Vec3& n, double tolerance = 1e-12) {
  OptimalNormal result{n, alignment(c.pose_a.rotation().col(2), n, tolerance), {}};
  const Pair pair = pair_of(c);
  if (pair == Pair::plane || pair == Pair::sphere) return result;
  for (int i = pair == Pair::box ? 0 : 2; i < 3; ++i) {
    result.to_b[i] = alignment(c.pose_b.rotation().col(i), n, tolerance);
  }
  return result;
}

/// Lengths from which coordinates are computed: rounding is relative to them.
double lengths(const Configuration& c) {
  return larger_size(c) + c.pose_a.position().norm() + c.pose_b.position().norm();
}

template <class Check>
void for_all_normals(Pair pair, const Check& check) {
  for (const auto& name : pose_classes(pair)) {
    for (std::uint64_t i = 0; i < patches_per_class; ++i) {
      const Identity id{pair, name, 20261121, i};
      SCOPED_TRACE(to_string(id));
      const Configuration c = make_configuration(id);
      const Truth t = truth(c);
      for (const OptimalNormal& n : t.normals) check(c, n, t.signed_distance.midpoint());
    }
  }
}

class PatchClasses : public testing::TestWithParam<Pair> {};
/// Of bodies whose features follow from how the normal lies to their axes.
class PatchesOfAxes : public PatchClasses {};

TEST_P(PatchesOfAxes, HaveTheExactOneWithinThatOfEveryEpsilon) {
  for_all_normals(GetParam(), [](const Configuration& c, const OptimalNormal& n, double) {
    for (const double epsilon : {1e-4, 1e-9}) {
      const ContactPatch wider = contact_patch(c, n.n, epsilon * larger_size(c));
      // Inscribed polygons may lack 0.5% of their width.
      const double slack = 0.005 * wider.perimeter() + 1e-13 * lengths(c);
      for (const double tolerance : {4e-16, 1e-14, 1e-12}) {
        for (const Vec3& p : contact_patch(c, optimal(c, n.n, tolerance)).outline()) {
          EXPECT_LE(wider.distance(p), slack) << "epsilon " << epsilon;
        }
      }
    }
  });
}

// Half of the distance above B's highest point, which for a sphere needs none of our code.
TEST(PatchOfASphere, LiesHalfwayBetweenTheSupportPlanes) {
  for_all_normals(Pair::sphere, [](const Configuration& c, const OptimalNormal& n, double sigma) {
    const Vec3 from_b = contact_patch(c, n).centroid() - c.pose_b.position();
    EXPECT_NEAR(from_b.dot(n.n) - std::get<Sphere>(c.b).radius(), sigma / 2, 1e-14 * lengths(c));
  });
}

TEST_P(PatchClasses, TurnsWithTheWorld) {
  // A third of a turn about (1, 1, 1): positions lose no bit.
  const Eigen::Quaterniond q(0.5, 0.5, 0.5, 0.5);
  const Eigen::Matrix3d rotation = q.toRotationMatrix();
  for_all_normals(GetParam(), [&](const Configuration& c, const OptimalNormal& n, double) {
    // The orientations' product is rounded, which changes tilts of 1e-15.
    const Configuration turned = rotated(c, q);
    OptimalNormal turned_normal = n;
    turned_normal.n = rotation * n.n;
    const ContactPatch patch = contact_patch(c, n), again = contact_patch(turned, turned_normal);
    const double rounding = 1e-9 * larger_size(c) + 1e-13 * lengths(c);
    EXPECT_NEAR(again.perimeter(), patch.perimeter(), rounding);
    if (patch.kind() != ContactPatch::Kind::region) return;
    EXPECT_NEAR(again.area(), patch.area(), rounding * larger_size(c));
    EXPECT_LE((again.centroid() - rotation * patch.centroid()).norm(), rounding);
  });
}

TEST_P(PatchClasses, ScalesWithTheUnitOfLength) {
  for_all_normals(GetParam(), [](const Configuration& c, const OptimalNormal& n, double) {
    const ContactPatch patch = contact_patch(c, n);
    for (const double s : {0x1p-20, 0x1p20}) {
      // A power of two changes no digit.
      const ContactPatch again = contact_patch(scaled(c, s), n);
      EXPECT_EQ(again.kind(), patch.kind());
      EXPECT_EQ(again.area(), s * s * patch.area());
      EXPECT_EQ(again.perimeter(), s * patch.perimeter());
      EXPECT_EQ(again.centroid(), Vec3(s * patch.centroid()));
    }
  });
}

INSTANTIATE_TEST_SUITE_P(, PatchClasses, testing::ValuesIn(all_pairs), name_of_other);
INSTANTIATE_TEST_SUITE_P(, PatchesOfAxes, testing::ValuesIn(pairs_of_sizes), name_of_other);

// Contact patches of rounded bodies: those of their cores, moved out, and those of other shapes
// that they are.

using Kind = ContactPatch::Kind;

/// Relative width by which inscribed polygons may be too narrow, as contact_patch.hpp promises.
constexpr double narrower = 5e-3;

const Eigen::Quaterniond flat_on_z(1, 0, 0, 0), lying_along_x(1, 0, 1, 0);
const Plane ground({0, 0, 1}, 0);

ContactPatch exact_patch(const Configuration& c) {
  return contact_patch(c, truth(c).normals.front());
}

TEST(RoundedPatch, OfACapIsTheCoresDiscInTheBodysPlane) {
  const ContactPatch p =
      exact_patch({Cylinder(2, 3, 0.5), Pose(Vec3(0, 0, 3), flat_on_z), ground, Pose()});
  EXPECT_EQ(p.kind(), Kind::region);
  EXPECT_NEAR(p.area(), std::numbers::pi * 1.5 * 1.5, 1e-12);
  EXPECT_NEAR(p.centroid().z(), 0, 1e-15);
}

TEST(RoundedPatch, OfASideIsTheCoresGenerator) {
  const ContactPatch p =
      exact_patch({Cylinder(2, 3, 0.5), Pose(Vec3(0, 0, 2), lying_along_x), ground, Pose()});
  EXPECT_EQ(p.kind(), Kind::segment);
  EXPECT_NEAR(p.perimeter(), 5, 1e-12);
}

TEST(RoundedPatch, OfACoreWithoutALengthOrAWidthIsAPoint) {
  for (const auto& [cylinder, turn] :
       {std::pair(Cylinder(2, 3, 2), flat_on_z), std::pair(Cylinder(3, 2, 2), lying_along_x)}) {
    const ContactPatch p = exact_patch({cylinder, Pose(Vec3(0, 0, 3), turn), ground, Pose()});
    EXPECT_EQ(p.kind(), Kind::point);
    EXPECT_NEAR(p.centroid().norm(), 0, 1e-15);
  }
}

TEST(RoundedPatch, OfABoxUnderACapIsTheCoresFace) {
  const ContactPatch p = exact_patch({Cylinder(9, 1, 1), Pose(Vec3(0, 0, 4), flat_on_z),
                                      Box({2, 1, 3}, 0.25), Pose(Vec3::Zero(), flat_on_z)});
  EXPECT_EQ(p.kind(), Kind::region);
  EXPECT_NEAR(p.area(), 4 * 1.75 * 0.75, 1e-12);
  EXPECT_NEAR(p.centroid().z(), 3, 1e-12);
}

// Only the two rims' points are where they are by their roundings.
TEST(RoundedPatch, OfARoundRimIsItsPointNearestToTheOtherBody) {
  const Configuration c{Cylinder(2, 2, 1), Pose(Vec3::Zero(), flat_on_z), Sphere(3.5),
                        Pose(Vec3(4, 0, 5), flat_on_z)};
  const ContactPatch p = exact_patch(c);
  EXPECT_EQ(p.kind(), Kind::point);
  // From (1, 0, 1) along (3, 4)/5 the surfaces are at 1 and at 5 − 3.5.
  EXPECT_NEAR((p.centroid() - Vec3(1 + 1.25 * 0.6, 0, 1 + 1.25 * 0.8)).norm(), 0, 1e-12);
}

/// Same width of the ε-patches along several directions, as far as polygons allow.
void expect_one_extent(const ContactPatch& p, const ContactPatch& q) {
  for (int k = 0; k < 12; ++k) {
    const double angle = std::numbers::pi * k / 12;
    const Vec3 direction = std::cos(angle) * p.in_world({1, 0}) +
                           std::sin(angle) * p.in_world({0, 1}) -
                           (std::cos(angle) + std::sin(angle)) * p.in_world({0, 0});
    EXPECT_NEAR(p.extent(direction) / q.extent(direction), 1, 2 * narrower);
  }
}

TEST(RoundedPatch, WithinADepthIsThatOfTheCapsuleOrSphereThatTheBodyIs) {
  for (const double tilt : {0.0, 1e-6, 1e-3, 0.3, 1.5}) {
    const Eigen::Quaterniond turn(std::cos(tilt / 2), 0, std::sin(tilt / 2), 0);
    for (const double epsilon : {1e-6, 1e-2, 0.3}) {
      SCOPED_TRACE(testing::Message() << tilt << " " << epsilon);
      const Vec3 n(0, 0, 1);
      const Cylinder wide(50, 1);
      const auto under = [&](const Shape& b) {
        return contact_patch({wide, Pose(Vec3(0, 0, 9), flat_on_z), b, Pose(Vec3::Zero(), turn)}, n,
                             epsilon);
      };
      expect_one_extent(under(Capsule(0.5, 1.5)), under(Cylinder(0.5, 2, 0.5)));
      expect_one_extent(under(Sphere(0.5)), under(Cylinder(0.5, 0.5, 0.5)));
      expect_one_extent(under(Sphere(0.5)), under(Box({0.5, 0.5, 0.5}, 0.5)));
    }
  }
}

// A point of the part, moved into the support plane, is not farther out than the body along any
// other direction by more than what epsilon is.
TEST(RoundedPatch, WithinADepthLiesInTheBody) {
  const Vec3 n = Vec3(0.2, -0.3, 1).normalized();
  for (const Shape& shape : {Shape(Cylinder(1, 2, 0.25)), Shape(Cylinder(2, 1, 0.5)),
                             Shape(Box({1, 2, 3}, 0.5)), Shape(Box({1, 1, 3}, 1))}) {
    const Pose pose(Vec3::Zero(), Eigen::Quaterniond(3, 1, 0.5, -0.25));
    for (const double epsilon : {1e-6, 1e-2, 0.5}) {
      for (const Vec3& p : support_part(shape, pose, n, epsilon, Vec3::Zero())) {
        // A direction across n sees the part as the body is seen.
        for (int k = 0; k < 12; ++k) {
          const double angle = 2 * std::numbers::pi * k / 12;
          const Vec3 across =
              std::cos(angle) * n.unitOrthogonal() + std::sin(angle) * n.cross(n.unitOrthogonal());
          EXPECT_LE(p.dot(across), support(shape, pose, across) + 1e-12);
        }
      }
    }
  }
}

TEST(RoundedPatch, WidthsFromADepthOfRoundCornersAreCorners) {
  const Pose pose(Vec3::Zero(), Eigen::Quaterniond(3, 1, 0.5, -0.25));
  const Vec3 n(0, 0, 1);
  for (const Shape& shape : {Shape(Box({1, 2, 3}, 0.5)), Shape(Box({1, 1, 1}, 1)),
                             Shape(Cylinder(1, 1, 1)), Shape(Cylinder(1, 2, 1))}) {
    const WidthFromEpsilon width = width_from_epsilon(shape, pose, n, 1e-6);
    EXPECT_TRUE(width.is_a_corner);
    EXPECT_GE(width.largest, 2 * std::sqrt(1e-6 * rounding_of(shape)));
  }
}

}  // namespace
}  // namespace touchstone::oracle
