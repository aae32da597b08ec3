// One class that combines all difficulties: each other class has one, while faults of contact
// routines appear where several coincide. A configuration is made in four steps, each of which
// often does nothing. (1) Draw bodies near an alignment whose features nearly meet, or a known
// failure, or a member of another class, or what rounding makes of one. (2) Move, turn and scale
// both bodies as one. (3) Change some of the numbers. (4) Bring numbers that are out of range back
// into it.
#include <algorithm>
#include <bit>
#include <cmath>
#include <utility>

#include "properties/features.hpp"
#include "properties/hulls.hpp"
#include "properties/pose_class.hpp"
#include "properties/recorded.hpp"

namespace touchstone {
namespace {

using Quaternion = Eigen::Quaterniond;

/// Bound of every length and quaternion component: sums of a few, and laws that scale by 8 or move
/// a body by 30 sizes, do not overflow.
constexpr double max_number = 0x1p1000;

/// A number with any exponent that leaves room for a few sums and products.
double draw_magnitude(Draw& draw) {
  const int exponent = static_cast<int>(draw.integer(-1000, 999));
  return std::ldexp(draw.uniform(1, 2), exponent);
}

/// A relative tilt, clearance or change from 1e-17 to 1. Values near an ulp and near its square
/// root are more frequent: there a term, or its square, drops below rounding.
double draw_small(Draw& draw) {
  switch (draw.integer(0, 3)) {
    case 0:
      return draw.log_uniform(1e-16, 1e-13);
    case 1:
      return draw.log_uniform(1e-9, 1e-6);
    default:
      return draw.log_uniform(1e-17, 1);
  }
}

/// Exactly zero in one of four draws.
double draw_small_or_zero(Draw& draw) {
  if (draw.one_in(4)) return 0;
  const double sign = draw.sign();
  return sign * draw_small(draw);
}

// SizeKind

enum class SizeKind { moderate, dyadic, extreme_aspect, any_exponent };

SizeKind draw_kind_of_sizes(Draw& draw) {
  const std::int64_t kind = draw.integer(0, 31);
  return kind < 22   ? SizeKind::moderate
         : kind < 27 ? SizeKind::dyadic
         : kind < 31 ? SizeKind::extreme_aspect
                     : SizeKind::any_exponent;
}

double draw_size(Draw& draw, SizeKind kind) {
  switch (kind) {
    case SizeKind::moderate:
      return draw.log_uniform(0.05, 2);
    case SizeKind::dyadic:
      return static_cast<double>(draw.integer(1, 16)) / 4;
    case SizeKind::extreme_aspect:
      return draw.log_uniform(1e-8, 1);
    case SizeKind::any_exponent:
      break;
  }
  return draw.coin() ? draw_magnitude(draw) : 1;
}

std::vector<double> draw_sizes(Draw& draw, Pair pair) {
  const SizeKind kind = draw_kind_of_sizes(draw);
  std::vector<double> sizes(size_count(pair));
  for (double& size : sizes) size = draw_size(draw, kind);
  // Make some sizes equal or of a simple ratio: tangent rims, congruent caps, a capsule as long as
  // the cylinder.
  for (int i = 0; i < 4 && draw.coin(); ++i) {
    const double from = draw.any_of(sizes);
    constexpr double ratios[] = {1, 1, 2, 0.5};
    draw.any_of(sizes) = from * draw.any_of(ratios);
  }
  return sizes;
}

// Orientations, as quaternions of any length

Quaternion draw_integer_quaternion(Draw& draw) {
  for (;;) {
    double v[4];
    for (double& x : v) x = static_cast<double>(draw.integer(-4, 4));
    if (v[0] != 0 || v[1] != 0 || v[2] != 0 || v[3] != 0) {
      return Quaternion(v[0], v[1], v[2], v[3]);
    }
  }
}

/// A rotation about z: by zero, quarters of a turn or any angle, often with a small error.
Quaternion draw_turn_about_z(Draw& draw) {
  const Quaternion turns[] = {Quaternion(1, 0, 0, 0), Quaternion(1, 0, 0, 1),
                              Quaternion(1, 0, 0, -1), Quaternion(0, 0, 0, 1)};
  const Quaternion turn = draw.one_in(3) ? draw.turn_about_z() : draw.any_of(turns);
  const double off = draw.coin() ? 0 : draw_small_or_zero(draw);
  return product(turn, Quaternion(1, 0, 0, off));
}

/// A small rotation about x or y, about any axis perpendicular to z, or about all three axes.
Quaternion draw_tilt(Draw& draw) {
  const double angle = draw_small_or_zero(draw);
  switch (draw.integer(0, 3)) {
    case 0:
      return Quaternion(1, angle / 2, 0, 0);
    case 1:
      return Quaternion(1, 0, angle / 2, 0);
    case 2: {
      const Vec3 axis = draw.direction_across(Vec3(0, 0, 1));
      return Quaternion(1, angle / 2 * axis.x(), angle / 2 * axis.y(), 0);
    }
    default: {
      const double about_y = draw_small_or_zero(draw), about_z = draw_small_or_zero(draw);
      return Quaternion(1, angle / 2, about_y / 2, about_z / 2);
    }
  }
}

/// A's orientation in B's frame: nearly parallel, opposite or perpendicular, or arbitrary.
Quaternion draw_relative_orientation(Draw& draw) {
  const std::int64_t kind = draw.integer(0, 15);
  if (kind == 0) return draw.orientation();
  if (kind == 1) return draw_integer_quaternion(draw);
  const Quaternion parallel[] = {Quaternion(1, 0, 0, 0), Quaternion(0, 1, 0, 0)};
  const Quaternion perpendicular[] = {Quaternion(1, 0, 1, 0), Quaternion(1, 1, 0, 0)};
  const Quaternion base = kind < 9 ? draw.any_of(parallel) : draw.any_of(perpendicular);
  const Quaternion heading = draw_turn_about_z(draw), tilt = draw_tilt(draw);
  return product(product(product(heading, base), tilt), draw_turn_about_z(draw));
}

Quaternion times(const Quaternion& q, double factor) {
  return Quaternion(q.w() * factor, q.x() * factor, q.y() * factor, q.z() * factor);
}

/// The same orientation as a quaternion of a length of one, nearly one, or far from it.
Quaternion with_a_length(Draw& draw, const Quaternion& q) {
  switch (draw.integer(0, 7)) {
    case 0:
    case 1:
      return q;
    case 2:
      return times(normalized(q), 1 + draw_small_or_zero(draw));
    case 3: {
      const int exponent = static_cast<int>(draw.one_in(8) ? draw.integer(-900, 900) : 1);
      return times(normalized(q), std::ldexp(1, exponent));
    }
    default:
      return normalized(q);
  }
}

/// Points with a hull: of any form and up to the size of a given body, or of small whole numbers,
/// so that faces are plane and edges aligned to the last bit.
std::vector<Vec3> draw_vertices(Draw& draw, const std::vector<double>& sizes) {
  constexpr HullForm forms[] = {HullForm::usual,          HullForm::regular,  HullForm::of_box,
                                HullForm::of_prism,       HullForm::triangle, HullForm::wedge,
                                HullForm::nearly_coplanar};
  for (;;) {
    std::vector<Vec3> points;
    if (draw.one_in(3)) {
      const auto coordinate = [&] { return static_cast<double>(draw.integer(-2, 2)); };
      for (std::int64_t count = draw.integer(3, 10); count > 0; --count) {
        points.push_back({coordinate(), coordinate(), coordinate()});
      }
    } else {
      const auto proportions = draw.one_in(8) ? Proportions::plate : Proportions::usual;
      points = draw_hull_points(draw, draw.any_of(forms), proportions);
    }
    const double size = draw.any_of(sizes);
    for (Vec3& p : points) p *= size;
    if (has_hull(points)) return points;
  }
}

// Positions

/// Lengths at which parts of the two shapes are: a hull's are those of its vertices' coordinates.
std::vector<double> lengths_of(const Numbers& n) {
  std::vector<double> lengths = n.sizes;
  for (const Vec3& vertex : n.vertices) {
    for (int i = 0; i < 3; ++i) lengths.push_back(std::abs(vertex[i]));
  }
  return lengths;
}

/// A coordinate at which parts of the two shapes coincide, or any within their reach, often with a
/// small error.
double draw_coordinate(Draw& draw, const std::vector<double>& sizes) {
  const double one = draw.any_of(sizes), other = draw.any_of(sizes);
  double at = 0;
  switch (draw.integer(0, 7)) {
    case 0:
      break;
    case 1:
      at = draw.sign() * one;
      break;
    case 2:
    case 3:
      at = draw.sign() * (one + other);
      break;
    case 4:
      at = draw.sign() * (one - other);
      break;
    default:
      at = 2 * draw.uniform(-1, 1) * (one + other);
  }
  const double clearance = draw.coin() ? 0 : draw_small_or_zero(draw);
  return at + clearance * one;
}

/// An offset along and across one of the bodies' axes, or with three coordinates.
Vec3 draw_aligned_offset(Draw& draw, const Numbers& n) {
  const std::vector<double> sizes = lengths_of(n);
  const double across = draw_coordinate(draw, sizes), along = draw_coordinate(draw, sizes);
  const double aside = draw.coin() ? 0 : draw_coordinate(draw, sizes);
  const Vec3 headings[] = {Vec3(1, 0, 0), Vec3(0, 1, 0), draw.direction_across(Vec3(0, 0, 1))};
  const Vec3 e = draw.any_of(headings);
  const Vec3 offset(across * e.x() - aside * e.y(), across * e.y() + aside * e.x(), along);
  return rotated(draw.coin() ? n.orientation_b : n.orientation_a, offset);
}

std::vector<Feature> features_of_b(Pair pair) {
  using enum Feature;
  switch (pair) {
    case Pair::plane:
      return {cap};
    case Pair::sphere:
      return {end};
    case Pair::capsule:
      return {side, end};
    case Pair::cylinder:
      return {cap, side, rim, rim};
    case Pair::box:
    case Pair::convex:
      break;
  }
  return {cap, edge, vertex};
}

/// An offset at which drawn features meet with a clearance that is positive, negative or zero.
Vec3 draw_meeting_offset(Draw& draw, const Numbers& n) {
  using enum Feature;
  const Configuration shapes = configuration_of(n);
  const Quaternion turn_a = normalized(n.orientation_a), turn_b = normalized(n.orientation_b);
  constexpr Feature of_a[] = {cap, side, rim, rim};
  const std::vector<Feature> of_b = features_of_b(n.pair);
  const Feature on_a = draw.any_of(of_a), on_b = draw.any_of(of_b);
  const double size = draw.any_of(n.sizes), clearance = size * draw_small_or_zero(draw);
  const Configuration met = meet(draw, {shapes.a, turn_a, shapes.b, turn_b}, on_a, on_b, clearance);
  return met.pose_a.position() - met.pose_b.position();
}

/// The offset from B's centre to A's.
Vec3 draw_offset(Draw& draw, const Numbers& n) {
  return draw.coin() ? draw_meeting_offset(draw, n) : draw_aligned_offset(draw, n);
}

/// B's position: mostly at or near the origin, sometimes far away, or at a distance that is
/// negligible against all other lengths.
Vec3 draw_place(Draw& draw) {
  const std::int64_t kind = draw.integer(0, 15);
  if (kind < 8) return Vec3::Zero();
  Vec3 direction = draw.direction();
  if (kind < 13) return direction;
  if (kind < 15) return draw.log_uniform(1e-17, 1e17) * direction;
  return Vec3(std::ldexp(direction.x(), -1070), 0, 0);
}

Numbers draw_bodies_near_contact(Draw& draw, Pair pair) {
  Numbers n;
  n.pair = pair;
  n.sizes = draw_sizes(draw, pair);
  if (pair == Pair::convex) n.vertices = draw_vertices(draw, n.sizes);
  if (pair == Pair::plane) {
    n.normal = draw.coin() ? Vec3(0, 0, 1) : draw.direction();
    n.displacement = draw.coin() ? 0 : draw_coordinate(draw, n.sizes);
  }
  const Quaternion frames[] = {Quaternion(1, 0, 0, 0), draw_integer_quaternion(draw),
                               draw.orientation()};
  n.orientation_b = draw.any_of(frames);
  n.orientation_a = product(n.orientation_b, draw_relative_orientation(draw));
  n.position_b = draw_place(draw);
  n.position_a = n.position_b + draw_offset(draw, n);
  return n;
}

Numbers draw_known_failure(Draw& draw, Pair pair) {
  const auto& known = known_failures(pair);
  return draw.coin() ? known.front()
                     : draw.any_of(known);  // the first is often of our own routines
}

Numbers draw_from_a_class(Draw& draw, Pair pair) {
  return numbers_of(draw.any_of(old_classes(pair)).generate(draw));
}

int draw_exponent(Draw& draw) {
  constexpr std::int64_t reaches[] = {20, 200, 1000};
  const std::int64_t reach = draw.any_of(reaches);
  return static_cast<int>(draw.integer(-reach, reach));
}

// Single numbers

/// The double that many places away in the order of all doubles of the same sign.
double neighbour(double x, std::int64_t places) {
  const auto magnitude = std::bit_cast<std::int64_t>(std::abs(x)) + places;
  return magnitude < 0 ? 0 : std::copysign(std::bit_cast<double>(magnitude), x);
}

double to_a_dyadic(Draw& draw, double x) {
  const int digits = static_cast<int>(draw.integer(0, 8));
  return std::ldexp(std::floor(std::ldexp(x, digits)), -digits);
}

void change_one(Draw& draw, const std::vector<double*>& numbers) {
  double& x = *draw.any_of(numbers);
  double& other = *draw.any_of(numbers);
  switch (draw.integer(0, 15)) {
    case 0:
    case 1:
    case 2:
      x = neighbour(x, draw.integer(-4, 4));
      break;
    case 3:
    case 4:
    case 5:
      x += x * draw_small_or_zero(draw);
      break;
    case 6:
    case 7:
      x += draw_small_or_zero(draw);
      break;
    case 8:
      x = -x;
      break;
    case 9:
      std::swap(x, other);
      break;
    case 10: {
      constexpr double ratios[] = {1, 1, -1, 2, 0.5};
      x = other * draw.any_of(ratios);
      break;
    }
    case 11:
      x = 0;
      break;
    case 12:
      x = to_a_dyadic(draw, x);
      break;
    case 13:
      x = static_cast<double>(draw.integer(-4, 4));
      break;
    case 14:
      x = draw_small_or_zero(draw);
      break;
    default: {
      const double sign = draw.sign();
      if (draw.one_in(4)) x = sign * draw_magnitude(draw);
      if (draw.one_in(4)) x = sign * neighbour(0, draw.integer(1, 1000));
    }
  }
}

// Into range

double in_range(double x) {
  if (std::isnan(x)) return 0;
  return std::abs(x) <= max_number ? x : std::copysign(max_number, x);
}

bool is_zero(const Quaternion& q) { return q.w() == 0 && q.x() == 0 && q.y() == 0 && q.z() == 0; }

/// Makes sizes positive, quaternions and normals nonzero, of vertices on a line a triangle, and a
/// plane's distance from its origin at most max_number.
void make_valid(Numbers& n) {
  for (double* x : every_number(n)) *x = in_range(*x);
  for (double& size : n.sizes) size = size == 0 ? 1 : std::abs(size);
  if (is_zero(n.orientation_a)) n.orientation_a.w() = 1;
  if (is_zero(n.orientation_b)) n.orientation_b.w() = 1;
  if (n.pair == Pair::convex && !has_hull(n.vertices)) {
    n.vertices = {Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(0, 0, 1)};
  }
  if (n.pair != Pair::plane) return;
  if (n.normal.x() == 0 && n.normal.y() == 0 && n.normal.z() == 0) n.normal.z() = 1;
  const double length =
      std::max({std::abs(n.normal.x()), std::abs(n.normal.y()), std::abs(n.normal.z())});
  if (!(std::abs(n.displacement) / length <= max_number)) n.displacement = 0;
}

/// Numbers of which at least `min_changes` are to be changed; each further one with probability
/// 1/one_more_in.
struct Source {
  Numbers numbers;
  int min_changes;
  std::int64_t one_more_in;
};

Source draw_source(Draw& draw, Pair pair) {
  const std::int64_t kind = draw.integer(0, 7);
  if (kind == 0 && !known_failures(pair).empty()) return {draw_known_failure(draw, pair), 1, 2};
  if (kind == 1) return {draw_from_a_class(draw, pair), 1, 2};
  Numbers n = draw_bodies_near_contact(draw, pair);
  n.orientation_a = with_a_length(draw, n.orientation_a);
  n.orientation_b = with_a_length(draw, n.orientation_b);
  return {std::move(n), 0, 4};
}

/// What rounding makes of an exact arrangement.
Configuration draw_worn(Draw& draw, Pair pair) {
  std::vector<PoseClass> exact;
  // Later ones than suite 2, and those of a pair's first one, would change what is drawn.
  const int suite = std::max(2, arrangements(pair).front().suite);
  for (const Arrangement& a : arrangements(pair)) {
    if (a.is_exact() && a.suite <= suite) exact.push_back({pair, &a, {}});
  }
  PoseClass c = draw.any_of(exact);
  std::vector<Clearance> clearances = c.arrangement->clearances;
  clearances.push_back(Clearance::usual);
  c.modifiers[ModifierKind::clearance] = static_cast<int>(draw.any_of(clearances));
  c.modifiers[ModifierKind::frame] = static_cast<int>(Frame::worn);
  return c.generate(draw);
}

Configuration draw_hostile(Draw& draw, Pair pair) {
  auto [n, changes, one_more_in] = draw_source(draw, pair);
  if (draw.one_in(4))
    turn_both(n, draw.coin() ? draw.orientation() : draw_integer_quaternion(draw));
  if (draw.one_in(8)) scale_both(n, draw_exponent(draw));
  constexpr int max_changes = 5;
  while (changes < max_changes && draw.one_in(one_more_in)) ++changes;
  for (const auto numbers = every_number(n); changes > 0; --changes) change_one(draw, numbers);
  make_valid(n);
  // Drawn last, so that the numbers of all other configurations stay.
  if (draw.one_in(6)) return configuration_of(draw_entangled(draw, pair));
  if (draw.one_in(7)) return draw_worn(draw, pair);
  return configuration_of(n);
}

}  // namespace

Arrangement hostile(Pair pair) {
  return {
      "hostile",
      "Everything at once: tilts and clearances of any size about alignments and meeting "
      "features, exact coincidences and what rounding makes of them, neighbours of doubles, any "
      "exponent, and known failures with a few numbers changed.",
      Arrangement::Orientations::mixed,
      {},
      [pair](Draw& draw, const Modifiers&) { return draw_hostile(draw, pair); }};
}

}  // namespace touchstone
