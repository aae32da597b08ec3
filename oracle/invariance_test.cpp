// What leaves the geometry alone leaves the enclosure alone: equal, not nearly equal.
#include <array>
#include <gtest/gtest.h>
#include <random>

#include "oracle/lattice_poses.hpp"
#include "oracle/truth.hpp"
#include "properties/draw.hpp"
#include "properties/identity.hpp"

namespace touchstone::oracle {
namespace {

void expect_equal(const Enclosure& a, const Enclosure& b) {
  EXPECT_EQ(a.lo, b.lo);
  EXPECT_EQ(a.hi, b.hi);
}

/// Rounded to a multiple of `step`, exactly.
Vec3 rounded(const Vec3& v, double step) { return step * (v / step).array().round().matrix(); }

Eigen::Quaterniond rounded(const Eigen::Quaterniond& q, double step) {
  return Eigen::Quaterniond(Eigen::Vector4d(step * (q.coeffs() / step).array().round().matrix()));
}

/// Like the class's configuration, with coordinates of so few digits that rotation by `turn` is
/// exact; turn's entries are integers whose squares add up to 25.
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
      for (std::uint64_t i = 0; i < 4; ++i) {
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
    for (std::uint64_t i = 0; i < 4; ++i) {
      SCOPED_TRACE(to_string(Identity{Pair::cylinder, name, 6, i}));
      const Configuration c = make_configuration({Pair::cylinder, name, 6, i});
      const Configuration exchanged{std::get<Cylinder>(c.b), c.pose_b, c.a, c.pose_a};
      const Truth forth = truth(c), back = truth(exchanged);
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
    const Truth forth = truth(c);
    const Truth back = truth({std::get<Cylinder>(c.b), c.pose_b, c.a, c.pose_a});
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
      const Cylinder a = poses.cylinder(), b = poses.cylinder();
      const Vec3 p = poses.position();
      const Eigen::Quaterniond q = poses.orientation(), r = poses.orientation();
      const auto scaled = [&](double s) {
        return truth({Cylinder(s * a.radius(), s * a.half_length()), Pose(s * p, q),
                      Cylinder(s * b.radius(), s * b.half_length()), Pose(Vec3::Zero(), r)})
            .signed_distance;
      };
      const Enclosure one = scaled(1), other = scaled(factor);
      expect_equal({one.lo * mpq_class(factor), one.hi * mpq_class(factor)}, other);
    }
  }
}

}  // namespace
}  // namespace touchstone::oracle
