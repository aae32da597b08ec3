#include "reports/examine_cast.hpp"

#include <cmath>
#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "properties/files/configuration_json.hpp"
#include "properties/files/strict_json.hpp"

namespace touchstone {
namespace {

using nlohmann::json;

/// The configuration at the touch, in the person's frame: of a person whose body a is our B, that
/// body has moved the other way.
Configuration at_the_touch(const CastExamination& cast, Order order) {
  const Configuration& c = cast.configuration;
  const double t = cast.truth.fraction.hi.get_d();
  if (order == Order::as_ours) return swept(c, cast.sweep, t);
  return {c.a, c.pose_a, c.b, Sweep(-cast.sweep.translation()).moved(c.pose_b, t)};
}

json score_json(const CastScore& score) {
  return {{"outcome", outcome_name(score.outcome)},
          {"distance", or_null(score.distance)},
          {"normal_regret", or_null(score.normal_regret)}};
}

/// "touch", "never", "from-start", or "failed".
std::string answer_word(const CastAnswer& answer) {
  return answer.cast ? status_name(answer.cast->status) : "failed";
}

std::string few_digits(const std::optional<double>& x) {
  return x && std::isfinite(*x) ? fmt::format("{:.3g}", *x) : "-";
}

std::string normal_sentence(const CastExamination& cast) {
  if (!cast.truth.there || cast.truth.there->normals.empty()) return "";
  const oracle::OptimalNormal& normal = cast.truth.there->normals.front();
  const auto patch = oracle::contact_patch(at_the_touch(cast, Order::as_ours), normal);
  return fmt::format("; there: normal ({:.6g}, {:.6g}, {:.6g}), ties: {}; contact patch: {}",
                     normal.n.x(), normal.n.y(), normal.n.z(), ties_name(cast.truth.there->ties),
                     patch_kind_name(patch.kind()));
}

}  // namespace

std::string first_touch_text(const oracle::FirstTouch& touch) {
  using Status = oracle::FirstTouch::Status;
  constexpr int digits = 20;
  const std::string low = oracle::decimal_below(touch.fraction.lo, digits);
  const std::string high = oracle::decimal_above(touch.fraction.hi, digits);
  switch (touch.status) {
    case Status::touch:
      return fmt::format("A touches B first when it has gone {} of its sweep", high);
    case Status::never:
      return "A touches B never in its sweep";
    case Status::from_start:
      return "A touches B before it moves";
    case Status::undecided:
      break;
  }
  return fmt::format(
      "A does not touch B before it has gone {} of its sweep; no proof tells "
      "whether it does between that and {}",
      low, high);
}

CastExamination examine_cast(const Configuration& c, const Sweep& sweep,
                             const std::vector<const Candidate*>& candidates, const Bar& bar) {
  CastExamination result{c, sweep, oracle::first_touch(c, sweep), {}};
  if (sweep.turns()) return result;
  for (const Candidate* candidate : candidates) {
    const CastQuestion question{c, sweep.translation()};
    const std::optional<CastAnswer> answer = ask_casts(*candidate, {&question, 1}).front();
    if (!answer) continue;
    const CastScore score = answer->cast ? score_cast(c, sweep, result.truth, *answer->cast, bar)
                                         : CastScore{CastOutcome::failed, {}, {}};
    result.answers.push_back({candidate->name, *answer, score});
  }
  return result;
}

json to_json(const CastExamination& cast, Order order) {
  json truth = {{"status", status_name(cast.truth.status)},
                {"fraction", decimals(cast.truth.fraction)}};
  if (cast.truth.there) {
    truth["there"] = to_json(at_the_touch(cast, order), *cast.truth.there, order);
  }
  json answers = json::object();
  const double sign = order == Order::swapped ? -1 : 1;
  for (const auto& [candidate, answer, score] : cast.answers) {
    json& written = answers[candidate];
    written = {{"status", answer_word(answer)}, {"score", score_json(score)}};
    if (answer.cast) {
      written["fraction"] = answer.cast->fraction;
      written["normal"] = to_json(Vec3(sign * answer.cast->normal));
    } else {
      written["reason"] = answer.failure;
    }
  }
  return {{"truth", std::move(truth)}, {"answers", std::move(answers)}};
}

std::string cast_text(const CastExamination& cast, const Terminal& terminal) {
  std::string text =
      terminal.folded("cast: " + first_touch_text(cast.truth) + normal_sentence(cast) + '.');
  if (!cast.answers.empty()) {
    const TextTable table("candidate", 0,
                          {{"outcome", 15, 0},
                           {"answer", 10, 1},
                           {"fraction", 10, 2},
                           {"left", 9, 3},
                           {"regret", 8, 4}},
                          terminal);
    text += table.headings();
    for (const ScoredCast& scored : cast.answers) {
      const bool is_right = scored.score.outcome == CastOutcome::agree;
      text += table.row(
          shown_name(scored.candidate),
          {{outcome_name(scored.score.outcome), !is_right},
           {answer_word(scored.answer)},
           {scored.answer.cast ? fmt::format("{:.4g}", scored.answer.cast->fraction) : "-"},
           {few_digits(scored.score.distance)},
           {few_digits(scored.score.normal_regret)}},
          is_right);
    }
    text += Legend(table, terminal)
                .of("left", "signed distance there, relative to the smaller size, as is regret")
                .text();
  }
  return text + terminal.folded("the cast, a line for touchstone solve:") +
         to_json(cast.configuration, cast.sweep).dump() + '\n';
}

}  // namespace touchstone
