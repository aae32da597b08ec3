// The law "hint": two frames of a simulation, where the first one's normal is the hint of the
// second. In the second frame A is pressed into B along that normal by a hundred-thousandth of the
// smaller size, as by gravity. A unique normal stays as it was; if several tie, any other one
// becomes better by up to twice the step. A routine without memory chooses anew, and its normal
// flickers from frame to frame; with the hint it should stay.
#include <cmath>
#include <fmt/format.h>

#include "oracle/truth.hpp"
#include "properties/laws/law.hpp"
#include "properties/moves.hpp"

namespace touchstone {
namespace {

/// The step, relative to the threshold. The difference of the gaps along two normals changes by at
/// most twice the step, so that a tie remains one to within half the threshold.
constexpr double step = 0.2;

/// More than a solver's tolerance changes a given normal, radians.
constexpr double largest_turn = 10 * M_PI / 180;

Vec3 normal_of(const Answer& answer) { return Eigen::Map<const Vec3>(answer.normal); }

Configuration pressed_in(const Configuration& c, const Answer& first, const Bar& bar) {
  return with_a_moved(c, -step * bar.threshold * normal_of(first).normalized());
}

double angle(const Vec3& u, const Vec3& v) { return std::atan2(u.cross(v).norm(), u.dot(v)); }

/// Contacts within half of the tolerance, so that the choice made by a hint is not itself a
/// failure.
double hint_threshold(const Configuration& c, const Bar& bar) {
  return 0.5 * bar.tolerance * error_size(c, bar);
}

/// The second frame three times: without a hint, with the first answer's normal, and with its
/// opposite, which occurs after a body was caught on the other side.
std::vector<HintedQuestion> hinted_questions(const Configuration& c, const Answer& first,
                                             const Bar& bar) {
  if (first.status != TS_CONTACT) return {};
  const Configuration next = pressed_in(c, first, bar);
  return {{next, std::nullopt}, {next, normal_of(first)}, {next, Vec3(-normal_of(first))}};
}

/// "jump" if the normal turns away from the hint although the hint is still as good; any other
/// failure if the answer agrees with the truth without a hint but not with one.
std::optional<Violation> judge_hint(const Configuration& c, std::span<const Answer> answers,
                                    const Bar& bar) {
  if (answers.size() < 4) return std::nullopt;
  const Answer &first = answers[0], &plain = answers[1], &hinted = answers[2], &misled = answers[3];
  const Configuration next = pressed_in(c, first, bar);
  const oracle::Truth& truth = truth_of(next);

  Judge judge(next, truth, bar);
  if (agrees(judge.score(plain).outcome)) {
    for (const Answer* answer : {&hinted, &misled}) {
      const Score s = judge.score(*answer);
      if (agrees(s.outcome)) continue;
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

}  // namespace

Law hint_law(bool (*applies)(const Configuration&)) {
  return {
      "hint",
      "With the normal as hint, and A pressed in along it by a tenth of the tolerance, the "
      "normal turns by more than 10 degrees only where another is better; no hint makes a right "
      "answer wrong.",
      applies,
      [](const Configuration&, const Bar&) { return std::vector<Configuration>{}; },
      judge_hint,
      hinted_questions,
      hint_threshold};
}

}  // namespace touchstone
