#include "properties/identity.hpp"

#include <cmath>
#include <cstring>
#include <gmock/gmock.h>
#include <gmpxx.h>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>
#include <set>

#include "oracle/truth.hpp"
#include "properties/arbitrary.hpp"
#include "reference/invalid_input.hpp"

namespace touchstone {
namespace {

using testing::HasSubstr;

/// Every number of a configuration, for comparison bit by bit.
std::vector<double> numbers(const Configuration& c) {
  std::vector<double> all = {c.a.radius(), c.a.half_length()};
  const auto add_pose = [&](const Pose& p) {
    all.insert(all.end(),
               {p.position().x(), p.position().y(), p.position().z(), p.orientation().w(),
                p.orientation().x(), p.orientation().y(), p.orientation().z()});
  };
  add_pose(c.pose_a);
  if (const auto* s = std::get_if<Plane>(&c.b)) {
    all.insert(all.end(), {s->normal().x(), s->normal().y(), s->normal().z(), s->displacement()});
  } else if (const auto* sphere = std::get_if<Sphere>(&c.b)) {
    all.push_back(sphere->radius());
  } else if (const auto* capsule = std::get_if<Capsule>(&c.b)) {
    all.insert(all.end(), {capsule->radius(), capsule->half_length()});
  } else if (const auto* cylinder = std::get_if<Cylinder>(&c.b)) {
    all.insert(all.end(), {cylinder->radius(), cylinder->half_length()});
  } else if (const auto* box = std::get_if<Box>(&c.b)) {
    const Vec3& h = box->half_extents();
    all.insert(all.end(), {h.x(), h.y(), h.z()});
  }
  add_pose(c.pose_b);
  return all;
}

bool same_bits(const Configuration& x, const Configuration& y) {
  const auto a = numbers(x), b = numbers(y);
  return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(double)) == 0;
}

struct Class {
  Pair pair;
  std::string name;
};
std::vector<Class> every_class() {
  std::vector<Class> all;
  for (const Pair pair : all_pairs) {
    for (const auto& name : pose_classes(pair)) all.push_back({pair, name});
  }
  return all;
}

TEST(Identity, PrintsAndParsesBack) {
  const Identity id{Pair::box, "near-parallel-1e-6", 42, 137};
  EXPECT_EQ(to_string(id), "cylinder-box/near-parallel-1e-6/42/137");
  EXPECT_EQ(parse_identity(to_string(id)), id);
  const Identity largest{Pair::sphere, "rim", ~std::uint64_t{0}, ~std::uint64_t{0}};
  EXPECT_EQ(parse_identity(to_string(largest)), largest);
}

TEST(Identity, RefusesWhatItIsNotAndNamesThePart) {
  const struct {
    const char* text;
    const char* field;
    const char* remedy;
  } table[] = {
      {"", "identity", "pair/class/seed/index"},
      {"cylinder-box", "identity", "pair/class/seed/index"},
      {"cylinder-box/rim-face/1", "identity", "pair/class/seed/index"},
      {"cylinder-cone/rim-face/1/2", "identity.pair", "cylinder-sphere"},
      {"cylinder-sphere/rim-face/1/2", "identity.class", "general-deep"},
      {"cylinder-box/rim-face/-1/2", "identity.seed", "whole number"},
      {"cylinder-box/rim-face/1/2x", "identity.index", "whole number"},
      {"cylinder-box/rim-face/1/2/3", "identity.index", "whole number"},
      {"cylinder-box/rim-face/1/", "identity.index", "whole number"},
      {"cylinder-box/rim-face/1/99999999999999999999", "identity.index", "whole number"},
  };
  for (const auto& row : table) {
    SCOPED_TRACE(row.text);
    try {
      parse_identity(row.text);
      ADD_FAILURE() << "accepted";
    } catch (const InvalidInput& e) {
      EXPECT_EQ(e.field(), row.field);
      EXPECT_THAT(e.remedy(), HasSubstr(row.remedy));
    }
  }
}

TEST(Identity, RebuildsTheSameBitsInAnyOrder) {
  for (const auto& [pair, name] : every_class()) {
    const Configuration first = make_configuration({pair, name, 7, 3});
    make_configuration({pair, name, 7, 2});
    EXPECT_TRUE(same_bits(first, make_configuration({pair, name, 7, 3}))) << name;
    EXPECT_FALSE(same_bits(first, make_configuration({pair, name, 7, 4}))) << name;
    EXPECT_FALSE(same_bits(first, make_configuration({pair, name, 8, 3}))) << name;
  }
}

// A changed generator breaks every identity that anybody has noted down: change these on purpose
// only.
TEST(Identity, KeepsItsBitsFromVersionToVersion) {
  const struct {
    const char* identity;
    double radius_a, x_a, w_b;
  } golden[] = {
      {"cylinder-plane/general-shallow/1/0", 0x1.d4242dc64ffd7p-3, -0x1.3acaf66fc3ab8p-2,
       -0x1.c91671e21c794p-1},
      {"cylinder-sphere/rim/1/0", 0x1.382f5fdde1268p-1, -0x1.d6fef345787f2p-1,
       -0x1.65dc18a27cdccp-4},
      {"cylinder-capsule/perpendicular-x/1/0", 0x1.13067848p-2, 0x1.59bc4298p-2, -0x1p+1},
      {"cylinder-cylinder/near-parallel-1e-9/42/137", 0x1.7e76b9f974136p-1, -0x1.633bb018ecee2p+0,
       0x1.5612aeaff413ap-2},
      {"cylinder-cylinder/touching/1/5", 0x1.62edf97p-2, -0x1.1d6942b8p-1, 0x1p+0},
      {"cylinder-box/edge-rim/1/0", 0x1.8149d1a60dd27p-2, 0x1.56519ac60d2c9p-1,
       -0x1.2fe19c94a776bp-3},
      {"cylinder-box/far-from-origin/18446744073709551615/3", 0x1.a0cc32c3e7597p-1,
       -0x1.495999d5f681bp+19, 0x1.9610103c3090fp-1},
  };
  for (const auto& row : golden) {
    const Configuration c = make_configuration(parse_identity(row.identity));
    EXPECT_EQ(c.a.radius(), row.radius_a) << row.identity << std::hexfloat << c.a.radius();
    EXPECT_EQ(c.pose_a.position().x(), row.x_a)
        << row.identity << std::hexfloat << c.pose_a.position().x();
    EXPECT_EQ(c.pose_b.orientation().w(), row.w_b)
        << row.identity << std::hexfloat << c.pose_b.orientation().w();
  }
}

TEST(PoseClasses, AreNamedOnceAndDescribedInASentence) {
  for (const Pair pair : all_pairs) {
    std::set<std::string> names;
    for (const auto& name : pose_classes(pair)) {
      EXPECT_TRUE(names.insert(name).second) << name;
      const auto text = describe_pose_class(pair, name);
      EXPECT_GT(text.size(), 20u);
      EXPECT_EQ(text.back(), '.') << name;
    }
  }
  EXPECT_GE(every_class().size(), 150u);
}

TEST(PoseClasses, MakeOnlyFiniteNumbers) {
  for (const auto& [pair, name] : every_class()) {
    for (std::uint64_t i = 0; i < 100; ++i) {
      const Configuration c = make_configuration({pair, name, 1, i});
      ASSERT_EQ(pair_of(c), pair);
      for (const double x : numbers(c)) ASSERT_TRUE(std::isfinite(x)) << name << " " << i;
    }
  }
}

// What a class promises, judged by the oracle.

constexpr std::uint64_t samples = 25;

TEST(PoseClasses, TouchingIsZeroToTheLastBit) {
  for (const Pair pair : all_pairs) {
    for (std::uint64_t i = 0; i < samples; ++i) {
      const Identity id{pair, "touching", 1, i};
      const auto t = oracle::truth(make_configuration(id), 1e-40);
      EXPECT_LE(t.signed_distance.lo, 0) << to_string(id);
      EXPECT_GE(t.signed_distance.hi, 0) << to_string(id);
    }
  }
}

TEST(PoseClasses, SeparatedIsApartByTheClearanceThatWasDrawn) {
  for (const Pair pair : all_pairs) {
    for (std::uint64_t i = 0; i < samples; ++i) {
      const Identity id{pair, "general-separated", 1, i};
      const Configuration c = make_configuration(id);
      const double relative = oracle::truth(c).signed_distance.midpoint() / smaller_size(c);
      EXPECT_GT(relative, 0.99e-6) << to_string(id);
      EXPECT_LT(relative, 1.01) << to_string(id);
    }
  }
}

TEST(PoseClasses, ShallowOverlapsByAtMostFivePercent) {
  for (const Pair pair : all_pairs) {
    for (std::uint64_t i = 0; i < samples; ++i) {
      const Identity id{pair, "general-shallow", 1, i};
      const Configuration c = make_configuration(id);
      const double relative = oracle::truth(c).signed_distance.midpoint() / smaller_size(c);
      EXPECT_LT(relative, 0) << to_string(id);
      EXPECT_GT(relative, -0.0501) << to_string(id);
    }
  }
}

TEST(PoseClasses, DeepOverlaps) {
  for (const Pair pair : all_pairs) {
    for (std::uint64_t i = 0; i < samples; ++i) {
      const Identity id{pair, "general-deep", 1, i};
      EXPECT_LT(oracle::truth(make_configuration(id)).signed_distance.hi, 0) << to_string(id);
    }
  }
}

/// R(q) z times |q|², exactly.
std::array<mpq_class, 3> exact_axis(const Pose& pose) {
  const auto& q = pose.orientation();
  const mpq_class w(q.w()), x(q.x()), y(q.y()), z(q.z());
  return {2 * (x * z + w * y), 2 * (y * z - w * x), w * w - x * x - y * y + z * z};
}

bool exactly_parallel(const Configuration& c) {
  const auto a = exact_axis(c.pose_a), b = exact_axis(c.pose_b);
  return a[1] * b[2] == a[2] * b[1] && a[2] * b[0] == a[0] * b[2] && a[0] * b[1] == a[1] * b[0];
}

bool exactly_perpendicular(const Configuration& c) {
  const auto a = exact_axis(c.pose_a), b = exact_axis(c.pose_b);
  return mpq_class(a[0] * b[0] + a[1] * b[1] + a[2] * b[2]) == 0;
}

TEST(PoseClasses, ParallelIsExact) {
  for (const Pair pair : {Pair::capsule, Pair::cylinder, Pair::box}) {
    for (const char* name : {"parallel-side", "coaxial", "concentric-aligned"}) {
      for (std::uint64_t i = 0; i < samples; ++i) {
        EXPECT_TRUE(exactly_parallel(make_configuration({pair, name, 1, i}))) << name << i;
      }
    }
  }
}

TEST(PoseClasses, PerpendicularIsExact) {
  for (const Pair pair : {Pair::capsule, Pair::cylinder}) {
    for (const char* name : {"perpendicular-t", "perpendicular-x", "cap-on-side"}) {
      for (std::uint64_t i = 0; i < samples; ++i) {
        EXPECT_TRUE(exactly_perpendicular(make_configuration({pair, name, 1, i}))) << name << i;
      }
    }
  }
}

TEST(PoseClasses, StandingAndLyingTieTheirPointsExactly) {
  for (std::uint64_t i = 0; i < samples; ++i) {
    EXPECT_TRUE(exactly_parallel(make_configuration({Pair::plane, "standing", 1, i})));
    EXPECT_TRUE(exactly_perpendicular(make_configuration({Pair::plane, "lying", 1, i})));
  }
}

/// Sine and cosine of the angle between the axes, each without cancellation.
struct AxisAngle {
  double sine, cosine;
};
AxisAngle axis_angle(const Configuration& c) {
  const auto a = exact_axis(c.pose_a), b = exact_axis(c.pose_b);
  const auto squared = [](const mpq_class& x, const mpq_class& y, const mpq_class& z) {
    return mpq_class(x * x + y * y + z * z);
  };
  const mpq_class lengths = squared(a[0], a[1], a[2]) * squared(b[0], b[1], b[2]);
  const mpq_class cosine = a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
  const mpq_class sine_squared =
      squared(a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]) /
      lengths;
  const mpq_class cosine_squared = cosine * cosine / lengths;
  return {std::sqrt(sine_squared.get_d()), std::sqrt(cosine_squared.get_d())};
}

TEST(PoseClasses, TiltsAreWhatTheirNamesSay) {
  for (const Pair pair : {Pair::capsule, Pair::cylinder, Pair::box}) {
    for (int k = 1; k <= 14; ++k) {
      const double tilt = std::pow(10, -k);
      for (std::uint64_t i = 0; i < 5; ++i) {
        const std::string digits = "1e-" + std::to_string(k);
        const double parallel =
            axis_angle(make_configuration({pair, "near-parallel-" + digits, 1, i})).sine;
        // Rounding of unit quaternions adds a few 1e-16.
        EXPECT_NEAR(parallel, tilt, 0.1 * tilt) << digits;
        // The tilt's part towards B's axis.
        const double perpendicular =
            axis_angle(make_configuration({pair, "near-perpendicular-" + digits, 1, i})).cosine;
        EXPECT_LE(perpendicular, 1.1 * tilt + 1e-15) << digits;
        EXPECT_GT(perpendicular, 0) << digits;
      }
    }
  }
}

TEST(PoseClasses, ExtremeAspectIsOneToAThousand) {
  for (std::uint64_t i = 0; i < samples; ++i) {
    const Cylinder needle = make_configuration({Pair::box, "aspect-needle", 1, i}).a;
    EXPECT_NEAR(needle.half_length() / needle.radius(), 1000, 1e-9);
    const Cylinder coin = make_configuration({Pair::box, "aspect-coin", 1, i}).a;
    EXPECT_NEAR(coin.radius() / coin.half_length(), 1000, 1e-9);
  }
}

RC_GTEST_PROP(Arbitrary, GeneratorsWorkInsideRapidcheck, ()) {
  const auto pair = *rc::gen::element(Pair::capsule, Pair::cylinder, Pair::box);
  const Configuration c = *configurations(pair, "general-shallow");
  RC_ASSERT(pair_of(c) == pair);
  RC_ASSERT(smaller_size(c) > 0);
}

}  // namespace
}  // namespace touchstone
