// The promise of the headers, held on every pair and pose class against the oracle, and the table
// of largest errors in README.md, which it keeps from going stale.
//
// TOUCHSTONE_COUNT sets how many configurations of each class are tried (twenty times as many
// hostile ones); by default 100, which makes 108,000 over all pairs and takes some 20 s of one
// core. 950 make a million.
#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <gtest/gtest.h>
#include <initializer_list>
#include <limits>
#include <map>
#include <optional>
#include <sstream>
#include <string>
#include <vector>

#include "oracle/truth.hpp"
#include "properties/identity.hpp"
#include "properties/moves.hpp"
#include "reference/contact_of.hpp"
#include "reference/critical_poses_test.hpp"
#include "reference/invalid_input.hpp"
#include "reference/points_on_both_test.hpp"
#include "reference/random_bodies_test.hpp"
#include "reference/single_precision.hpp"
#include "reference/support.hpp"

namespace touchstone {
namespace {

std::uint64_t count_per_class() { return tried_of_each(100); }

/// Errors of one answer, relative to a size.
struct Errors {
  double distance = 0, regret = 0;
  double length = 0;   ///< of the normal, less one
  double deepest = 0;  ///< the deepest point's depth
  double places = 0;   ///< points off the surfaces

  Errors() = default;
  explicit Errors(const Configuration& c) : Errors(c, size_of(c)) {}
  Errors(const Configuration& c, double size) : Errors(c, size, signed_distance(c)) {}
  Errors(const Configuration& c, double size, const SignedDistance& answer)
      : Errors(c, size, answer, contact(c, std::max(answer.value, 0.0) + 1e-6 * smaller_size(c))) {}
  Errors(const Configuration& c, double size, const SignedDistance& answer, const Contact& touch) {
    const oracle::Truth t = oracle::truth(c);
    distance = std::abs(answer.value - t.signed_distance.midpoint()) / size;
    regret = oracle::normal_regret(c, t, answer.normal) / size;
    length = std::abs(answer.normal.norm() - 1);
    double depth = -std::numeric_limits<double>::infinity();
    for (const ContactPoint& p : touch.points()) {
      depth = std::max(depth, p.depth);
      const Vec3 half = p.depth / 2 * touch.normal;
      places = std::max({places, std::abs(outside(c.a, c.pose_a, p.position - half)) / size,
                         std::abs(outside(c.b, c.pose_b, p.position + half)) / size});
    }
    deepest = std::abs(depth + t.signed_distance.midpoint()) / size;
  }
  void keep_larger(const Errors& other) {
    distance = std::max(distance, other.distance), regret = std::max(regret, other.regret);
    deepest = std::max(deepest, other.deepest), places = std::max(places, other.places);
  }
};

using Worst = std::map<std::string, Errors>;  ///< by family

/// The errors that `errors_of(configuration, is_hostile)` has, if any, of so many configurations of
/// each pose class, and twenty times as many hostile ones.
template <class FamilyOf, class ErrorsOf>
Worst worst_errors(Pair pair, std::uint64_t per_class, double most, FamilyOf family_of,
                   ErrorsOf errors_of) {
  constexpr std::uint64_t hostile_factor = 20;
  Worst worst;
  std::vector<std::string> classes = pose_classes(pair);
  classes.push_back("hostile");
  for (const auto& name : classes) {
    const bool is_hostile = name == "hostile";
    Errors& of_family = worst[family_of(pair, name)];
    for (std::uint64_t i = 0;
         i < (is_hostile ? hostile_factor * per_class : of_each_class(pair, per_class)); ++i) {
      const Identity id{pair, name, 7, i};
      const std::optional<Errors> errors = errors_of(make_configuration(id), is_hostile);
      if (!errors) continue;
      EXPECT_LE(errors->distance, most) << to_string(id);
      EXPECT_LE(errors->regret, most) << to_string(id);
      EXPECT_LE(errors->length, 4e-15) << to_string(id);
      of_family.keep_larger(*errors);
    }
  }
  for (const auto& [family, errors] : worst) {
    std::printf("%s: distance %.2g, regret %.2g, deepest point %.2g, places %.2g\n", family.c_str(),
                errors.distance, errors.regret, errors.deepest, errors.places);
  }
  return worst;
}

/// The family under which the table of README.md counts a pose class.
std::string family_of(Pair pair, const std::string& pose_class) {
  if (pose_class == "hostile" || pose_class == "recorded") return pose_class;
  const auto parts = parts_of(pair, pose_class);
  const auto& modifiers = parts.modifiers;
  const auto has = [&](std::initializer_list<std::string_view> starts) {
    return std::any_of(starts.begin(), starts.end(), [&](std::string_view start) {
      return std::any_of(modifiers.begin(), modifiers.end(),
                         [&](const std::string& m) { return m.starts_with(start); });
    });
  };
  if (has({"needle", "coin", "plate", "uneven"})) return "needles, coins, plates, uneven sizes";
  if (has({"tiny", "huge", "far"})) return "tiny, huge or far away";
  if (has({"tilted"})) return "tilted by 1e-1 to 1e-15";
  return parts.arrangement == "general" ? "general" : "features that meet, alignments";
}

/// The figures of one pair in README.md by "quantity | family", of
/// quantities "in float" or others.
std::map<std::string, double> documented_errors(Pair pair, bool in_float) {
  std::ifstream file(TOUCHSTONE_ACCURACY_TABLE);
  std::map<std::string, double> figures;
  for (std::string line; std::getline(file, line);) {
    std::vector<std::string> cells;
    std::istringstream row(line);
    for (std::string cell; std::getline(row, cell, '|');) {
      const auto begin = cell.find_first_not_of(' '), end = cell.find_last_not_of(' ');
      cells.push_back(begin == cell.npos ? "" : cell.substr(begin, end + 1 - begin));
    }
    // An empty cell before the first bar, two words, then a figure of each pair.
    const std::size_t column = 3 + static_cast<std::size_t>(pair);
    if (cells.size() != 3 + std::size(all_pairs)) continue;
    if (cells[1].ends_with("in float") != in_float) continue;
    char* rest = nullptr;
    std::strtod(cells[2].c_str(), &rest);
    if (rest != cells[2].c_str()) continue;  // a row of times
    const double figure = std::strtod(cells[column].c_str(), &rest);
    if (rest != cells[column].c_str()) figures[cells[1] + " | " + cells[2]] = figure;
  }
  return figures;
}

/// A figure stands for its largest error as long as that is no larger and not less than half of it;
/// of what is rounding, which another compiler changes, not less than a tenth.
void expect_documented(std::map<std::string, double>& figures, const std::string& cell,
                       double error) {
  constexpr double rounding = 1e-12, none = 1e-17;
  error = std::max(error, none);
  const double wanted = 2 * error < rounding ? 2 * error : error,
               digit = std::pow(10, std::floor(std::log10(wanted)));
  const double figure = figures.contains(cell) ? figures[cell] : 0;
  EXPECT_TRUE(error <= figure && error >= figure / (figure < rounding ? 10 : 2))
      << "README.md has " << figure << " for " << cell << " but the largest error is " << error
      << ": write " << std::ceil(wanted / digit) * digit;
  figures.erase(cell);
}

/// Of all families. `in_float` follows the quantities, " in float" or nothing.
void expect_documented(Pair pair, const std::string& in_float, const Worst& worst) {
  if (std::getenv("TOUCHSTONE_COUNT")) return;  // the figures are those of the default count
  std::map<std::string, double> figures = documented_errors(pair, !in_float.empty());
  for (const auto& [family, errors] : worst) {
    const std::string row = in_float + " | " + family;
    expect_documented(figures, "signed distance" + row, errors.distance);
    expect_documented(figures, "normal regret" + row, errors.regret);
    if (family == "hostile") continue;
    expect_documented(figures, "depth of the deepest point" + row, errors.deepest);
    expect_documented(figures, "places of points" + row, errors.places);
  }
  EXPECT_TRUE(figures.empty()) << "a row of README.md has a figure of nothing that is measured";
}

class Accuracy : public testing::TestWithParam<Pair> {};
/// Of shapes whose sizes are rounded to float.
class AccuracyInFloat : public Accuracy {};

TEST_P(Accuracy, IsWithinRoundingOfTheLargerSizeAndAsDocumented) {
  // Hostile bodies may be farther apart than they are large, or than their points are exact.
  const auto errors_of = [](const Configuration& c, bool is_hostile) {
    return Errors(c, is_hostile ? scale_of(c) : size_of(c));
  };
  const Worst worst = worst_errors(GetParam(), count_per_class(), promised, family_of, errors_of);
  expect_documented(GetParam(), "", worst);
}

/// With all numbers rounded to float; none where a size is then zero or infinite, or answers would
/// leave the range in which floats have all their digits.
std::optional<Configuration> rounded_to_float(const Configuration& c) {
  // Volatile: GCC 12 leaves out both conversions of two neighbours that it makes a vector of.
  const auto rounded = [](double x) -> double {
    const volatile float stored = static_cast<float>(x);
    return stored;
  };
  const auto vector = [&](const Vec3& x) {
    return Vec3(rounded(x.x()), rounded(x.y()), rounded(x.z()));
  };
  const auto pose = [&](const Pose& p) {
    const auto& q = p.orientation();
    return Pose(vector(p.position()),
                {rounded(q.w()), rounded(q.x()), rounded(q.y()), rounded(q.z())});
  };
  const auto shape = [&](const Shape& other) -> Shape {
    if (const auto* s = std::get_if<Plane>(&other)) {
      return Plane(vector(s->normal()), rounded(s->displacement()));
    }
    if (const auto* s = std::get_if<Sphere>(&other)) return Sphere(rounded(s->radius()));
    if (const auto* s = std::get_if<Box>(&other)) return Box(vector(s->half_extents()));
    if (const auto* s = std::get_if<Capsule>(&other)) {
      return Capsule(rounded(s->radius()), rounded(s->half_length()));
    }
    const auto& s = std::get<Cylinder>(other);
    return Cylinder(rounded(s.radius()), rounded(s.half_length()));
  };
  try {
    const Configuration result{std::get<Cylinder>(shape(c.a)), pose(c.pose_a), shape(c.b),
                               pose(c.pose_b)};
    const double far = result.pose_a.position().norm() + result.pose_b.position().norm();
    const bool is_in_range = larger_size(result) > 1e-30 && size_of(result) + far < 1e30;
    return is_in_range ? std::optional(result) : std::nullopt;
  } catch (const InvalidInput&) {
    return std::nullopt;
  }
}

/// Of answers in float about bodies that floats hold exactly.
Errors errors_in_float(const Configuration& c, double size) {
  const auto to_float = [](const Pose& p) {
    return FloatPose(p.position().cast<float>(), p.orientation().cast<float>());
  };
  const FloatPose pose_a = to_float(c.pose_a), pose_b = to_float(c.pose_b);
  return std::visit(
      [&](const auto& b) {
        const FloatSignedDistance found = signed_distance(c.a, pose_a, b, pose_b);
        // Further than the distance, however that was rounded.
        const double more = 1e-6 * (smaller_size(c) + std::abs(double(found.value)));
        const auto threshold = static_cast<float>(std::max(double(found.value), 0.0) + more);
        const FloatContact points = contact(c.a, pose_a, b, pose_b, threshold);
        Contact touch;
        touch.normal = points.normal.template cast<double>().normalized();
        touch.signed_distance = points.signed_distance;
        for (const FloatContactPoint& p : points.points()) {
          touch.add_point(p.position.template cast<double>(), p.depth);
        }
        const Vec3 normal = found.normal.template cast<double>().normalized();
        return Errors(c, size, {found.value, normal}, touch);
      },
      c.b);
}

TEST_P(AccuracyInFloat, IsThatOfRoundingAndAsDocumented) {
  constexpr double promised_of_floats = 1e-6;
  const auto family = [](Pair, const std::string& name) -> std::string {
    const bool is_far = name.find("+far") != name.npos || name.find("far+") != name.npos;
    return name == "hostile" ? name : is_far ? "far away" : "all others";
  };
  const auto errors_of = [](const Configuration& in_double, bool) -> std::optional<Errors> {
    const auto c = rounded_to_float(in_double);
    return c ? std::optional(errors_in_float(*c, scale_of(*c))) : std::nullopt;
  };
  expect_documented(
      GetParam(), " in float",
      worst_errors(GetParam(), count_per_class() / 5, promised_of_floats, family, errors_of));
}

template <class Name>
void expect_exact(const Configuration& c, const Name& name) {
  const Errors errors(c);
  EXPECT_LE(errors.distance, promised) << name;
  EXPECT_LE(errors.regret, promised) << name;
  EXPECT_LE(errors.length, 4e-15) << name;
}

// Of ten million configurations (touchstone campaign --candidates reference --count 42373) those
// with the largest errors, relative to the smaller size: all of extreme aspect. The last are coins
// deep in each other, of which the search of rims once stopped too early.
TEST(AccuracyOfTheWorst, IsWithinRoundingOfTheLargerSize) {
  for (const char* id :
       {"cylinder-sphere/aspect-needle-deep/1/18013", "cylinder-sphere/aspect-needle-deep/1/7553",
        "cylinder-cylinder/aspect-coin-deep/1/27067", "cylinder-sphere/aspect-needle/1/17514",
        "cylinder-cylinder/aspect-coin/1/41393",      "cylinder-cylinder/aspect-coin/1/2798",
        "cylinder-cylinder/aspect-needle/1/15061",    "cylinder-sphere/aspect-needle/1/23949",
        "cylinder-capsule/aspect-coin/1/18475",       "cylinder-box/aspect-needle/1/18623",
        "cylinder-capsule/aspect-needle/1/32780",     "cylinder-capsule/aspect-needle/1/830",
        "cylinder-capsule/aspect-coin/1/24641",       "cylinder-box/aspect-coin/1/9003",
        "cylinder-box/aspect-needle/1/33844",         "cylinder-plane/aspect-needle-deep/1/19335",
        "cylinder-plane/aspect-needle-deep/1/1848",   "cylinder-box/aspect-coin/1/27023",
        "cylinder-plane/aspect-needle/1/4270",        "cylinder-plane/aspect-coin/1/21195",
        "cylinder-cylinder/hostile/3/31965"}) {
    expect_exact(make_configuration(parse_identity(id)), id);
  }
}

// Configurations that were found wrong once.
TEST(AccuracyOfTheHostile, IsWithinRoundingOfTheLargerSize) {
  for (const CriticalPose& pose : critical_poses("distance")) {
    expect_exact(pose.configuration, pose.name);
  }
}

// No power of a length may overflow or vanish, of any length that a double holds.
TEST_P(Accuracy, IsTheSameAtEveryScale) {
  for (const auto& name : pose_classes(GetParam())) {
    for (std::uint64_t i = 0; i < of_each_class(GetParam(), 3); ++i) {
      const Identity id{GetParam(), name, 7, i};
      const Configuration c = make_configuration(id);
      const SignedDistance answer = signed_distance(c);
      for (const int exponent : {-700, -170, -130, -100, -82, 82, 100, 128, 140, 166, 400, 900}) {
        const double by = std::ldexp(1, exponent);
        const SignedDistance at_scale = signed_distance(scaled(c, by));
        SCOPED_TRACE(to_string(id) + " times 2^" + std::to_string(exponent));
        const double rounding = 1e-13 * larger_size(c) + 1e-15 * c.pose_a.position().norm();
        ASSERT_NEAR(at_scale.value / by, answer.value, rounding);
        ASSERT_NEAR(at_scale.normal.norm(), 1, 4e-15);
        if (GetParam() == Pair::plane) continue;  // a half-space has a gap along its normal only
        ASSERT_GE(gap(c, at_scale.normal), answer.value - rounding);
      }
    }
  }
}

// Lengths of both ends beside each other.
TEST(AccuracyOfTheHostile, HoldsForLengthsFarApart) {
  const Eigen::Quaterniond turn(0.9, 0.3, 0.2, 0.1);
  for (const double tiny : {1e-40, 1e-24, 1e-9}) {
    for (const double huge : {1e9, 1e24, 1e40}) {
      const Shape others[] = {Sphere(huge),         Sphere(tiny),         Capsule(tiny, huge),
                              Capsule(huge, tiny),  Cylinder(tiny, huge), Cylinder(huge, tiny),
                              Box({tiny, 1, huge}), Box({huge, tiny, 1})};
      for (const Shape& b : others) {
        for (const Cylinder& a : {Cylinder(tiny, huge), Cylinder(huge, tiny), Cylinder(1, 1)}) {
          const double size = std::max(largest_half_extent(a), largest_half_extent(b));
          expect_exact({a, Pose(size * Vec3(0.3, -0.4, 0.9), turn), b, Pose()},
                       testing::Message() << shape_name(b) << " " << tiny << " " << huge);
        }
      }
    }
  }
}

// Rims that are all but tangent, from outside or from within, on axes that are all but parallel:
// two stationary points lie close together in a valley that is flat to rounding.
TEST(CylinderCylinder, RimsThatNearlyTouchOnNearlyParallelAxesAreExact) {
  Random random(1);
  const auto uniform = [&](double lo, double hi) { return random.uniform(lo, hi); };
  const std::uint64_t count = 2 * count_per_class();
  for (std::uint64_t i = 0; i < count; ++i) {
    const Cylinder a(uniform(0.2, 1), uniform(0.2, 1)), b(uniform(0.2, 1), uniform(0.2, 1));
    const double hair = random.power_of_ten(-12, -5), tilt = random.power_of_ten(-13, -2);
    const double heading = uniform(0, 6.3),
                 leaning = heading + uniform(-1, 1) * random.power_of_ten(-9, 0.5);
    const double beside =
        (uniform(0, 1) < 0.5 ? a.radius() + b.radius() : std::abs(a.radius() - b.radius())) +
        random.sign() * hair * uniform(0, 1);
    const double above = a.half_length() + b.half_length() +
                         (uniform(0, 1) < 0.5 ? 1 : tilt) * random.sign() * hair * uniform(0, 1) +
                         random.sign() * tilt * a.radius();
    const Eigen::Quaterniond turn = random.turn();
    const Eigen::Quaterniond lean(1, tilt / 2 * std::cos(leaning), tilt / 2 * std::sin(leaning), 0);
    const Vec3 d(beside * std::cos(heading), beside * std::sin(heading), above);
    const Configuration c{a, Pose(turn * d, turn * lean), b, Pose(Vec3::Zero(), turn)};
    expect_exact(c, i);
  }
}

// Along normals nearly parallel to an axis, 1 - (n·u)² has no digits left where the axes are
// perpendicular to within the square root of rounding.
TEST(CylinderCylinder, RimsThatFaceEachOtherOnNearlyPerpendicularAxesAreExact) {
  const Configuration facing{Cylinder(1, 2), Pose({-0.48, -3.38, 2.66}, {1, 1.000000022, 0, 0}),
                             Cylinder(1, 1), Pose()};
  expect_exact(facing, "facing");

  Random random(1);
  const auto uniform = [&](double lo, double hi) { return random.uniform(lo, hi); };
  const std::uint64_t count = 4 * count_per_class();
  for (std::uint64_t i = 0; i < count; ++i) {
    const auto size = [&] { return std::exp2(uniform(-2, 2)); };
    const Cylinder a(size(), size()), b(size(), size());
    const double tilt = random.sign() * random.power_of_ten(-9, -7);
    const double at_a = uniform(0, 6.3), at_b = uniform(0, 6.3);
    const Vec3 rim_a(a.radius() * std::cos(at_a), random.sign() * a.half_length(),
                     a.radius() * std::sin(at_a));
    const Vec3 rim_b(b.radius() * std::cos(at_b), b.radius() * std::sin(at_b),
                     random.sign() * b.half_length());
    const Vec3 apart = random.power_of_ten(-4, 0) * std::min(a.radius(), b.radius()) *
                       Vec3(uniform(-1, 1), uniform(-1, 1), uniform(-1, 1));
    const Configuration c{a, Pose(rim_b - rim_a + apart, {1, 1 + tilt, 0, 0}), b, Pose()};
    expect_exact(c, i);
  }
}

INSTANTIATE_TEST_SUITE_P(, Accuracy, testing::ValuesIn(all_pairs), name_of_other);
INSTANTIATE_TEST_SUITE_P(, AccuracyInFloat, testing::ValuesIn(pairs_of_sizes), name_of_other);

}  // namespace
}  // namespace touchstone
