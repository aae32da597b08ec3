#include "properties/laws/cast_laws.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <iterator>
#include <map>
#include <set>
#include <tuple>
#include <utility>

#include "candidates/host/worker_processes.hpp"
#include "oracle/judge/cast_score.hpp"
#include "properties/files/bytes.hpp"
#include "properties/moves.hpp"
#include "properties/simplify.hpp"

namespace touchstone {

/// On its way from a worker.
using SimpleCast = std::pair<std::pair<Configuration, Vec3>, Violation>;
template <>
SimpleCast blank<SimpleCast>() {
  return {{blank<Configuration>(), Vec3::Zero()}, {}};
}

namespace {

/// Metres: the bar's, and what rounding of poses and of a fraction in double moves A.
double tolerance_of(const CastQuestion& q, const Bar& bar) {
  const Configuration& c = q.configuration;
  const double lengths =
      c.pose_a.position().stableNorm() + c.pose_b.position().stableNorm() + q.sweep.stableNorm();
  return bar.tolerance * error_size(c, bar) + 0x1p-50 * lengths;
}

std::optional<Violation> violated(const char* failure, double metres, const CastQuestion& q,
                                  const Bar& bar, const std::string& detail) {
  return Violation{failure, std::abs(metres) / error_size(q.configuration, bar), detail};
}

std::optional<Violation> judge_touch(const CastQuestion& q, std::span<const Cast> answers,
                                     const Bar& bar) {
  const Cast& answer = answers.front();
  if (answer.status == CastStatus::never) return std::nullopt;
  const Sweep sweep(q.sweep);
  const double left = DistanceInTime(q.configuration, sweep).at(answer.fraction);
  const double tolerance = tolerance_of(q, bar);
  const bool is_inside = answer.status == CastStatus::touch && left < -tolerance;
  if (left <= tolerance && !is_inside) return std::nullopt;
  return violated(
      is_inside ? "late" : "early", left, q, bar,
      fmt::format("at the fraction {} the signed distance is {:.6g} m", answer.fraction, left));
}

std::optional<Violation> judge_free(const CastQuestion& q, std::span<const Cast> answers,
                                    const Bar& bar) {
  const Cast& answer = answers.front();
  if (answer.status == CastStatus::from_start) return std::nullopt;
  const bool is_never = answer.status == CastStatus::never;
  const Sweep sweep(q.sweep);
  const DistanceInTime distance(q.configuration, sweep);
  constexpr int parts = 8;
  for (int i = 0; i < parts + is_never; ++i) {
    const double t = answer.fraction * i / parts, there = distance.at(t);
    if (there >= -tolerance_of(q, bar)) continue;
    return violated(is_never ? "missed" : "late", there, q, bar,
                    fmt::format("at {} of the sweep, before {}, the signed distance is {:.6g} m", t,
                                is_never ? "its end" : fmt::format("{}", answer.fraction), there));
  }
  return std::nullopt;
}

/// Where an answer lets A go, as a part of the first question's sweep.
struct Stop {
  double t;
  bool touches;
};
Stop stop_of(const Cast& answer, double length) {
  return {answer.fraction * length, answer.status != CastStatus::never};
}

/// Whether A may go on from where one answer stops it to where the other does: between them the
/// bodies come no deeper than rounding and the bar allow, and nowhere in between.
std::optional<Violation> judge_stops(const CastQuestion& q, Stop one, Stop other, const Bar& bar,
                                     const std::string& other_name) {
  const double tolerance = 2 * tolerance_of(q, bar);
  const auto [earlier, later] = std::minmax(one, other, [](Stop a, Stop b) { return a.t < b.t; });
  if (!earlier.touches || (later.t - earlier.t) * q.sweep.stableNorm() <= tolerance) {
    return std::nullopt;
  }
  const Sweep sweep(q.sweep);
  const DistanceInTime distance(q.configuration, sweep);
  const double start = distance.at(earlier.t), end = distance.at(later.t);
  double change = start - distance.nearest(earlier.t, later.t).distance;
  if (later.touches) change = std::max(change, std::abs(start - end));
  if (change <= tolerance) return std::nullopt;
  return violated("not-invariant", change, q, bar,
                  fmt::format("A goes up to {} of the sweep, {} up to {}: signed distances differ "
                              "by {:.6g} m between these",
                              one.t, other_name, other.t, change));
}

constexpr double lengths_asked[] = {0.5, 3};

std::vector<CastQuestion> other_lengths(const CastQuestion& q) {
  std::vector<CastQuestion> result;
  for (const double length : lengths_asked) result.push_back({q.configuration, length * q.sweep});
  return result;
}

std::optional<Violation> judge_lengths(const CastQuestion& q, std::span<const Cast> answers,
                                       const Bar& bar) {
  const Stop whole = stop_of(answers[0], 1);
  for (std::size_t i = 0; i < std::size(lengths_asked); ++i) {
    const double length = lengths_asked[i];
    const Stop other = stop_of(answers[i + 1], length);
    // What ends before it touches says nothing of what comes later.
    if (whole.touches != other.touches && (whole.touches ? whole.t > length : other.t > 1)) {
      continue;
    }
    const auto name = fmt::format("with {:g} times the sweep", length);
    if (auto found = judge_stops(q, whole, other, bar, name)) return found;
  }
  return std::nullopt;
}

std::vector<CastQuestion> exchanged_cast(const CastQuestion& q) {
  if (pair_of(q.configuration) != Pair::cylinder) return {};
  return {{exchanged(q.configuration), -q.sweep}};
}
const Eigen::Quaterniond& some_turn() {
  static const Eigen::Quaterniond turn = Eigen::Quaterniond(1, 2, -3, 4).normalized();
  return turn;
}
std::vector<CastQuestion> turned_cast(const CastQuestion& q) {
  return {{rotated(q.configuration, some_turn()), some_turn() * q.sweep}};
}

std::optional<Violation> judge_exchanged(const CastQuestion& q, std::span<const Cast> answers,
                                         const Bar& bar) {
  return judge_stops(q, stop_of(answers[0], 1), stop_of(answers[1], 1), bar,
                     "the other body, moving backwards,");
}
std::optional<Violation> judge_turned(const CastQuestion& q, std::span<const Cast> answers,
                                      const Bar& bar) {
  return judge_stops(q, stop_of(answers[0], 1), stop_of(answers[1], 1), bar,
                     "with all turned alike");
}

}  // namespace

const std::vector<CastLaw>& all_cast_laws() {
  static const std::vector<CastLaw> laws = {
      {"cast-answers", "Every cast has an answer.", nullptr, nullptr},
      {"cast-touch",
       "At an answered touch the bodies are neither apart nor, but from the start, "
       "inside each other.",
       nullptr, judge_touch},
      {"cast-free",
       "The bodies do not overlap before an answered touch, nor in a sweep without one.", nullptr,
       judge_free},
      {"cast-length",
       "With half and with three times the sweep A touches in the same place, or "
       "ends before it.",
       other_lengths, judge_lengths},
      {"cast-exchange",
       "Of two cylinders, the other one moving backwards touches at the same time.", exchanged_cast,
       judge_exchanged},
      {"cast-rotation", "With both bodies and the sweep turned alike A touches at the same time.",
       turned_cast, judge_turned}};
  return laws;
}

const CastLaw* find_cast_law(std::string_view name) {
  const auto found = std::ranges::find(all_cast_laws(), name, &CastLaw::name);
  return found == all_cast_laws().end() ? nullptr : &*found;
}

std::size_t place_of_law(std::string_view name) {
  if (const CastLaw* const law = find_cast_law(name)) {
    return all_laws().size() + static_cast<std::size_t>(law - all_cast_laws().data());
  }
  return static_cast<std::size_t>(&find_law(name) - all_laws().data());
}

const std::string& statement_of_law(std::string_view name) {
  const CastLaw* const law = find_cast_law(name);
  return law ? law->statement : find_law(name).statement;
}

namespace {

constexpr std::uint64_t configurations_of_cast = 20;

/// One after the other of each class and motion.
std::vector<CastIdentity> casts_to_check(Pair pair, const CheckOptions& options) {
  std::vector<CastIdentity> result;
  const std::uint64_t of_class = std::max<std::uint64_t>(1, options.count / configurations_of_cast);
  for (const PoseClass& c : selected(pair, {options.classes, options.groups})) {
    for (std::uint64_t i = 0; i < of_class; ++i) {
      const CastMotion& motion = cast_motions()[result.size() % cast_motions().size()];
      result.push_back({Identity{c, options.seed, i}, &motion});
    }
  }
  return result;
}

/// What a law is told of a cast: all answers that it asks for, or how the first one failed.
struct Answered {
  std::vector<Cast> casts;
  std::string failure;
};

/// None where the candidate has no cast of it, or fails in one that the law asks besides.
std::optional<Answered> all_answered(std::span<const std::optional<CastAnswer>> answers) {
  Answered result;
  if (answers.front()) result.failure = answers.front()->failure;
  if (!result.failure.empty()) return result;
  for (const auto& answer : answers) {
    if (!answer || !answer->cast) return std::nullopt;
    result.casts.push_back(*answer->cast);
  }
  return result;
}

/// Only one law is about casts that fail, and about nothing else.
std::optional<Violation> judged(const CastLaw& law, const CastQuestion& cast,
                                const Answered& answered, const Bar& bar) {
  if (law.judge) {
    return answered.failure.empty() ? law.judge(cast, answered.casts, bar) : std::nullopt;
  }
  return answered.failure.empty() ? std::nullopt
                                  : std::optional(Violation{"failed", 1, answered.failure});
}

/// The answers to each cast and to what the law asks besides, all asked together. None where the
/// law says nothing of the cast, or an answer is missing.
using AllAnswers = std::vector<std::optional<Answered>>;
AllAnswers answers_to(const CastLaw& law, std::span<const CastQuestion> casts,
                      const AnswersCasts& ask) {
  std::vector<CastQuestion> asked;
  std::vector<std::size_t> counts;
  for (const CastQuestion& cast : casts) {
    const std::size_t before = asked.size();
    std::vector<CastQuestion> more;
    if (law.questions) more = law.questions(cast);
    if (!more.empty() || !law.questions) asked.push_back(cast);
    std::ranges::move(more, std::back_inserter(asked));
    counts.push_back(asked.size() - before);
  }
  const std::vector<std::optional<CastAnswer>> answers = ask(asked);
  std::span<const std::optional<CastAnswer>> left = answers;
  AllAnswers result;
  for (const std::size_t count : counts) {
    result.push_back(count > 0 ? all_answered(left.first(count)) : std::nullopt);
    left = left.subspan(count);
  }
  return result;
}

/// A cast that breaks a law, as it was met.
struct MetCast {
  const CastLaw* law;
  std::string identity;
  CastQuestion cast;
  Violation violation;
  std::string features;

  auto kind() const {
    return std::tuple(pair_of(cast.configuration), law, violation.failure, features);
  }
};

/// The simplest cast that fails by the same name, and where the same features meet if these are
/// known, with how it does.
std::pair<CastQuestion, Violation> simplest(const MetCast& met, std::size_t max_trials,
                                            const AnswersCasts& ask, const Bar& bar) {
  Violation violation = met.violation;
  const auto first_failing = [&](const std::vector<CastQuestion>& next) {
    const AllAnswers answers = answers_to(*met.law, next, ask);
    for (std::size_t i = 0; i < next.size(); ++i) {
      if (!answers[i]) continue;
      const auto found = judged(*met.law, next[i], *answers[i], bar);
      if (!found || found->failure != met.violation.failure) continue;
      if (!met.features.empty() && meeting_features(next[i]) != met.features) continue;
      violation = *found;
      return i;
    }
    return next.size();
  };
  CastQuestion simple = simplified_in_batches(met.cast, first_failing, max_trials);
  return {std::move(simple), std::move(violation)};
}

/// Simplifies the first of each kind.
std::vector<Failure> simplified(const std::vector<MetCast>& all, const AnswersCasts& ask,
                                const CheckOptions& options) {
  std::map<decltype(std::declval<MetCast>().kind()), std::uint64_t> met;
  std::set<std::tuple<Pair, const CastLaw*, std::string>> names;
  std::vector<std::pair<const MetCast*, int>> firsts;  // with its number of trials
  for (const MetCast& m : all) {
    if (met[m.kind()]++ > 0) continue;
    const bool is_first_of_name =
        names.insert({pair_of(m.cast.configuration), m.law, m.violation.failure}).second;
    firsts.emplace_back(&m, is_first_of_name ? trials_of_first : trials_of_others);
  }
  const auto texts = run_in_processes(
      firsts.size(), options.workers,
      [&](std::size_t i) {
        const auto trials = static_cast<std::size_t>(firsts[i].second);
        auto [cast, violation] = simplest(*firsts[i].first, trials, ask, options.bar);
        return to_bytes(SimpleCast{{cast.configuration, cast.sweep}, violation});
      },
      [&](std::size_t i) { return firsts[i].first->identity; }, [](std::size_t) {});
  std::vector<Failure> result;
  for (std::size_t i = 0; i < texts.size(); ++i) {
    if (texts[i].empty()) continue;  // interrupted before
    const MetCast& m = *firsts[i].first;
    const auto [cast, violation] = from_bytes<SimpleCast>(texts[i]);
    result.push_back({m.law->name,
                      {},
                      {},
                      m.identity,
                      cast.first,
                      violation,
                      options.bar,
                      {},
                      {},
                      m.features,
                      met.at(m.kind()),
                      cast.second});
  }
  return result;
}

}  // namespace

std::optional<Violation> broken(const CastLaw& law, const CastQuestion& cast,
                                const AnswersCasts& answers, const Bar& bar) {
  const auto answered = answers_to(law, {&cast, 1}, answers).front();
  return answered ? judged(law, cast, *answered, bar) : std::nullopt;
}

std::vector<LawResult> check_casts(const AnswersCasts& answers,
                                   std::span<const CastLaw* const> laws,
                                   const CheckOptions& options) {
  std::vector<LawResult> results;
  std::vector<MetCast> met;
  for (const Pair pair : options.pairs) {
    const std::vector<CastIdentity> identities = casts_to_check(pair, options);
    std::vector<CastQuestion> casts;
    for (const CastIdentity& identity : identities) casts.push_back(make_cast(identity));
    for (const CastLaw* law : laws) {
      LawResult result{law->name, pair};
      const AllAnswers all = answers_to(*law, casts, answers);
      for (std::size_t i = 0; i < casts.size(); ++i) {
        if (!all[i]) continue;
        ++result.tried;
        const auto violation = judged(*law, casts[i], *all[i], options.bar);
        if (!violation) continue;
        ++result.broken;
        ++result.counts[violation->failure];
        met.push_back({law, to_string(identities[i]), casts[i], *violation,
                       options.by_features ? meeting_features(casts[i]) : ""});
      }
      if (result.tried > 0) results.push_back(result);
    }
  }
  for (Failure& f : simplified(met, answers, options)) {
    const auto of_law = std::ranges::find_if(results, [&](const LawResult& r) {
      return r.law == f.law && r.pair == pair_of(f.configuration);
    });
    of_law->failures.push_back(std::move(f));
  }
  return results;
}

std::vector<LawResult> check_casts(const Candidate& candidate, std::span<const CastLaw* const> laws,
                                   const CheckOptions& options) {
  const auto ask = [&](std::span<const CastQuestion> casts) { return ask_casts(candidate, casts); };
  std::vector<LawResult> results = check_casts(ask, laws, options);
  for (LawResult& result : results) {
    for (Failure& f : result.failures) {
      f.candidate = candidate.name;
      f.version = candidate.version;
    }
  }
  return results;
}

}  // namespace touchstone
