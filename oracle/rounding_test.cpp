#include "oracle/rounding.hpp"

#include <cmath>
#include <gtest/gtest.h>

#include "oracle/enclosure.hpp"
#include "oracle/truth.hpp"
#include "properties/draw.hpp"
#include "properties/identity.hpp"
#include "properties/moves.hpp"

namespace touchstone::oracle {
namespace {

using Quaternion = Eigen::Quaterniond;

bool meet(const Enclosure& a, const Enclosure& b) { return a.lo <= b.hi && b.lo <= a.hi; }

TEST(RoundedConfiguration, NoPoseClassLosesADigit) {
  for (const Pair pair : all_pairs) {
    for (const std::string& name : pose_classes(pair)) {
      for (std::uint64_t i = 0; i < 4; ++i) {
        SCOPED_TRACE(to_string(Identity{pair, name, 8, i}));
        EXPECT_EQ(rounded_configuration(make_configuration({pair, name, 8, i})).error, 0);
      }
    }
  }
}

// Few bits, so that rounding errors are large.
TEST(RoundedConfiguration, TheErrorBoundsWhatRoundingChanges) {
  for (const Pair pair : {Pair::capsule, Pair::cylinder, Pair::box}) {
    for (const std::string& name : pose_classes(pair)) {
      for (std::uint64_t i = 0; i < 1; ++i) {
        SCOPED_TRACE(to_string(Identity{pair, name, 9, i}));
        const Configuration c = make_configuration({pair, name, 9, i});
        for (const int bits : {3, 6, 12, 30}) {
          const auto [rounded, error] = rounded_configuration(c, bits);
          const Enclosure exact = truth(c).signed_distance, is = truth(rounded).signed_distance;
          EXPECT_TRUE(meet(exact, {is.lo - error, is.hi + error})) << bits;
          EXPECT_LE(error, 38 * std::ldexp(larger_size(c), -bits)) << bits;
        }
      }
    }
  }
}

TEST(RoundedConfiguration, AnOrientationMovesTheFarthestPointByNoMoreThanTheError) {
  // A needle of half length 1 over a box: the end goes down by the sine of the tilt.
  const Configuration c{Cylinder(0x1p-60, 1), Pose({0, 0, 3}, Quaternion(1, 0, 1 + 0.875 / 64, 0)),
                        Box({4, 4, 1}), Pose()};
  const auto [rounded, error] = rounded_configuration(c, 6);
  const mpq_class change = truth(c).signed_distance.lo - truth(rounded).signed_distance.lo;
  EXPECT_GT(abs(change), error / 8);
  EXPECT_LE(abs(change), error);
}

TEST(RoundedConfiguration, SizesThatVanishStayPositive) {
  const auto [rounded, error] =
      rounded_configuration({Cylinder(1e-300, 1), Pose(), Box({5e-324, 1, 1}), Pose()});
  EXPECT_EQ(rounded.a.radius(), 0x1p-192);
  EXPECT_EQ(std::get<Box>(rounded.b).half_extents().x(), 0x1p-192);
  EXPECT_GT(error, 0);
  EXPECT_LE(error, 0x1p-190);
}

TEST(RoundedConfiguration, WhatBothPositionsHaveInCommonCostsNothing) {
  const Vec3 tiny(1e-300, -1e-250, 0);
  const Configuration c{Cylinder(1, 1), Pose(tiny, upright), Cylinder(1, 1), Pose(tiny, upright)};
  EXPECT_EQ(rounded_configuration(c).error, 0);
  EXPECT_EQ(rounded_configuration(c).configuration.pose_a.position(), Vec3::Zero());
}

TEST(RoundedConfiguration, ANarrowerWidthSharpensTheSameNumber) {
  // A tilt of 1e-70, lengths of 1e-80, and both beside what lies 1e200 away.
  const Quaternion tilt(1, 1e-70, 0, 0);
  const Configuration configurations[] = {
      {Cylinder(1, 2), Pose({0.5, 0, 2.5}, tilt), Cylinder(1, 1), Pose()},
      {Cylinder(1, 2), Pose({0.5, 1e-80, 2.5}, tilt), Box({1, 1e-90, 1}), Pose()},
      {Cylinder(1, 2), Pose({1e200, 1e190, 3}, Quaternion(1, 2, 3, 4)), Cylinder(1, 1), Pose()},
      {Cylinder(1, 2), Pose({1e60, -1e60, 3}, Quaternion(1, 2, 3, 4)), Capsule(1, 1), Pose()},
      {Cylinder(1, 2), Pose({0, 0, 1e300}, upright), Box({1, 2, 3}), Pose()}};
  for (const Configuration& c : configurations) {
    const Enclosure wide = truth(c).signed_distance, narrow = truth(c, 1e-95).signed_distance;
    EXPECT_LE(narrow.hi - narrow.lo, mpq_class(1e-95) * mpq_class(larger_size(c)));
    EXPECT_LE(wide.lo, narrow.lo);
    EXPECT_GE(wide.hi, narrow.hi);
  }
}

TEST(RoundedConfiguration, TheSignIsToldDownTo1e54OfTheSize) {
  const Quaternion turned(1, 0, 0, 1e-150);
  for (const double size : {1e-30, 1e-54}) {
    // Coins whose faces are -size / 2 and 2 size apart.
    const auto coins = [&](double height) {
      return truth({Cylinder(1, size), Pose({0, 0, height}, upright), Cylinder(1, size),
                    Pose({0, 1e-130, -size}, turned)})
          .signed_distance;
    };
    EXPECT_LT(coins(size / 2).hi, 0);
    EXPECT_GT(coins(3 * size).lo, 0);
  }
}

TEST(RoundedConfiguration, BodiesThatTouchWithRoundedNumbersAreSaidToTouchNearly) {
  const Enclosure e = truth({Cylinder(1, 1), Pose({0, 0, 2}, upright), Cylinder(1, 1),
                             Pose({0, 1e-130, 0}, Quaternion(1, 0, 0, 1e-150))})
                          .signed_distance;
  EXPECT_LT(e.lo, 0);
  EXPECT_GT(e.hi, 0);
  EXPECT_LE(e.hi - e.lo, 0x1p-183);
}

TEST(Decimal, RoundsOutward) {
  const mpq_class third(1, 3);
  EXPECT_EQ(decimal_below(third, 4), "0.3333");
  EXPECT_EQ(decimal_above(third, 4), "0.3334");
  EXPECT_EQ(decimal_below(-third, 4), "-0.3334");
  EXPECT_EQ(decimal_above(-third, 4), "-0.3333");
}

TEST(Decimal, IsExactWhereDigitsSuffice) {
  const std::pair<const char*, mpq_class> numbers[] = {
      {"0", 0},
      {"1", 1},
      {"-2.5", {-5, 2}},
      {"1024", 1024},
      {"0.0078125", {1, 128}},
      {"-1.25e-9", mpq_class("-1/800000000")},
      {"1.5e20", mpq_class("150000000000000000000")}};
  for (const auto& [text, exact] : numbers) {
    EXPECT_EQ(decimal_below(exact, 12), text);
    EXPECT_EQ(decimal_above(exact, 12), text);
  }
}

TEST(Decimal, CarriesIntoTheNextPowerOfTen) {
  EXPECT_EQ(decimal_above(mpq_class(9999, 10000), 3), "1");
  EXPECT_EQ(decimal_below(mpq_class(-9999, 10000), 3), "-1");
  EXPECT_EQ(decimal_below(mpq_class(9999, 10000), 3), "0.999");
}

TEST(Enclosure, MidpointAndWidthAreOfItsEnds) {
  const Enclosure e{mpq_class(1, 4), mpq_class(3, 4)};
  EXPECT_EQ(e.midpoint(), 0.5);
  EXPECT_EQ(e.width(), 0.5);
}

TEST(Quotient, IsRoundedTowardsZero) {
  const double third = 1.0 / 3;  // below a third
  EXPECT_EQ(quotient(Float(1.0), Float(3.0)), third);
  EXPECT_EQ(quotient(Float(-1.0), Float(3.0)), -third);
  EXPECT_EQ(quotient(Float(1.0), Float(10.0)), std::nextafter(0.1, 0));  // 0.1 is above a tenth
  EXPECT_EQ(quotient(Float(0.0), Float(-3.0)), 0);
  EXPECT_EQ(quotient(Float(std::ldexp(3, -1000)), Float(std::ldexp(1, 75))), std::ldexp(1, -1074));
}

/// The cell around [lo, hi] / divisor, for doubles.
std::optional<Enclosure> around(const GridCell& cell, double lo, double hi, long divisor = 1) {
  return cell.around(Float(lo), Float(hi), divisor);
}

TEST(GridCell, IsTheSameHoweverNarrowlyTheNumberIsKnown) {
  const GridCell cell(1, 0.125);
  const auto wide = around(cell, 30, 33, 100);
  const auto narrow = around(cell, 32, 32, 100);
  ASSERT_TRUE(wide && narrow);
  EXPECT_EQ(wide->lo, narrow->lo);
  EXPECT_EQ(wide->hi, narrow->hi);
  EXPECT_LE(narrow->lo, mpq_class(32, 100));
  EXPECT_GE(narrow->hi, mpq_class(32, 100));
  EXPECT_EQ(narrow->hi - narrow->lo, mpq_class(1, 8));
}

TEST(GridCell, IsNoWiderThanAskedFor) {
  const auto cell = around(GridCell(3, 0.1), 5, 5);  // 0.3 → 1/4
  ASSERT_TRUE(cell);
  EXPECT_EQ(cell->hi - cell->lo, mpq_class(1, 4));
}

TEST(GridCell, DyadicNumbersAreNeverOnItsBorders) {
  const GridCell cell(1, 0.125);
  for (int i = -64; i <= 64; ++i) {
    if (i == 0) continue;
    const double x = i / 16.0, epsilon = 0x1p-40;
    EXPECT_TRUE(around(cell, x - epsilon, x + epsilon)) << i;
  }
}

TEST(GridCell, NeverReachesZero) {
  const GridCell cell(1, 1);
  for (const int x : {1, -1}) {
    const auto found = around(cell, x, x, 1000);
    ASSERT_TRUE(found);
    EXPECT_GT(found->lo * found->hi, 0);
    EXPECT_LE(found->lo, mpq_class(x, 1000));
    EXPECT_GE(found->hi, mpq_class(x, 1000));
  }
  EXPECT_FALSE(around(cell, -1, 1));
  EXPECT_FALSE(around(cell, 0, 0));
  EXPECT_EQ(GridCell(3, 1).nearly_zero(10).hi, mpq_class(1, 512));
}

// The number of a cell may have as many digits as there are between a distance and the spacing.
TEST(GridCell, ContainsItsNumberHoweverManyCellsThereAre) {
  for (const double width : {0x1p-1000, 1e-30, 1e-13, 1.0, 1e30}) {
    const GridCell cell(1, width);
    for (const double x : {1e200, 7.0, 0x1p-60, 5e-324}) {
      for (const double signed_x : {x, -x}) {
        for (const long divisor : {1L, 3L, 1000003L}) {
          const auto found = around(cell, signed_x, signed_x, divisor);
          ASSERT_TRUE(found);
          const mpq_class exact = mpq_class(signed_x) / divisor, spacing = found->hi - found->lo;
          EXPECT_LT(found->lo, exact);
          EXPECT_GT(found->hi, exact);
          EXPECT_LE(spacing, mpq_class(width));
          EXPECT_FALSE(cell.around(
              Float(signed_x), Float(signed_x) + Float(mpz_class(divisor)) * Float(width), divisor))
              << "at least as wide as a cell";
        }
      }
    }
  }
}

TEST(GridCell, ScalesWithPowersOfTwo) {
  const auto one = around(GridCell(1.5, 1e-3), -37, -37, 100),
             eight = around(GridCell(12, 1e-3), 8 * -37, 8 * -37, 100);
  ASSERT_TRUE(one && eight);
  EXPECT_EQ(8 * one->lo, eight->lo);
  EXPECT_EQ(8 * one->hi, eight->hi);
}

}  // namespace
}  // namespace touchstone::oracle
