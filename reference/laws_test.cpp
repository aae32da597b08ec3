// What holds for every answer without a truth to compare it with.
#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <string>
#include <vector>

#include "properties/identity.hpp"
#include "reference/contact_of.hpp"
#include "reference/random_bodies_test.hpp"
#include "reference/support.hpp"

namespace touchstone {
namespace {

constexpr int per_class = 2;

std::vector<Identity> some_identities(Pair pair) {
  std::vector<Identity> identities;
  for (const auto& name : pose_classes(pair)) {
    for (std::uint64_t i = 0; i < per_class; ++i) identities.push_back({pair, name, 3, i});
  }
  return identities;
}

double law_rounding(const Configuration& c) {
  return 1e-15 * (c.pose_a.position().norm() + c.pose_b.position().norm());
}

class Law : public testing::TestWithParam<Pair> {};

TEST(CylinderCylinder, ExchangedBodiesAnswerBitForBitAlike) {
  std::vector<Identity> identities = some_identities(Pair::cylinder);
  // Some of these are so large or small that they are scaled.
  for (std::uint64_t i = 0; i < 1000; ++i) identities.push_back({Pair::cylinder, "hostile", 3, i});
  for (const Identity& id : identities) {
    const Configuration c = make_configuration(id);
    const Configuration exchanged{std::get<Cylinder>(c.b), c.pose_b, c.a, c.pose_a};
    SCOPED_TRACE(to_string(id));
    const SignedDistance one = signed_distance(c), other = signed_distance(exchanged);
    EXPECT_EQ(one.value, other.value);
    EXPECT_EQ(one.normal, Vec3(-other.normal));
    EXPECT_EQ(overlaps(c), overlaps(exchanged));
    const Contact contact1 = contact(c, 0), contact2 = contact(exchanged, 0);
    EXPECT_EQ(contact1.normal, Vec3(-contact2.normal));
    ASSERT_EQ(contact1.points().size(), contact2.points().size());
    for (std::size_t i = 0; i < contact1.points().size(); ++i) {
      EXPECT_EQ(contact1.points()[i].position, contact2.points()[i].position);
      EXPECT_EQ(contact1.points()[i].depth, contact2.points()[i].depth);
    }
  }
}

void expect_agreement(const Configuration& c, double threshold) {
  const double distance = signed_distance(c).value;
  const Contact answer = contact(c, threshold);
  EXPECT_EQ(answer.points().empty(), distance > threshold);
  if (answer.points().empty()) {
    EXPECT_GT(answer.signed_distance, threshold);
    EXPECT_LE(answer.signed_distance, distance + 1e-13 * larger_size(c) + law_rounding(c));
  } else {
    EXPECT_EQ(answer.signed_distance, distance);
  }
}

TEST_P(Law, ContactAgreesWithSignedDistanceAndOverlaps) {
  for (const Identity& id : some_identities(GetParam())) {
    const Configuration c = make_configuration(id);
    const double distance = signed_distance(c).value;
    SCOPED_TRACE(to_string(id));
    EXPECT_EQ(overlaps(c), distance <= 0);
    for (const double threshold : {0.0, 0.01 * smaller_size(c), 10 * larger_size(c)}) {
      expect_agreement(c, threshold);
    }
    if (distance > 0) expect_agreement(c, distance);
  }
}

/// The lines of the axes, or a cap and the other axis' end, are as far apart as the threshold, but
/// for rounding, or rims meet; the bodies themselves are that far apart or much farther.
TEST(Touch, ThatRoundingDecidesIsDecidedAlike) {
  Random random(5);
  const auto size = [&] { return random.uniform(0.1, 1); };
  const auto along = [&] { return random.uniform(-2, 2); };
  const auto pose = [](const Vec3& position, const Vec3& axis) {
    return Pose(position, turn_between(Vec3::UnitZ(), axis));
  };
  int touching = 0, apart = 0;
  for (int i = 0; i < 10000; ++i) {
    const Vec3 u1 = random.direction(), u2 = random.direction(), n = random.direction();
    const Vec3 across = u1.cross(u2).normalized();
    const double r1 = size(), r2 = size(), h1 = size(), h2 = size();
    const double threshold = i % 2 == 0 ? 0 : 0.1 * size();
    const Vec3 beside = (r1 + r2 + threshold) * across + along() * u1 + along() * u2;
    const Vec3 above = (h1 + r2 + threshold) * u1 + along() * r1 * across;
    const auto rim = [&](const Vec3& u, double r, double h) {
      return Vec3(std::copysign(h, u.dot(n)) * u + r * (n - n.dot(u) * u).normalized());
    };
    const Vec3 rims = rim(u1, r1, h1) + rim(u2, r2, h2) + threshold * n;
    for (const Vec3& d : {beside, above, Vec3(above - h2 * u2), Vec3(above + h2 * u2), rims}) {
      for (const Shape& b : {Shape(Cylinder(r2, h2)), Shape(Capsule(r2, h2)), Shape(Sphere(r2))}) {
        const Configuration c{Cylinder(r1, h1), pose(d, u1), b, pose(Vec3::Zero(), u2)};
        const double distance = signed_distance(c).value;
        SCOPED_TRACE(std::string(shape_name(b)) + " " + std::to_string(i));
        EXPECT_EQ(overlaps(c), distance <= 0);
        expect_agreement(c, threshold);
        touching += std::abs(distance - threshold) < 1e-14;
        apart += distance > threshold + 0.1;
      }
    }
  }
  EXPECT_GT(touching, 1000);
  EXPECT_GT(apart, 1000);
}

TEST_P(Law, APreviousNormalNeverCostsMoreThanTheThreshold) {
  Random random(2);
  for (const Identity& id : some_identities(GetParam())) {
    const Configuration c = make_configuration(id);
    const double threshold = 0.01 * smaller_size(c);
    const Vec3 previous = random.direction();
    const Contact plain = contact(c, threshold), hinted = contact(c, threshold, &previous);
    SCOPED_TRACE(to_string(id));
    EXPECT_EQ(plain.points().empty(), hinted.points().empty());
    EXPECT_LE(std::abs(plain.signed_distance - hinted.signed_distance), threshold);
    EXPECT_GE(hinted.normal.dot(previous), plain.normal.dot(previous) - 1e-15);
  }
}

INSTANTIATE_TEST_SUITE_P(, Law, testing::ValuesIn(all_pairs), name_of_other);

TEST(Aabb, ReachesAsFarAsTheSupportsAlongTheWorldsAxes) {
  for (const Pair pair : {Pair::sphere, Pair::capsule, Pair::cylinder, Pair::box}) {
    for (std::uint64_t i = 0; i < 50; ++i) {
      const Configuration c = make_configuration({pair, "general-deep", 5, i});
      const Aabb box = aabb(c.b, c.pose_b);
      for (int k = 0; k < 3; ++k) {
        EXPECT_NEAR(box.upper[k], support(c.b, c.pose_b, Vec3::Unit(k)), 1e-14);
        EXPECT_NEAR(-box.lower[k], support(c.b, c.pose_b, -Vec3::Unit(k)), 1e-14);
      }
    }
  }
}

TEST(Aabb, OfBodiesThatTouchOverlap) {
  for (const Pair pair : all_pairs) {
    for (std::uint64_t i = 0; i < 200; ++i) {
      const Configuration c = make_configuration({pair, "general-shallow", 6, i});
      EXPECT_TRUE(aabb(c.a, c.pose_a).overlaps(aabb(c.b, c.pose_b)));
    }
  }
}

}  // namespace
}  // namespace touchstone
