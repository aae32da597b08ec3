#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "properties/files/named_members.hpp"
#include "reports/report.hpp"

namespace touchstone {

// What the parts of report.json consist of: written, read and described by its schema from here
// (json_members.hpp). docs/report.schema.json says what each member means. Of a report that is
// read, trends, worst cases and what else only pages show are left out, as older files have them in
// other forms.

inline const auto& values_of(Outcome) { return all_outcomes; }
inline const char* name_of(Outcome outcome) { return outcome_name(outcome); }
inline const auto& values_of(CastOutcome) { return all_cast_outcomes; }
inline const char* name_of(CastOutcome outcome) { return outcome_name(outcome); }
inline const auto& values_of(Pair) { return all_pairs; }
inline const char* name_of(Pair pair) { return pair_name(pair); }
inline const auto& values_of(Group) { return reported_groups; }
inline const char* name_of(Group group) { return group_name(group); }
inline constexpr std::array kinds_of_factor = {Factor::Kind::arrangement, Factor::Kind::modifier};
inline const auto& values_of(Factor::Kind) { return kinds_of_factor; }
inline const char* name_of(Factor::Kind kind) {
  return kind == Factor::Kind::arrangement ? "arrangement" : "modifier";
}

namespace rule {
inline constexpr Rule pair{.one_of = names_of_all<Pair>, .name = "pair"};
inline constexpr Rule group{.one_of = names_of_all<Group>, .name = "group"};
inline constexpr Rule pair_or_all{.one_of = [] {
  auto names = names_of_all<Pair>();
  names.push_back("all");
  return names;
}};
/// A time, a number of instructions, or the factor between two; quotients of two stay finite.
inline constexpr Rule measured{
    .min = 1e-30, .max = 1e30, .must = "must be a positive number, from 1e-30 to 1e30"};
inline constexpr Rule row_count{
    .min = 1, .max = 0x1p53, .must = "must be positive and at most 2^53"};  // exact as a double
}  // namespace rule

/// Null for an empty text.
inline std::optional<std::string> text_or_null(const std::string& text) {
  return text.empty() ? std::nullopt : std::optional(text);
}

void members(auto& a, Machine& m) {
  a.named("cpu", m.cpu);
  a.named("cores", m.cores, rule::from_one, When::newer);
  a.named("compiler", m.compiler);
  a.named("os", m.os, When::newer);
}

void members(auto& a, CandidateDescription& c) {
  a.named("name", c.name);
  a.named("family", c.family, When::newer);
  a.named("version", c.version);
  a.named("settings", c.settings);
  a.named("models", c.models, When::newer);
  constexpr Rule precision{.one_of = [] {
    return std::vector<std::string>{"", "double", "float"};
  }};
  a.named("precision", c.precision, precision, When::newer);
  constexpr Rule runs{.one_of = [] {
    return std::vector<std::string>{"native", "wasm", "script"};
  }};
  a.named("runs", c.runs, runs, When::newer);
  a.named("given", c.given, When::filled);
}

void members(auto& a, PoseClassDescription& c) {
  a.named("pair", c.pair, rule::pair);
  a.named("class", c.pose_class);
  a.named("description", c.description, When::newer);
  a.named("group", c.group, rule::group, When::newer);
  a.named("arrangement", c.arrangement, When::newer);
  a.named("modifiers", c.modifiers, When::newer);
  a.named("digest", c.digest, {.pattern = "^[0-9a-f]{16}$"}, When::filled);
}

void members(auto& a, Bounds& b) { a.elements(b.lower, b.upper); }

void members(auto& a, Quantiles& q) {
  a.named("median", q.median, rule::not_negative);
  a.named("p99", q.p99, rule::not_negative);
  a.named("max", q.max, rule::not_negative);
  a.ascending({"median", "p99", "max"});
  a.written("median_bounds", q.median_bounds, When::filled);
  a.written("p99_bounds", q.p99_bounds, When::filled);
}

void members(auto& a, LogHistogram& h) {
  a.named("zero", h.zero);
  a.named("first", h.first);
  a.named("counts", h.counts);
}

/// Quantiles of errors with the histogram that is drawn of them.
struct ErrorStatistics {
  Quantiles quantiles;
  std::optional<LogHistogram> histogram;
};
void members(auto& a, ErrorStatistics& e) {
  members(a, e.quantiles);
  a.named("histogram", e.histogram, When::filled);
}

void members(auto& a, SignedMedian& m) {
  a.named("median", m.value);
  a.written("median_bounds", m.bounds, When::filled);
}

template <class Archive>
void members(Archive& a, Shares& s) {
  a.named("mean", s.mean, rule::share);
  if constexpr (Archive::reads) s.median = s.p1 = s.min = s.mean;  // of older files
  a.named("median", s.median, rule::share, When::newer);
  a.named("p1", s.p1, rule::share, When::newer);
  a.named("min", s.min, rule::share, When::newer);
  a.ascending({"min", "p1", "median"});
  a.written("median_bounds", s.median_bounds, When::filled);
  a.written("p1_bounds", s.p1_bounds, When::filled);
}

template <class Archive>
void name_errors(Archive& a, const char* name, std::optional<Quantiles>& quantiles,
                 std::optional<LogHistogram>& histogram) {
  std::optional<ErrorStatistics> errors;
  if (quantiles) errors = {*quantiles, histogram};
  a.named(name, errors);
  if constexpr (Archive::reads) {
    if (errors) quantiles = errors->quantiles, histogram = errors->histogram;
  }
}

/// Numbers by outcome that add up to the count.
template <class Archive>
void name_outcomes(Archive& a, Statistics& s) {
  std::map<Outcome, std::uint64_t> outcomes;
  for (const Outcome outcome : all_outcomes) {
    if (s.of(outcome) > 0) outcomes[outcome] = s.of(outcome);
  }
  a.named("outcomes", outcomes);
  std::uint64_t left = s.count;
  bool all_fit = true;
  for (const auto& [outcome, count] : outcomes) {
    if constexpr (Archive::reads) s.outcomes[static_cast<std::size_t>(outcome)] = count;
    all_fit = all_fit && count <= left;
    left -= count;
  }
  a.require(all_fit && left == 0, "outcomes", "must be numbers whose sum is the count");
}

void members(auto& a, Statistics& s) {
  a.named("count", s.count, rule::row_count);
  name_outcomes(a, s);
  name_errors(a, "depth_error", s.depth_error, s.depth_histogram);
  name_errors(a, "normal_regret", s.normal_regret, s.regret_histogram);
  a.named("point_error", s.point_error);
  a.named("deepest_error", s.deepest_error, When::newer);
  a.named("bias", s.bias, When::newer);
  a.named("coverage", s.coverage);
  a.written("severity", s.severity);
  a.written("normal_angle", s.normal_angle);
  a.written("model_error", s.model_error);
  a.written("solver_error", s.solver_error);
  a.written("points", s.points);
}

/// The three numbers of a spread, all of them null where there is none.
template <class Archive>
void name_spread(Archive& a, std::optional<Spread>& spread, const char* median, const char* low,
                 const char* high) {
  std::optional<double> of_low, of_median, of_high;
  if (spread) of_low = spread->low, of_median = spread->median, of_high = spread->high;
  a.named(median, of_median, rule::measured);
  a.named(low, of_low, rule::measured, When::newer);
  a.named(high, of_high, rule::measured, When::newer);
  if (!of_median) return;
  a.require(of_low.has_value(), low, rule::measured.must);
  a.require(of_high.has_value(), high, rule::measured.must);
  a.ascending({low, median, high});
  if constexpr (Archive::reads) spread = {*of_median, *of_low, *of_high};
}

void members(auto& a, QueryTime& t) {
  Spread& time = t.nanoseconds;
  a.named("median", time.median, rule::measured);
  a.named("low", time.low, rule::measured);
  a.named("high", time.high, rule::measured);
  a.ascending({"low", "median", "high"});
  a.named("repetitions", t.repetitions, When::newer);
  a.named("p95", t.p95, rule::not_negative, When::newer);
  a.named("instructions", t.instructions, rule::measured);
  name_spread(a, t.ratio_to_bullet, "ratio_to_bullet", "ratio_low", "ratio_high");
  a.written("spread", time.high - time.low, rule::not_negative);
  std::optional<double> floor, our_clock, processor;
  if (const auto& m = t.measured)
    floor = m->floor, our_clock = m->our_clock, processor = m->processor;
  a.written("floor", floor, rule::not_negative);
  a.written("our_clock", our_clock, rule::not_negative);
  a.written("processor", processor, rule::not_negative);
}

/// An entry of `results`.
void members(auto& a, ResultRow& row) {
  a.named("pair", row.pair, rule::pair);
  a.named("class", row.pose_class);
  a.named("candidate", row.candidate);
  members(a, row.statistics);
  a.named("nanoseconds", row.time);
  a.written("worst_index", row.worst_index);
}

/// An entry of `summary`.
struct SummaryRow {
  ResultRow row;
};
void members(auto& a, SummaryRow& summary) {
  ResultRow& row = summary.row;
  a.named("pair", row.pair, rule::pair_or_all);
  a.named("class", row.pose_class, rule::group);
  a.named("candidate", row.candidate);
  members(a, row.statistics);
  a.named("nanoseconds", row.time);
  a.named("pareto", row.pareto);
  a.written("tied_with", row.tied_with);
}

void members(auto& a, TrendBin& b) {
  a.named("decade", b.decade);
  a.named("count", b.count);
  a.named("missed", b.missed);
  a.named("median", b.median, rule::not_negative);
  a.named("max", b.max, rule::not_negative);
}
void members(auto& a, Trend& t) {
  a.named("pair", t.pair, rule::pair);
  a.named("group", t.group, rule::group);
  a.named("candidate", t.candidate);
  constexpr Rule variable{.one_of = [] {
    return std::vector<std::string>{"tilt", "depth", "aspect", "distance"};
  }};
  a.named("variable", t.variable, variable);
  a.named("bins", t.bins);
}

void members(auto& a, FailureRate& r) {
  a.named("count", r.count);
  a.named("failed", r.failed);
}
void members(auto& a, Factor& f) {
  a.named("pair", f.pair, rule::pair);
  a.named("candidate", f.candidate);
  a.named("group", f.group, rule::group);
  a.named("kind", f.kind);
  a.named("name", f.name);
  a.named("with", f.with);
  a.named("without", f.without, rule::share);
  a.named("worst", text_or_null(f.worst));
}
void members(auto& a, Contrast& c) {
  a.named("pair", c.pair, rule::pair);
  a.named("candidate", c.candidate);
  a.named("arrangement", c.arrangement);
  a.named("plain_class", c.plain_class);
  a.named("modifier", c.modifier);
  a.named("plain", c.plain);
  a.named("modified", c.modified);
  a.named("chance", c.chance, rule::share);
  a.named("fails", c.fails);
  a.named("worst", text_or_null(c.worst));
}

/// The truth of an examination, and its answers by candidate (answer_json.hpp).
struct TruthOf {
  const Examination* examination;
};
nlohmann::json to_json(const TruthOf& truth);
struct AnswersOf {
  const Examination* examination;
};
nlohmann::json to_json(const AnswersOf& answers);

void members(auto& a, Examination& e) {
  a.named("id", e.id);
  a.named("configuration", e.configuration);
  a.named("replay", e.replay);
  std::optional<TruthOf> truth;
  std::optional<AnswersOf> answers;
  if (e.truth) truth = TruthOf{&e}, answers = AnswersOf{&e};
  a.named("truth", truth, When::filled);
  a.named("answers", answers, When::filled);
}

void members(auto& a, WorstCase& w) {
  members(a, w.examination);
  a.named("pair", w.pair, rule::pair);
  a.named("group", w.group, rule::group);
  a.named("class", w.pose_class);
  a.named("candidate", w.candidate);
  a.named("outcome", w.score.outcome);
  a.named("depth_error", w.score.depth_error);
  a.named("normal_regret", w.score.normal_regret, rule::not_negative);
  a.named("severity", w.score.severity, rule::not_negative);
}

void members(auto& a, DrakeCase& c) {
  a.named("description", c.description);
  a.named("configuration", c.configuration);
}
struct PublishedByDrake {
  std::optional<double> penetration, signed_distance;
};
void members(auto& a, PublishedByDrake& p) {
  a.named("penetration", p.penetration, rule::not_negative);
  a.named("signed_distance", p.signed_distance, rule::not_negative);
}
void members(auto& a, DrakeProtocol::Published& p) {
  a.named("pair", p.pair, rule::pair);
  a.named("published", PublishedByDrake{p.penetration, p.signed_distance});
  a.named("configurations", p.configurations);
}
void members(auto& a, DrakeProtocol::Result& r) {
  a.named("pair", r.pair, rule::pair);
  a.named("candidate", r.candidate);
  a.named("count", r.count);
  a.named("outcomes", r.outcomes);
  a.named("max_error", r.max_error, rule::not_negative);
  a.named("worst", r.worst);
}
void members(auto& a, DrakeProtocol& p) {
  a.named("depth", p.depth, rule::positive);
  a.named("pairs", p.pairs);
  a.named("results", p.results);
}

void members(auto& a, Casts::Row& r) {
  a.named("pair", r.pair, rule::pair);
  a.named("group", r.group, rule::group);
  a.named("candidate", r.candidate);
  a.named("count", r.count);
  a.named("outcomes", r.outcomes);
  a.named("wrong_by_motion", r.wrong_by_motion);
  a.named("distance_p99", r.distance_p99, rule::not_negative);
  a.named("distance_max", r.distance_max, rule::not_negative);
}
void members(auto& a, Casts::Worst& w) {
  a.named("id", w.id);
  a.named("pair", w.pair, rule::pair);
  a.named("group", w.group, rule::group);
  a.named("candidate", w.candidate);
  a.named("outcome", w.outcome);
  a.named("distance", w.distance);
  a.named("normal_regret", w.normal_regret, rule::not_negative);
  a.named("replay", w.replay);
  a.named("fraction", w.fraction, rule::share);
}
void members(auto& a, Casts& c) {
  a.named("count", c.count);
  a.named("results", c.results);
  a.named("worst", c.worst);
}

void members(auto& a, RecordedShare& s) {
  a.named("pair", s.pair, rule::pair);
  a.named("arrangement", s.arrangement.name);
  a.named("tilt", s.arrangement.tilt, rule::not_negative);
  a.named("share", s.share, rule::share);
}

void members(auto& a, ReleaseStep& s) {
  a.named("pair", s.pair, rule::pair);
  a.named("class", s.pose_class);
  a.named("candidate", s.candidate);
  a.named("before", s.before, rule::share);
  a.named("after", s.after, rule::share);
}
void members(auto& a, History& h) {
  a.named("engine", h.engine);
  a.named("steps", h.steps);
}

void members(auto& a, Report::Extent& e) {
  a.named("classes", e.classes);
  a.named("configurations", e.configurations);
}
struct CompletedExtent {
  Report::Extent extent;
  std::uint64_t timed_classes;
};
void members(auto& a, CompletedExtent& c) {
  members(a, c.extent);
  a.named("timed_classes", c.timed_classes);
}

template <class Archive>
void members(Archive& a, Report& r) {
  a.named("version", r.version);
  a.named("seed", r.seed);
  a.named("tolerance", r.tolerance, rule::positive);
  a.named("threshold", r.threshold, rule::not_negative);
  a.named("machine", r.machine);
  a.named("configurations", r.configurations);
  a.named("partial", r.partial);
  a.named("candidates", r.candidates);
  a.named("classes", r.classes, When::newer);
  a.named("results", r.results);
  std::vector<SummaryRow> summary;
  for (const ResultRow& row : r.summary) summary.push_back({row});
  if (!r.is_old) a.named("summary", summary);  // an old one is over all groups, as none is any more
  if constexpr (Archive::reads) {
    for (SummaryRow& row : summary) r.summary.push_back(std::move(row.row));
  }
  a.written("command", r.command);
  a.written("planned", r.planned);
  a.written("completed", CompletedExtent{r.completed, r.timed_classes});
  a.written("wall_seconds", r.wall_seconds, rule::not_negative);
  a.written("oracle_microseconds", r.oracle_microseconds);
  a.written("factors", r.factors);
  a.written("contrasts", r.contrasts);
  a.written("trends", r.trends);
  a.written("recorded", r.recorded);
  a.written("drake_protocol", r.drake_protocol);
  a.written("worst", r.worst);
  a.written("casts", r.casts, When::filled);
  a.written("stability", r.stability, When::filled);
  a.written("experiments", r.experiments, When::filled);
  a.written("engines", r.engines, When::filled);
  a.written("history", r.history, When::filled);
}

}  // namespace touchstone
