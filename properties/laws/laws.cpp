// The laws. Each is judged at the bar's tolerance, relative to the smaller size, unless it says
// otherwise.
#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <iterator>
#include <limits>

#include "oracle/judge/normals.hpp"
#include "oracle/judge/score.hpp"
#include "oracle/patch/contact_patch.hpp"
#include "oracle/truth.hpp"
#include "properties/files/given_text.hpp"
#include "properties/laws/law.hpp"
#include "properties/moves.hpp"
#include "properties/named.hpp"
#include "properties/numbers.hpp"
#include "reference/invalid_input.hpp"
#include "reference/support.hpp"

namespace touchstone {
namespace {

using Answers = std::span<const Answer>;
using Questions = std::vector<Configuration>;

Vec3 vector(const double (&v)[3]) { return {v[0], v[1], v[2]}; }

bool always(const Configuration&) { return true; }

/// Can the bodies be moved, turned, grown and scaled without overflow and with rounding errors far
/// below the tolerance? Not if they are so far away that coordinates round by more than their sizes
/// allow.
bool can_be_moved(const Configuration& c) {
  constexpr double min_size = 0x1p-1000, max_length = 0x1p1000, max_distance = 1e10;
  const double distance = std::max(c.pose_a.position().cwiseAbs().maxCoeff(),
                                   c.pose_b.position().cwiseAbs().maxCoeff());
  return smaller_size(c) >= min_size && larger_size(c) <= max_length && distance <= max_length &&
         distance <= max_distance * error_size(c, Bar{});
}

Questions nothing_else(const Configuration&, const Bar&) { return {}; }

/// The answer's signed distance, at most the threshold; no contact counts as the threshold.
double distance(const Answer& answer, const Bar& bar) {
  return answer.status == TS_CONTACT ? std::min(answer.signed_distance, bar.threshold)
                                     : bar.threshold;
}

double true_distance(const Configuration& c) { return truth_of(c).signed_distance.midpoint(); }

// answers

std::optional<Violation> judge_answers(const Configuration&, Answers answers, const Bar&) {
  const Answer& a = answers[0];
  if (a.status == TS_CRASHED) return Violation{"crashed", 1, a.reason};
  if (a.status == TS_TIMED_OUT) return Violation{"timed-out", 1, a.reason};
  if (a.status == TS_FAILED) return Violation{"failed", 1, "the candidate says it failed"};
  if (!is_finite(a)) return Violation{"not-finite", 1, "a number of the answer is not finite"};
  if (a.status != TS_CONTACT) return std::nullopt;
  // More than the rounding error of a unit vector's length in single precision.
  constexpr double unit = 1e-6;
  const auto not_unit = [](const double(&n)[3]) { return std::abs(vector(n).norm() - 1) > unit; };
  for (int i = 0; i < a.point_count; ++i) {
    if (not_unit(a.points[i].normal)) {
      return Violation{"wrong-normal", std::abs(vector(a.points[i].normal).norm() - 1),
                       fmt::format("the normal of point {} is no unit vector", i)};
    }
  }
  if (!not_unit(a.normal)) return std::nullopt;
  return Violation{"wrong-normal", std::abs(vector(a.normal).norm() - 1),
                   "the normal is no unit vector"};
}

// agreement

std::optional<Violation> judge_agreement(const Configuration& c, Answers answers, const Bar& bar) {
  const Score& s = score_of(c, answers[0], bar);
  if (agrees(s.outcome) || s.outcome == Outcome::unsupported) return std::nullopt;
  if (is_of_points(s.outcome)) return std::nullopt;  // that is the law "points"
  std::string detail;
  if (s.depth_error) detail += fmt::format("depth error {:.3g}", *s.depth_error);
  if (s.normal_regret) {
    detail += fmt::format("{}normal regret {:.3g}", detail.empty() ? "" : ", ", *s.normal_regret);
  }
  detail += detail.empty() ? fmt::format("wrong by {:.3g} of the smaller size", s.severity)
                           : " of the smaller size";
  return Violation{outcome_name(s.outcome), s.severity, detail};
}

// Invariance: the same distance and as good a normal.

/// A bound of the error of gap() in double, and of normals being unit to 1e-6 only: the gap along a
/// vector is taken, not that along its direction.
double gap_error(const Configuration& c, const Vec3& n) {
  constexpr double roundings = 64 * std::numeric_limits<double>::epsilon();
  const double reach = c.pose_a.position().norm() + c.pose_b.position().norm() + 4 * larger_size(c);
  return (roundings + 2 * std::abs(n.norm() - 1)) * reach;
}

/// Do the gaps along two normals certainly differ by no more than this? Only in double, so that few
/// have to be certified.
bool are_gaps_alike(const Configuration& c, const Vec3& n, const Configuration& other,
                    const Vec3& other_n, double unit, double most) {
  if (pair_of(c) == Pair::plane) return false;  // certified_gap says how a plane is judged
  const double difference = gap(other, other_n) / unit - gap(c, n);
  const double error = gap_error(other, other_n) / unit + gap_error(c, n);
  return std::abs(difference) + error <= most;
}

std::optional<Violation> differs(const Configuration& c, const Answer& answer,
                                 const Configuration& other, const Answer& other_answer,
                                 const Bar& bar, double unit = 1) {
  const double size = error_size(c, bar);
  const double change = std::abs(distance(other_answer, bar) / unit - distance(answer, bar)) / size;
  if (!(change <= bar.tolerance)) {
    return Violation{"not-invariant", change,
                     fmt::format("the distance changes by {:.3g} of the smaller size", change)};
  }
  if (answer.status != TS_CONTACT || other_answer.status != TS_CONTACT) return std::nullopt;
  if (are_gaps_alike(c, vector(answer.normal), other, vector(other_answer.normal), unit,
                     bar.tolerance * size)) {
    return std::nullopt;
  }
  const auto felt = [](const Configuration& asked, const Answer& a) {
    const Vec3 n = vector(a.normal);
    const oracle::Truth& truth = truth_of(asked);
    return felt_regret(asked, truth, n.normalized(), oracle::normal_regret(asked, truth, n));
  };
  const double regret = std::abs(felt(other, other_answer) / unit - felt(c, answer)) / size;
  if (regret <= bar.tolerance) return std::nullopt;
  return Violation{
      "not-invariant", regret,
      fmt::format("the normal's regret changes by {:.3g} of the smaller size", regret)};
}

/// Judges a law all of whose questions are the same geometry in another form.
template <Questions (*Ask)(const Configuration&, const Bar&)>
std::optional<Violation> judge_same(const Configuration& c, Answers answers, const Bar& bar) {
  const Questions questions = Ask(c, bar);
  for (std::size_t i = 0; i < questions.size(); ++i) {
    if (auto v = differs(c, answers[0], questions[i], answers[i + 1], bar)) return v;
  }
  return std::nullopt;
}

bool are_cylinders(const Configuration& c) { return pair_of(c) == Pair::cylinder; }

Questions ask_exchange(const Configuration& c, const Bar&) { return {exchanged(c)}; }
Questions ask_rotation(const Configuration& c, const Bar&) {
  return {rotated(c, Eigen::Quaterniond(3, -1, 2, 0.5).normalized()),
          rotated(c, Eigen::Quaterniond(1, 1, 0, 0).normalized())};
}
Questions ask_translation(const Configuration& c, const Bar&) {
  return {translated(c, larger_size(c) * Vec3(1, -2, 3))};
}
Questions ask_spin(const Configuration& c, const Bar&) { return {spun(c, 0.7), spun(c, -2.9)}; }
Questions ask_flip(const Configuration& c, const Bar&) { return {flipped(c)}; }

constexpr double factors[] = {0.125, 8};

bool asks_for_overlap_only(const Bar& bar) { return bar.threshold == 0; }

Questions ask_scale(const Configuration& c, const Bar& bar) {
  // A threshold would have to be scaled, too.
  if (!asks_for_overlap_only(bar)) return {};
  return {scaled(c, factors[0]), scaled(c, factors[1])};
}
std::optional<Violation> judge_scale(const Configuration& c, Answers answers, const Bar& bar) {
  const Questions questions = ask_scale(c, bar);
  for (std::size_t i = 0; i < questions.size(); ++i) {
    if (auto v = differs(c, answers[0], questions[i], answers[i + 1], bar, factors[i])) return v;
  }
  return std::nullopt;
}

// Small steps: a signed distance changes by no more than the step.

struct Step {
  Vec3 direction;
  double length;  // of the smaller size
};
const Step small_steps[] = {{{1, 0, 0}, 1e-3}, {{0, 1, 0}, 1e-3},      {{0, 0, 1}, 1e-3},
                            {{1, 0, 0}, 1e-6}, {{0.6, 0, 0.8}, -1e-6}, {{0, 0, 1}, 1e-9}};

Questions ask_steps(const Configuration& c, const Bar&) {
  Questions result;
  for (const Step& step : small_steps) {
    result.push_back(with_a_moved(c, step.length * smaller_size(c) * step.direction));
  }
  return result;
}
std::optional<Violation> judge_steps(const Configuration& c, Answers answers, const Bar& bar) {
  const double size = error_size(c, bar);
  for (std::size_t i = 0; i < std::size(small_steps); ++i) {
    const double change =
        std::abs(distance(answers[i + 1], bar) - distance(answers[0], bar)) / size;
    if (change <= std::abs(small_steps[i].length) + bar.tolerance) continue;
    return Violation{"jump", change,
                     fmt::format("a step of {:.1g} of the smaller size changes the distance by "
                                 "{:.3g}",
                                 std::abs(small_steps[i].length), change)};
  }
  return std::nullopt;
}

// Growth: a larger body is at least as deep, and deeper by at most its growth.

constexpr double growth = 0.01;

Questions ask_growth(const Configuration& c, const Bar&) {
  return {with_a_grown(c, 1 + growth, 1), with_a_grown(c, 1, 1 + growth)};
}
std::optional<Violation> judge_growth(const Configuration& c, Answers answers, const Bar& bar) {
  const double size = error_size(c, bar), grown[] = {c.a.radius(), c.a.half_length()};
  for (int i = 0; i < 2; ++i) {
    const double change = (distance(answers[i + 1], bar) - distance(answers[0], bar)) / size;
    const double max_change = growth * grown[i] / size;
    const char* what = i == 0 ? "radius" : "half length";
    if (change > bar.tolerance) {
      return Violation{"shallow", change,
                       fmt::format("a larger {} raises the distance by {:.3g}", what, change)};
    }
    if (change < -max_change - bar.tolerance) {
      return Violation{"overdeep", -change,
                       fmt::format("a {} larger by {:.3g} lowers the distance by {:.3g}", what,
                                   max_change, -change)};
    }
  }
  return std::nullopt;
}

// Way out: moved by its depth along the normal, A touches B.

/// Does the score of an overlap with this signed distance and normal show that A touches B after
/// the way out? Moved by t along the unit vector n, A is between g(n) + t and σ + t from B. So the
/// errors of depth and normal decide, but for the normal's length and for rounding.
bool surely_leads_out(const Configuration& c, const Answer& a, const Bar& bar) {
  if (pair_of(c) == Pair::plane) return false;  // certified_gap says how a plane is judged
  const Score& s = score_of(c, a, bar);
  if (!s.depth_error || !s.normal_regret) return false;
  const double error = gap_error(c, vector(a.normal)) / error_size(c, bar);
  return std::abs(*s.depth_error) + *s.normal_regret + error <= bar.tolerance;
}

std::optional<Violation> judge_way_out(const Configuration& c, Answers answers, const Bar& bar) {
  const Answer& a = answers[0];
  if (a.status != TS_CONTACT || a.signed_distance >= 0) return std::nullopt;
  if (surely_leads_out(c, a, bar)) return std::nullopt;
  const double size = error_size(c, bar);
  const double left = true_distance(with_a_moved(c, -a.signed_distance * vector(a.normal))) / size;
  if (std::abs(left) <= bar.tolerance) return std::nullopt;
  return Violation{left < 0 ? "shallow" : "overdeep", std::abs(left),
                   fmt::format("after the way out the distance is {:.3g} of the smaller size, not "
                               "zero",
                               left)};
}

// Apart: no contact beyond the threshold.

/// Moves A along an optimal normal until its distance from B exceeds threshold and tolerance.
Questions ask_apart(const Configuration& c, const Bar& bar) {
  const oracle::Truth& truth = truth_of(c);
  const double clear = bar.threshold + 10 * bar.tolerance * error_size(c, bar);
  const double way = clear - truth.signed_distance.midpoint();
  if (way <= 0) return {};
  return {with_a_moved(c, way * truth.normals.front().n)};
}
std::optional<Violation> judge_apart(const Configuration& c, Answers answers, const Bar& bar) {
  const double size = error_size(c, bar);
  const Questions questions = ask_apart(c, bar);
  for (std::size_t i = 0; i < answers.size(); ++i) {
    const Configuration& asked = i == 0 ? c : questions[i - 1];
    if (answers[i].status != TS_CONTACT || distance(answers[i], bar) >= bar.threshold) continue;
    const double apart = (true_distance(asked) - bar.threshold) / size;
    if (apart <= bar.tolerance) continue;
    return Violation{
        "phantom", apart,
        fmt::format("a contact {:.3g} of the smaller size beyond the threshold", apart)};
  }
  return std::nullopt;
}

// Points

std::string points_text(const Score& s) {
  if (s.points == 0) return "a contact of overlapping bodies has no points";
  if (s.outcome == Outcome::phantom_points) {
    return fmt::format("a point is {:.3g} of the smaller size beyond the threshold", s.severity);
  }
  return fmt::format("the deepest point is {:.3g} of the smaller size {} than the bodies are",
                     std::abs(*s.deepest_error), *s.deepest_error < 0 ? "less deep" : "deeper");
}

std::optional<Violation> judge_points(const Configuration& c, Answers answers, const Bar& bar) {
  const Answer& a = answers[0];
  const Score& s = score_of(c, a, bar);
  if (is_of_points(s.outcome) && s.outcome != Outcome::off_body) {
    return Violation{outcome_name(s.outcome), s.severity, points_text(s)};
  }
  const double size = error_size(c, bar);
  for (int i = 0; a.status == TS_CONTACT && i < a.point_count; ++i) {
    const double excess = point_excess(c, a.points[i]) / size;
    if (excess <= bar.tolerance) continue;
    return Violation{"off-body", excess,
                     fmt::format("point {} is {:.3g} of the smaller size farther from a surface "
                                 "than its depth",
                                 i, excess)};
  }
  return std::nullopt;
}

// Manifold

/// Coverage of the exact patch of the optimal normal nearest to the answer's. All of it lies within
/// the bodies' overlap, so that a point may lie anywhere on it; the patch within a depth that the
/// score refers to reaches further where a face leans, up to where no point may lie.
double coverage_of_exact_patch(const Configuration& c, const oracle::Truth& truth,
                               const Answer& a) {
  const auto nearest = std::max_element(
      truth.normals.begin(), truth.normals.end(), [&](const auto& n, const auto& m) {
        return n.n.dot(vector(a.normal)) < m.n.dot(vector(a.normal));
      });
  std::vector<Vec3> points;
  for (int i = 0; i < a.point_count; ++i) points.push_back(vector(a.points[i].position));
  return coverage(oracle::contact_patch(c, *nearest), points, patch_resolution * smaller_size(c));
}

std::optional<Violation> judge_manifold(const Configuration& c, Answers answers, const Bar& bar) {
  constexpr double min_coverage = 0.3;
  // Only for exact alignments: near one the right number of points is a matter of degree.
  const oracle::Truth& truth = truth_of(c);
  const bool is_aligned =
      std::all_of(truth.normals.begin(), truth.normals.end(), [&](const auto& normal) {
        // Along an oblique normal the cylinder has a single lowest point.
        return normal.to_a != oracle::Alignment::oblique &&
               oracle::contact_patch(c, normal).kind() != oracle::ContactPatch::Kind::point;
      });
  if (!is_aligned) return std::nullopt;
  const Score& s = score_of(c, answers[0], bar);
  if (!s.coverage || *s.coverage >= min_coverage) return std::nullopt;
  if (coverage_of_exact_patch(c, truth, answers[0]) >= min_coverage) return std::nullopt;
  return Violation{"few-points", min_coverage - *s.coverage,
                   fmt::format("{} {} {:.2f} of the contact patch", counted(s.points, "point"),
                               s.points == 1 ? "covers" : "cover", *s.coverage)};
}

// Memory

Questions ask_again(const Configuration& c, const Bar&) {
  return {with_a_moved(c, smaller_size(c) * Vec3(0.01, 0.02, -0.01)), spun(flipped(c), 0.4),
          translated(c, larger_size(c) * Vec3(-30, 20, 10)), c};
}
bool are_equal(const ts_point& p, const ts_point& q) {
  return vector(p.position) == vector(q.position) && vector(p.normal) == vector(q.normal) &&
         p.depth == q.depth;
}

std::optional<Violation> judge_again(const Configuration&, Answers answers, const Bar&) {
  const Answer &first = answers.front(), &last = answers.back();
  bool same = first.status == last.status;
  if (same && first.status == TS_CONTACT) {
    same = first.point_count == last.point_count && first.signed_distance == last.signed_distance &&
           vector(first.normal) == vector(last.normal) &&
           std::equal(first.points, first.points + first.point_count, last.points, are_equal);
  }
  if (same) return std::nullopt;
  return Violation{"not-invariant", 1, "the same question has another answer after other ones"};
}

}  // namespace

const std::vector<Law>& all_laws() {
  static const std::vector<Law> laws = {
      {"answers",
       "Every valid configuration is answered, with finite numbers and unit normals (to 1e-6).",
       always, nothing_else, judge_answers},
      {"agreement", "Depth and normal regret agree with the oracle.", always, nothing_else,
       judge_agreement},
      {"exchange", "Two cylinders exchanged have the same distance and as good a normal.",
       are_cylinders, ask_exchange, judge_same<ask_exchange>},
      {"rotation", "Both bodies rotated have the same distance and as good a normal.", can_be_moved,
       ask_rotation, judge_same<ask_rotation>},
      {"translation", "Both bodies moved have the same distance and as good a normal.",
       can_be_moved, ask_translation, judge_same<ask_translation>},
      {"spin",
       "Bodies of revolution turned about their axes have the same distance and as good "
       "a normal.",
       can_be_moved, ask_spin, judge_same<ask_spin>},
      {"flip", "Bodies turned end for end have the same distance and as good a normal.",
       can_be_moved, ask_flip, judge_same<ask_flip>},
      {"scale", "All lengths times 8, or an eighth, scale the distance.", can_be_moved, ask_scale,
       judge_scale},
      {"small-steps", "A step of A changes the distance by no more than its length.", can_be_moved,
       ask_steps, judge_steps},
      {"growth",
       "A cylinder with a larger radius or length is not less deep, and not deeper by "
       "more than it grew.",
       can_be_moved, ask_growth, judge_growth},
      {"way-out", "A moved by its depth along the normal touches B.", can_be_moved, nothing_else,
       judge_way_out},
      {"apart", "Bodies farther apart than the threshold have no contact.", can_be_moved, ask_apart,
       judge_apart},
      {"points",
       "Every contact point is no farther from both surfaces than its depth; where depth and "
       "normal are right, the deepest point is as deep as the bodies are, and none is beyond the "
       "threshold.",
       always, nothing_else, judge_points},
      {"manifold", "Of exactly aligned bodies the points cover at least 0.3 of the contact patch.",
       always, nothing_else, judge_manifold},
      hull_law(can_be_moved),
      hint_law(can_be_moved),
      {"memory", "The answer does not depend on what was asked before, to the last bit.",
       can_be_moved, ask_again, judge_again},
  };
  return laws;
}

const Law& find_law(std::string_view name) { return named(all_laws(), name, "--law"); }

const std::vector<std::string>& all_failures() {
  static const std::vector<std::string> failures = {"missed",
                                                    "phantom",
                                                    "shallow",
                                                    "overdeep",
                                                    "wrong-normal",
                                                    "off-body",
                                                    "few-points",
                                                    "jump",
                                                    "not-invariant",
                                                    "not-finite",
                                                    "failed",
                                                    "crashed",
                                                    "timed-out",
                                                    "shallow-points",
                                                    "overdeep-points",
                                                    "phantom-points",
                                                    "no-points",
                                                    "early",
                                                    "late"};
  return failures;
}

}  // namespace touchstone
