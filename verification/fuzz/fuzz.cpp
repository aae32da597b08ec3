#include "verification/fuzz/fuzz.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>
#include <limits>

#include "properties/draw.hpp"
#include "properties/moves.hpp"
#include "properties/numbers.hpp"

namespace touchstone {
namespace {

/// What README promises of distances and normals, relative to `scale`; and of the deepest point's
/// depth.
constexpr double promised = 1e-13, promised_above = 1e-12, promised_below = 1e-6;

/// The larger size, or how far the bodies or the plane are apart.
double scale_of(const Configuration& c) {
  const auto* plane = std::get_if<Plane>(&c.b);
  return std::max({larger_size(c), (c.pose_a.position() - c.pose_b.position()).stableNorm(),
                   plane ? std::abs(plane->unit_displacement()) : 0});
}

std::optional<std::string> contradiction(const OwnAnswers& own, double scale) {
  const double sigma = own.certified.value, rounding = promised * scale;
  if (!(std::abs(own.distance.value - sigma) <= rounding)) {
    return fmt::format("signed_distance {:a}, certified_distance {:a}", own.distance.value, sigma);
  }
  const bool is_contact = !own.contact.points().empty();
  if (std::abs(sigma) > rounding && (own.overlaps != (sigma < 0) || is_contact != (sigma < 0))) {
    return fmt::format("certified_distance {:a}, overlaps {}, contact {}", sigma, own.overlaps,
                       is_contact);
  }
  if (!is_contact) return std::nullopt;
  double deepest = -std::numeric_limits<double>::infinity();
  for (const ContactPoint& p : own.contact.points()) deepest = std::max(deepest, p.depth);
  if (!(std::abs(own.contact.signed_distance - sigma) <= rounding)) {
    return fmt::format("contact {:a}, certified_distance {:a}", own.contact.signed_distance, sigma);
  }
  if (!(deepest <= -sigma + promised_above * scale && deepest >= -sigma - promised_below * scale)) {
    return fmt::format("deepest point {:a}, certified_distance {:a}", deepest, sigma);
  }
  return std::nullopt;
}

std::optional<std::string> untruth(const Configuration& c, const OwnAnswers& own, double scale,
                                   const oracle::Truth& truth) {
  const double sigma = truth.signed_distance.midpoint(), rounding = promised * scale;
  if (!(std::abs(own.distance.value - sigma) <= rounding)) {
    return fmt::format("signed_distance {:a}, truth {:a}", own.distance.value, sigma);
  }
  if (!(std::abs(own.certified.value - sigma) <= own.certified.error_bound)) {
    return fmt::format("certified_distance {:a} ± {}, truth {:a}", own.certified.value,
                       own.certified.error_bound, sigma);
  }
  for (const Vec3& n : {own.distance.normal, own.certified.normal}) {
    const double regret = oracle::normal_regret(c, truth, n);
    if (!(regret <= rounding)) return fmt::format("normal regret {}", regret);
  }
  return std::nullopt;
}

}  // namespace

OwnAnswers own_answers(const Configuration& c) {
  return {signed_distance(c), certified_distance(c), contact(c, 0), overlaps(c)};
}

std::optional<std::string> disagreement(const Configuration& c, const OwnAnswers& own,
                                        const oracle::Truth* truth) {
  const double scale = scale_of(c);
  auto found = contradiction(own, scale);
  if (!found && truth) found = untruth(c, own, scale, *truth);
  return found;
}

namespace {

class Reader {
 public:
  explicit Reader(std::span<const std::uint8_t> bytes) : rest_(bytes) {}

  unsigned byte() {
    if (rest_.empty()) return 0;
    const unsigned value = rest_.front();
    rest_ = rest_.subspan(1);
    return value;
  }

  /// Between 2^lo and 2^(hi + 1): a byte of exponent, six of mantissa.
  double magnitude(int lo, int hi) {
    const int exponent = lo + static_cast<int>(byte()) % (hi - lo + 1);
    std::uint64_t mantissa = 0;
    for (int i = 0; i < 6; ++i) mantissa = mantissa << 8 | byte();
    return std::ldexp(1 + std::ldexp(static_cast<double>(mantissa), -48), exponent);
  }

  /// Zero where the byte before it is small, else a magnitude with a sign.
  double difference(int lo, int hi) {
    constexpr unsigned none = 96;
    const unsigned kind = byte();
    if (kind < none) return 0;
    return (kind % 2 == 0 ? 1 : -1) * magnitude(lo, hi);
  }

 private:
  std::span<const std::uint8_t> rest_;
};

constexpr int least_exponent = -60;

/// An earlier size, or one of its own.
double size_of(Reader& in, const std::vector<double>& earlier) {
  constexpr unsigned equal = 64;
  const unsigned kind = in.byte();
  if (kind < equal && !earlier.empty()) return earlier[kind % earlier.size()];
  return in.magnitude(-7, 6);
}

/// Nothing, a size, or a sum or difference of two.
double offset_of(Reader& in, const std::vector<double>& sizes) {
  const unsigned kind = in.byte(), which = in.byte();
  const double one = sizes[which % sizes.size()], two = sizes[which / 16 % sizes.size()];
  const double offset = std::array{0.0, one, one + two, one - two}[kind % 4];
  return kind / 4 % 2 == 0 ? offset : -offset;
}

/// A turn by a vector, which may be zero.
Eigen::Quaterniond turn_of(Reader& in) {
  const double x = in.difference(least_exponent, 0), y = in.difference(least_exponent, 0);
  const double z = in.difference(least_exponent, 0);
  return normalized(Eigen::Quaterniond(1, x, y, z));
}

/// Any orientation, or none.
Eigen::Quaterniond frame_of(Reader& in) {
  const double w = in.difference(-3, 0), x = in.difference(-3, 0), y = in.difference(-3, 0);
  const double z = in.difference(-3, 0);
  if (w == 0 && x == 0 && y == 0 && z == 0) return upright;
  return normalized(Eigen::Quaterniond(w, x, y, z));
}

/// A triangle, so that no hull is a line, and up to six points more.
void add_vertices(Reader& in, Numbers& n) {
  for (int k = 0; k < 3; ++k) n.vertices.push_back(n.sizes[0] * Vec3::Unit(k));
  for (unsigned i = in.byte() % 7; i > 0; --i) {
    Vec3& v = n.vertices.emplace_back();
    for (double& x : v) x = offset_of(in, n.sizes) + in.difference(least_exponent, 1) * n.sizes[0];
  }
}

}  // namespace

Configuration configuration_from_bytes(std::span<const std::uint8_t> bytes) {
  // Those with a search are worth more.
  constexpr std::array pairs = {Pair::cylinder, Pair::box,    Pair::capsule,  Pair::cylinder,
                                Pair::plane,    Pair::sphere, Pair::cylinder, Pair::convex};
  constexpr std::array along = {&upright, &along_x, &along_y};
  Reader in(bytes);
  Numbers n;
  n.pair = pairs[in.byte() % pairs.size()];
  const unsigned axes = in.byte();
  for (std::size_t i = size_count(n.pair); i > 0; --i) n.sizes.push_back(size_of(in, n.sizes));
  n.orientation_a = product(turn_of(in), *along[axes % along.size()]);
  for (int i = 0; i < 3; ++i) n.position_a[i] = offset_of(in, n.sizes);
  for (int i = 0; i < 3; ++i) {
    n.position_a[i] += in.difference(least_exponent, 1) * n.sizes[0];
  }
  if (n.pair == Pair::convex) add_vertices(in, n);
  if (n.pair == Pair::plane) {
    n.normal = rotated(turn_of(in), Vec3::UnitZ());
    n.displacement = offset_of(in, n.sizes);
  }
  turn_both(n, frame_of(in));
  return configuration_of(n);
}

}  // namespace touchstone
