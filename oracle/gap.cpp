// The gap along a given direction, and the regret of having chosen it.
#include <algorithm>
#include <optional>
#include <stdexcept>

#include "oracle/difference.hpp"
#include "oracle/truth.hpp"
#include "reference/invalid_input.hpp"

namespace touchstone::oracle {
namespace {

constexpr long first_bits = 128;
constexpr long last_bits = 1L << 16;

/// The gap against the column of the half-space beneath the cylinder's circumsphere (see
/// oracle::certified_gap). With α between n and the plane's normal, D the centre's height and ρ the
/// circumradius: D cos α − h_A(n) − ρ sin α − 2ρ max(0, −cos α).
Ball gap_above_column(const Difference& difference, const BallDifference& balls,
                      const BallVector& n) {
  const BallVector up = to_balls(difference.plane_normal);
  const Ball length = norm(n), up_length = norm(up);
  const Ball cosine = dot(n, up) / (length * up_length);
  const Ball sine = norm(cross(n, up)) / (length * up_length);
  const Ball height = balls.along(up).centre_distance;
  const Ball radius(difference.discs.front().radius);
  const Ball half_length(difference.segments.front().half_length);
  const Ball circumradius = sqrt(square(radius) + square(half_length));
  const Ball below = (abs(cosine) - cosine) * circumradius;  // twice max(0, −cos α) times ρ
  return height * cosine - balls.along(n).half_width - circumradius * sine - below;
}

}  // namespace

/// The exact difference is made once; so are its balls of the first precision, which is nearly
/// always enough.
struct Gaps::State {
  State(const Configuration& configuration, double width)
      : difference(make_difference(configuration)),
        wanted(width_in_units(difference, configuration, width)) {}

  /// In units.
  struct Ends {
    Float lo, hi;
  };
  /// No wider than wanted.
  Ends along(const Vec3& n) {
    if (!n.allFinite() || n.isZero(0)) {
      throw InvalidInput("n", "not a direction", "must be finite and not zero");
    }
    const IntegerVector direction = in_frame_of_a(difference, n);
    for (long bits = first_bits; bits <= last_bits; bits *= 2) {
      const WorkingPrecision precision(bits);
      if (bits == first_bits && !first) first.emplace(difference);
      const Ball value =
          bits == first_bits ? gap(*first, direction) : gap(BallDifference(difference), direction);
      if (!value.is_finite()) continue;
      Ends ends{value.lower_end(), value.upper_end()};
      if (!(wanted < ends.hi - ends.lo)) return ends;
    }
    throw std::logic_error("oracle: the gap could not be enclosed");
  }

  Ball gap(const BallDifference& balls, const IntegerVector& direction) const {
    const BallVector n = to_balls(direction);
    return difference.is_plane ? gap_above_column(difference, balls, n) : balls.gap(n);
  }

  Difference difference;
  Float wanted;  ///< width in units
  std::optional<BallDifference> first;
};

Gaps::Gaps(const Configuration& configuration, double width)
    : state_(std::make_unique<State>(configuration, width)) {}
Gaps::Gaps(Gaps&&) noexcept = default;
Gaps& Gaps::operator=(Gaps&&) noexcept = default;
Gaps::~Gaps() = default;

Enclosure Gaps::along(const Vec3& n) {
  const State::Ends gap = state_->along(n);
  const Integer& metre = state_->difference.per_metre;
  return {gap.lo.rational() / metre, gap.hi.rational() / metre};
}

double Gaps::regret(const Truth& truth, const Vec3& n) {
  const State::Ends gap = state_->along(n);
  // (a/b + c/d)/2 − (lo + hi)/(2m) as one quotient, for a common factor costs more than the rest.
  const auto number = [](const mpz_class& x) { return Float(x); };
  const mpq_class &lo = truth.signed_distance.lo, &hi = truth.signed_distance.hi;
  const Float b = number(lo.get_den()), d = number(hi.get_den());
  const Float m = number(state_->difference.per_metre), bd = b * d;
  const Float sum = (number(lo.get_num()) * d + number(hi.get_num()) * b) * m;
  const Float regret = sum - (gap.lo + gap.hi) * bd;
  return std::max(0.0, quotient(regret, Float(2.0) * bd * m));
}

Enclosure certified_gap(const Configuration& configuration, const Vec3& n, double width) {
  return Gaps(configuration, width).along(n);
}

double normal_regret(const Configuration& configuration, const Truth& truth, const Vec3& n) {
  return Gaps(configuration).regret(truth, n);
}

}  // namespace touchstone::oracle
