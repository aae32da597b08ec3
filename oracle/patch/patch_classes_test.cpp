// Properties of the contact patch on every pair and pose class, at every optimal normal.
#include <cmath>
#include <gtest/gtest.h>

#include "oracle/patch/contact_patch.hpp"
#include "oracle/truth.hpp"
#include "properties/identity.hpp"
#include "properties/moves.hpp"
#include "reference/random_bodies_test.hpp"

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

}  // namespace

}  // namespace touchstone::oracle
