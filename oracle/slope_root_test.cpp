// Roots of slopes against the roots of the polynomials that have both branches' roots: the same
// critical directions, whichever way they are isolated.
#include "oracle/slope_root.hpp"

#include <cmath>
#include <gtest/gtest.h>
#include <optional>
#include <string>
#include <vector>

#include "oracle/critical_direction.hpp"
#include "oracle/curve_search.hpp"
#include "oracle/rounding.hpp"
#include "properties/identity.hpp"

namespace touchstone::oracle {
namespace {

using Kind = CriticalSite::Kind;

/// Every direction of one curve at one vertex, with its gap.
struct Found {
  std::vector<DirectionBound> bounds;
  bool is_family = false;
};

constexpr long bits = 200;

void append(const Difference& difference, const CriticalSite& site, Found& found) {
  CriticalDirections directions;
  (site.kind == Kind::rim_line ? append_rim_line : append_rim_rim)(difference, site, directions);
  const WorkingPrecision precision(bits);
  const BallDifference balls(difference);
  for (const auto& direction : directions) {
    if (direction->family()) found.is_family = true;
    direction->enclose(difference, balls, found.bounds);
  }
}

/// Which of the two ways found a direction that the other one has not.
enum class Missing { none, by_slopes, by_polynomials };

bool has(const Found& found, const DirectionBound& wanted) {
  // Directions this close with equal gaps to 200 bits are the same, or a cluster's.
  constexpr double same_direction = 1e-9;
  const auto unit = [](const BallVector& n) {
    return Vec3(n.x.midpoint(), n.y.midpoint(), n.z.midpoint()).normalized();
  };
  const WorkingPrecision precision(bits);
  return std::any_of(found.bounds.begin(), found.bounds.end(), [&](const DirectionBound& b) {
    return (b.gap - wanted.gap).contains_zero() &&
           (!b.normal || !wanted.normal ||
            (unit(*b.normal) - unit(*wanted.normal)).norm() < same_direction);
  });
}

Missing difference_of(const Found& slopes, const Found& polynomials, const BallVector& disc_axis) {
  const WorkingPrecision precision(bits);
  for (const DirectionBound& b : polynomials.bounds) {
    // The disc's own axis is a site of its own.
    const bool is_axis = b.normal && norm(cross(*b.normal, disc_axis)).contains_zero();
    if (!is_axis && !has(slopes, b)) return Missing::by_slopes;
  }
  for (const DirectionBound& b : slopes.bounds) {
    if (!has(polynomials, b)) return Missing::by_polynomials;
  }
  return Missing::none;
}

/// Counts of curves on which double intervals separated all roots, and did not.
struct Isolated {
  int all = 0, not_all = 0;
};

/// One curve whole, at one vertex, both ways.
void expect_same_roots(const Difference& difference, const CriticalSite& curve, unsigned turns,
                       const auto& slope_of, Isolated& count) {
  Found slopes, polynomials;
  bool is_isolated = true;
  for (unsigned turn = 0; turn < turns; ++turn) {
    CriticalSite site = curve;
    site.turn = turn;
    site.lo = -1;
    site.hi = 1;
    append(difference, site, polynomials);
    std::vector<SlopeBracket> brackets;
    for (const int branch : {1, -1}) {
      const CGAL::Protect_FPU_rounding<true> rounding;
      is_isolated = is_isolated && isolate_slope_roots(slope_of(branch), branch,
                                                       {curve.first, turn, -1, 1}, brackets);
    }
    for (const SlopeBracket& bracket : brackets) {
      EXPECT_LE(bracket.lo, bracket.hi);
      site.lo = bracket.lo;
      site.hi = bracket.hi;
      site.branch = bracket.branch;
      site.rising = bracket.rising;
      append(difference, site, slopes);
    }
  }
  if (polynomials.is_family) {
    EXPECT_FALSE(is_isolated) << "a family has no isolated roots";
    return;
  }
  ++(is_isolated ? count.all : count.not_all);
  if (!is_isolated) return;
  const BallVector axis = to_balls(difference.discs[curve.second].frame.axis);
  EXPECT_EQ(difference_of(slopes, polynomials, axis), Missing::none)
      << "segment " << curve.first << " signs " << curve.signs;
}

/// A curve at one vertex, with its slope on the branches 1 and −1.
template <class Slope>
struct Curve {
  CriticalSite site;
  Slope positive, negative;
};

Isolated expect_same_roots(const Configuration& configuration) {
  Isolated count;
  const Difference difference = make_difference(rounded_configuration(configuration).configuration);
  const auto segments = static_cast<unsigned>(difference.segments.size());
  if (segments < 2) return count;
  std::vector<Curve<LineSlope<Interval>>> lines;
  std::vector<Curve<RimSlope<Interval>>> rims;
  {
    const CGAL::Protect_FPU_rounding<true> rounding;
    const IntervalDifference intervals(difference);
    for (unsigned i = 0; i < segments; ++i) {
      for (unsigned d = 0; d < difference.discs.size(); ++d) {
        if (parallel(difference.discs[d].frame.axis, difference.segments[i].frame.axis)) continue;
        const LineSearch line(intervals, difference, i, d);
        for (unsigned v = 0; v < 1U << (segments - 1); ++v) {
          const unsigned below = v & ((1U << i) - 1);
          CriticalSite site{Kind::rim_line, i, d, below | (v & ~((1U << i) - 1)) << 1};
          site.heading = line.heading();
          lines.push_back({site, line.slope(v, 1), line.slope(v, -1)});
        }
      }
    }
    for (unsigned signs = 0; signs < 4 && difference.discs.size() == 2; ++signs) {
      const RimSearch search(intervals, signs);
      rims.push_back({{Kind::rim_rim, 0, 1, signs}, search.slope(1), search.slope(-1)});
    }
  }
  const auto expect_of = [&](const auto& curves, unsigned turns) {
    for (const auto& curve : curves) {
      const auto slope = [&](int branch) { return branch > 0 ? curve.positive : curve.negative; };
      expect_same_roots(difference, curve.site, turns, slope, count);
    }
  };
  expect_of(lines, 4);
  expect_of(rims, 2);
  return count;
}

class CurvesOf : public testing::TestWithParam<std::string> {};

TEST_P(CurvesOf, SlopesAndPolynomialsHaveTheSameRoots) {
  Isolated count;
  for (std::uint64_t i = 0; i < 6; ++i) {
    const Identity id = parse_identity(GetParam() + "/5/" + std::to_string(i));
    SCOPED_TRACE(to_string(id));
    const Isolated here = expect_same_roots(make_configuration(id));
    count.all += here.all;
    count.not_all += here.not_all;
  }
  // Whole curves, also where no maximum can lie: multiple roots are rare.
  EXPECT_GE(count.all, 9 * count.not_all);
  EXPECT_GT(count.all, 0);
}

INSTANTIATE_TEST_SUITE_P(
    , CurvesOf,
    testing::Values("cylinder-cylinder/general", "cylinder-box/general", "cylinder-capsule/general",
                    "cylinder-cylinder/general+needle", "cylinder-box/general+needle",
                    "cylinder-cylinder/near-parallel-1e-3", "cylinder-cylinder/near-parallel-1e-6",
                    "cylinder-box/near-parallel-1e-6", "cylinder-capsule/near-parallel-1e-6",
                    "cylinder-cylinder/near-parallel-1e-9", "cylinder-box/near-parallel-1e-9",
                    "cylinder-cylinder/perpendicular+tilted-1e-6",
                    "cylinder-box/perpendicular+tilted-1e-9",
                    "cylinder-cylinder/perpendicular+tilted-1e-15",
                    "cylinder-capsule/perpendicular+tilted-1e-12",
                    "cylinder-cylinder/rim-rim+needle", "cylinder-box/edge-cap"),
    [](const auto& test) {
      std::string name = test.param;
      for (char& c : name) {
        if (std::isalnum(static_cast<unsigned char>(c)) == 0) c = '_';
      }
      return name;
    });

// What makes near-parallel and near-perpendicular classes cost as much as others.
TEST(CurveSites, OfPoseClassesAreIsolatedWithoutPolynomials) {
  int roots = 0, pieces = 0;
  for (const Pair pair : {Pair::capsule, Pair::cylinder, Pair::box}) {
    for (const std::string& name : pose_classes(pair)) {
      const Configuration c = make_configuration({pair, name, 6, 0});
      const Difference difference = make_difference(rounded_configuration(c).configuration);
      for (const CriticalSite& site : critical_sites(difference, 1e-13 * larger_size(c))) {
        if (site.kind != Kind::rim_line && site.kind != Kind::rim_rim) continue;
        ++(site.branch == 0 ? pieces : roots);
      }
    }
  }
  EXPECT_GT(roots, 200);
  EXPECT_LE(100 * pieces, roots);
}

mpq_class exact(double x) { return x; }

TEST(IntervalFunctions, SquareRootEnclosesTheRoot) {
  const CGAL::Protect_FPU_rounding<true> rounding;
  for (const double x : {0.0, 5e-324, 2.3e-308, 0.1, 1.0, 2.0, 3.0, 4.0, 1 + 0x1p-52, 1e300}) {
    const Interval root = square_root(Interval(x));
    EXPECT_GE(root.inf(), 0);
    EXPECT_LE(exact(root.inf()) * exact(root.inf()), exact(x));
    EXPECT_GE(exact(root.sup()) * exact(root.sup()), exact(x));
    EXPECT_LE(root.sup() - root.inf(), 0x1p-50 * root.sup());
  }
  EXPECT_EQ(square_root(Interval(-1, 4)).inf(), 0);
}

TEST(IntervalFunctions, CosineTowardsIsTakenAtTheRightEnds) {
  const CGAL::Protect_FPU_rounding<true> rounding;
  const double ends[] = {-3, -1, -0.25, 0, 0.25, 1, 3};
  for (const double x0 : ends) {
    for (const double x1 : ends) {
      for (const double y : {-2.0, 0.5}) {
        if (x0 > x1) continue;
        const Interval range = cosine_towards(Interval(x0, x1), Interval(y, y + 0.25));
        for (const double x : {x0, (x0 + x1) / 2, x1}) {
          for (const double v : {y, y + 0.25}) {
            const double value = x / std::sqrt(x * x + v * v);
            EXPECT_LE(range.inf(), value);
            EXPECT_GE(range.sup(), value - 1e-15);
          }
        }
      }
      if (x0 > x1 || x0 < 0) continue;
      // No wider than what its ends say.
      const Interval thin = cosine_towards(Interval(x0, x1), Interval(2));
      EXPECT_NEAR(thin.inf(), x0 / std::hypot(x0, 2), 1e-15);
      EXPECT_NEAR(thin.sup(), x1 / std::hypot(x1, 2), 1e-15);
    }
  }
}

TEST(TurnedFrame, StaysOrthogonalAndOfEqualLengths) {
  const Frame frame{{0, 0, 5}, {3, 4, 0}, {-4, 3, 0}};
  const TurnedFrame turned = turned_frame(frame, 0.25);
  const Integer length = 5 * turned.stretch;
  EXPECT_EQ(dot(turned.frame.e, turned.frame.f), 0);
  EXPECT_EQ(dot(turned.frame.e, turned.frame.e), length * length);
  EXPECT_EQ(dot(turned.frame.f, turned.frame.f), length * length);
  EXPECT_TRUE(is_zero(cross(cross(turned.frame.e, turned.frame.f), frame.axis)));
  // By 2 arctan(1/4), whose cosine is 15/17 and whose sine is 8/17.
  EXPECT_EQ(17 * dot(turned.frame.e, frame.e), 15 * 5 * length);
  EXPECT_EQ(17 * dot(turned.frame.e, frame.f), 8 * 5 * length);
}

/// S = cos φ − 3 sin φ − κ ρ', whose root without the bend is t = 1/3.
struct MadeUpCurve {
  Polynomial given;
  double y = 1, factor = 0;
  int stretch_squared = 1;

  std::optional<Ball> stretch() const {
    if (stretch_squared == 1) return std::nullopt;
    return sqrt(Ball(stretch_squared));
  }
  Polynomial polynomial() const { return given; }
  LineSlope<Ball> slope(int branch) const {
    const auto ball = [](double x) { return Ball(mpq_class(x)); };
    return {{1, -3}, {0, 1}, ball(y), ball(branch * factor), false};
  }
};

TEST(CurveRoot, EnclosesARootOfASlopeAsNarrowlyAsAsked) {
  const MadeUpCurve curve{{-1, 3}};
  CurveRoot root(SlopeBracket{-1, 1, 1, false});
  for (const long wanted : {64, 256, 1024}) {
    const WorkingPrecision precision(wanted + RootBracket::spare_bits);
    const Ball t = root.enclose(curve);
    EXPECT_LE(t.lower(), mpq_class(1, 3));
    EXPECT_GE(t.upper(), mpq_class(1, 3));
    EXPECT_LE((t.upper() - t.lower()) * (mpz_class(1) << static_cast<mp_bitcnt_t>(wanted)), 4);
  }
}

TEST(CurveRoot, IsDecidedByThePolynomialAlone) {
  // Another root of the polynomial, but not of the slope, 2^-150 away on either side.
  const mpz_class big = mpz_class(1) << 150U;
  for (const int side : {1, -1}) {
    const Polynomial other{mpz_class(-big - 3 * side), mpz_class(3 * big)};
    const MadeUpCurve curve{Polynomial{-1, 3} * other};
    const mpq_class third(1, 3), beside = third + mpq_class(side, big);
    const auto made = [] { return CurveRoot(SlopeBracket{0.25, 0.5, 1, false}); };
    EXPECT_TRUE(made().is(curve, 1, 3));
    EXPECT_FALSE(made().is(curve, beside.get_num(), beside.get_den()));
    EXPECT_FALSE(made().is(curve, 1, 2));
    EXPECT_TRUE(made().is_root_of(curve, Polynomial{-1, 3} * Polynomial{-2, 0, 1}));
    EXPECT_FALSE(made().is_root_of(curve, other));
    EXPECT_TRUE(made().is_root_of(curve, {0}));
  }
}

TEST(CurveRoot, OfAStretchedParameterIsThePolynomialsRoot) {
  // √2 times the root is 1/3. The other polynomial's root is 2^-150 away.
  const mpz_class big = mpz_class(1) << 150U;
  const Polynomial own{-1, 0, 18}, other{-big - 1, 0, 18 * big};
  const MadeUpCurve curve{own * other, 1, 0, 2};
  CurveRoot root(SlopeBracket{-1, 1, 1, false});
  const WorkingPrecision precision(256);
  const Ball t = root.enclose(curve);
  EXPECT_TRUE((Ball(18) * square(t) - Ball(1)).contains_zero());
  EXPECT_LT(t.upper() - t.lower(), 0x1p-200);
  EXPECT_TRUE(root.is_root_of(curve, own));
  EXPECT_FALSE(root.is_root_of(curve, other));
  EXPECT_FALSE(root.is(curve, 1, 3));
}

TEST(CurveRoot, AMultipleRootOfThePolynomialIsRecognised) {
  const MadeUpCurve curve{Polynomial{-1, 3} * Polynomial{-1, 3}};
  CurveRoot root(SlopeBracket{0.25, 0.5, 1, false});
  EXPECT_TRUE(root.is(curve, 1, 3));
  EXPECT_FALSE(root.is_root_of(curve, {-2, 0, 1}));
}

// ρ' jumps from −1 to 1 within 2^-40: Newton's method fails on such a wide bracket.
TEST(CurveRoot, ABendFarNarrowerThanTheBracketIsBisected) {
  const MadeUpCurve curve{{}, 0x1p-40, 2};
  CurveRoot root(SlopeBracket{-0.5, 0.25, 1, false});
  const WorkingPrecision precision(128);
  const Ball t = root.enclose(curve);
  const SlopeOfParameter slope(curve.slope(1));
  EXPECT_TRUE(slope.value(Ball(t.lower() - mpq_class(1, mpz_class(1) << 100U))).is_positive());
  EXPECT_TRUE(slope.value(Ball(t.upper() + mpq_class(1, mpz_class(1) << 100U))).is_negative());
  EXPECT_LE(std::abs(t.midpoint()), 0x1p-39);
}

TEST(SlopeIsolation, GivesUpWhereTheSlopeVanishesIdentically) {
  const CGAL::Protect_FPU_rounding<true> rounding;
  std::vector<SlopeBracket> brackets;
  const LineSlope<Interval> line({0, 0}, {1, 0}, 1, 0, false);
  EXPECT_FALSE(isolate_slope_roots(line, 1, {0, 0, -1, 1}, brackets));
  const RimSlope<Interval> coaxial({0, 0}, {0, {1, 0}}, {0, {0, 1}}, 1, 1);
  EXPECT_FALSE(isolate_slope_roots(coaxial, 1, {0, 0, -1, 1}, brackets));
}

// S and dS/dφ vanish at φ = 0.3, up to rounding: doubles cannot tell no root from two.
TEST(SlopeIsolation, GivesUpAtADoubleRoot) {
  const double phi = 0.3, c = std::cos(phi), s = std::sin(phi);
  // ρ' and ρ'' of x = sin φ, y = 1
  const double length = std::hypot(s, 1), d = s * c / length;
  const double dd = c * c / (length * length * length) - s * s / length;
  const CGAL::Protect_FPU_rounding<true> rounding;
  const LineSlope<Interval> line({d * c - dd * s, d * s + dd * c}, {0, 1}, 1, 1, false);
  std::vector<SlopeBracket> brackets;
  EXPECT_FALSE(isolate_slope_roots(line, 1, {0, 0, 0.25, 0.375}, brackets));
}

TEST(SlopeIsolation, ARootAtAnEndOfAPieceIsFoundFromBothSides) {
  const CGAL::Protect_FPU_rounding<true> rounding;
  // S = sin φ
  const LineSlope<Interval> line({0, 1}, {1, 0}, 1, 0, false);
  for (const Piece& piece : {Piece{0, 0, -0.5, 0}, Piece{0, 0, 0, 0.5}}) {
    std::vector<SlopeBracket> brackets;
    EXPECT_TRUE(isolate_slope_roots(line, 1, piece, brackets));
    ASSERT_EQ(brackets.size(), 1u);
    EXPECT_LE(brackets[0].lo, 0);
    EXPECT_GE(brackets[0].hi, 0);
    EXPECT_LT(brackets[0].hi - brackets[0].lo, 1e-15);
    EXPECT_TRUE(brackets[0].rising);
  }
}

}  // namespace
}  // namespace touchstone::oracle
