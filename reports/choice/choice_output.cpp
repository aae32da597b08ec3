#include <algorithm>
#include <cctype>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <limits>
#include <utility>

#include <nlohmann/json.hpp>

#include "properties/files/configuration_json.hpp"
#include "properties/files/disk.hpp"
#include "properties/files/strict_json.hpp"
#include "reports/choice/choice.hpp"
#include "reports/make_report.hpp"
#include "reports/pages/page.hpp"
#include "reports/replay.hpp"
#include "reports/report_json.hpp"

namespace touchstone {
namespace {

using nlohmann::json;

json run_json(const Choice& choice, std::size_t index, const std::string& folder) {
  const SceneRun& run = choice.runs[index];
  const double steps = choice.steps();
  json models = json::array();
  for (const Candidate* m : run.models) models.push_back(m->name);
  json result = run_json(choice.file, run);
  result.update({{"name", run.name},
                 {"models", models},
                 {"models_alone", choice.has_models_alone(run)},
                 {"microseconds_per_step", run.nanoseconds / 1000 / steps},
                 {"step_microseconds", run.seconds() * 1e6 / steps},
                 {"points_per_step", run.points},
                 {"solver_microseconds_per_step", run.solver_seconds * 1e6 / steps},
                 {"timed", run.timing > 0},
                 {"overlap", run.straying.overlap},
                 {"strayed", run.straying.distance},
                 {"strayed_body", run.straying.body},
                 {"tilted", run.straying.tilt},
                 {"tilted_body", run.straying.tilted_body},
                 {"render", render_command(choice, run)},
                 {"evidence", nullptr}});
  if (const auto& e = run.evidence) {
    const std::string file = evidence_file(choice, index, folder);
    result["evidence"] = {{"bodies", e->bodies},
                          {"candidate", e->candidate},
                          {"wrong", e->wrong},
                          {"time", e->time},
                          {"configuration", to_json(e->configuration)},
                          {"replay", replay_command(file, e->candidate)}};
  }
  return result;
}

json score_json(const std::string& candidate, const ReplayScore& s) {
  return {{"name", candidate},
          {"nanoseconds", or_null(s.nanoseconds)},
          {"count", s.count},
          {"agree", s.agree},
          {"depth_error", or_null(s.depth_error)},
          {"normal_angle", s.normal_angle}};
}

json kind_json(const Choice& choice, std::size_t k) {
  const PairKind& kind = choice.kinds.all()[k];
  const Candidate& exact = *choice.candidates[0];
  const Candidate& chosen = *choice.runs[choice.answer].models[k];
  json candidates = json::array();
  for (std::size_t c = 0; c < choice.candidates.size(); ++c) {
    const ReplayScore& s = choice.replayed[k][c];
    if (s.count > 0) candidates.push_back(score_json(choice.candidates[c]->name, s));
  }
  json result = {{"name", kind.name},
                 {"bodies", kind.bodies},
                 {"pair", pair_name(kind.pair)},
                 {"asked", kind.answers.size()},
                 {"chosen", chosen.name},
                 {"is_sphere", choice.is_sphere(k, chosen)},
                 {"bytes", choice.model_bytes(k, chosen)},
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

/// Indices of the runs that no other one beats in both error and cost, the cheapest first.
json front(const Choice& choice) {
  std::vector<std::size_t> order(choice.runs.size());
  for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
  std::sort(order.begin(), order.end(), [&](std::size_t x, std::size_t y) {
    return std::pair(choice.runs[x].seconds(), choice.runs[x].error()) <
           std::pair(choice.runs[y].seconds(), choice.runs[y].error());
  });
  json result = json::array();
  double min_error = std::numeric_limits<double>::infinity();
  for (const std::size_t i : order) {
    if (!(choice.runs[i].error() < min_error)) continue;
    min_error = choice.runs[i].error();
    result.push_back(i);
  }
  return result;
}

json pair_candidate_json(const PairCandidate& candidate, const std::string& file) {
  json result = score_json(candidate.name, candidate.score);
  result["serves"] = candidate.serves;
  result["worst"] = nullptr;
  if (candidate.worst) {
    result["worst"] = {{"configuration", to_json(*candidate.worst)},
                       {"file", file},
                       {"replay", replay_command(file, candidate.name)}};
  }
  return result;
}

/// A robot's name as part of a file name.
std::string as_file_name(std::string name) {
  constexpr std::size_t max_length = 100;
  name.resize(std::min(name.size(), max_length));
  const auto is_plain = [](unsigned char c) {
    return std::isalnum(c) != 0 || c == '-' || c == '_' || c == '.';
  };
  std::replace_if(
      name.begin(), name.end(), [&](char c) { return !is_plain(c); }, '-');
  return name;
}

void write_configuration(const std::string& file, const Configuration& configuration) {
  write_file(file, to_json(configuration).dump() + '\n', "--out");
}

}  // namespace

json run_json(const SceneFile& file, const RepeatedRun& run) {
  json verdicts = json::array();
  for (const Verdict& v : run.verdicts) {
    verdicts.push_back({{"value", or_null(v.value)},
                        {"limit", v.limit},
                        {"time", v.time},
                        {"bodies", bodies_of(file, v)},
                        {"holds", v.holds()}});
  }
  return {{"error", or_null(run.error())},
          {"holds", run.holds()},
          {"trials", run.trials},
          {"held", run.held},
          {"disturbance", run.disturbance},
          {"verdicts", verdicts},
          {"first_broken", run.holds() ? json(nullptr) : json(run.first_broken())}};
}

json scene_json(const SceneFile& file, const Trials& trials, const Spreads& spreads) {
  json needs = json::array(), undecidable = json::array();
  for (std::size_t i = 0; i < file.needs.size(); ++i) {
    const Need& need = *file.needs[i];
    needs.push_back({{"text", need.text(file.scene)}, {"unit", need.unit}, {"spread", nullptr}});
    const bool is_compared = i < spreads.of_needs.size() && spreads.of_needs[i].has_value();
    if (is_compared) needs.back()["spread"] = *spreads.of_needs[i];
  }
  for (const Undecidable& u : spreads.undecidable) {
    undecidable.push_back(
        {{"text", u.text}, {"unit", u.unit}, {"limit", u.limit}, {"spread", or_null(u.spread)}});
  }
  return {{"name", file.name},
          {"description", file.description},
          {"ignored", file.ignored},
          {"bodies", file.scene.bodies.size()},
          {"step", file.scene.step},
          {"duration", file.scene.duration},
          {"disturbances", trials.disturbances},
          {"seed", trials.seed},
          {"needs", needs},
          {"undecidable", undecidable}};
}

json choice_json(const Choice& choice, const std::string& command, const std::string& folder) {
  json runs = json::array(), kinds = json::array(), too_slow = json::array(), same = json::array();
  for (std::size_t i = 0; i < choice.runs.size(); ++i) {
    runs.push_back(run_json(choice, i, folder));
  }
  for (std::size_t k = 0; k < choice.kinds.all().size(); ++k) kinds.push_back(kind_json(choice, k));
  for (const Candidate* c : choice.too_slow) too_slow.push_back(c->name);
  for (const Candidate* c : choice.same_as_sphere) same.push_back(c->name);
  return {{"schema", "touchstone-choice-1"},
          {"command", command},
          {"machine", to_json(describe_machine())},
          {"scene", scene_json(choice.file, choice.trials, choice.spreads)},
          {"possible", !choice.impossible},
          {"step_saved", choice.impossible ? 0 : choice.step_saved()},
          {"worthwhile", choice.answer != 0},
          {"frame_microseconds", choice.frame_seconds(choice.runs[choice.answer]) * 1e6},
          {"exact_frame_microseconds", choice.frame_seconds(choice.runs[0]) * 1e6},
          {"point_microseconds",
           choice.point_seconds() ? json(*choice.point_seconds() * 1e6) : json(nullptr)},
          {"unasked", unasked_text(choice)},
          {"cheaper_routines", choice.impossible ? "" : cheaper_routines(choice)},
          {"long_step", long_step_text(choice)},
          {"kinds", kinds},
          {"answer", choice.answer},
          {"runs", runs},
          {"front", front(choice)},
          {"too_slow", too_slow},
          {"same_as_sphere", same}};
}

json pairs_json(const PairsChoice& choice, const std::string& command, const std::string& folder) {
  json pairs = json::array();
  for (std::size_t i = 0; i < choice.pairs.size(); ++i) {
    const PairChoice& pair = choice.pairs[i];
    json candidates = json::array();
    for (const PairCandidate& c : pair.candidates) {
      candidates.push_back(pair_candidate_json(c, evidence_file(choice, i, c, folder)));
    }
    pairs.push_back({{"name", pair.name},
                     {"example", pair.example},
                     {"count", pair.count},
                     {"chosen", pair.chosen ? candidates[*pair.chosen] : json(nullptr)},
                     {"candidates", candidates}});
  }
  return {{"schema", "touchstone-pair-choice-1"},
          {"command", command},
          {"machine", to_json(describe_machine())},
          {"name", choice.name},
          {"shapes", choice.shapes},
          {"ignored", choice.ignored},
          {"needs",
           {{"depth", choice.needs.depth},
            {"angle", choice.needs.angle},
            {"count", choice.needs.count},
            {"seed", choice.needs.seed}}},
          {"pairs", pairs}};
}

std::string choice_page(json choice, json motion) {
  choice["motion"] = std::move(motion);
  return render_page(Page::choice, choice);
}

std::string evidence_file(const Choice& choice, std::size_t run, const std::string& folder) {
  return fmt::format("{}/{}-{}.json", folder, choice.file.name, run);
}

std::string evidence_file(const PairsChoice& choice, std::size_t pair,
                          const PairCandidate& candidate, const std::string& folder) {
  std::string name = candidate.name;
  std::replace(name.begin(), name.end(), ':', '-');
  return fmt::format("{}/{}-{}-{}.json", folder, as_file_name(choice.name), pair + 1, name);
}

std::string render_command(const Choice& choice, const SceneRun& run) {
  std::vector<std::string> names;
  for (const Candidate* m : run.models) names.push_back(m->name);
  std::string command = fmt::format(
      "{} simulate {} --povray out/render --contacts {}", program_name(names), choice.arguments,
      shell_quoted(fmt::format("{}", fmt::join(choice.contacts_of(run), ","))));
  if (run.disturbance == 0) return command;
  return command + fmt::format(" --disturbance {} --seed {}", run.disturbance, choice.trials.seed);
}

std::string replay_command(const std::string& file, const std::string& candidate) {
  return fmt::format("{} replay {} --candidates reference,{}", program_name({candidate}),
                     shell_quoted(file), shell_quoted(candidate));
}

void write_evidence(const Choice& choice, const std::string& folder) {
  check_writable(folder);
  remove_older(folder, choice.file.name + '-', ".json");
  for (std::size_t i = 0; i < choice.runs.size(); ++i) {
    if (const auto& e = choice.runs[i].evidence) {
      write_configuration(evidence_file(choice, i, folder), e->configuration);
    }
  }
}

void write_evidence(const PairsChoice& choice, const std::string& folder) {
  remove_older(folder, as_file_name(choice.name) + '-', ".json");
  for (std::size_t i = 0; i < choice.pairs.size(); ++i) {
    for (const PairCandidate& c : choice.pairs[i].candidates) {
      if (!c.worst) continue;
      check_writable(folder);
      write_configuration(evidence_file(choice, i, c, folder), *c.worst);
    }
  }
}

}  // namespace touchstone
