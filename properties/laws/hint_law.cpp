#include "properties/laws/hint_law.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

#include "oracle/truth.hpp"
#include "properties/laws/moves.hpp"

namespace touchstone {
namespace {

/// Of the threshold. The gaps along two normals change by at most twice the step against each
/// other, so that a tie is still one to within half the threshold.
constexpr double step = 0.2;

/// Beyond what a solver's tolerance makes of one and the same normal.
constexpr double largest_turn = 10 * M_PI / 180;

Vec3 normal_of(const Answer& answer) { return Eigen::Map<const Vec3>(answer.normal); }

Configuration pressed_in(const Configuration& c, const Answer& first, const Bar& bar) {
  return with_a_moved(c, -step * bar.threshold * normal_of(first).normalized());
}

double angle(const Vec3& u, const Vec3& v) { return std::atan2(u.cross(v).norm(), u.dot(v)); }

}  // namespace

double hint_threshold(const Configuration& c, const Bar& bar) {
  return 0.5 * bar.tolerance * error_size(c, bar);
}

std::vector<Frame> hinted_frames(const Configuration& c, const Answer& first, const Bar& bar) {
  if (first.status != TS_CONTACT) return {};
  const Configuration next = pressed_in(c, first, bar);
  return {{next, std::nullopt}, {next, normal_of(first)}, {next, Vec3(-normal_of(first))}};
}

std::optional<Violation> judge_hint(const Configuration& c, std::span<const Answer> answers,
                                    const Bar& bar) {
  if (answers.size() < 4) return std::nullopt;
  const Answer &first = answers[0], &plain = answers[1], &hinted = answers[2], &misled = answers[3];
  const Configuration next = pressed_in(c, first, bar);
  const oracle::Truth truth = oracle::truth(next);

  if (score(next, truth, plain, bar).outcome == Outcome::agree) {
    for (const Answer* answer : {&hinted, &misled}) {
      const Score s = score(next, truth, *answer, bar);
      if (s.outcome == Outcome::agree) continue;
      return Violation{
          outcome_name(s.outcome), s.severity,
          fmt::format("right without a hint, and with the {} as hint the depth error "
                      "is {:.3g}, the normal regret {:.3g} of the smaller size",
                      answer == &hinted ? "previous normal" : "previous normal's opposite",
                      s.depth_error.value_or(NAN), s.normal_regret.value_or(NAN))};
    }
  }

  if (hinted.status != TS_CONTACT) return std::nullopt;
  const double turn = angle(normal_of(first), normal_of(hinted));
  if (turn <= largest_turn) return std::nullopt;
  const double regret = oracle::normal_regret(next, truth, normal_of(first));
  if (!(regret <= 0.5 * bar.threshold)) return std::nullopt;
  return Violation{"jump", turn,
                   fmt::format("the normal turns by {:.3g} degrees though the previous one is "
                               "within {:.2g} of the smaller size of the best",
                               turn * 180 / M_PI, regret / error_size(c, bar))};
}

}  // namespace touchstone
