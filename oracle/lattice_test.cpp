// Configurations of small integers, where degenerate poses are common: touching, families of
// normals, polynomials that vanish.
#include <cmath>
#include <cstdlib>

#include "oracle/expect_truth.hpp"
#include "oracle/lattice_poses.hpp"
#include "oracle/truth.hpp"

namespace touchstone::oracle {
namespace {

int count() {
  const char* text = std::getenv("TOUCHSTONE_COUNT");
  return text ? std::atoi(text) : 2000;
}

/// A direction of the family, `part` of the way from its first end to its last.
Vec3 member(const NormalFamily& family, double part) {
  if (family.kind == NormalFamily::Kind::circle) {
    const Vec3 e = family.axis.unitOrthogonal();
    return Eigen::AngleAxisd(2 * M_PI * part, family.axis) * e;
  }
  const Vec3& from = family.ends.at(0);
  const Vec3& to = family.ends.at(1);
  const double angle = std::abs(std::atan2(family.axis.dot(from.cross(to)), from.dot(to)));
  return Eigen::AngleAxisd(part * angle, family.axis) * from;
}

TEST(Lattice, NoDirectionBeatsTheOracleAndEveryMemberOfAFamilyReachesIt) {
  LatticePoses poses(1);
  int families = 0;
  for (int i = 0; i < count(); ++i) {
    SCOPED_TRACE(i);
    const Configuration c = poses.next();
    const Truth t = truth(c);
    expect_brute_force_agrees(c, t, 200);
    EXPECT_EQ(t.ties == Ties::continuum, !t.families.empty());
    for (const NormalFamily& family : t.families) {
      ++families;
      if (family.kind == NormalFamily::Kind::curve) continue;
      for (const double part : {0.0, 0.25, 0.5, 0.75, 1.0}) {
        EXPECT_LE(normal_regret(c, t, member(family, part)), 1e-14) << part;
      }
    }
  }
  EXPECT_GT(families, count() / 400);
}

TEST(Lattice, TouchingIsProvenNotGuessed) {
  LatticePoses poses(2);
  int touching = 0;
  for (int i = 0; i < count(); ++i) {
    SCOPED_TRACE(i);
    const Truth t = truth(poses.next());
    const auto& [lo, hi] = t.signed_distance;
    const bool zero = lo == 0 && hi == 0;
    EXPECT_TRUE(zero || lo > 0 || hi < 0);
    touching += zero;
  }
  EXPECT_GT(touching, count() / 100);
}

// The directions that the filter drops must not matter: with a bar low enough to keep every
// critical direction the signed distance is the same.
TEST(Lattice, TheFilterDropsNothingThatMatters) {
  LatticePoses poses(3);
  for (int i = 0; i < count() / 4; ++i) {
    SCOPED_TRACE(i);
    const Configuration c = poses.next();
    const Truth filtered = truth(c), all = truth(c, 1e-30, 1e6);
    EXPECT_EQ(filtered.signed_distance.lo, all.signed_distance.lo);
    EXPECT_EQ(filtered.signed_distance.hi, all.signed_distance.hi);
    EXPECT_LE(filtered.normals.size(), all.normals.size());
  }
}

}  // namespace
}  // namespace touchstone::oracle
