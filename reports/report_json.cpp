#include "reports/report_json.hpp"

#include <utility>

#include <nlohmann/json.hpp>

#include "properties/files/answer_json.hpp"
#include "properties/files/configuration_json.hpp"
#include "properties/files/strict_json.hpp"

namespace touchstone {
namespace {

using nlohmann::json;

json to_json(const Bounds& bounds) { return {bounds.lower, bounds.upper}; }

json to_json(const std::optional<Quantiles>& q) {
  if (!q) return nullptr;
  json result = {{"median", q->median}, {"p99", q->p99}, {"max", q->max}};
  if (q->median_bounds) result["median_bounds"] = to_json(*q->median_bounds);
  if (q->p99_bounds) result["p99_bounds"] = to_json(*q->p99_bounds);
  return result;
}

json to_json(const std::optional<Quantiles>& q, const std::optional<LogHistogram>& h) {
  json result = to_json(q);
  if (h) result["histogram"] = {{"zero", h->zero}, {"first", h->first}, {"counts", h->counts}};
  return result;
}

json to_json(const std::optional<Shares>& s) {
  if (!s) return nullptr;
  json result = {{"mean", s->mean}, {"median", s->median}, {"p1", s->p1}, {"min", s->min}};
  if (s->median_bounds) result["median_bounds"] = to_json(*s->median_bounds);
  if (s->p1_bounds) result["p1_bounds"] = to_json(*s->p1_bounds);
  return result;
}

json to_json(const std::optional<SignedMedian>& m) {
  if (!m) return nullptr;
  json result = {{"median", m->value}};
  if (m->bounds) result["median_bounds"] = to_json(*m->bounds);
  return result;
}

json to_json(const OutcomeCounts& counts) {
  json result = json::object();
  for (const Outcome outcome : all_outcomes) {
    const std::uint64_t count = counts[static_cast<std::size_t>(outcome)];
    if (count > 0) result[outcome_name(outcome)] = count;
  }
  return result;
}

json to_json(const Statistics& s) {
  json points = json::object();
  for (const auto& [number, count] : s.points) points[std::to_string(number)] = count;
  json result = {{"count", s.count},
                 {"outcomes", to_json(s.outcomes)},
                 {"severity", to_json(s.severity)},
                 {"depth_error", to_json(s.depth_error, s.depth_histogram)},
                 {"bias", to_json(s.bias)},
                 {"normal_regret", to_json(s.normal_regret, s.regret_histogram)},
                 {"normal_angle", to_json(s.normal_angle)},
                 {"point_error", to_json(s.point_error)},
                 {"deepest_error", to_json(s.deepest_error)},
                 {"model_error", to_json(s.model_error)},
                 {"solver_error", to_json(s.solver_error)},
                 {"points", points},
                 {"coverage", to_json(s.coverage)}};
  return result;
}

json to_json(const std::optional<QueryTime>& time) {
  if (!time) return nullptr;
  const auto& [median, low, high] = time->nanoseconds;
  json result = {{"median", median},
                 {"low", low},
                 {"high", high},
                 {"spread", high - low},
                 {"p95", or_null(time->p95)},
                 {"repetitions", time->repetitions},
                 {"instructions", or_null(time->instructions)},
                 {"ratio_to_bullet", nullptr},
                 {"ratio_low", nullptr},
                 {"ratio_high", nullptr},
                 {"floor", nullptr},
                 {"our_clock", nullptr},
                 {"processor", nullptr}};
  if (time->measured) {
    result["floor"] = time->measured->floor;
    result["our_clock"] = time->measured->our_clock;
    result["processor"] = time->measured->processor;
  }
  if (const auto& ratio = time->ratio_to_bullet) {
    result["ratio_to_bullet"] = ratio->median;
    result["ratio_low"] = ratio->low;
    result["ratio_high"] = ratio->high;
  }
  return result;
}

json to_json(const Trend& trend) {
  json bins = json::array();
  for (const TrendBin& bin : trend.bins) {
    bins.push_back({{"decade", bin.decade ? json(*bin.decade) : json(nullptr)},
                    {"count", bin.count},
                    {"missed", bin.missed},
                    {"median", bin.median},
                    {"max", bin.max}});
  }
  return {{"pair", trend.pair},
          {"group", trend.group},
          {"candidate", trend.candidate},
          {"variable", trend.variable},
          {"bins", bins}};
}

json to_json(const DrakeProtocol::Published& p) {
  json configurations = json::array();
  for (const DrakeCase& c : p.configurations) {
    configurations.push_back(
        {{"description", c.description}, {"configuration", to_json(c.configuration)}});
  }
  return {
      {"pair", p.pair},
      {"published",
       {{"penetration", or_null(p.penetration)}, {"signed_distance", or_null(p.signed_distance)}}},
      {"configurations", configurations}};
}

json to_json(const DrakeProtocol::Result& r) {
  json outcomes = json::object();
  for (const auto& [outcome, count] : r.outcomes) outcomes[outcome_name(outcome)] = count;
  return {{"pair", r.pair},
          {"candidate", r.candidate},
          {"count", r.count},
          {"outcomes", outcomes},
          {"max_error", or_null(r.max_error)},
          {"worst", r.worst ? json(*r.worst) : json(nullptr)}};
}

json to_json(const CandidateDescription& c) {
  json result = {{"name", c.name},         {"family", c.family}, {"version", c.version},
                 {"settings", c.settings}, {"models", c.models}, {"precision", c.precision},
                 {"runs", c.runs}};
  if (c.given) result["given"] = true;
  return result;
}

json to_json(const RecordedShare& s) {
  return {{"pair", pair_name(s.pair)},
          {"arrangement", s.arrangement.name},
          {"tilt", s.arrangement.tilt ? json(*s.arrangement.tilt) : json(nullptr)},
          {"share", s.share}};
}

json to_json(const Report::Extent& extent) {
  return {{"classes", extent.classes}, {"configurations", extent.configurations}};
}

template <class Value>
json array_of(const std::vector<Value>& values) {
  json result = json::array();
  for (const Value& value : values) result.push_back(to_json(value));
  return result;
}

json to_json(const std::optional<DrakeProtocol>& protocol) {
  if (!protocol) return nullptr;
  return {{"depth", protocol->depth},
          {"pairs", array_of(protocol->pairs)},
          {"results", array_of(protocol->results)}};
}

}  // namespace

json to_json(const Machine& machine) {
  return {{"cpu", machine.cpu},
          {"cores", machine.cores},
          {"compiler", machine.compiler},
          {"os", machine.os}};
}

json to_json(const PoseClassDescription& c) {
  json result = {{"pair", c.pair},   {"class", c.pose_class},        {"description", c.description},
                 {"group", c.group}, {"arrangement", c.arrangement}, {"modifiers", c.modifiers}};
  if (!c.digest.empty()) result["digest"] = c.digest;
  return result;
}

namespace {

json row_json(const ResultRow& row) {
  json result = to_json(row.statistics);
  result["pair"] = row.pair;
  result["class"] = row.pose_class;
  result["candidate"] = row.candidate;
  result["nanoseconds"] = to_json(row.time);
  return result;
}

json to_json(const FailureRate& rate) { return {{"count", rate.count}, {"failed", rate.failed}}; }

}  // namespace

json summary_json(const Report& report) {
  json rows = json::array();
  for (const ResultRow& row : report.summary) {
    json& added = rows.emplace_back(row_json(row));
    added["pareto"] = row.pareto ? json(*row.pareto) : json(nullptr);
    added["tied_with"] = row.tied_with;
  }
  return rows;
}

json to_json(const ResultRow& row) {
  json result = row_json(row);
  result["worst_index"] = row.worst_index ? json(*row.worst_index) : json(nullptr);
  return result;
}

json to_json(const Factor& f) {
  return {{"pair", f.pair},
          {"candidate", f.candidate},
          {"group", f.group},
          {"kind", f.kind == Factor::Kind::arrangement ? "arrangement" : "modifier"},
          {"name", f.name},
          {"with", to_json(f.with)},
          {"without", f.without},
          {"worst", f.worst.empty() ? json(nullptr) : json(f.worst)}};
}

json to_json(const Contrast& c) {
  return {{"pair", c.pair},
          {"candidate", c.candidate},
          {"arrangement", c.arrangement},
          {"plain_class", c.plain_class},
          {"modifier", c.modifier},
          {"plain", to_json(c.plain)},
          {"modified", to_json(c.modified)},
          {"chance", c.chance},
          {"fails", c.fails},
          {"worst", c.worst.empty() ? json(nullptr) : json(c.worst)}};
}

json to_json(const Examination& e) {
  json result = {{"id", e.id}, {"configuration", to_json(e.configuration)}, {"replay", e.replay}};
  if (!e.truth) return result;
  result["truth"] = to_json(e.configuration, *e.truth);
  json& answers = result["answers"] = json::object();
  for (const auto& [candidate, answer, score] : e.answers) {
    answers[candidate] = to_json(answer, score);
  }
  return result;
}

json to_json(const WorstCase& worst) {
  json result = to_json(worst.examination);
  result["pair"] = worst.pair;
  result["group"] = worst.group;
  result["class"] = worst.pose_class;
  result["candidate"] = worst.candidate;
  result["outcome"] = outcome_name(worst.score.outcome);
  result["depth_error"] = or_null(worst.score.depth_error);
  result["normal_regret"] = or_null(worst.score.normal_regret);
  result["severity"] = worst.score.severity;
  return result;
}

json to_json(const Report& report) {
  json completed = to_json(report.completed);
  completed["timed_classes"] = report.timed_classes;
  json result = {{"schema", report_schema},
                 {"version", report.version},
                 {"command", report.command},
                 {"seed", report.seed},
                 {"tolerance", report.tolerance},
                 {"threshold", report.threshold},
                 {"machine", to_json(report.machine)},
                 {"configurations", report.configurations},
                 {"partial", report.partial},
                 {"planned", to_json(report.planned)},
                 {"completed", completed},
                 {"wall_seconds", report.wall_seconds},
                 {"oracle_microseconds", to_json(report.oracle_microseconds)},
                 {"candidates", array_of(report.candidates)},
                 {"classes", array_of(report.classes)},
                 {"results", array_of(report.results)},
                 {"summary", summary_json(report)},
                 {"factors", array_of(report.factors)},
                 {"contrasts", array_of(report.contrasts)},
                 {"trends", array_of(report.trends)},
                 {"recorded", array_of(report.recorded)},
                 {"drake_protocol", to_json(report.drake_protocol)},
                 {"worst", array_of(report.worst)}};
  if (report.stability) result["stability"] = to_json(*report.stability);
  if (report.experiments) result["experiments"] = to_json(*report.experiments);
  if (report.engines) result["engines"] = to_json(*report.engines);
  return result;
}

std::string text_by_lines(const json& object) {
  std::string text;
  for (const auto& [name, value] : object.items()) {
    text += (text.empty() ? "{\n" : ",\n") + json(name).dump() + ": ";
    if (!value.is_array() || value.empty()) {
      text += value.dump();
      continue;
    }
    const char* before = "[\n";
    for (const json& entry : value) text += std::exchange(before, ",\n") + entry.dump();
    text += "\n]";
  }
  return text + "\n}\n";
}

}  // namespace touchstone
