#include "oracle/rounding.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <variant>
#include <vector>

#include "oracle/body.hpp"
#include "oracle/hull.hpp"
#include "reference/invalid_input.hpp"

namespace touchstone::oracle {
namespace {

/// Rounds to multiples of a power of two; halves away from zero, so that opposite numbers stay
/// opposite.
class Grid {
 public:
  /// The spacing is 2^-bits times the largest power of two not above `size`.
  Grid(double size, int bits) : exponent_(std::ilogb(size) - bits) {}

  double nearest(double x) const {
    constexpr int min_exponent = std::numeric_limits<double>::min_exponent;
    constexpr int digits = std::numeric_limits<double>::digits;
    // Already a multiple, as is every double if the spacing is below the smallest one.
    if (x == 0 || exponent_ <= min_exponent - digits || std::ilogb(x) - (digits - 1) >= exponent_) {
      return x;
    }
    return std::scalbn(std::round(std::scalbn(x, -exponent_)), exponent_);
  }
  /// Like nearest, but at least one multiple.
  double nearest_size(double x) const {
    const double rounded = nearest(x);
    return rounded > 0 ? rounded : std::scalbn(1.0, exponent_);
  }
  Vec3 nearest(const Vec3& v) const {
    return v.unaryExpr([this](double x) { return nearest(x); });
  }

 private:
  int exponent_;
};

mpq_class change(double from, double to) { return abs(mpq_class(to) - mpq_class(from)); }

/// Upper bound of the distance from the centre of those points of a shape that a rotation moves.
mpq_class reach(const Shape& shape) {
  const Body body(shape);
  Vec3 farthest = body.half_extents;
  if (body.hull) {
    for (const Vec3& v : body.hull->vertices()) farthest = farthest.cwiseMax(v.cwiseAbs());
  }
  return mpq_class(farthest.x()) + mpq_class(farthest.y()) + mpq_class(farthest.z()) +
         mpq_class(body.disc_radius);
}

/// The hull of rounded vertices; of the given ones if rounding puts them on one line. Adds to
/// `error` how far a vertex moves at most, and by how much the rounding changes.
Convex rounded(const Convex& body, const Grid& lengths, mpq_class& error) {
  const double rounding = body.rounding() > 0 ? lengths.nearest_size(body.rounding()) : 0;
  error += change(body.rounding(), rounding);
  std::vector<Vec3> vertices;
  mpq_class farthest = 0;
  for (const Vec3& v : body.vertices()) {
    const Vec3& to = vertices.emplace_back(v.unaryExpr([&](double x) {
      return x == 0 ? x : std::copysign(lengths.nearest_size(std::abs(x)), x);
    }));
    if (to == v) continue;
    mpq_class moved = 0;
    for (int i = 0; i < 3; ++i) moved += change(v[i], to[i]);
    farthest = std::max(farthest, moved);
  }
  if (farthest == 0) return body.rounded(rounding);
  try {
    Convex hull = convex_hull(vertices, rounding);
    error += farthest;
    return hull;
  } catch (const InvalidInput&) {
    return body.rounded(rounding);
  }
}

/// Rounds an orientation and adds to `error` a bound of how far that moves a point at distance
/// `reach`.
Eigen::Quaterniond rounded(const Eigen::Quaterniond& q, int bits, const mpq_class& reach,
                           mpq_class& error) {
  const double largest = q.coeffs().cwiseAbs().maxCoeff();
  const Grid grid(largest, bits);
  Eigen::Quaterniond result = q;
  mpq_class changes = 0;
  for (int i = 0; i < 4; ++i) {
    double& component = result.coeffs()[i];
    component = grid.nearest(component);
    if (component != q.coeffs()[i]) changes += change(q.coeffs()[i], component);
  }
  if (changes != 0) error += 2 * reach * changes / mpq_class(largest);
  return result;
}

}  // namespace

RoundedConfiguration rounded_configuration(const Configuration& c, int bits) {
  if (std::holds_alternative<Plane>(c.b) || std::holds_alternative<Sphere>(c.b)) return {c, 0};
  mpq_class error = 0;
  const Grid lengths(larger_size(c), bits);
  const Resized round_shape{[&](double size) {
    const double rounded = lengths.nearest_size(size);
    if (rounded != size) error += change(size, rounded);
    return rounded;
  }};
  const Cylinder a = round_shape(c.a);
  const auto* const body = std::get_if<Convex>(&c.b);
  const Shape b = body ? rounded(*body, lengths, error) : round_shape(c.b);

  const Vec3 &from_a = c.pose_a.position(), &from_b = c.pose_b.position();
  const Vec3 to_a = lengths.nearest(from_a), to_b = lengths.nearest(from_b);
  if (to_a != from_a || to_b != from_b) {
    for (int i = 0; i < 3; ++i) {
      const mpq_class moved_a = mpq_class(to_a[i]) - mpq_class(from_a[i]);
      const mpq_class moved_b = mpq_class(to_b[i]) - mpq_class(from_b[i]);
      error += abs(moved_a - moved_b);
    }
  }
  const Eigen::Quaterniond q_a = rounded(c.pose_a.orientation(), bits, reach(a), error);
  const Eigen::Quaterniond q_b = rounded(c.pose_b.orientation(), bits, reach(b), error);
  return {{a, Pose(to_a, q_a), b, Pose(to_b, q_b)}, error};
}

namespace {

/// Shifts right by `bits`, rounding towards zero.
Integer shifted(const Integer& x, long bits) {
  Integer result;
  mpz_tdiv_q_2exp(result.get_mpz_t(), x.get_mpz_t(), static_cast<mp_bitcnt_t>(bits));
  return result;
}

}  // namespace

std::optional<FarBodies> FarBodies::brought_nearer(Difference& difference, int bits) {
  const bool makes_polynomials = difference.segments.size() > 1 || difference.hull;
  if (difference.is_plane || !makes_polynomials) return std::nullopt;
  const Integer size = sum_of_sizes(difference);
  const IntegerVector& d = difference.d;
  const long excess = std::max({bits_of(d.x), bits_of(d.y), bits_of(d.z)}) -
                      bits_of(size * difference.norm) - bits - 1;
  if (excess <= 0) return std::nullopt;
  const Difference before = difference;
  difference.d = {shifted(d.x, excess), shifted(d.y, excess), shifted(d.z, excess)};
  // The centres are now at least 2^bits S apart: the two upper bounds exceed the lower ones by less
  // than S 2^-bits, and the direction, truncated by less than √3 of D norm, is off by 4 2^-bits/S.
  mpq_class error(5 * size);
  error >>= static_cast<mp_bitcnt_t>(bits);
  return FarBodies(before, difference, std::move(error));
}

FarBodies::FarBodies(const Difference& before, const Difference& after, mpq_class error)
    : before_(before.d), after_(after.d), norm_(before.norm), error_(std::move(error)) {}

Ball FarBodies::shift() const {
  return (norm(to_balls(before_)) - norm(to_balls(after_))) / Ball(norm_);
}

}  // namespace touchstone::oracle
