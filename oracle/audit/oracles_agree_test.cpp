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
#include <iterator>
#include <optional>
#include <random>
#include <string>

#include "oracle/audit/enclose.hpp"
#include "oracle/patch/contact_patch.hpp"
#include "oracle/truth.hpp"
#include "properties/arbitrary.hpp"
#include "properties/identity.hpp"
#include "reference/invalid_input.hpp"

namespace touchstone {
namespace {

using Quaternion = Eigen::Quaterniond;

/// Moderate numbers, small integers and halves, and a varying share of numbers of any exponent;
/// bodies that coincide, touch or are parallel, exactly or nearly.
class HostileConfigurations {
 public:
  explicit HostileConfigurations(std::uint64_t seed) : bits_(seed) {}

  Configuration next(Pair pair) {
    for (;;) {
      try {
        return any(pair);
      } catch (const InvalidInput&) {
        // An overflow.
      }
    }
  }

 private:
  std::uint64_t below(std::uint64_t n) { return bits_() % n; }
  bool one_in(std::uint64_t n) { return below(n) == 0; }
  double fraction() { return std::ldexp(static_cast<double>(bits_() >> 11), -53); }
  double sign() { return one_in(2) ? 1 : -1; }

  double extreme() {
    constexpr double special[] = {5e-324,
                                  1e-320,
                                  1e-310,
                                  2.2250738585072014e-308,
                                  1e-300,
                                  1e-200,
                                  1e-162,
                                  1e-154,
                                  1e-100,
                                  1e-60,
                                  1e-40,
                                  1e-30,
                                  1e-20,
                                  1e30,
                                  1e50,
                                  1e100,
                                  1e154,
                                  1e200,
                                  1e300,
                                  1e308,
                                  1.7976931348623157e308};
    if (one_in(2)) return sign() * special[below(std::size(special))];
    return sign() * std::ldexp(1 + fraction(), static_cast<int>(below(2098)) - 1074);
  }
  double small() { return sign() * std::pow(10.0, -17 * fraction()); }
  double ordinary() {
    if (one_in(4)) return static_cast<double>(below(9)) / 2 - 2;
    return one_in(3) ? small() : 4 * fraction() - 2;
  }
  double number() {
    constexpr std::uint64_t extreme_in[] = {0, 12, 4, 1};
    const std::uint64_t n = extreme_in[mood_];
    return n != 0 && one_in(n) ? extreme() : ordinary();
  }
  double size() {
    const double x = std::abs(number());
    return x > 0 ? x : 1;
  }
  Vec3 vector() {
    const double x = number(), y = one_in(6) ? x : number();
    return {x, y, one_in(6) ? -y : number()};
  }

  Quaternion orientation() {
    Quaternion q = Quaternion::Identity();
    if (!one_in(4)) {
      const double w = number();
      const Vec3 v = vector();
      q = Quaternion(w, v.x(), v.y(), v.z());
    }
    if (mood_ > 0 && one_in(4)) q.coeffs()[static_cast<int>(below(4))] = extreme();
    return q;
  }
  /// The same orientation, tilted by any angle or turned by nearly 90°; or another one.
  Quaternion related(const Quaternion& q) {
    switch (below(5)) {
      case 0:
        return q;
      case 1:
        return Quaternion(Eigen::Vector4d(-2 * q.coeffs()));
      case 2: {
        const double tilt = mood_ > 0 && one_in(2) ? extreme() : small();
        return q * Quaternion(1, tilt, one_in(2) ? small() : 0, 0);
      }
      case 3:
        return q * Quaternion(1, 1 + small(), 0, 0);
      default:
        return orientation();
    }
  }

  Cylinder cylinder() {
    const double radius = size();
    return {radius, one_in(5) ? radius : size()};
  }
  Shape other_body(Pair pair, const Cylinder& a) {
    switch (pair) {
      case Pair::plane: {
        const Vec3 normal = vector();
        return Plane(normal, number());
      }
      case Pair::sphere:
        return Sphere(one_in(4) ? a.radius() : size());
      case Pair::capsule: {
        const double radius = size();
        return Capsule(radius, size());
      }
      case Pair::cylinder:
        return one_in(4) ? a : cylinder();
      case Pair::box: {
        const double x = size(), y = one_in(4) ? x : size();
        return Box(Vec3(x, y, size()));
      }
    }
    return Sphere(1);
  }
  /// Offset of the centres: zero, along one axis, such that surfaces touch, or any.
  Vec3 offset(const Cylinder& a, const Shape& b) {
    Vec3 along = Vec3::Zero();
    switch (below(5)) {
      case 0:
        return along;
      case 1:
        along[static_cast<int>(below(3))] = number();
        return along;
      case 2:
        along[static_cast<int>(below(3))] = mood_ > 0 ? extreme() : small();
        along[static_cast<int>(below(3))] =
            smallest_half_extent(b) + (one_in(2) ? a.radius() : a.half_length());
        return along;
      default:
        return vector();
    }
  }

  Configuration any(Pair pair) {
    mood_ = below(4);
    const Cylinder a = cylinder();
    const Shape b = other_body(pair, a);
    const Quaternion q = orientation();
    const Vec3 p = one_in(2) ? Vec3(0, 0, 0) : vector();
    const Vec3 from_b = offset(a, b);
    return {a, Pose(p + from_b, related(q)), b, Pose(p, q)};
  }

  std::mt19937_64 bits_;
  std::uint64_t mood_ = 0;
};

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
  HostileConfigurations configurations(17 + static_cast<std::uint64_t>(GetParam()));
  double longest = 0;
  for (std::uint64_t i = 0; i < count(); ++i) {
    const Configuration c = configurations.next(GetParam());
    const double start = processor_milliseconds();
    const oracle::Truth t = oracle::truth(c);
    for (const oracle::OptimalNormal& normal : t.normals) oracle::contact_patch(c, normal);
    longest = std::max(longest, processor_milliseconds() - start);
    ASSERT_FALSE(t.normals.empty());
    // At most one cell of the grid wide, or the remaining neighbourhood of zero.
    EXPECT_LE(t.signed_distance.hi - t.signed_distance.lo,
              mpq_class(1e-30) * mpq_class(larger_size(c)));
    expect_no_contradiction(t.signed_distance, audit::enclose(c));
    if (HasFailure()) {
      showValue(c, std::cout);
      return;
    }
  }
  RecordProperty("longest_ms", std::to_string(longest));
#if defined(NDEBUG) && !defined(__SANITIZE_ADDRESS__)
  EXPECT_LE(longest, 50);
#endif
}

INSTANTIATE_TEST_SUITE_P(, Hostile, testing::ValuesIn(all_pairs), [](const auto& pair) {
  return std::string(pair_name(pair.param)).substr(std::string("cylinder-").size());
});

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
      const oracle::Enclosure truth = oracle::truth(c).signed_distance;
      const audit::Enclosure e = audit::enclose(c);
      ASSERT_LE(mpq_class(e.lo), truth.hi);
      ASSERT_GE(mpq_class(e.hi), truth.lo);
      ASSERT_GE(mpq_class(e.pair_distance), truth.lo);
      EXPECT_LE(e.hi - e.lo, widest * larger_size(c));
      if (name == "general+shallow" || name == "general+apart" || name == "general+deep") {
        EXPECT_LE(e.hi - e.lo, 1.0001e-9 * larger_size(c));
      }
    }
  }
}

INSTANTIATE_TEST_SUITE_P(, PoseClasses, testing::ValuesIn(all_pairs), [](const auto& pair) {
  return std::string(pair_name(pair.param)).substr(std::string("cylinder-").size());
});

}  // namespace

}  // namespace touchstone
