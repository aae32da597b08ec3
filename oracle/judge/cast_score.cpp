#include "oracle/judge/cast_score.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace touchstone {
namespace {

/// Of truths, relative to the larger size.
constexpr double judged_width = 1e-15;

/// The configuration at t with B at the origin: far from the world's origin, and after a long way,
/// doubles would place A elsewhere.
Configuration seen_from_b(const Configuration& c, const Sweep& sweep, double t) {
  Vec3 offset;
  for (int i = 0; i < 3; ++i) {
    const mpq_class a(c.pose_a.position()[i]), b(c.pose_b.position()[i]);
    offset[i] = mpq_class(a - b + mpq_class(t) * mpq_class(sweep.translation()[i])).get_d();
  }
  return {c.a, Pose(offset, sweep.moved(c.pose_a, t).orientation()), c.b,
          Pose(Vec3::Zero(), c.pose_b.orientation())};
}

}  // namespace

double DistanceInTime::at(double t) const {
  const Pose turned(c_.pose_a.position(), sweep_.moved(c_.pose_a, t).orientation());
  const Configuration in_place{c_.a, t > 0 ? turned : c_.pose_a, c_.b, c_.pose_b};
  return oracle::truth_at(in_place, sweep_.translation(), t, judged_width)
      .signed_distance.midpoint();
}

DistanceInTime::Moment DistanceInTime::nearest(double first, double last) const {
  constexpr double golden = 0.6180339887498949;  // golden section
  constexpr int steps = 30;
  const auto moment = [&](double t) { return Moment{t, at(t)}; };
  const auto lower = [](const Moment& one, const Moment& other) {
    return other.distance < one.distance ? other : one;
  };
  Moment best = lower(moment(first), moment(last));
  Moment left = moment(last - golden * (last - first));
  Moment right = moment(first + golden * (last - first));
  for (int i = 0; i < steps; ++i) {
    best = lower(best, lower(left, right));
    if (left.distance < right.distance) {
      last = right.t, right = left;
      left = moment(last - golden * (last - first));
    } else {
      first = left.t, left = right;
      right = moment(first + golden * (last - first));
    }
  }
  return best;
}

Configuration swept(const Configuration& c, const Sweep& sweep, double t) {
  return {c.a, sweep.moved(c.pose_a, t), c.b, c.pose_b};
}

const char* outcome_name(CastOutcome outcome) {
  constexpr std::array names = {"agree",   "late",         "early", "missed",
                                "made-up", "wrong-normal", "failed"};
  return names[static_cast<std::size_t>(outcome)];
}
const char* status_name(CastStatus status) {
  constexpr std::array names = {"touch", "never", "from-start"};
  return names[static_cast<std::size_t>(status)];
}
const char* status_name(oracle::FirstTouch::Status status) {
  constexpr std::array names = {"touch", "never", "from-start", "undecided"};
  return names[static_cast<std::size_t>(status)];
}

CastScore score_cast(const Configuration& c, const Sweep& sweep, const oracle::FirstTouch& truth,
                     const Cast& answer, const Bar& bar) {
  using Status = oracle::FirstTouch::Status;
  const DistanceInTime distance(c, sweep);
  const double size = error_size(c, bar), first = truth.fraction.hi.get_d();
  const bool touches = truth.status != Status::never;
  CastScore score;
  if (answer.status == CastStatus::never) {
    if (!touches) return score;
    score.distance = std::min(0.0, distance.nearest(first, 1).distance) / size;
    if (*score.distance < -bar.tolerance) score.outcome = CastOutcome::missed;
    return score;
  }
  const double t = answer.status == CastStatus::from_start ? 0 : answer.fraction;
  score.distance = distance.at(t) / size;
  if (*score.distance > bar.tolerance) {
    score.outcome = !touches    ? CastOutcome::made_up
                    : t > first ? CastOutcome::late
                                : CastOutcome::early;
    return score;
  }
  // On the other side of a thin body, or in it, A has passed through.
  const double farthest = std::hypot(c.a.radius(), c.a.half_length());
  const double speed = sweep.translation().stableNorm() + sweep.spin().stableNorm() * farthest;
  if (touches && (t - first) * speed > bar.tolerance * size) {
    score.distance = std::min(*score.distance, distance.nearest(first, t).distance / size);
    if (*score.distance < -bar.tolerance) {
      score.outcome = CastOutcome::late;
      return score;
    }
  }
  if (answer.normal.isZero(0)) return score;
  const Configuration placed = seen_from_b(c, sweep, t);
  score.normal_regret =
      oracle::normal_regret(placed, oracle::truth(placed, judged_width), answer.normal) / size;
  if (*score.normal_regret > bar.tolerance) score.outcome = CastOutcome::wrong_normal;
  return score;
}

}  // namespace touchstone
