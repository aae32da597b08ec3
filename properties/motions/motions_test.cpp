#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "oracle/patch/contact_patch.hpp"
#include "oracle/truth.hpp"
#include "properties/arbitrary.hpp"
#include "properties/motions/motion.hpp"
#include "reference/error_of_test.hpp"
#include "reference/invalid_input.hpp"

namespace touchstone {
namespace {

using testing::HasSubstr;

const Cylinder can(0.3, 0.4);  // circumradius 0.5
Configuration at(const Vec3& position, const Eigen::Quaterniond& q) {
  return {can, Pose(position, q), Sphere(0.2), Pose()};
}
const Eigen::Quaterniond straight(1, 0, 0, 0);

TEST(LargestDisplacement, IsTheLengthOfATranslation) {
  EXPECT_DOUBLE_EQ(largest_displacement(at({1, 2, 3}, straight), at({1.3, 2.4, 3}, straight)), 0.5);
}

TEST(LargestDisplacement, IsTheChordOfTheCircumradiusInARotation) {
  // A right angle: the chord is sqrt 2 circumradii, whatever the quaternions' lengths.
  const Eigen::Quaterniond quarter(3, 3, 0, 0);
  EXPECT_NEAR(largest_displacement(at({0, 0, 0}, straight), at({0, 0, 0}, quarter)),
              std::sqrt(2.0) * 0.5, 1e-15);
}

TEST(LargestDisplacement, KeepsItsDigitsForATinyRotation) {
  const Eigen::Quaterniond turned(0.6, 0.8, 0, 0), tiny(0.6, 0.8, 1e-100, 0);
  EXPECT_NEAR(largest_displacement(at({0, 0, 0}, turned), at({0, 0, 0}, tiny)) / 1e-100, 1, 1e-12);
}

TEST(Perturbation, MovesOrTurnsByItsAmplitude) {
  const Configuration c = at({0.5, -0.25, 0.125}, Eigen::Quaterniond(1, 2, 0, -1));
  for (int exponent = -14; exponent <= Decade::max; ++exponent) {
    const Decade amplitude(exponent);
    const double a = amplitude.value(), rounding = 4e-16 / a;
    for (std::uint64_t number = 0; number < 12; ++number) {
      const Configuration to = perturbed(c, {amplitude, 7, number});
      const double moves = (to.pose_a.position() - c.pose_a.position()).norm() / (0.2 * a);
      Configuration turned = to;
      turned.pose_a = Pose(c.pose_a.position(), to.pose_a.orientation());
      const double turns = largest_displacement(c, turned) / (0.5 * a);
      EXPECT_NEAR(moves, number % 3 == 1 ? 0 : 1, 5 * rounding) << a << ' ' << number;
      // 2 sin(θ/2) of θ = 2 arctan(a/2) is a to second order.
      EXPECT_NEAR(turns, number % 3 == 0 ? 0 : 1, a * a + rounding) << a << ' ' << number;
    }
  }
}

TEST(Perturbation, GoesAnotherWayForEveryNumberSeedAndAmplitude) {
  const Configuration c = at({0, 0, 0}, straight);
  const auto shown = [&](const Perturbation& p) { return rc::toString(perturbed(c, p)); };
  const std::string first = shown({Decade(-3), 1, 0});
  EXPECT_EQ(first, shown({Decade(-3), 1, 0}));
  EXPECT_NE(first, shown({Decade(-3), 2, 0}));
  EXPECT_NE(first, shown({Decade(-3), 1, 3}));
  const Vec3 p = perturbed(c, {Decade(-3), 1, 0}).pose_a.position().normalized();
  EXPECT_LT(p.dot(perturbed(c, {Decade(-4), 1, 0}).pose_a.position().normalized()), 0.999);
}

// A changed step breaks every name with an @ that has been written down. The rows: a translation, a
// rotation by a unit in the last place, both.
TEST(Perturbation, KeepsItsBitsFromVersionToVersion) {
  const struct {
    const char* perturbation;
    const char* pose;
  } golden[] = {{"1e-8/1/0",
                 "position (-0x1.1217ab1d1cfa4p-1, -0x1.bc085ef93110bp-1, -0x1.ca64626f7f4ccp-4) "
                 "orientation (-0x1.8p+1, -0x1p+0, -0x1p+0, 0x1.8p+1)"},
                {"1e-16/1/4",
                 "position (-0x1.1217ab2p-1, -0x1.bc085fp-1, -0x1.ca6463p-4) orientation "
                 "(-0x1.8p+1, -0x1p+0, -0x1.ffffffffffffep-1, 0x1.8p+1)"},
                {"1e-2/7/5",
                 "position (-0x1.12d5cfc4a7fcbp-1, -0x1.bce8919491472p-1, -0x1.cbe244cdd979ep-4) "
                 "orientation (-0x1.814c045063111p+1, -0x1.f8e78b32c881p-1, -0x1.02d0ee2ea2a06p+0, "
                 "0x1.7ed3330e46743p+1)"}};
  const Configuration c = make_configuration(parse_identity("cylinder-box/side-on-face/1/4"));
  for (const auto& row : golden) {
    EXPECT_THAT(rc::toString(perturbed(c, parse_perturbation(row.perturbation))),
                HasSubstr(row.pose))
        << row.perturbation;
  }
}

TEST(Perturbation, PrintsAndParsesBack) {
  const Perturbation p = parse_perturbation("1e-8/3/18446744073709551615");
  EXPECT_EQ(p.amplitude.value(), 1e-8);
  EXPECT_EQ(to_string(p), "1e-8/3/18446744073709551615");
}

TEST(Perturbation, RefusesWhatItIsNotAndNamesThePart) {
  expect_refusals({{"", "perturbation", "1e-8/1/4"},
                   {"1e-8/1", "perturbation", "1e-8/1/4"},
                   {"1e-17/1/4", "perturbation.amplitude", "1e-16"},
                   {"1e-08/1/4", "perturbation.amplitude", "1e-16"},
                   {"0.1/1/4", "perturbation.amplitude", "1e-1"},
                   {"1e-8/x/4", "perturbation.seed", "whole number"},
                   {"1e-8/1/-4", "perturbation.number", "whole number"},
                   {"1e-8/1/4/5", "perturbation.number", "whole number"}},
                  parse_perturbation);
}

// The bound that amplification is measured against holds for the truth, in every class.
TEST(LargestDisplacement, BoundsTheTrueChangeOfDistance) {
  for (const Pair pair : all_pairs) {
    for (const std::string& name : pose_classes(pair)) {
      const Configuration from = make_configuration({pair, name, 11, 2});
      for (const int exponent : {-9, -4, -1}) {
        for (std::uint64_t number = 0; number < 1; ++number) {
          const Configuration to = perturbed(from, {Decade(exponent), 11, number});
          const double change = std::abs(oracle::truth(to).signed_distance.midpoint() -
                                         oracle::truth(from).signed_distance.midpoint());
          EXPECT_LE(change, largest_displacement(from, to) * (1 + 1e-12) +
                                1e-15 * (from.pose_a.position().norm() + larger_size(from)))
              << pair_name(pair) << '/' << name << ' ' << exponent << ' ' << number;
        }
      }
    }
  }
}

using Kind = oracle::ContactPatch::Kind;

TEST(CriticalPose, IsExactlyWhatItSays) {
  const struct {
    const char* name;
    Kind patch;
    std::size_t normals;
    double depth;  // times 256
  } table[] = {
      {"lying", Kind::segment, 1, 1},
      {"standing", Kind::region, 1, 1},
      {"parallel-sides", Kind::segment, 1, 1},
      {"cap-on-cap", Kind::region, 1, 1},
      {"t", Kind::segment, 1, 1},
      {"x", Kind::point, 1, 1},
      {"rim-on-rim", Kind::point, 2, 0.8},
      {"edge-on-side", Kind::segment, 1, 1},
      {"cap-on-box-corner", Kind::region, 1, 1},
  };
  ASSERT_EQ(critical_poses().size(), std::size(table));
  for (const auto& row : table) {
    SCOPED_TRACE(row.name);
    const Configuration& c = find_critical_pose(row.name).configuration;
    const oracle::Truth truth = oracle::truth(c);
    EXPECT_EQ(truth.normals.size(), row.normals);
    EXPECT_NEAR(-256 * truth.signed_distance.midpoint(), row.depth, 1e-12);
    EXPECT_EQ(oracle::contact_patch(c, truth.normals[0]).kind(), row.patch);
  }
}

TEST(MapPixel, InTheMiddleIsTheDegeneratePoseItself) {
  for (const CriticalPose& pose : critical_poses()) {
    EXPECT_EQ(rc::toString(map_pixel(pose, Decade(-8), 0, 0)), rc::toString(pose.configuration))
        << pose.name;
  }
}

TEST(MapPixel, AtTheMarginIsChangedByTheZoom) {
  for (const CriticalPose& pose : critical_poses()) {
    SCOPED_TRACE(pose.name);
    const Configuration& c = pose.configuration;
    const double circumradius = std::hypot(c.a.radius(), c.a.half_length());
    for (const auto& [change, column, row] :
         {std::tuple(&pose.across, map_reach, 0), std::tuple(&pose.up, 0, -map_reach)}) {
      const double expected =
          change->turn.norm() * circumradius + change->move.norm() * smaller_size(c);
      const Configuration pixel = map_pixel(pose, Decade(-4), column, row);
      EXPECT_NEAR(largest_displacement(c, pixel) / 1e-4, expected, 1e-8);
      // The degeneracy is broken: no other pose of the map is this one.
      EXPECT_GT(expected, 0.1);
    }
  }
}

// A changed pose breaks every name that has been written down.
TEST(StabilityName, KeepsItsBitsFromVersionToVersion) {
  const struct {
    const char* name;
    const char* shown;
  } golden[] = {
      {"map/rim-on-rim/1e-12/-3/16",
       "a: cylinder radius 0x1p-2 half_length 0x1p-1 position "
       "(-0x1.a636641c4df1ap-45, 0x0p+0, 0x1.fep-1) orientation (0x1p+1, "
       "-0x1.19799812dea11p-41, 0x1p+0, 0x1.19799812dea11p-40); b: cylinder radius "
       "0x1p-2 half_length 0x1p-1 position (0x0p+0, 0x0p+0, 0x0p+0) orientation "
       "(0x1p+1, 0x0p+0, -0x1p+0, 0x0p+0)"},
      {"map/edge-on-side/1e-2/7/-16",
       "a: cylinder radius 0x1p-2 half_length 0x1p-1 position "
       "(0x1.4b9999999999ap-1, 0x1p-3, 0x1.64ccccccccccdp-1) orientation "
       "(0x1.ff5c28f5c28f6p-1, -0x1.0051eb851eb85p+0, 0x1.5c28f5c28f5c3p-8, "
       "-0x1.5c28f5c28f5c3p-8); b: box half_extents (0x1p-1, 0x1p-1, 0x1p-1) "
       "position (0x0p+0, 0x0p+0, 0x0p+0) orientation (0x1p+0, 0x0p+0, 0x0p+0, "
       "0x0p+0)"},
      {"sequence/roll-over-edge/113/200",
       "a: cylinder radius 0x1p-2 half_length 0x1p-1 position "
       "(0x1.20372ebfc79bep-1, 0x1p-3, 0x1.79cfddc33a87ep-1) orientation (0x1p+0, "
       "-0x1p+0, 0x0p+0, 0x0p+0); b: box half_extents (0x1p-1, 0x1p+0, 0x1p-1) "
       "position (0x0p+0, 0x0p+0, 0x0p+0) orientation (0x1p+0, 0x0p+0, 0x0p+0, "
       "0x0p+0)"},
  };
  for (const auto& row : golden) {
    EXPECT_EQ(rc::toString(named_configuration(row.name)->configuration), row.shown) << row.name;
  }
}

TEST(StabilityName, RefusesWhatItIsNotAndNamesThePart) {
  EXPECT_FALSE(named_configuration("cylinder-box/rim-face/1/0"));
  expect_refusals({{"map", "map", "map/standing/1e-12/-3/16"},
                   {"map/standing/1e-12/3", "map", "map/standing/1e-12/-3/16"},
                   {"map/leaning/1e-12/3/4", "map.pose", "standing"},
                   {"map/standing/1e-20/3/4", "map.zoom", "1e-16"},
                   {"map/standing/1e-12/17/4", "map.column", "from -16 to 16"},
                   {"map/standing/1e-12/3/4.5", "map.row", "from -16 to 16"},
                   {"sequence/roll-over-edge/3", "sequence", "113/200"},
                   {"sequence/fall/3/4", "sequence.motion", "roll-over-edge"},
                   {"sequence/roll-over-edge/5/4", "sequence.step", "from 0 to 4"},
                   {"sequence/roll-over-edge/0/0", "sequence.steps", "from 1"}},
                  named_configuration);
}

TEST(Motion, IsContinuous) {
  constexpr int steps = 64;
  for (const Motion& motion : motions()) {
    for (int i = 1; i <= steps; ++i) {
      const Configuration from = pose_at(motion, i - 1, steps), to = pose_at(motion, i, steps);
      EXPECT_GT(largest_displacement(from, to), 0) << motion.name << ' ' << i;
      EXPECT_LT(largest_displacement(from, to), 0.05) << motion.name << ' ' << i;
    }
  }
}

TEST(Motion, StaysInContactUntilTheBodiesPart) {
  for (const Motion& motion : motions()) {
    const bool parts = motion.name == "slide-off-box" || motion.name == "slide-over-cap";
    for (int i = 0; i <= 16; ++i) {
      const double depth = -oracle::truth(pose_at(motion, i, 16)).signed_distance.midpoint();
      const bool ends = parts && (i == 16 || (i == 0 && motion.name == "slide-over-cap"));
      if (ends) {
        EXPECT_NEAR(depth, 0, 1e-15) << motion.name << ' ' << i;
      } else {
        EXPECT_GT(depth, 0.002) << motion.name << ' ' << i;
      }
    }
  }
}

TEST(Motion, KeepsOneDepthWhereNothingElseChanges) {
  for (const char* name : {"tilt-on-plane", "tilt-on-box", "roll-on-plane", "roll-on-box",
                           "yaw-on-box", "spin-on-box", "roll-over-edge", "sphere-round-rim"}) {
    for (const int step : {0, 7, 20, 31, 40}) {
      const double depth =
          -oracle::truth(pose_at(find_motion(name), step, 40)).signed_distance.midpoint();
      EXPECT_NEAR(256 * depth, 1, 1e-12) << name << ' ' << step;
    }
  }
}

}  // namespace
}  // namespace touchstone
