// The gap along a given direction, and the regret of having chosen it.
#include <algorithm>
#include <optional>
#include <stdexcept>
#include <utility>
#include <vector>

#include "oracle/difference.hpp"
#include "oracle/truth.hpp"
#include "reference/invalid_input.hpp"

namespace touchstone::oracle {
namespace {

constexpr long first_gap_bits = 128;
constexpr long last_gap_bits = 1L << 16;

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
  const Ball circumradius = sqrt(square(radius) + square(half_length)) + Ball(difference.inflation);
  const Ball below = (abs(cosine) - cosine) * circumradius;  // twice max(0, −cos α) times ρ
  return height * cosine - balls.along(n).half_width - circumradius * sine - below;
}

/// In units.
struct Ends {
  Float lo, hi;
};

/// The exact difference is made once; so are its balls of the first precision, which is nearly
/// always enough.
class Gaps {
 public:
  Gaps(const Configuration& configuration, double width)
      : difference_(make_difference(configuration)),
        wanted_(width_in_units(difference_, configuration, width)) {}

  /// No wider than wanted.
  Ends along(const Vec3& n) {
    if (!n.allFinite() || n.isZero(0)) {
      throw InvalidInput("n", "not a direction", "must be finite and not zero");
    }
    const IntegerVector direction = in_frame_of_a(difference_, n);
    for (long bits = first_gap_bits; bits <= last_gap_bits; bits *= 2) {
      const WorkingPrecision precision(bits);
      if (bits == first_gap_bits && !first_) first_.emplace(difference_);
      const Ball value = bits == first_gap_bits ? gap(*first_, direction)
                                                : gap(BallDifference(difference_), direction);
      if (!value.is_finite()) continue;
      Ends ends{value.lower_end(), value.upper_end()};
      if (!(wanted_ < ends.hi - ends.lo)) return ends;
    }
    throw std::logic_error("oracle: the gap could not be enclosed");
  }

  /// In metres.
  Enclosure enclosure_along(const Vec3& n) {
    const Ends gap = along(n);
    return {gap.lo.rational() / per_metre(), gap.hi.rational() / per_metre()};
  }

  const Integer& per_metre() const { return difference_.per_metre; }

 private:
  Ball gap(const BallDifference& balls, const IntegerVector& direction) const {
    const BallVector n = to_balls(direction);
    return difference_.is_plane ? gap_above_column(difference_, balls, n) : balls.gap(n);
  }

  Difference difference_;
  Float wanted_;  ///< width in units
  std::optional<BallDifference> first_;
};

constexpr double gap_width = 1e-15;

}  // namespace

struct Regrets::State {
  /// (a/b + c/d)/2 − (lo + hi)/(2m) = ((ad + cb)m − (lo + hi)bd)/(2bdm) is one quotient, for a
  /// common factor costs more than the rest.
  State(const Configuration& configuration, const Truth& truth) : gaps(configuration, gap_width) {
    const mpq_class &lo = truth.signed_distance.lo, &hi = truth.signed_distance.hi;
    const Float b(lo.get_den()), d(hi.get_den()), m(gaps.per_metre());
    denominators = b * d;
    distances = (Float(lo.get_num()) * d + Float(hi.get_num()) * b) * m;
    divisor = Float(2.0) * denominators * m;
  }

  double of(const Vec3& n) {
    const Ends gap = gaps.along(n);
    return std::max(0.0, quotient(distances - (gap.lo + gap.hi) * denominators, divisor));
  }

  Gaps gaps;
  Float denominators, distances, divisor;  ///< bd, (ad + cb)m and 2bdm
  std::vector<std::pair<Vec3, double>> known;
};

Regrets::Regrets(const Configuration& configuration, const Truth& truth)
    : state_(std::make_unique<State>(configuration, truth)) {}
Regrets::Regrets(Regrets&&) noexcept = default;
Regrets::~Regrets() = default;

Enclosure Regrets::gap(const Vec3& n) { return state_->gaps.enclosure_along(n); }

double Regrets::of(const Vec3& n) {
  for (const auto& [direction, regret] : state_->known) {
    if (direction == n) return regret;
  }
  return state_->known.emplace_back(n, state_->of(n)).second;
}

Enclosure certified_gap(const Configuration& configuration, const Vec3& n, double width) {
  return Gaps(configuration, width).enclosure_along(n);
}

double normal_regret(const Configuration& configuration, const Truth& truth, const Vec3& n) {
  return Regrets(configuration, truth).of(n);
}

}  // namespace touchstone::oracle
