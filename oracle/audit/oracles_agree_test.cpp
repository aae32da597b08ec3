// The two oracles against each other: on every pair and pose class, and on any finite numbers.
// Whatever their exponents, both oracles answer, do not contradict each other, and one truth takes
// bounded time.
//
// TOUCHSTONE_COUNT sets how many configurations are tried: of each class (10 by default, for CI)
// and of each pair (300 by default).
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <ctime>
#include <gtest/gtest.h>
#include <iostream>
#include <optional>
#include <string>

#include "oracle/as_hull.hpp"
#include "oracle/audit/enclose.hpp"
#include "oracle/expect_confirmed.hpp"
#include "oracle/patch/contact_patch.hpp"
#include "oracle/rounded.hpp"
#include "oracle/truth.hpp"
#include "properties/arbitrary.hpp"
#include "properties/draw.hpp"
#include "properties/identity.hpp"
#include "properties/numbers.hpp"
#include "reference/invalid_input.hpp"
#include "reference/random_bodies_test.hpp"
#include "reference/support.hpp"

namespace touchstone {
namespace {

/// A finite number near either end of the doubles, or with any exponent.
double extreme(Draw& draw) {
  constexpr double ends[] = {5e-324, 1e-310, 2.2250738585072014e-308, 1e-162, 1e-154,
                             1e154,  1e300,  1.7976931348623157e308};
  const double sign = draw.sign();
  if (draw.coin()) return sign * draw.any_of(ends);
  const double mantissa = draw.uniform(1, 2);
  return sign * std::ldexp(mantissa, static_cast<int>(draw.integer(-1074, 1023)));
}

/// A member of the class of everything at once, in which a varying share of the numbers, none to
/// all, are extreme.
Configuration with_extremes(Pair pair, std::uint64_t index) {
  const Numbers given = numbers_of(make_configuration({pair, "hostile", 17, index}));
  Draw draw{rc::Random(index)};
  constexpr std::int64_t extreme_one_in[] = {1000, 12, 4, 1};
  const std::int64_t one_in = draw.any_of(extreme_one_in);
  for (;;) {
    Numbers n = given;
    for (double* x : every_number(n)) {
      if (draw.one_in(one_in)) *x = extreme(draw);
    }
    for (double& size : n.sizes) size = std::abs(size);
    try {
      return configuration_of(n);
    } catch (const InvalidInput&) {
      // A plane's distance overflows.
    }
  }
}

/// Processor time of this thread, which a busy machine does not change.
double processor_milliseconds() {
  timespec t;
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
  return 1e3 * static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_nsec);
}

std::uint64_t count() {
  const char* text = std::getenv("TOUCHSTONE_COUNT");
  return text ? std::strtoull(text, nullptr, 10) : 300;
}

/// An end of the second oracle's enclosure; none if it is infinite.
std::optional<mpq_class> end(double x) {
  if (!std::isfinite(x)) return std::nullopt;
  return mpq_class(x);
}

void expect_no_contradiction(const oracle::Enclosure& truth, const audit::Enclosure& e) {
  ASSERT_LE(e.lo, e.hi);  // no NaN
  EXPECT_FALSE(end(e.lo) && *end(e.lo) > truth.hi);
  EXPECT_FALSE(end(e.hi) && *end(e.hi) < truth.lo);
  EXPECT_FALSE(end(e.pair_distance) && *end(e.pair_distance) < truth.lo);
}

class Hostile : public testing::TestWithParam<Pair> {};

TEST_P(Hostile, NumbersAreAnsweredAlikeByBothOraclesAndSoon) {
  double longest = 0;
  for (std::uint64_t i = 0; i < count(); ++i) {
    const Configuration c = with_extremes(GetParam(), i);
    const double start = processor_milliseconds();
    const oracle::Truth t = oracle::truth(c);
    for (const oracle::OptimalNormal& normal : t.normals) oracle::contact_patch(c, normal);
    longest = std::max(longest, processor_milliseconds() - start);
    ASSERT_FALSE(t.normals.empty());
    // At most one cell of the grid wide, or the remaining neighbourhood of zero.
    EXPECT_LE(t.signed_distance.hi - t.signed_distance.lo,
              mpq_class(1e-30) * mpq_class(larger_size(c)));
    expect_no_contradiction(t.signed_distance, audit::enclose(c));
    if (GetParam() == Pair::box) {
      expect_no_contradiction(t.signed_distance, audit::enclose(with_hull(c)));
    }
    if (HasFailure()) {
      showValue(c, std::cout);
      return;
    }
  }
  RecordProperty("longest_ms", std::to_string(longest));
  constexpr double max_milliseconds = 1e4;  // a thousand times what most take: ends what hangs
  EXPECT_LE(longest, max_milliseconds);
}

INSTANTIATE_TEST_SUITE_P(, Hostile, testing::ValuesIn(all_pairs), name_of_other);

std::uint64_t count_per_class() {
  const char* text = std::getenv("TOUCHSTONE_COUNT");
  return text ? std::strtoull(text, nullptr, 10) : 3;
}

class PoseClasses : public testing::TestWithParam<Pair> {};

TEST_P(PoseClasses, BothOraclesEncloseOneSignedDistance) {
  for (const auto& name : pose_classes(GetParam())) {
    // Relative to the larger size; continua of normals (concentric, coaxial) cost the most, those
    // of bodies of very different sizes more than the rest.
    const bool is_continuum = name.starts_with("concentric") || name.starts_with("coaxial");
    const bool is_uneven = name.find("+needle") != name.npos || name.find("+coin") != name.npos ||
                           name.find("+plate") != name.npos || name.find("+uneven") != name.npos;
    const double widest = is_continuum && is_uneven ? 1e-3 : 1e-4;
    for (std::uint64_t i = 0; i < count_per_class(); ++i) {
      const Identity id{GetParam(), name, 20261121, i};
      SCOPED_TRACE(to_string(id));
      const Configuration c = make_configuration(id);
      const oracle::Truth t = oracle::truth(c);
      const audit::Enclosure e =
          expect_confirmed(c, t, audit::Budget{}, is_continuum ? 1e-5 : 1e-9);
      EXPECT_LE(e.hi - e.lo, widest * larger_size(c));
      if (name == "general+shallow" || name == "general+apart" || name == "general+deep") {
        EXPECT_LE(e.hi - e.lo, 1.0001e-9 * larger_size(c));
      }
      if (GetParam() != Pair::box) continue;
      // The same body as a hull.
      const audit::Enclosure of_hull =
          expect_confirmed(with_hull(c), t, audit::Budget{}, is_continuum ? 1e-5 : 1e-9);
      EXPECT_LE(of_hull.hi - of_hull.lo, widest * larger_size(c));
    }
  }
}

// With roundings from none to all of the smallest size, whose cores are discs, segments and points.
TEST_P(PoseClasses, OfRoundedBodiesAreAnsweredAlikeByBothOracles) {
  constexpr double parts[] = {0, 1e-9, 0.2, 0.9, 1};
  std::uint64_t k = 0;
  for (const auto& name : pose_classes(GetParam())) {
    // Continua of normals, and what is next to one.
    const bool is_continuum = name.starts_with("concentric") || name.starts_with("coaxial");
    const auto expect_one_distance = [&](const Configuration& sharp) {
      const Configuration c = rounded_by(sharp, parts[k % 5], parts[k / 5 % 5]);
      const oracle::Truth t = oracle::truth(c);
      const bool has_many = is_continuum || t.ties == oracle::Ties::continuum;
      expect_confirmed(c, t, audit::Budget{}, has_many ? 1e-5 : 1e-9);
    };
    for (std::uint64_t i = 0; i < std::max<std::uint64_t>(count_per_class() / 3, 1); ++i, ++k) {
      const Identity id{GetParam(), name, 20261126, i};
      SCOPED_TRACE(to_string(id));
      const Configuration c = make_configuration(id);
      expect_one_distance(c);
      if (GetParam() == Pair::box) expect_one_distance(with_hull(c));
    }
  }
}

INSTANTIATE_TEST_SUITE_P(, PoseClasses, testing::ValuesIn(all_pairs), name_of_other);

/// A hull of points of a small lattice or of any, of which some kinds lie in one plane, or in
/// nearly one, or are a needle; both bodies upright, or turned by small integers, or anyhow.
Configuration with_any_hull(std::uint64_t index) {
  Draw draw{rc::Random(index)};
  const bool on_lattice = draw.coin();
  const auto coordinate = [&](int half) {
    return on_lattice ? 0.5 * static_cast<double>(draw.integer(-half, half))
                      : draw.uniform(-0.5 * half, 0.5 * half);
  };
  const auto vector = [&](int half) {
    const double x = coordinate(half), y = coordinate(half);
    return Vec3(x, y, coordinate(half));
  };
  const auto pose = [&](const Vec3& at) {
    if (draw.coin()) return Pose(at, {1, 0, 0, 0});
    const Vec3 axis = vector(6);
    return Pose(at, {draw.coin() ? 1 : 2.5, axis.x(), axis.y(), axis.z()});
  };
  constexpr double flatness[] = {1, 1, 0, 1e-3, 1e-9, 1e-15};
  constexpr std::int64_t counts[] = {3, 4, 6, 12, 40};
  const double thin = draw.any_of(flatness), wide = draw.one_in(5) ? 0.01 : 1;
  for (;;) {
    std::vector<Vec3> points;
    for (auto i = draw.any_of(counts); i > 0; --i) {
      points.push_back(vector(4).cwiseProduct(Vec3(1, wide, thin)));
    }
    const double radius = std::abs(coordinate(3)) + 0.5;
    const Cylinder cylinder(radius, std::abs(coordinate(3)) + 0.5);
    const Pose at = pose(vector(7));
    try {
      return {cylinder, at, oracle::convex_hull(points), pose(Vec3::Zero())};
    } catch (const InvalidInput&) {
      // All on one line.
    }
  }
}

TEST(Hulls, AreAnsweredAlikeByBothOracles) {
  for (std::uint64_t i = 0; i < count(); ++i) {
    SCOPED_TRACE(i);
    const Configuration c = with_any_hull(i);
    const oracle::Truth t = oracle::truth(c);
    const bool is_continuum = t.ties == oracle::Ties::continuum;
    const audit::Enclosure e = expect_confirmed(c, t, audit::Budget{}, is_continuum ? 1e-5 : 1e-9);
    EXPECT_LE(e.hi - e.lo, 1e-4 * larger_size(c));
    if (HasFailure()) {
      showValue(c, std::cout);
      return;
    }
  }
}

TEST(Hulls, HavePatchesThatLieInBothBodies) {
  std::uint64_t regions = 0, segments = 0;
  for (std::uint64_t i = 0; i < count(); ++i) {
    SCOPED_TRACE(i);
    const Configuration c = with_any_hull(i);
    Draw draw{rc::Random(i)};
    // Farther off, the patch looks for another point.
    const double off = 1e-9 * (larger_size(c) + c.pose_a.position().norm());
    for (const oracle::OptimalNormal& n : oracle::truth(c).normals) {
      const oracle::ContactPatch patch = oracle::contact_patch(c, n);
      regions += patch.kind() == oracle::ContactPatch::Kind::region ? 1 : 0;
      segments += patch.kind() == oracle::ContactPatch::Kind::segment ? 1 : 0;
      // Moved along the normal into either support plane, it is no farther out than the body is.
      const double top = support(c.b, c.pose_b, n.n), bottom = -support(c.a, c.pose_a, -n.n);
      for (const Vec3& p : patch.outline()) {
        for (int k = 0; k < 30; ++k) {
          const double x = draw.uniform(-1, 1), y = draw.uniform(-1, 1);
          const Vec3 m = Vec3(x, y, draw.uniform(-1, 1)).normalized();
          const double along = p.dot(m) - p.dot(n.n) * n.n.dot(m), slope = n.n.dot(m);
          EXPECT_LE(along + top * slope, support(c.b, c.pose_b, m) + off);
          EXPECT_LE(along + bottom * slope, support(c.a, c.pose_a, m) + off);
        }
      }
    }
    if (HasFailure()) {
      showValue(c, std::cout);
      return;
    }
  }
  EXPECT_GT(regions + segments, 0u);
}

}  // namespace

}  // namespace touchstone
