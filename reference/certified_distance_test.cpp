// What `certified_distance` claims, held against the oracle; then the derivation of proofs.md,
// "Rounding of a certified distance", stage by stage: what each is rounded is held against the
// exact oracle, long double or dense sampling, and must be a good part of its bound somewhere, so
// that a bound of nothing would be seen.
//
// TOUCHSTONE_COUNT times a few configurations are drawn of each kind; by default 100.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <gtest/gtest.h>
#include <limits>
#include <string>
#include <vector>

#include "oracle/truth.hpp"
#include "properties/identity.hpp"
#include "reference/contact_of.hpp"
#include "reference/curves.hpp"
#include "reference/random_bodies_test.hpp"
#include "reference/rims.hpp"
#include "reference/rounding_made_test.hpp"

namespace touchstone {
namespace {

std::uint64_t draws() { return tried_of_each(100); }

struct Proven {
  double share;                                ///< of the bounds that are rounding
  double largest_bound = 0, largest_part = 0;  ///< of `scale_of`; of an error in its bound
};

/// The truth lies within the bound of each configuration that make(i) makes, and what the fast
/// routine answers within twice that.
template <class Make>
Proven expect_bounds_hold(std::uint64_t count, Make make) {
  Proven result{};
  std::uint64_t proven = 0;
  for (std::uint64_t i = 0; i < count; ++i) {
    const Configuration c = make(i);
    const double scale = scale_of(c);
    const CertifiedDistance certified = certified_distance(c);
    const double sigma = oracle::truth(c, 1e-20).signed_distance.midpoint();
    const double error = std::abs(certified.value - sigma), bound = certified.error_bound;
    EXPECT_LE(error, bound) << i;
    EXPECT_NEAR(signed_distance(c).value, certified.value, 2 * bound) << i;
    EXPECT_NEAR(certified.normal.norm(), 1, 4e-15) << i;
    proven += bound <= promised * scale;
    result.largest_bound = std::max(result.largest_bound, bound / scale);
    result.largest_part = std::max(result.largest_part, error / bound);
  }
  result.share = static_cast<double>(proven) / static_cast<double>(count);
  return result;
}

// On every pair and pose class the bound is rounding (the search is proven complete), and of nearly
// all hostile configurations: TOUCHSTONE_COUNT of each class, by default 25, and 200 times as many
// hostile ones.

class Certified : public testing::TestWithParam<Pair> {};

TEST_P(Certified, BoundsHoldAndAreRounding) {
  std::vector<std::string> classes = pose_classes(GetParam());
  classes.push_back("hostile");
  constexpr double min_proven_part_of_hostile = 0.999;
  for (const std::string& name : classes) {
    SCOPED_TRACE(name);
    const bool hostile = name == "hostile";
    const Proven all = expect_bounds_hold(
        hostile ? 200 * tried_of_each(25) : of_each_class(GetParam(), tried_of_each(25)),
        [&](std::uint64_t i) {
          return make_configuration({GetParam(), name, 13, i});
        });
    EXPECT_GE(all.share, hostile ? min_proven_part_of_hostile : 1);
    if (hostile) {
      std::printf("proven %.3f%% of hostile ones, largest bound %.2g, largest error %.2g of its\n",
                  100 * all.share, all.largest_bound, all.largest_part);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(, Certified, testing::ValuesIn(all_pairs), name_of_other);

// However close to a tie: each generator makes the poses in which a search hardly sees the
// difference. README.md has the rates.
TEST(CertifiedDistance, BoundsHoldOfWhatAttacksProofs) {
  const struct {
    const char* name;
    Configuration (RoundingMade::*make)();
    double min_proven_part;
  } generators[] = {{"arrangement", &RoundingMade::arrangement, 1},
                    {"diagonal", &RoundingMade::diagonal, 1},
                    {"post_along_rim", &RoundingMade::post_along_rim, 0.7},
                    {"equal_coins", &RoundingMade::equal_coins, 0.7},
                    {"needle_over_rim", &RoundingMade::needle_over_rim, 1},
                    {"deep_coins", &RoundingMade::deep_coins, 0.99}};
  for (const auto& generator : generators) {
    SCOPED_TRACE(generator.name);
    const Proven all = expect_bounds_hold(draws(), [&](std::uint64_t i) {
      RoundingMade random(i);
      return (random.*generator.make)();
    });
    EXPECT_GE(all.share, generator.min_proven_part);
    std::printf("%s: proven %.2f%%, largest bound %.1g\n", generator.name, 100 * all.share,
                all.largest_bound);
  }
}

// Rims that touch from within along axes that are parallel but for rounding: every point of the
// rims is a stationary one.
TEST(CertifiedDistance, IsProvenWhereRimsCoincide) {
  const double tilts[] = {0.0, 1e-17, 1e-16, 3e-16, 1e-15, 1e-12, 1e-8};
  const Proven all = expect_bounds_hold(std::size(tilts), [&](std::uint64_t i) -> Configuration {
    return {Cylinder(1, 1), Pose({0, 0, 1.99}, {1, tilts[i], 0, 0}), Cylinder(1, 1), Pose()};
  });
  EXPECT_EQ(all.share, 1);
}

/// Pairs that rounding has most to do with: sizes of 1e-6 to 1e6 beside each other, quaternions of
/// any length, axes at any angle or nearly parallel or across, up to 1e6 from the world's origin,
/// deep, touching or apart.
class Uneven : public Random {
 public:
  using Random::Random;

  double size() { return toss() ? uniform(0.2, 2) : power_of_ten(-3, 3); }

  Configuration of(Pair pair) {
    const auto plane = [&] { return Plane(power_of_ten(-3, 3) * direction(), uniform(-2, 2)); };
    const Shape b = shape_of_sizes(
        pair, [&] { return size(); }, plane);
    Configuration c{Cylinder(size(), size()), Pose(), b, Pose()};
    const Eigen::Quaterniond turn = any_turn();
    const Eigen::Quaterniond lean(Eigen::AngleAxisd(power_of_ten(-17, 0), direction()));
    const Eigen::Quaterniond turn_a = toss() ? any_turn() : lean * turn;
    const Vec3 origin = toss() ? Vec3(Vec3::Zero()) : Vec3(power_of_ten(0, 6) * direction());
    const double reach = pair == Pair::plane ? larger_size(c) : larger_size(c) + c.a.radius();
    const Vec3 d = uniform(0, 2) * reach * direction();
    c.pose_a = Pose(origin + d, stretched(turn_a));
    c.pose_b = Pose(origin, stretched(turn));
    return c;
  }

 private:
  Eigen::Quaterniond any_turn() {
    const Vec3 v = direction();
    const double angle = uniform(0, 3.14159);
    return Eigen::Quaterniond(Eigen::AngleAxisd(toss() ? angle : 3.14159265, v));
  }
  Eigen::Quaterniond stretched(const Eigen::Quaterniond& q) {
    return Eigen::Quaterniond(Eigen::Vector4d(power_of_ten(-3, 3) * q.coeffs()));
  }
};

bool holds(const CertifiedDistance& answer, double sigma) {
  return std::abs(answer.value - sigma) <= answer.error_bound;
}

class CertifiedOfUneven : public testing::TestWithParam<Pair> {};

TEST_P(CertifiedOfUneven, TheTruthIsWithinTheBoundWhichIsNoMoreThanRounding) {
  std::vector<double> parts;
  for (std::uint64_t i = 0; i < 5 * draws(); ++i) {
    const Configuration c = Uneven(i).of(GetParam());
    const CertifiedDistance answer = certified_distance(c);
    const oracle::Truth truth = oracle::truth(c, 1e-22);
    const double sigma = truth.signed_distance.midpoint();
    EXPECT_TRUE(holds(answer, sigma))
        << i << ": " << answer.value - sigma << " in " << answer.error_bound;
    parts.push_back(std::abs(answer.value - sigma) / answer.error_bound);
    // An answer that is wrong by a little more than its bound is seen.
    CertifiedDistance planted = answer;
    planted.value += std::copysign(1.1 * answer.error_bound, answer.value - sigma);
    EXPECT_FALSE(holds(planted, sigma)) << i;
  }
  std::sort(parts.begin(), parts.end());
  EXPECT_GT(parts[parts.size() / 2], 2e-4);
  EXPECT_GT(parts.back(), 1e-2);
  std::printf("error in parts of the bound: median %.2g, largest %.2g\n", parts[parts.size() / 2],
              parts.back());
}

INSTANTIATE_TEST_SUITE_P(, CertifiedOfUneven, testing::ValuesIn(all_pairs), name_of_other);

FoldedCylinders folded_cylinders(const Configuration& c) {
  const Cylinder& b = std::get<Cylinder>(c.b);
  return {FoldedAxes(c.pose_a.axis(), c.pose_b.axis(), c.pose_a.position() - c.pose_b.position()),
          c.a.radius(), c.a.half_length(), b.radius(), b.half_length()};
}

// The frame and the formula of a gap together, along normals that are and are not of unit length.
TEST(CertifiedStages, AGapInTheFoldedFrameIsThatOfTheExactBodiesButForRounding) {
  double worst = 0;
  for (std::uint64_t i = 0; i < 20 * draws(); ++i) {
    Uneven random(i);
    const Configuration c = random.of(Pair::cylinder);
    const FoldedCylinders pair = folded_cylinders(c);
    const Vec3 n = random.direction();
    const double length = random.toss() ? 1 : random.power_of_ten(-3, 3);
    // Back in the world the normal is rounded, too: by less than 8 units.
    const double bound =
        (rounding_part + 8 * unit_roundoff + pair.axes.unit_error()) * pair.lengths();
    const double exact = oracle::certified_gap(c, pair.axes.to_world(length * n), 1e-22).midpoint();
    const double error = std::abs(pair.gap(length * n) / length - exact);
    EXPECT_LE(error, bound) << i;
    worst = std::max(worst, error / bound);
  }
  EXPECT_GT(worst, 1e-2);
}

/// `Rims::at` in long double, of exactly unit (c, s) and exactly this angle.
struct ExactRimPoint {
  long double radial, distance, slope, curvature;

  ExactRimPoint(const FoldedAxes& f, double r1, double r2, const Vec3& q, double cosine,
                double sine) {
    using Real = long double;
    const Real length = std::hypot(Real(f.c), Real(f.s)), c = f.c / length, s = f.s / length;
    const Real unit = std::hypot(Real(cosine), Real(sine)), x = cosine / unit, y = sine / unit;
    const Real v2 = q.y() - r1 * x, v3 = q.z() - r1 * y;
    const Real height = c * q.x() + s * v2, k = c * v2 - s * q.x();
    radial = std::hypot(k, v3);
    const Real cos2 = k / radial, sin2 = v3 / radial, beside = radial - r2;
    distance = std::hypot(height, beside);
    const Real a2 = s * height + c * beside * cos2, a3 = beside * sin2;
    slope = a2 * y - a3 * x;
    const Real follow = c * y * sin2 + x * cos2;
    curvature = r1 * (1 - r2 * follow * follow / radial) + (a2 * x + a3 * y);
  }
};

TEST(CertifiedStages, PointsOfRimsAreRoundedByNoMoreThanTheMarginsOfTheSearch) {
  double worst_slope = 0, worst_curvature = 0, worst_distance = 0;
  for (std::uint64_t i = 0; i < 200 * draws(); ++i) {
    Uneven random(i);
    const Configuration c = random.of(Pair::cylinder);
    FoldedCylinders pair = folded_cylinders(c);
    if (pair.r1 > pair.r2) std::swap(pair.r1, pair.r2);
    FoldedAxes& f = pair.axes;
    const double angle = random.uniform(0, 3.1415), cosine = std::cos(angle);
    const double sine = std::sin(angle);
    if (random.toss()) {  // next to axis 2, or at it
      const double near = random.power_of_ten(-18, 0);
      f.d1 = pair.h1, f.d2 = pair.r1 * cosine + near * f.c, f.d3 = pair.r1 * sine + near;
      pair.h2 = random.power_of_ten(-3, 0);
    }
    const Rims rims(pair, 1, 1);
    // As it is computed there.
    const Vec3 q = f.d() - 1.0 * pair.h1 * Vec3(1, 0, 0) - 1.0 * pair.h2 * Vec3(f.c, f.s, 0);
    const RimSample x = rims.at(angle, cosine, sine);
    const ExactRimPoint exact(f, pair.r1, pair.r2, q, cosine, sine);
    const double distance = static_cast<double>(std::abs(x.distance - exact.distance));
    EXPECT_LE(distance, rims.distance_rounding()) << i;
    worst_distance = std::max(worst_distance, distance / rims.distance_rounding());
    const Passage p = rims.passage(x, 0);
    if (!(p.min_radial > 0)) continue;
    const double slope = static_cast<double>(std::abs(x.slope - exact.slope));
    const double curvature = static_cast<double>(std::abs(x.curvature - exact.curvature));
    EXPECT_LE(slope, p.rounding) << i;
    EXPECT_LE(curvature, p.rounding_of_curvature) << i;
    worst_slope = std::max(worst_slope, slope / p.rounding);
    worst_curvature = std::max(worst_curvature, curvature / p.rounding_of_curvature);
  }
  std::printf("rounded, in parts of the bounds: distance %.2g, slope %.2g, curvature %.2g\n",
              worst_distance, worst_slope, worst_curvature);
  EXPECT_GT(worst_distance, 0.02);
  EXPECT_GT(worst_slope, 0.02);
  EXPECT_GT(worst_curvature, 0.02);
}

/// What `ellipse_excess` bounds, less the gap of n.
double gap_along(double a, double b, double x, double y, double angle) {
  const double c = std::cos(angle), s = std::sin(angle);
  return x * c + y * s - std::hypot(a * c, b * s);
}

// Of the foot's normal and of any other one, on the whole quadrant and on arcs; the best of those
// that were tried decides the depth.
TEST(CertifiedStages, NoNormalBesideAnEllipseExceedsWhatIsClaimedOfTheFoot) {
  constexpr double quarter = 1.5707963267948966;
  int tight = 0, of_feet = 0;
  for (std::uint64_t i = 0; i < 50 * draws(); ++i) {
    Uneven random(i);
    const double a = random.power_of_ten(-1, 1);
    const double b = a * (random.toss() ? random.uniform(0, 1) : random.power_of_ten(-8, 0));
    const double x = random.toss() ? random.uniform(0, 2 * a) : a * random.power_of_ten(-8, 0);
    const double y = random.uniform(-1, 1) * (random.toss() ? 2 * a : b);
    double first = 0, last = quarter;
    NormalArc arc;
    if (random.toss()) {
      first = random.uniform(0, quarter);
      arc.first = Vec2(std::cos(first), std::sin(first));
    }
    if (random.toss()) {
      last = random.uniform(first, quarter);
      arc.last = Vec2(std::cos(last), std::sin(last));
    }
    std::optional<Vec2> n = ellipse_normal(a, b, x, y);
    const bool is_foot = n.has_value();
    if (n && random.toss()) {  // off the foot
      const double off =
          std::clamp(std::atan2(n->y(), n->x()) + random.power_of_ten(-9, -1), 0.0, 1.5);
      n = Vec2(std::cos(off), std::sin(off));
    }
    double best = gap_along(a, b, x, y, first);
    if (arc.last) best = std::max(best, gap_along(a, b, x, y, last));
    if (n) {
      const double angle = std::atan2(n->y(), n->x());
      if (angle >= first && angle <= last) best = std::max(best, gap_along(a, b, x, y, angle));
    }
    if (random.toss()) best += a * random.power_of_ten(-9, 0);  // another stage found a better one
    const double excess = ellipse_excess(a, b, x, y, n, -best, arc);
    double largest = best;
    constexpr int places = 300;
    for (int k = 0; k <= places; ++k) {
      const double angle = first + (last - first) * k / places;
      largest = std::max(largest, gap_along(a, b, x, y, angle));
    }
    const double rounding = 4e-16 * (a + x + std::abs(y));
    EXPECT_LE(largest - best, excess + rounding)
        << i << ": a " << a << " b " << b << " x " << x << " y " << y << " depth " << -best;
    of_feet += is_foot;
    tight += is_foot && excess <= 1e-14 * (a + x + std::abs(y) + std::abs(best));
  }
  EXPECT_GT(tight, of_feet / 3);
}

// Where the axis passes through an edge of a hull, which is a tie all around: of the edge's normals
// the ellipse's steepest is far from the best, but not the arc that they are.
TEST(CertifiedStages, AnArcWithoutTheFootIsBoundedByItsOwnNormals) {
  Random random(1);
  for (int i = 0; i < 1000; ++i) {
    SCOPED_TRACE(i);
    // As narrow as rounding leaves it, from the normal with the whole depth on.
    const double a = random.uniform(1, 2), b = a * random.uniform(0.5, 1);
    const double x = a - random.uniform(0.1, 1) * b * b / a, y = random.uniform(0, 0.5);
    NormalArc narrow;
    narrow.last = Vec2(1, random.power_of_ten(-17, -15));
    EXPECT_LE(ellipse_excess(a, b, x, y, ellipse_normal(a, b, x, y), a - x, narrow), 1e-13);
    // Falling from its first normal on, however it bends back beyond its last one.
    const double fall = (1 + random.power_of_ten(-3, 0)) * (a - b * b / a);
    NormalArc wide;
    wide.last = Vec2(std::cos(1.0), std::sin(1.0));
    EXPECT_LE(ellipse_excess(a, b, 0, -fall, Vec2(0, 1), a, wide), 1e-13);
  }
}

// Lengths out of range are scaled, and the answer back, which may round it to a multiple of the
// least double, or overflow.
TEST(CertifiedDistance, HoldsOfLengthsNextToTheLeastAndTheLargestDouble) {
  for (std::uint64_t i = 0; i < 100; ++i) {
    Uneven random(i);
    const double scale = std::ldexp(random.uniform(1, 2), -1070);
    const Configuration c{Cylinder(3 * scale, 5 * scale),
                          Pose(7 * scale * random.direction(), {1, 0.3, 0.2, 0.1}),
                          Cylinder(2 * scale, 4 * scale), Pose(Vec3::Zero(), {1, 0, 0, 0})};
    const CertifiedDistance answer = certified_distance(c);
    const oracle::Truth truth = oracle::truth(c);
    EXPECT_LE(abs(mpq_class(answer.value) - truth.signed_distance.lo),
              mpq_class(answer.error_bound));
  }
  constexpr double largest = std::numeric_limits<double>::max();
  const Configuration far{Cylinder(1, 1), Pose({largest, 0, 0}, {1, 0, 0, 0}), Cylinder(1, 1),
                          Pose({-largest, 0, 0}, {1, 0, 0, 0})};
  EXPECT_EQ(certified_distance(far).value, largest);
  EXPECT_EQ(certified_distance(far).error_bound, std::numeric_limits<double>::infinity());
}

}  // namespace
}  // namespace touchstone
