// What holds for every answer without a truth to compare it with; then what `certified_distance`
// claims, held against the oracle.
#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <gtest/gtest.h>
#include <random>
#include <string>
#include <vector>

#include "oracle/truth.hpp"
#include "properties/identity.hpp"
#include "reference/contact_of.hpp"
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
/// Laws of two bounded bodies: a half-space has no gap off its own normal.
class BoundedLaw : public Law {};

TEST_P(BoundedLaw, SignedDistanceIsTheGapAlongTheNormal) {
  for (const Identity& id : some_identities(GetParam())) {
    const Configuration c = make_configuration(id);
    const SignedDistance answer = signed_distance(c);
    EXPECT_NEAR(gap(c, answer.normal), answer.value, 1e-14 * larger_size(c) + law_rounding(c))
        << to_string(id);
  }
}

TEST_P(BoundedLaw, NoSampledDirectionHasALargerGap) {
  std::mt19937 random(1);
  std::normal_distribution<double> coordinate;
  for (const Identity& id : some_identities(GetParam())) {
    const Configuration c = make_configuration(id);
    const SignedDistance answer = signed_distance(c);
    const double most = answer.value + 1e-13 * larger_size(c) + law_rounding(c);
    for (int i = 0; i < 300; ++i) {
      const Vec3 offset(coordinate(random), coordinate(random), coordinate(random));
      // Everywhere, and ever closer to the answer.
      const Vec3 n = (i < 100 ? offset : answer.normal + std::pow(10, -(i % 10)) * offset);
      ASSERT_LE(gap(c, n.normalized()), most) << to_string(id);
    }
  }
}

TEST_P(Law, MovingBothBodiesMovesTheAnswer) {
  const Eigen::Quaterniond turn = Eigen::Quaterniond(3, -1, 2, 0.5).normalized();
  for (const Identity& id : some_identities(GetParam())) {
    const Configuration c = make_configuration(id);
    const Vec3 shift = larger_size(c) * Vec3(1, -2, 3);
    const auto moved = [&](const Pose& pose) {
      return Pose(turn * pose.position() + shift, turn * pose.orientation().normalized());
    };
    const Configuration other{c.a, moved(c.pose_a), c.b, moved(c.pose_b)};
    EXPECT_NEAR(signed_distance(other).value, signed_distance(c).value,
                1e-13 * larger_size(c) + 10 * law_rounding(c))
        << to_string(id);
  }
}

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
  std::mt19937_64 random(5);
  std::normal_distribution<double> normal;
  std::uniform_real_distribution<double> size(0.1, 1), along(-2, 2);
  const auto unit = [&] {
    return Vec3(normal(random), normal(random), normal(random)).normalized();
  };
  const auto pose = [](const Vec3& position, const Vec3& axis) {
    return Pose(position, turn_between(Vec3::UnitZ(), axis));
  };
  int touching = 0, apart = 0;
  for (int i = 0; i < 10000; ++i) {
    const Vec3 u1 = unit(), u2 = unit(), across = u1.cross(u2).normalized(), n = unit();
    const double r1 = size(random), r2 = size(random), h1 = size(random), h2 = size(random);
    const double threshold = i % 2 == 0 ? 0 : 0.1 * size(random);
    const Vec3 beside = (r1 + r2 + threshold) * across + along(random) * u1 + along(random) * u2;
    const Vec3 above = (h1 + r2 + threshold) * u1 + along(random) * r1 * across;
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
  std::mt19937 random(2);
  std::normal_distribution<double> coordinate;
  for (const Identity& id : some_identities(GetParam())) {
    const Configuration c = make_configuration(id);
    const double threshold = 0.01 * smaller_size(c);
    const Vec3 previous =
        Vec3(coordinate(random), coordinate(random), coordinate(random)).normalized();
    const Contact plain = contact(c, threshold), hinted = contact(c, threshold, &previous);
    SCOPED_TRACE(to_string(id));
    EXPECT_EQ(plain.points().empty(), hinted.points().empty());
    EXPECT_LE(std::abs(plain.signed_distance - hinted.signed_distance), threshold);
    EXPECT_GE(hinted.normal.dot(previous), plain.normal.dot(previous) - 1e-15);
  }
}

std::string name_of_other(const testing::TestParamInfo<Pair>& pair) {
  return std::string(pair_name(pair.param)).substr(std::string("cylinder-").size());
}
INSTANTIATE_TEST_SUITE_P(, Law, testing::ValuesIn(all_pairs), name_of_other);
INSTANTIATE_TEST_SUITE_P(, BoundedLaw,
                         testing::Values(Pair::sphere, Pair::capsule, Pair::cylinder, Pair::box),
                         name_of_other);

// Three stationary rim pairs within 0.05 rad, of which an even scan of the rim sees one.
TEST(CylinderCylinder, RimsWithCloseStationaryPointsAreResolved) {
  const Configuration table[] = {
      {Cylinder(0x1.f2e4caacfc2c5p-1, 0x1.0dd948c0ef4ddp-1),
       Pose({-0x1.82289cad9876dp+0, -0x1.94049c7dff1f4p-2, 0x1.e7ee04bcd3eecp+0},
            {0x1.b1b26a2079e21p-1, 0x1.0837601a5133ap-1, 0x1.9ed64bcf10519p-4,
             0x1.3b24e35c7f6c3p-4}),
       Cylinder(0x1.9245f5498b488p-2, 0x1.1cc5a1038fc0dp-2),
       Pose({-0x1.6c0aa813bec08p-1, -0x1.be948a8aaf07p-4, 0x1.2735efe02a156p-1},
            {-0x1.ca37b7de55afap-1, -0x1.90e10560b005cp-2, 0x1.908db562dd6b9p-4,
             -0x1.85d2f0335978dp-3})},
      {Cylinder(0x1.0bec94ef482d2p-2, 0x1.343e5c00f1858p-1),
       Pose({0x1.26a07d7f3ac2p-7, -0x1.ceebe9af60534p+0, -0x1.948ed7f2f8904p+0},
            {-0x1.8e7661f79a4p-1, 0x1.4eb5b2cc8ef13p-2, 0x1.bab83b8119c54p-4,
             -0x1.0ce3b16a291a2p-1}),
       Cylinder(0x1.0f906c30a55cp-1, 0x1.9dc7584dd7c27p-2),
       Pose({-0x1.599899706fdd8p-2, -0x1.95e3ecae1a4d4p-1, -0x1.a0a657753d5bap-1},
            {0x1.b59c1a30c3d2cp-4, -0x1.4afc639824473p-2, -0x1.088e329d4865fp-8,
             0x1.e16a06143e42dp-1})},
      {Cylinder(0x1.57841717dca2cp-2, 0x1.149818bd62499p-1),
       Pose({0x1.0ed4a470d8d87p-2, 0x1.4a21dc4da2b0cp+0, 0x1.240127bef85efp-1},
            {0x1.3b7aed69dbd7dp-2, 0x1.99998732aa354p-3, -0x1.59c6d2a88a2a9p-1,
             0x1.476fcec7e1c75p-1}),
       Cylinder(0x1.9d145b7a5b6b7p-1, 0x1.662b86a746fcfp-1),
       Pose({-0x1.6422273a3a5bp-3, -0x1.15003852556a8p-2, 0x1.22c150b4030bcp-2},
            {0x1.cf60662390becp-1, -0x1.416543242f94bp-2, 0x1.25b26d06fa9e4p-2,
             0x1.8a0f182177713p-7})},
  };
  for (const Configuration& c : table) {
    EXPECT_NEAR(signed_distance(c).value, oracle::truth(c).signed_distance.midpoint(),
                1e-12 * larger_size(c));
  }
}

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

// What `certified_distance` says of itself, held against the oracle on every pair and pose class
// and on hostile configurations: the truth lies within the bound, the bound is rounding (the search
// is proven complete), and the fast routine's answer lies within it, too.
//
// TOUCHSTONE_COUNT sets how many configurations of each class are tried (default 25); of hostile
// ones it is 200 times as many.

std::uint64_t laws_per_class() {
  const char* text = std::getenv("TOUCHSTONE_COUNT");
  return text ? std::strtoull(text, nullptr, 10) : 25;
}

/// The larger size, or how far the bodies are apart.
double law_scale(const Configuration& c) {
  const auto* plane = std::get_if<Plane>(&c.b);
  return std::max({larger_size(c), (c.pose_a.position() - c.pose_b.position()).stableNorm(),
                   plane ? std::abs(plane->unit_displacement()) : 0});
}

class Certified : public testing::TestWithParam<Pair> {};

TEST_P(Certified, BoundsHoldAndAreRounding) {
  constexpr double proven_part = 1e-13;
  std::vector<std::string> classes = pose_classes(GetParam());
  classes.push_back("hostile");
  constexpr double min_proven_part_of_hostile = 0.999;
  double worst = 0;
  std::string worst_id;
  for (const std::string& name : classes) {
    const bool hostile = name == "hostile";
    const std::uint64_t count = laws_per_class() * (hostile ? 200 : 1);
    std::uint64_t proven = 0;
    double largest_bound = 0;
    for (std::uint64_t i = 0; i < count; ++i) {
      const Identity id{GetParam(), name, 13, i};
      const Configuration c = make_configuration(id);
      const CertifiedDistance certified = certified_distance(c);
      const double error =
          std::abs(certified.value - oracle::truth(c, 1e-20).signed_distance.midpoint());
      EXPECT_LE(error, certified.error_bound) << to_string(id);
      EXPECT_LE(std::abs(signed_distance(c).value - certified.value), 2 * certified.error_bound)
          << to_string(id);
      EXPECT_NEAR(certified.normal.norm(), 1, 4e-15) << to_string(id);
      const double bound = certified.error_bound / law_scale(c);
      proven += bound <= proven_part;
      largest_bound = std::max(largest_bound, bound);
      const double part = error / certified.error_bound;
      if (part > worst) worst = part, worst_id = to_string(id);
    }
    const double share = static_cast<double>(proven) / static_cast<double>(count);
    EXPECT_GE(share, hostile ? min_proven_part_of_hostile : 1) << name;
    if (hostile) {
      std::printf("proven %.3f%% of hostile ones, largest bound %.2g\n", 100 * share,
                  largest_bound);
    }
  }
  std::printf("largest error %.2g of its bound at %s\n", worst, worst_id.c_str());
}

// Rims that touch from within along axes that are parallel but for rounding: every point of the
// rims is a stationary one.
TEST(CertifiedDistance, IsProvenWhereRimsCoincide) {
  for (const double tilt : {0.0, 1e-17, 1e-16, 3e-16, 1e-15, 1e-12, 1e-8}) {
    const Configuration c{Cylinder(1, 1), Pose({0, 0, 1.99}, {1, tilt, 0, 0}), Cylinder(1, 1),
                          Pose()};
    const CertifiedDistance certified = certified_distance(c);
    EXPECT_NEAR(certified.value, oracle::truth(c).signed_distance.midpoint(), certified.error_bound)
        << tilt;
    EXPECT_LE(certified.error_bound, 1e-13) << tilt;  // what counts as proven
  }
}

INSTANTIATE_TEST_SUITE_P(, Certified, testing::ValuesIn(all_pairs), name_of_other);

}  // namespace
}  // namespace touchstone
