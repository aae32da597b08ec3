// What every contact promises of its points, whatever the pose and the threshold: one as deep as
// the bodies, none deeper, none beyond the threshold, each halfway between the surfaces.
//
// TOUCHSTONE_COUNT sets how many configurations of each pose class are tried; by default 400.
#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <gtest/gtest.h>
#include <limits>
#include <random>
#include <string>

#include "properties/identity.hpp"
#include "reference/contact_of.hpp"
#include "reference/points_on_both.hpp"

namespace touchstone {
namespace {

std::uint64_t contacts_per_class() {
  const char* text = std::getenv("TOUCHSTONE_COUNT");
  return text ? std::strtoull(text, nullptr, 10) : 100;
}

/// What rounding is relative to: the larger size, or a longer distance.
double rounding_length(const Configuration& c) {
  const auto* plane = std::get_if<Plane>(&c.b);
  return std::max({larger_size(c), plane ? std::abs(plane->unit_displacement()) : 0.0,
                   (c.pose_a.position() - c.pose_b.position()).norm()});
}

/// One point is as deep as the bodies, none deeper and none beyond the threshold.
void expect_depths(const Configuration& c, const Contact& answer, double threshold) {
  const double rounding = 1e-13 * rounding_length(c), depth = -answer.signed_distance;
  double deepest = -std::numeric_limits<double>::infinity();
  for (const ContactPoint& p : answer.points()) {
    deepest = std::max(deepest, p.depth);
    EXPECT_GE(p.depth, -threshold - rounding);
  }
  // Three points of a body at rest do not see which way it leans by less than a millionth.
  EXPECT_GE(deepest, depth - std::max(1e-6 * smaller_size(c), rounding));
  EXPECT_LE(deepest, depth + rounding);
}

/// `aside` is how far off their surfaces points may lie, next to what round bodies do.
void expect_contract(const Configuration& c, double threshold, double aside,
                     PointRange range = PointRange::near_deepest) {
  const Contact answer = contact(c, threshold, nullptr, range);
  ASSERT_EQ(answer.points().empty(), answer.signed_distance > threshold);
  if (answer.points().empty()) return;
  expect_depths(c, answer, threshold);
  // As in points_on_both.hpp, of the room that the threshold leaves. Balls of a capsule that leans
  // lie below its surface.
  const double size = larger_size(c);
  const double room = std::min(1e-3 * size, threshold - answer.signed_distance);
  const double slant = std::holds_alternative<Capsule>(c.b) ? 5e-5 * size : 50 * room * room / size;
  for (const ContactPoint& p : answer.points()) {
    EXPECT_NEAR(outside(c.a, c.pose_a, p.position - p.depth / 2 * answer.normal), 0, aside + slant);
    EXPECT_NEAR(outside(c.b, c.pose_b, p.position + p.depth / 2 * answer.normal), 0, aside + slant);
  }
}

class PointContract : public testing::TestWithParam<Pair> {};

TEST_P(PointContract, HoldsInEveryPoseClassAtEveryThreshold) {
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> uniform(0, 1);
  for (const auto& name : pose_classes(GetParam())) {
    for (std::uint64_t i = 0; i < contacts_per_class(); ++i) {
      const Identity id{GetParam(), name, 13, i};
      const Configuration c = make_configuration(id);
      const double distance = signed_distance(c).value, size = smaller_size(c);
      const auto hair = [&] { return size * std::pow(10, -17 * uniform(random)); };
      const double sign = uniform(random) < 0.5 ? -1 : 1;
      SCOPED_TRACE(to_string(id));
      for (const double threshold :
           {0.0, 1e-6 * size, distance, distance / 2, distance + hair(), sign * hair()}) {
        SCOPED_TRACE(threshold);
        const double aside = name.find("+tilted") != name.npos ? 1e-6 : 3e-8;
        expect_contract(c, threshold, aside * larger_size(c) + position_rounding(c));
        if (HasFatalFailure()) return;
      }
    }
  }
}

// Along a previous normal that only ties, features need not reach each other: points then lie on
// the bodies to within the threshold, or the bodies part along their best normal.
TEST_P(PointContract, HoldsWithAnyPreviousNormalToWithinTheThreshold) {
  std::mt19937_64 random(2);
  std::uniform_real_distribution<double> uniform(-1, 1);
  for (const auto& name : pose_classes(GetParam())) {
    const double aside = name.find("+tilted") != name.npos ? 1e-6 : 3e-8;
    for (std::uint64_t i = 0; i < contacts_per_class(); ++i) {
      const Identity id{GetParam(), name, 15, i};
      const Configuration c = make_configuration(id);
      const SignedDistance plain = signed_distance(c);
      const double distance = plain.value, size = smaller_size(c);
      SCOPED_TRACE(to_string(id));
      const Vec3 any(uniform(random), uniform(random), uniform(random));
      for (const Vec3& previous : {any, Vec3(-plain.normal)}) {
        for (const double threshold :
             {0.0, 5e-5 * size, distance + 1e-3 * size, distance + size, 10 * larger_size(c)}) {
          SCOPED_TRACE(threshold);
          const Contact answer = contact(c, threshold, &previous);
          if (answer.points().empty()) continue;
          expect_depths(c, answer, threshold);
          const double off =
              (aside + 5e-5) * larger_size(c) + position_rounding(c) + std::max(0.0, threshold);
          for (const ContactPoint& p : answer.points()) {
            const Vec3 half = p.depth / 2 * answer.normal;
            EXPECT_LE(outside(c.a, c.pose_a, p.position - half), off);
            EXPECT_LE(outside(c.b, c.pose_b, p.position + half), off);
          }
          if (HasFailure()) return;
        }
      }
    }
  }
}

// Where rims are tangent, a cap and a side that each face the other count as flat, but meet at one
// place alone.
TEST(PointContractOfTheHostile, TangentRimsHaveNoDeeperPoint) {
  const Configuration c{
      Cylinder(0x1.30e3518754be1p-1, 0x1.3431fef0ed584p-3),
      Pose({0x0p+0, 0x1.d18562f25db32p-2, 0x1.a6ec00f8b877fp-2},
           {0x1.5f3aa673fa911p-1, 0x1.5f3aa673fa91p-3, -0x1.5f3aa673fa91p-3, 0x1.5f3aa673fa91p-1}),
      Cylinder(0x1.717cf2577383cp-6, 0x1.e1b4f0c9faabbp-3),
      Pose({0x0p+0, 0x1.99febd7ba6ee4p-4, -0x1.b6599030c91c8p-3},
           {0x1.edec7bc3942cfp-1, 0x1.0db0e8c614a9ap-2, 0x0p+0, 0x0p+0})};
  for (const double threshold : {0.0, 1e-6, 1e-3, 0.1, 600.0}) {
    SCOPED_TRACE(threshold);
    expect_contract(c, threshold, 1e-6 * larger_size(c));
  }
}

// The corner of a plate's face, which leans, is on the cap's rim but for rounding.
TEST(PointsWhereACornerTouchesARim, LieOnBothBodies) {
  const Configuration c = make_configuration(
      parse_identity("cylinder-box/vertex-rim+touching+plate+not-quite-unit/13/2486"));
  expect_contract(c, 1e-6 * smaller_size(c), 3e-8 * larger_size(c));
}

// The cap of a needle that leans by 0.09 over a larger cap's rim is seen from it as an ellipse, of
// which the circle within does not reach as far as the rims do.
TEST(PointsWhereRimsTouch, LieOnBothBodies) {
  for (const char* identity : {"cylinder-cylinder/general+needle/21/800",
                               "cylinder-cylinder/rim-rim+shallow+needle+huge/21/22207"}) {
    SCOPED_TRACE(identity);
    const Configuration c = make_configuration(parse_identity(identity));
    expect_contract(c, 0, 3e-8 * larger_size(c));
  }
}

// A side that crosses an edge next to which a face leans by less than would be seen, but by more
// than the overlap leaves: the bodies are deepest where side and edge cross, and nowhere else.
TEST(PointsWhereASideCrossesAnEdge, LieOnBothBodies) {
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> uniform(-1, 1);
  const auto between = [&](double lo, double hi) {
    return lo * std::pow(hi / lo, (1 + uniform(random)) / 2);
  };
  for (int i = 0; i < 100000; ++i) {
    const Cylinder a(between(1e-4, 0.3), between(0.3, 1));
    const Box b({between(0.3, 1), between(1e-4, 0.3), between(1e-4, 0.3)});
    const double lean = between(1e-7, 1e-3), turn = between(1e-6, 0.1);
    const Quaternion crossing = Quaternion(1, lean, turn, uniform(random)).normalized();
    Vec3 place(uniform(random), uniform(random) / 10, 1);
    const auto posed = [&] {
      return Configuration{a, Pose(place, crossing * along_y.normalized()), b, Pose()};
    };
    const double depth = between(1e-9, 1e-5);
    for (int k = 0; k < 3; ++k) place.z() -= signed_distance(posed()).value + depth;
    SCOPED_TRACE(i);
    expect_contract(posed(), 0, 3e-8 * larger_size(posed()));
    if (HasFailure()) return;
  }
}

// For engines: features that lean by up to 0.1 have all their points, off round surfaces by half
// its square.
TEST_P(PointContract, LiesOnBothBodiesInEveryPoseClass) {
  for (const auto& name : pose_classes(GetParam())) {
    for (std::uint64_t i = 0; i < 10; ++i) {
      const Identity id{GetParam(), name, 11, i};
      const Configuration c = make_configuration(id);
      const Contact answer = contact(c, 0);
      SCOPED_TRACE(to_string(id));
      ASSERT_EQ(answer.points().empty(), answer.signed_distance > 0);
      // Where rims meet at a small tilt, rounding of the normal over the tilt says where on the
      // rim.
      const double aside = name.find("+tilted") != name.npos ? 1e-6 : 3e-8;
      expect_points_on_both(c, answer, aside * larger_size(c) + position_rounding(c));
    }
  }
}

TEST_P(PointContract, HoldsOfAllPointsWithinTheThreshold) {
  constexpr double leans_most = 0.1;
  for (const auto& name : pose_classes(GetParam())) {
    for (std::uint64_t i = 0; i < contacts_per_class(); ++i) {
      const Identity id{GetParam(), name, 14, i};
      const Configuration c = make_configuration(id);
      const double distance = signed_distance(c).value, size = smaller_size(c);
      SCOPED_TRACE(to_string(id));
      for (const double threshold : {0.0, 0.02 * size, distance + 0.1 * size}) {
        SCOPED_TRACE(threshold);
        expect_contract(c, threshold, leans_most * leans_most / 2 * larger_size(c),
                        PointRange::within_threshold);
        if (HasFatalFailure()) return;
      }
    }
  }
}

TEST(PointsWithinTheThreshold, HoldARockingCoinAtBothEdges) {
  // Its lower edge is 12 mm in the floor, its upper one, 2 × 0.1 m × 0.04 higher, 4 mm.
  const Quaternion leaning(Eigen::AngleAxisd(0.04, Vec3::UnitX()));
  const double lowest = 0.1 * std::sin(0.04) + 0.01 * std::cos(0.04);
  const Configuration on_box{Cylinder(0.1, 0.01), Pose({0, 0, lowest - 0.012}, leaning),
                             Box({1, 1, 1}), Pose(Vec3(0, 0, -1))};
  const Configuration on_plane{on_box.a, on_box.pose_a, Plane(Vec3::UnitZ(), 0), Pose()};
  for (const Configuration& c : {on_box, on_plane}) {
    EXPECT_EQ(contact(c, 0).points().size(), 1u);
    double lower = 0, upper = 0;
    const Contact all = contact(c, 0, nullptr, PointRange::within_threshold);
    for (const ContactPoint& p : all.points()) {
      lower = std::min(lower, p.position.y()), upper = std::max(upper, p.position.y());
    }
    EXPECT_NEAR(lower, -0.1, 1e-3);
    EXPECT_GT(upper, 0.04);
  }
}

INSTANTIATE_TEST_SUITE_P(, PointContract, testing::ValuesIn(all_pairs), [](const auto& pair) {
  return std::string(pair_name(pair.param)).substr(std::string("cylinder-").size());
});

// Configurations that generators of another make found to break it.
TEST(PointContractOfTheHostile, HoldsAtEveryThreshold) {
  const struct {
    const char* name;
    Configuration configuration;
  } table[] = {
      {"two sides that cross by a hair, deepest between their points",
       {Cylinder(0x1p-2, 0x1.4p+2),
        Pose({0x1.1745d1745d174p-2, -0x1.ac37dac37dac4p-2, 0x1.bed61bed61bfp-6},
             {0x1.041c6a547a96ep+1, -0x1.78c73ac4b8bf4p+1, -0x1.1fa452869f12cp-7,
              -0x1.847b2902f586dp+1}),
        Capsule(0x1p-2, 0x1.4p+2), Pose({0, 0, 0}, {0x1p+1, -0x1.8p+1, 0, -0x1.8p+1})}},
      {"nearly parallel sides of a thin cylinder and a capsule",
       {Cylinder(0x1.0070515e42d8fp-3, 0x1p+0),
        Pose({-0x1.13c64bfba5dc6p-1, -0x1.157196601acd1p-1, -0x1.4a5444e32b812p-1},
             {0x1.5a3bce7786fc7p-3, 0x1.7e6911203c28ep-1, 0x1.fe621f570fb4ap-1,
              -0x1.8b5c01787ec9cp-1}),
        Capsule(0x1.0000000000001p+0, 0x1.7c0fe7f7e96a9p-1),
        Pose({-0x1.13c64bfb65d5ep-1, -0x1.1571965fbbb4fp-1, -0x1.4a5444e32fbf7p-1},
             {0x1.191c2ae513dc8p-3, 0x1.81610f785fa0dp-1, 0x1.eccd2099499p-1,
              -0x1.a02dbda644ebap-1})}},
      {"a coin that leans by less than a millionth of its radius on a plane",
       {Cylinder(0x1.0000000000001p+0, 0x1.57f034d85e31ep-17),
        Pose({0x1.a90241aff478fp-1, 0x1.1d4b238e78a8p+1, -0x1.1a5b2ce68e9dfp+0},
             {-0x1.b746fe0c66244p-1, 0x1.be1c9e0ede663p+1, 0x1.eac50d954218ap-1,
              -0x1.0917aad28ddadp+1}),
        Plane({0x0p+0, -0x1p+0, 0x0p+0}, 0x0p+0),
        Pose({0x0p+0, 0x0.0000000000002p-1022, 0x1.13ef98aed9ca7p-769},
             {0x1p+1, 0x1.8p+1, 0x1p+1, -0x1p+0})}},
      {"rims of coins",
       {Cylinder(0x1.b13659066461p-2, 0x1.75fd0fe9ef57dp-27),
        Pose({-0x1.2da5fe2b88b1cp-3, -0x1.29235e2e8a34dp-6, 0x1.aab725a430b04p-2},
             {0x1.000000c5ff6bp+0, -0x1.95160edf7a7e9p-23, 0x1.6a09e437ee11dp-1,
              -0x1.27bc4f7287733p-24}),
        Cylinder(0x1.1374fcc2a9c82p-2, 0x1.48078c6e5eb72p-15),
        Pose({0x0p+0, 0x0p+0, 0x0p+0}, {0x1p+0, 0x0p+0, 0x1.6a09e667f3bcdp-1, 0x0p+0})}},
      {"a rim that touches a cap's",
       {Cylinder(0x1p+0, 0x1.6d5864517da23p-1),
        Pose({-0x1.85283beb6fc5fp+0, 0x1.49e7bf9270e66p-1, -0x1.d73d4e4c6abd5p-1},
             {0x1p+0, -0x1p+0, 0x0p+0, 0x0p+0}),
        Cylinder(0x1.6e643f5563ac4p-1, 0x1.f80f809019b94p-4),
        Pose({-0x1.3fa5967298415p-2, 0x1.e65f39729d6bbp-1, -0x1.a29d9fb97cd21p-7},
             {0x1p+0, -0x0.0000000000001p-1022, 0x0p+0, 0x0p+0})}},
      {"a leaning cap over a leaning face",
       {Cylinder(0x1.a710ecf48d4cdp-1, 0x1.a710ecf48d4cdp+0),
        Pose({0x1.e38c50bd1f2e2p-2, 0x1.1055cefb31e43p+0, 0x1.3ea437fac3eb3p+0},
             {0x1.70b2d4ff2f4fcp+0, 0x1.861830d01b63bp+1, 0x1.542f51e868373p-1,
              0x1.b3db8060021ebp+1}),
        Box({0x1.a710ecf48d4ccp+0, 0x1p-2, 0x1.57d452867df2ap-2}),
        Pose({0x0p+0, 0x0p+0, 0x0p+0}, {0x1p+1, 0x1.8p+1, 0x1p+0, 0x1.8p+1})}},
      {"a side along an edge of a leaning face",
       {Cylinder(0x1.fffffffffffffp-1, 0x1.fffffffffffffp-1),
        Pose({0x1.218e0b6d7df6dp+0, -0x1.5e9050b5d9498p+1, -0x1.c0eb00d035ed9p+0},
             {0x1.000f2ef8889acp+0, -0x1.001e5df065aadp+0, 0x1.ffe1a20f1a376p-1,
              -0x1.fff0d107c21e9p+0}),
        Box({0x1.72e94afc24648p-2, 0x1.8p+1, 0x1p-1}),
        Pose({0x0p+0, 0x0p+0, 0x0p+0}, {0x1p+0, -0x1p+0, 0x1p+0, -0x1p+1})}},
      {"a cap whose rim meets a face's corner",
       {Cylinder(0x1p+0, 0x1.cp-1),
        Pose({-0x1.899abd4beb498p-4, 0x1.c09a7625ee09ap+0, 0x1.228b4a537cebdp+0},
             {0x1.2d1422771731dp+229, 0x1.19ec8f1d30ef5p+232, -0x1.c9a6236865fddp+232,
              0x1.fdee8a09eafc3p+231}),
        Box({0x1.c000000000001p-1, 0x1p+0, 0x1p+1}),
        Pose({0x1.6e626b15e2c38p-1, -0x1.292f48dfec8dcp-1, -0x1.8deedfa69d37dp-2},
             {-0x1.18594e7fc0774p-3, 0x1.33b6c859e0298p-4, -0x1.cc11780dfabd8p-1,
              0x1.a3f33317d419bp-2})}},
      {"a side along the edge of a leaning face, but for rounding",
       {Cylinder(0x1p+1, 0x1.fffffffffffffp+0),
        Pose({0x1.429780dc14b58p+2, 0x1.8p+1, -0x1.9f352f56ab797p+0},
             {0x1.0000000000001p+0, -0x1.251c5ba441a9fp-10, 0x1.d81ede4403a8bp-10,
              -0x1.3dde95452d9e6p-1}),
        Box({0x1p+2, 0x1p+2, 0x1.0c6d11450579ap-1}),
        Pose({0x1p+0, -0x1p+0, -0x1p+1}, {0x1.0000000000002p+0, 0x0p+0, 0x0p+0, 0x0p+0})}},
      {"a cap that another holds but for a hair",
       {Cylinder(0x1.45fdd5c60a206p-1, 0x1p+1),
        Pose({0x1.82d27ffbba365p+1, 0x1.02e972aad0b49p+1, -0x1.e0755c65d5675p+1},
             {0x1.a6d436aa6aaecp-2, -0x1.e95ece9616af4p-2, -0x1.a2299a298f923p-2,
              0x1.516f4297e4f12p-1}),
        Cylinder(0x1p+2, 0x1p+1),
        Pose({0x1.0ff171e79a2cp-1021, 0x0p+0, 0x0p+0},
             {0x1.a6dbf4c8f9f09p-2, -0x1.e96b4d945abd2p-2, -0x1.a221c5a239728p-2,
              0x1.516aba916d6a9p-1})}},
  };
  for (const auto& row : table) {
    SCOPED_TRACE(row.name);
    const Configuration& c = row.configuration;
    const double distance = signed_distance(c).value;
    for (const double part : {0.0, 0.5, 1 - 1e-6, 1 - 1e-12, 1.0}) {
      SCOPED_TRACE(part);
      expect_contract(c, part * distance, 1e-6 * larger_size(c));
    }
    for (const double threshold : {1e-6, 0.1}) {
      SCOPED_TRACE(threshold);
      expect_contract(c, threshold * smaller_size(c), 1e-6 * larger_size(c));
    }
  }
}

// Beside the ends that keep a body from turning there is the place where the bodies are deepest.
TEST(PointContractOfTheHostile, SidesThatCrossByAHairHaveThreePoints) {
  const Eigen::Quaterniond along_x(1, 0, 1, 0), turned(Eigen::AngleAxisd(0.01, Vec3::UnitZ()));
  const Configuration c{Cylinder(1, 2), Pose({0, 0, 1.999}, turned * along_x), Cylinder(1, 2),
                        Pose({0, 0, 0}, along_x)};
  const Contact answer = contact(c, 0);
  ASSERT_EQ(answer.points().size(), 3u);
  EXPECT_NEAR(answer.points()[2].depth, 0.001, 1e-15);
  EXPECT_NEAR(answer.points()[2].position.x(), 0, 1e-9);
  for (const int end : {0, 1}) {
    // The lines' ends are 2 · 0.01 apart, which takes y²/2R of R = 2.
    EXPECT_NEAR(answer.points()[end].depth, 0.001 - 0.02 * 0.02 / 4, 1e-8);
    EXPECT_NEAR(std::abs(answer.points()[end].position.x()), 2, 1e-3);
  }
}

TEST(PreviousNormal, MayHaveAnyLengthAndMayBeNone) {
  const Configuration c{Cylinder(1, 1), Pose({0.1, 0, 1.9}, Eigen::Quaterniond(1, 0, 0, 0)),
                        Cylinder(1, 1), Pose()};
  const double infinity = std::numeric_limits<double>::infinity();
  const Vec3 oblique(0.48, 0.36, 0.8);
  for (const double length : {0.0, 1e-300, 0.9, 1.1, 1e300, infinity}) {
    const Vec3 previous = length * oblique;
    const Contact answer = contact(c, 10, &previous);
    EXPECT_NEAR(answer.normal.norm(), 1, 4e-15) << length;
    EXPECT_FALSE(answer.points().empty()) << length;
  }
}

}  // namespace
}  // namespace touchstone
