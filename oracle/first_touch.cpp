#include "oracle/first_touch.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "oracle/displacement.hpp"
#include "oracle/rounding.hpp"
#include "oracle/survivors.hpp"
#include "oracle/turning_touch.hpp"
#include "reference/invalid_input.hpp"

namespace touchstone::oracle {
namespace {

// The signed distance σ(t) of a translation is the largest of affine functions of t, the gaps along
// fixed directions. A positive one, g + s·τ at t + τ, proves σ > 0 as far as it is positive itself:
// to the right up to t + g/−s, and for ever if s >= 0, to the left likewise. That is Newton's
// method from the left, whose steps never go too far; the other end is any t with a proven σ <= 0.

/// Where bodies graze as spheres do, the way left is halved with each step; 2^-67 of it is asked.
constexpr int max_steps = 400;

constexpr long first_touch_bits = 160, last_touch_bits = 1280;

/// What one moment proves.
struct Moment {
  enum class Kind { apart, together, unknown } kind;
  /// If apart: they are, from one of these times on until the other; none: without end.
  std::optional<mpq_class> from, until;
};

/// a/b rounded down (up) to `bits` digits, for b > 0.
mpq_class quotient_below(const Float& a, const Float& b, arf_rnd_t rounding = ARF_RND_FLOOR) {
  constexpr long bits = 128;
  Float result;
  arf_div(result.get(), a.get(), b.get(), bits, rounding);
  return result.rational();
}

class Translation {
 public:
  /// The sweep is rounded as a position is.
  Translation(const Configuration& given, const Vec3& sweep)
      : Translation(rounded_configuration(given),
                    rounded_configuration({given.a, Pose(sweep), given.b, Pose()})) {}

  /// A time until which the bodies are apart as balls about both are; none if for ever. From far
  /// away that is much nearer, and costs next to nothing.
  std::optional<mpq_class> apart_as_balls() const {
    const WorkingPrecision precision(ball_bits);
    const Ball radius(Integer(sum_of_sizes(start_) * start_.norm), ball_bits);
    mpq_class t = 0;
    for (int step = 0; step < max_steps; ++step) {
      const BallVector d = difference_at(t);
      const Ball length = norm(d), distance = length - radius;
      if (!distance.is_positive()) return t;
      const Ball speed = dot(d, sweep_balls()) / length;
      if (speed.lower_end().sign() >= 0) return std::nullopt;
      const bool is_near = !(length - Ball(4) * radius).is_positive();
      Ball time = distance / -speed;
      if (!time.is_finite()) return t;
      Float free = time.lower_end();
      if (free.sign() <= 0) return t;
      constexpr long few_digits = 24;  // short times make short polynomials
      arf_set_round(free.get(), free.get(), few_digits, ARF_RND_FLOOR);
      t += free.rational();
      if (is_near || t > 1) return t;
    }
    return t;
  }

  Moment at(const mpq_class& t) const {
    Difference difference = start_;
    move_a(difference, sweep_, t);
    const mpq_class error_in_units = error_ * difference.per_metre;
    const Float error = error_ == 0 ? Float() : Ball(error_in_units).upper_end();
    std::vector<Survivor> survivors = all_directions(difference, 0);
    for (long bits = first_touch_bits; bits <= last_touch_bits; bits *= 2) {
      const WorkingPrecision precision(bits);
      const BallDifference balls(difference);
      enclose(survivors, difference, balls);
      const Maximum best = maximum(survivors);
      if (!best.lo || !best.hi) continue;
      const Float lo = *best.lo - error, hi = *best.hi + error;
      const bool is_known = hi < lo + lo;  // a tangent as good as any
      if (lo.sign() > 0 && (is_known || 2 * bits > last_touch_bits)) {
        return apart(survivors, difference, error, t);
      }
      const bool may_be_zero = lo.sign() <= 0 && hi.sign() > 0 && error.sign() == 0;
      if (hi.sign() <= 0 || (may_be_zero && is_exactly_zero(survivors, difference))) {
        return {Moment::Kind::together, {}, {}};
      }
    }
    return {Moment::Kind::unknown, {}, {}};
  }

  double length() const { return sweep_.stableNorm(); }
  bool is_over_plane() const { return start_.is_plane; }

 private:
  static constexpr long ball_bits = 128;

  Translation(const RoundedConfiguration& start, const RoundedConfiguration& sweep)
      : start_(exact_difference(start.configuration)),
        sweep_(sweep.configuration.pose_a.position()),
        error_(start.error + sweep.error),
        in_units_(in_units(start_, sweep_)),
        direction_(in_frame_of_a(start_, sweep_)) {}

  BallVector sweep_balls() const {
    return {Ball(in_units_.x), Ball(in_units_.y), Ball(in_units_.z)};
  }
  BallVector difference_at(const mpq_class& t) const {
    const auto at = [&](const Integer& d, const mpq_class& by) {
      return Ball(mpq_class(d + t * by));
    };
    return {at(start_.d.x, in_units_.x), at(start_.d.y, in_units_.y), at(start_.d.z, in_units_.z)};
  }

  /// How far and how long every direction with a positive gap keeps the bodies apart.
  Moment apart(const std::vector<Survivor>& survivors, const Difference& difference,
               const Float& error, const mpq_class& t) const {
    Moment moment{Moment::Kind::apart, t, t};
    mpq_class finer(difference.per_metre, start_.per_metre * difference.norm);
    finer.canonicalize();
    const Ball to_units(finer);
    const BallVector sweep = sweep_balls();
    for (const auto& [direction, bounds] : survivors) {
      for (const DirectionBound& bound : bounds) {
        if (!bound.normal || !bound.gap.is_finite()) continue;
        const Float gap = bound.gap.lower_end() - error;
        if (gap.sign() <= 0) continue;
        Ball slope = to_units * dot(sweep, *bound.normal) / norm(*bound.normal);
        if (!slope.is_finite()) continue;
        if (slope.contains_zero() && direction->is_across(direction_)) slope = Ball(0);
        const Float least = slope.lower_end(), most = slope.upper_end();
        if (least.sign() >= 0) {
          moment.until.reset();
        } else if (moment.until) {
          const mpq_class time = t + quotient_below(gap, Float() - least);
          moment.until = std::max(*moment.until, time);
        }
        if (most.sign() <= 0) {
          moment.from.reset();
        } else if (moment.from) {
          const mpq_class time = t - quotient_below(gap, most);
          moment.from = std::min(*moment.from, time);
        }
      }
    }
    return moment;
  }

  Difference start_;
  Vec3 sweep_;
  mpq_class error_;
  Vector3<mpq_class> in_units_;  ///< the sweep
  IntegerVector direction_;      ///< of the sweep, in A's frame
};

FirstTouch no_touch() { return {FirstTouch::Status::never, {1, 1}, {}}; }

FirstTouch touch_of_translation(const Configuration& c, const Vec3& sweep, double width) {
  using Status = FirstTouch::Status;
  const Translation translation(c, sweep);
  Moment moment = translation.at(0);
  if (moment.kind == Moment::Kind::together) {
    return {Status::from_start, {0, 0}, truth(c)};
  }
  if (moment.kind == Moment::Kind::unknown) return {Status::undecided, {0, 0}, {}};
  if (!moment.until) return no_touch();
  mpq_class until = *moment.until;  // they are apart before it
  if (!translation.is_over_plane()) {
    const std::optional<mpq_class> as_balls = translation.apart_as_balls();
    if (!as_balls) return no_touch();
    until = std::max(until, *as_balls);
  }
  const mpq_class step = mpq_class(width) / 2, end(1);
  for (int i = 0; i < max_steps; ++i) {
    if (until > end) return no_touch();
    const mpq_class latest = std::min(end, mpq_class(until + step));
    const mpq_class t = simplest_between(until, latest);
    moment = translation.at(t);
    if (moment.kind == Moment::Kind::together) {
      const double moves = mpq_class(t - until).get_d() * translation.length();
      const double tie = std::min(moves / larger_size(c), 1.0);
      constexpr double truth_width = 1e-30;
      return {Status::touch, {until, t}, truth_at(c, sweep, t, truth_width, tie)};
    }
    if (moment.kind == Moment::Kind::unknown) return {Status::undecided, {until, latest}, {}};
    // At that very moment they might touch.
    if (moment.from && *moment.from >= until) return {Status::undecided, {until, *moment.from}, {}};
    if (!moment.until) return no_touch();
    until = *moment.until;
  }
  return {Status::undecided, {until, end}, {}};
}

}  // namespace

mpq_class simplest_between(const mpq_class& lo, const mpq_class& hi) {
  Integer whole;
  mpz_fdiv_q(whole.get_mpz_t(), lo.get_num_mpz_t(), lo.get_den_mpz_t());
  if (lo == whole) return lo;
  const Integer next = whole + 1;
  if (hi >= next) return next;
  return whole + 1 / simplest_between(1 / (hi - whole), 1 / (lo - whole));
}

FirstTouch first_touch(const Configuration& configuration, const Sweep& sweep, double width) {
  if (!(std::isfinite(width) && width > 0)) {
    throw InvalidInput("width", std::to_string(width), "must be positive and finite");
  }
  if (sweep.turns()) return touch_of_turning(configuration, sweep);
  return touch_of_translation(configuration, sweep.translation(), width);
}

}  // namespace touchstone::oracle
