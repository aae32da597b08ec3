#include "simulation/scenes/evidence.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <limits>

#include "oracle/judge/score.hpp"
#include "oracle/truth.hpp"
#include "properties/files/configuration_json.hpp"

namespace touchstone {
namespace {

using nlohmann::json;

/// So many answers are held against the oracle.
constexpr std::size_t most_scored = 24;

std::vector<Asked> before_break(const Trajectory& went, double time, const std::vector<int>& bodies,
                                const auto& by_exact) {
  const auto asked_of = [&](bool any_body) {
    std::vector<Asked> result;
    for (const Asked& a : went.asked) {
      if (went.step * a.frame > time + went.step / 2) break;
      const auto names = [&](int body) {
        return std::find(bodies.begin(), bodies.end(), body) != bodies.end();
      };
      const bool touches = a.depth > 0 || a.status != TS_NONE;
      if (touches && !by_exact(a) && (any_body || names(a.a) || names(a.b))) result.push_back(a);
    }
    return result;
  };
  auto result = asked_of(bodies.empty());
  return result.empty() ? asked_of(true) : result;
}

/// The one whose depth is most wrong, and others evenly over time.
std::vector<Asked> worth_scoring(std::vector<Asked> all) {
  if (all.size() <= most_scored) return all;
  std::vector<Asked> result = {*std::max_element(
      all.begin(), all.end(),
      [](const Asked& x, const Asked& y) { return x.depth_error() < y.depth_error(); })};
  for (std::size_t i = 1; i < most_scored; ++i) {
    result.push_back(all[i * (all.size() - 1) / (most_scored - 1)]);
  }
  return result;
}

/// Points that span less of the patch are worth a word.
constexpr double poor_coverage = 0.5;

std::string in_words(const Score& s, const Configuration& c) {
  const double size = error_size(c, Bar{});
  std::string text = outcome_name(s.outcome);
  switch (s.outcome) {
    case Outcome::agree:
      text = "depth and normal are right";
      break;
    case Outcome::missed:
      return fmt::format("missed, {:.2g} m deep", s.severity * size);
    case Outcome::wrong_normal:
      return fmt::format("normal wrong by {:.2g}°", s.normal_angle.value_or(0));
    case Outcome::phantom:
    case Outcome::shallow:
    case Outcome::overdeep:
      text += fmt::format(" by {:.2g} m", std::abs(*s.depth_error) * size);
      break;
    case Outcome::shallow_points:
    case Outcome::overdeep_points:
    case Outcome::phantom_points:
      return text + fmt::format(" by {:.2g} m", s.severity * size);
    default:
      return text;
  }
  if (s.coverage.value_or(1) >= poor_coverage) return text;
  return text + fmt::format(", but {} {:.2f} of the contact patch",
                            s.points == 1 ? "its 1 point spans"
                                          : fmt::format("its {} points span", s.points),
                            *s.coverage);
}

/// Points that span nothing of the patch weigh as much as a tenth of the size in depth or normal.
double badness(const Score& s) {
  const bool no_answer = s.outcome != Outcome::agree && s.severity == 0;
  if (no_answer) return std::numeric_limits<double>::infinity();
  return 10 * s.severity + 1 - s.coverage.value_or(1);
}

}  // namespace

std::optional<Evidence> find_evidence(const SceneRun& run, const SceneFile& file,
                                      const Trajectory& went, const PairKinds& kinds,
                                      const Candidate& exact, Processes& processes) {
  const int broken = run.first_broken();
  const auto model_of = [&](const Asked& a) {
    const int kind = kinds.of(a.a, a.b);
    return kind >= 0 && run.models[kind] ? run.models[kind] : &exact;
  };
  const auto all = before_break(went, run.verdicts[broken].time, bodies_of(file.needs[broken]),
                                [&](const Asked& a) { return model_of(a) == &exact; });
  std::optional<Evidence> worst;
  double most = -1;
  for (const Asked& a : worth_scoring(all)) {
    const Candidate& model = *model_of(a);
    const Configuration c = went.configuration(file.scene, a);
    const Score s = score(c, oracle::truth(c), processes.of(model).answer(c), Bar{});
    if (badness(s) <= most) continue;
    most = badness(s);
    worst = {c, file.scene.bodies[a.a].name + " and " + file.scene.bodies[a.b].name, model.name,
             in_words(s, c), went.step * a.frame};
  }
  return worst;
}

std::string to_bytes(const SceneRun& run) {
  json verdicts = json::array();
  for (const Verdict& v : run.verdicts) {
    verdicts.push_back({std::isfinite(v.value) ? json(v.value) : json(nullptr), v.limit, v.time});
  }
  json result = {{"verdicts", verdicts}};
  if (const auto& e = run.evidence) {
    result["evidence"] = {{"configuration", to_json(e->configuration)},
                          {"bodies", e->bodies},
                          {"candidate", e->candidate},
                          {"wrong", e->wrong},
                          {"time", e->time}};
  }
  return result.dump();
}

void from_bytes(const std::string& bytes, SceneRun& run) {
  const json parsed = json::parse(bytes);
  run.verdicts.clear();
  for (const json& v : parsed["verdicts"]) {
    run.verdicts.push_back(
        {v[0].is_null() ? std::numeric_limits<double>::infinity() : v[0].get<double>(),
         v[1].get<double>(), v[2].get<double>()});
  }
  if (!parsed.contains("evidence")) return;
  const json& e = parsed["evidence"];
  run.evidence = {configuration_from_json(e["configuration"]).configuration,
                  e["bodies"].get<std::string>(), e["candidate"].get<std::string>(),
                  e["wrong"].get<std::string>(), e["time"].get<double>()};
}

}  // namespace touchstone
