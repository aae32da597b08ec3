#include "deep_normals.hpp"

#include <gtest/gtest.h>
#include <random>

#include "properties/identity.hpp"

namespace touchstone {
namespace {

struct Counts {
  int proven = 0, contradicted = 0;
};

/// Along how many random normals is the gap larger than along one that is said to have the largest?
int larger_gaps(const FoldedCylinders& pair, double gap, std::mt19937_64& random) {
  std::normal_distribution<double> normal;
  int count = 0;
  for (int i = 0; i < 500; ++i) {
    const Vec3 n = Vec3(normal(random), normal(random), normal(random)).normalized();
    count += pair.gap(n) > gap + 1e-13;
  }
  return count;
}

void count(const FoldedCylinders& pair, const Vec3& n, bool proven, std::mt19937_64& random,
           Counts& counts) {
  if (!proven) return;
  ++counts.proven;
  counts.contradicted += larger_gaps(pair, pair.gap(n), random) > 0;
}

TEST(DeepNormals, AreProvenOnlyWhereNoNormalHasALargerGap) {
  std::mt19937_64 random(1);
  Counts cap, crossing;
  for (const char* name : {"general-deep", "concentric", "aspect-coin-deep"}) {
    for (std::uint64_t i = 0; i < 1000; ++i) {
      const Configuration x = make_configuration({Pair::cylinder, name, 3, i});
      const auto& b = std::get<Cylinder>(x.b);
      const FoldedAxes f(x.pose_a.axis(), x.pose_b.axis(),
                         x.pose_a.position() - x.pose_b.position());
      const FoldedCylinders pair{f, x.a.radius(), x.a.half_length(), b.radius(), b.half_length()};
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

TEST(DeepNormals, OfCrossedCylindersIsAcrossBothSides) {
  const FoldedAxes f(Vec3::UnitX(), Vec3::UnitY(), Vec3(0, 0, 0.25));
  EXPECT_TRUE(no_normal_beats_crossing({f, 1, 2, 1, 2}));
  // Discs as thin as these are nearer to the way out along an axis.
  EXPECT_FALSE(no_normal_beats_crossing({f, 1, 0.25, 1, 2}));
}

}  // namespace
}  // namespace touchstone
