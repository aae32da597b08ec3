#include "reports/choice/choice_json.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fmt/format.h>

#include "properties/files/configuration_json.hpp"
#include "properties/files/write_file.hpp"
#include "reference/invalid_input.hpp"
#include "reports/machine.hpp"
#include "reports/report_json.hpp"

namespace touchstone {
namespace {

using nlohmann::json;

json finite(double x) { return std::isfinite(x) ? json(x) : json(nullptr); }

/// "scene-12.json": the configuration of the run number 12.
std::string evidence_file(const SceneFile& file, std::size_t run, const std::string& folder) {
  return fmt::format("{}/{}-{}.json", folder, file.name, run);
}

json run_json(const Choice& choice, const SceneFile& file, std::size_t index,
              const std::string& folder) {
  const SceneRun& run = choice.runs[index];
  const auto steps = static_cast<double>(choice.exact_run.frames.size() - 1);
  json models = json::array();
  for (const Candidate* m : run.models) models.push_back(m->name);
  json verdicts = json::array();
  for (const Verdict& v : run.verdicts) {
    verdicts.push_back(
        {{"value", finite(v.value)}, {"limit", v.limit}, {"time", v.time}, {"holds", v.holds()}});
  }
  json result = {{"name", run.name},
                 {"models", models},
                 {"microseconds_per_step", run.nanoseconds / 1000 / steps},
                 {"error", finite(run.error())},
                 {"holds", run.holds()},
                 {"verdicts", verdicts},
                 {"first_broken", nullptr},
                 {"evidence", nullptr}};
  if (!run.holds()) result["first_broken"] = run.first_broken();
  if (const auto& e = run.evidence) {
    const std::string at = evidence_file(file, index, folder);
    result["evidence"] = {{"bodies", e->bodies},
                          {"candidate", e->candidate},
                          {"wrong", e->wrong},
                          {"time", e->time},
                          {"configuration", to_json(e->configuration)},
                          {"replay", fmt::format("touchstone replay {} --candidates reference,{}",
                                                 at, e->candidate)}};
  }
  return result;
}

json kind_json(const Choice& choice, std::size_t k) {
  const PairKind& kind = choice.kinds.all()[k];
  const Candidate& exact = *choice.candidates[0];
  const Candidate& chosen = *choice.runs[choice.answer].models[k];
  json candidates = json::array();
  for (std::size_t c = 0; c < choice.candidates.size(); ++c) {
    const Replayed& r = choice.replayed[k][c];
    if (r.count == 0) continue;
    candidates.push_back({{"name", choice.candidates[c]->name},
                          {"nanoseconds", r.nanoseconds ? json(*r.nanoseconds) : json(nullptr)},
                          {"count", r.count},
                          {"agree", r.agree},
                          {"depth_error", finite(r.depth_error)},
                          {"normal_angle", r.normal_angle}});
  }
  json result = {{"name", kind.name},
                 {"bodies", kind.bodies},
                 {"pair", pair_name(kind.pair)},
                 {"asked", kind.asked.size()},
                 {"chosen", chosen.name},
                 {"nanoseconds", choice.nanoseconds(k, chosen)},
                 {"exact_nanoseconds", choice.nanoseconds(k, exact)},
                 {"next_cheaper", nullptr},
                 {"candidates", candidates}};
  if (!choice.cheaper.empty() && choice.cheaper[k]) {
    const Candidate& cheaper = *choice.runs[*choice.cheaper[k]].models[k];
    result["next_cheaper"] = {{"name", cheaper.name},
                              {"nanoseconds", choice.nanoseconds(k, cheaper)},
                              {"run", *choice.cheaper[k]}};
  }
  return result;
}

/// Runs that no other one beats in both error and cost, the dearest first.
json front(const Choice& choice) {
  std::vector<std::size_t> order(choice.runs.size());
  for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
  std::sort(order.begin(), order.end(), [&](std::size_t x, std::size_t y) {
    return std::pair(choice.runs[x].nanoseconds, choice.runs[x].error()) <
           std::pair(choice.runs[y].nanoseconds, choice.runs[y].error());
  });
  json result = json::array();
  double least = std::numeric_limits<double>::infinity();
  for (const std::size_t i : order) {
    if (!(choice.runs[i].error() < least)) continue;
    least = choice.runs[i].error();
    result.push_back(i);
  }
  return result;
}

}  // namespace

json to_json(const Choice& choice, const SceneFile& file, const std::string& command,
             const std::string& folder) {
  json needs = json::array();
  for (const Need& need : file.needs) {
    needs.push_back({{"text", describe(need, file.scene)}, {"unit", unit(need)}});
  }
  json runs = json::array(), kinds = json::array(), too_slow = json::array();
  for (std::size_t i = 0; i < choice.runs.size(); ++i) {
    runs.push_back(run_json(choice, file, i, folder));
  }
  for (std::size_t k = 0; k < choice.kinds.all().size(); ++k) kinds.push_back(kind_json(choice, k));
  for (const Candidate* c : choice.too_slow) too_slow.push_back(c->name);
  const double exact = choice.runs[0].nanoseconds;
  const double chosen = choice.runs[choice.answer].nanoseconds;
  const auto steps = static_cast<double>(choice.exact_run.frames.size() - 1);
  const double rest = choice.exact_run.seconds - choice.exact_run.contact_seconds;
  return {{"schema", "touchstone-choice-1"},
          {"command", command},
          {"machine", to_json(describe_machine())},
          {"scene",
           {{"name", file.name},
            {"description", file.description},
            {"bodies", file.scene.bodies.size()},
            {"step", file.scene.step},
            {"duration", file.scene.duration},
            {"needs", needs}}},
          {"possible", !choice.impossible},
          {"exact_is_cheapest", choice.answer == 0},
          {"time_saved", choice.impossible ? 0 : 1 - chosen / exact},
          {"rest_of_step_microseconds", rest * 1e6 / steps},
          {"kinds", kinds},
          {"answer", choice.answer},
          {"runs", runs},
          {"front", front(choice)},
          {"too_slow", too_slow}};
}

void write_evidence(const Choice& choice, const SceneFile& file, const std::string& folder) {
  check_writable(folder);
  for (std::size_t i = 0; i < choice.runs.size(); ++i) {
    if (!choice.runs[i].evidence) continue;
    const std::string at = evidence_file(file, i, folder);
    write_file(at, to_json(choice.runs[i].evidence->configuration).dump() + '\n', "--out");
  }
}

}  // namespace touchstone
