// Configurations of small integers, where degenerate poses are common: touching bodies, families of
// normals, polynomials that vanish. And invariance: a change that leaves the geometry as it is
// leaves the enclosure equal, not nearly equal.
#include <array>
#include <cmath>
#include <cstdlib>
#include <gtest/gtest.h>
#include <random>

#include "oracle/expect_confirmed.hpp"
#include "oracle/truth.hpp"
#include "properties/draw.hpp"
#include "properties/identity.hpp"
#include "properties/moves.hpp"
#include "reference/configuration.hpp"

namespace touchstone::oracle {
namespace {

/// Bodies and poses of small integers and halves, with integer quaternions: a large part of them
/// is degenerate in some way, and exact in double.
class LatticePoses {
 public:
  explicit LatticePoses(unsigned seed) : random_(seed) {}

  double integer(int lo, int hi) { return std::uniform_int_distribution<int>(lo, hi)(random_); }
  double length() { return integer(1, 4) / 2; }
  Eigen::Quaterniond orientation() {
    for (;;) {
      Eigen::Quaterniond q(integer(-2, 2), integer(-2, 2), integer(-2, 2), integer(-2, 2));
      if (q.squaredNorm() > 0) return q;
    }
  }
  Vec3 position() { return {integer(-4, 4) / 2, integer(-4, 4) / 2, integer(-4, 4) / 2}; }
  Cylinder cylinder() { return {length(), length()}; }
  Shape other_body(int kind) {
    switch (kind % 4) {
      case 0:
        return Sphere(length());
      case 1:
        return Capsule(length(), length());
      case 2:
        return cylinder();
      default:
        return Box({length(), length(), length()});
    }
  }
  Configuration next() {
    const Shape b = other_body(kind_++);
    return {cylinder(), Pose(position(), orientation()), b, Pose(Vec3::Zero(), orientation())};
  }

 private:
  std::mt19937 random_;
  int kind_ = 0;
};

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
    expect_confirmed(c, t);
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

// The directions that the filter drops do not matter: with a slack that keeps every critical
// direction the signed distance is the same.
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

void expect_equal(const Enclosure& a, const Enclosure& b) {
  EXPECT_EQ(a.lo, b.lo);
  EXPECT_EQ(a.hi, b.hi);
}

/// Rounded to a multiple of `step`, exactly.
Vec3 rounded(const Vec3& v, double step) { return step * (v / step).array().round().matrix(); }

Eigen::Quaterniond rounded(const Eigen::Quaterniond& q, double step) {
  return Eigen::Quaterniond(Eigen::Vector4d(step * (q.coeffs() / step).array().round().matrix()));
}

/// The class's configuration with coordinates rounded to so few digits that the rotation by `turn`
/// is exact; turn's entries are integers whose squares add up to 25.
struct Turned {
  Configuration before, after;
};

Turned turned(const Configuration& c, const Eigen::Quaterniond& turn, const Vec3& shift) {
  constexpr double fine = 1.0 / (1 << 20);
  Turned result{c, c};
  Pose* before[] = {&result.before.pose_a, &result.before.pose_b};
  Pose* after[] = {&result.after.pose_a, &result.after.pose_b};
  for (int i = 0; i < 2; ++i) {
    const Vec3 p = rounded(before[i]->position(), 25 * fine);
    const Eigen::Quaterniond q = rounded(before[i]->orientation(), fine);
    const Axes axes_of_turn = axes(turn);  // times 25
    const Vec3 moved = (p.x() * axes_of_turn.x + p.y() * axes_of_turn.y + p.z() * axes_of_turn.z);
    *before[i] = Pose(p, q);
    *after[i] = Pose(Vec3(rounded(moved / 25, fine) + shift), product(turn, q));
  }
  return result;
}

TEST(Invariance, ExactRotationAndTranslation) {
  const Eigen::Quaterniond turns[] = {{4, 0, 3, 0}, {2, 4, 2, 1}, {0, 0, 0, 5}, {-3, 0, 0, 4}};
  for (const Pair pair : all_pairs) {
    for (const std::string& name : pose_classes(pair)) {
      for (std::uint64_t i = 0; i < 2; ++i) {
        SCOPED_TRACE(to_string(Identity{pair, name, 5, i}));
        const auto [before, after] =
            turned(make_configuration({pair, name, 5, i}), turns[i % 4], {0.5, -3, 1024});
        const Truth was = truth(before), is = truth(after);
        expect_equal(was.signed_distance, is.signed_distance);
        ASSERT_EQ(was.normals.size(), is.normals.size());
        for (std::size_t k = 0; k < was.normals.size(); ++k) {
          const Vec3 n = turns[i % 4].normalized() * was.normals[k].n;
          EXPECT_LT((n - is.normals[k].n).norm(), 1e-14);
          EXPECT_EQ(was.normals[k].to_a, is.normals[k].to_a);
          EXPECT_EQ(was.normals[k].to_b, is.normals[k].to_b);
        }
      }
    }
  }
}

TEST(Invariance, ExchangeOfTheBodies) {
  for (const std::string& name : pose_classes(Pair::cylinder)) {
    for (std::uint64_t i = 0; i < 2; ++i) {
      SCOPED_TRACE(to_string(Identity{Pair::cylinder, name, 6, i}));
      const Configuration c = make_configuration({Pair::cylinder, name, 6, i});
      const Truth forth = truth(c), back = truth(exchanged(c));
      expect_equal(forth.signed_distance, back.signed_distance);
      EXPECT_EQ(forth.ties, back.ties);
      for (const OptimalNormal& normal : back.normals) {
        EXPECT_LE(normal_regret(c, forth, -normal.n), 1e-14 * larger_size(c));
      }
    }
  }
}

// Two bodies about one centre are the same seen from both sides, so that every normal ties with its
// opposite. An offset of 1e-27 to 1e-41 parts them by about as much.
TEST(Invariance, ExchangeKeepsTiesOfGapsThatAllButAgree) {
  LatticePoses poses(7);
  std::mt19937_64 random(3);
  std::uniform_real_distribution<double> number(-1, 1);
  const auto orientation = [&] {
    Eigen::Quaterniond q = poses.orientation();
    // Exactly degenerate, nearly so, or any.
    const double noise = std::array{0.0, 0x1p-30, 1.0}[random() % 3];
    for (double& component : q.coeffs()) component += noise * number(random);
    return q;
  };
  int unique = 0, finite = 0;
  for (int i = 0; i < 600; ++i) {
    SCOPED_TRACE(i);
    const double offset = std::ldexp(1, -90 - i % 46);
    const Vec3 d(offset * number(random), offset * number(random), offset * number(random));
    const Configuration c{Cylinder(1 + 0.9 * number(random), 1 + 0.9 * number(random)),
                          Pose(d, orientation()),
                          Cylinder(1 + 0.9 * number(random), 1 + 0.9 * number(random)),
                          Pose(Vec3::Zero(), orientation())};
    const Truth forth = truth(c), back = truth(exchanged(c));
    EXPECT_EQ(forth.ties, back.ties);
    if (forth.ties != Ties::continuum) {
      EXPECT_EQ(forth.normals.size(), back.normals.size());
    }
    unique += forth.ties == Ties::unique;
    finite += forth.ties == Ties::finite;
  }
  EXPECT_GT(unique, 50);
  EXPECT_GT(finite, 50);
}

TEST(Invariance, PowersOfTwo) {
  LatticePoses poses(4);
  for (const double factor : {0x1p-40, 0.5, 0x1p70}) {
    for (int i = 0; i < 100; ++i) {
      SCOPED_TRACE(i);
      const Configuration c = poses.next();
      const Enclosure one = truth(c).signed_distance;
      expect_equal({one.lo * mpq_class(factor), one.hi * mpq_class(factor)},
                   truth(scaled(c, factor)).signed_distance);
    }
  }
}

}  // namespace

}  // namespace touchstone::oracle
