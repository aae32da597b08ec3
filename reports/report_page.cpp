// report.html and engines.html.
#include <algorithm>
#include <array>
#include <cstdint>
#include <cstdlib>
#include <fmt/format.h>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include <nlohmann/json.hpp>

#include "properties/files/configuration_json.hpp"
#include "reports/pages/page.hpp"
#include "reports/replay.hpp"
#include "reports/report_json.hpp"
#include "simulation/experiment.hpp"

namespace touchstone {
namespace {

using nlohmann::json;

json rounded(const json& v, int digits) {
  if (v.is_number_float()) {
    return std::strtod(fmt::format("{:.{}g}", v.get<double>(), digits).c_str(), nullptr);
  }
  json result = v;
  if (v.is_structured()) {
    for (json& member : result) member = rounded(member, digits);
  }
  return result;
}

/// Of the rows of classes, of which there are twenty thousand, what the page shows of a class, with
/// as many digits: the class by its index, outcomes as [index in all_outcomes, count, …], of each
/// error one number.
json shown_of_classes(const json& results, const json& classes) {
  constexpr int digits = 2;
  std::map<std::pair<std::string, std::string>, std::size_t> index_of;
  for (const json& c : classes) index_of.try_emplace({c["pair"], c["class"]}, index_of.size());
  json rows = json::array();
  for (const json& row : results) {
    if (row["outcomes"].value("unsupported", std::uint64_t{0}) == row["count"]) continue;
    json shown;
    shown["class"] = index_of.at({row["pair"], row["class"]});
    for (const char* member : {"candidate", "worst_index"}) shown[member] = row[member];
    json& outcomes = shown["outcomes"] = json::array();
    for (std::size_t i = 0; i < all_outcomes.size(); ++i) {
      const auto of_outcome = row["outcomes"].find(outcome_name(all_outcomes[i]));
      if (of_outcome == row["outcomes"].end()) continue;
      outcomes.insert(outcomes.end(), {i, *of_outcome});
    }
    for (const auto& [member, value] :
         {std::pair("severity", "max"), std::pair("depth_error", "p99"),
          std::pair("normal_regret", "p99")}) {
      shown[member] = row[member].is_null() ? json(nullptr) : rounded(row[member][value], digits);
    }
    shown["coverage"] = row["coverage"].is_null() ? json(nullptr) : row["coverage"]["mean"];
    const json& time = row["nanoseconds"];
    shown["nanoseconds"] = time.is_null() ? time : json{time["median"], time["p95"]};
    // The thesis, beside which they are shown, has no more modifiers.
    const auto name = row["class"].get<std::string>();
    const bool is_plain = name.find('+') == std::string::npos || name.ends_with("+shallow");
    shown["points"] = is_plain ? row["points"] : json(nullptr);
    rows.push_back(std::move(shown));
  }
  return rows;
}

/// Of an answer to a worst case, what the page shows. A point whose normal is that of the whole
/// answer has none of its own.
json shown_answer(json answer) {
  constexpr int digits_of_score = 3;
  json& score = answer["score"];
  for (const char* unseen : {"deepest_error", "point_error"}) score.erase(unseen);
  score = rounded(score, digits_of_score);
  for (json& point : answer["points"]) {
    point.erase("depth");
    if (point["normal"] == answer["normal"]) point.erase("normal");
  }
  return answer;
}

/// Of the worst cases, the first few of each pair × group × candidate, with as many digits of truth
/// and answers as pictures of bodies a million metres away need; configurations stay exact.
json shown_worst(const json& worst) {
  constexpr int max_shown = 2, digits = 10;
  std::map<std::array<std::string, 3>, int> seen;
  json cases = json::array();
  for (json w : worst) {
    if (++seen[{w["pair"], w["group"], w["candidate"]}] > max_shown) continue;
    for (const char* unseen : {"depth_error", "normal_regret"}) w.erase(unseen);
    for (json& answer : w["answers"]) answer = rounded(shown_answer(std::move(answer)), digits);
    json& truth = w["truth"] = rounded(w["truth"], digits);
    truth.erase("families");
    for (json& patch : truth["patch"]) {
      for (const char* unseen : {"area", "perimeter"}) patch.erase(unseen);
    }
    for (json& bound : truth["signed_distance"]) {
      bound = rounded(std::strtod(bound.get<std::string>().c_str(), nullptr), digits);
    }
    cases.push_back(std::move(w));
  }
  return cases;
}

/// Bins as lists instead of objects, with as many digits as are shown.
json shown_trends(json trends) {
  constexpr int digits = 2;
  for (json& trend : trends) {
    for (json& bin : trend["bins"]) {
      bin = {bin["decade"], bin["count"], bin["missed"], rounded(bin["median"], digits),
             rounded(bin["max"], digits)};
    }
  }
  return trends;
}

}  // namespace

std::string report_page(const Report& report) {
  constexpr int digits = 4;
  json data = to_json(report);
  data["results"] = shown_of_classes(data["results"], data["classes"]);
  data["worst"] = shown_worst(data["worst"]);
  data["trends"] = shown_trends(std::move(data["trends"]));
  for (const char* list : {"results", "summary", "trends", "classes", "factors", "contrasts"}) {
    data[list] = rounded(data[list], digits);
  }
  std::vector<std::string> names;
  for (const CandidateDescription& c : report.candidates) names.push_back(c.name);
  data["marks"] = marks(names);
  data["program"] = program_name({});
  for (const CandidateDescription& c : report.candidates) {
    if (c.runs != "native") data["runs"][c.name] = c.runs;
    // Needs an option before it is known.
    const std::string program = program_name({c.name});
    if (program != data["program"]) data["programs"][c.name] = program;
  }
  json& outcomes = data["outcomes"] = json::array();
  for (const Outcome outcome : all_outcomes) outcomes.push_back(outcome_name(outcome));
  return render_page(Page::report, data);
}

namespace {

/// Looks from a little above at all moving bodies.
json camera_of(const Scene& scene) {
  Vec3 middle = Vec3::Zero();
  int moving = 0;
  for (const Body& b : scene.bodies) {
    if (!b.fixed) middle += b.pose.position(), ++moving;
  }
  middle /= std::max(moving, 1);
  double reach = 0;
  for (const Body& b : scene.bodies) {
    if (b.fixed) continue;
    reach = std::max(reach, (b.pose.position() - middle).norm() + largest_half_extent(b.shape));
  }
  const Vec3 from = middle + 6 * reach * Vec3(0.5, -0.8, 0.33);
  return {{"position", touchstone::to_json(from)}, {"look_at", touchstone::to_json(middle)}};
}

json motion_json(const EngineResult& result, double step) {
  const Experiment& experiment = find_experiment(result.experiment);
  json runs = json::array();
  EngineMotion motion;
  for (const bool cured : {false, true}) {
    motion = record_motion(experiment, result.engine, {.cured = cured}, step);
    runs.push_back({{"poses", base64(motion.poses)}});
  }
  return {{"experiment", result.experiment},
          {"engine", result.engine},
          {"bodies", bodies_json(motion.scene)},
          {"camera", camera_of(motion.scene)},
          {"interval", motion.interval},
          {"duration", motion.scene.duration},
          {"runs", runs}};
}

/// The results whose motion is worth seeing, the most striking first: those that are cured, by how
/// far they were from the answer on paper. Each experiment is shown once.
std::vector<const EngineResult*> worth_seeing(const EngineResults& results) {
  constexpr std::size_t max_shown = 4;
  std::vector<const EngineResult*> all, shown;
  for (const EngineResult& r : results.results) {
    if (is_one_run(find_experiment(r.experiment), results.step)) all.push_back(&r);
  }
  const auto gain = [](const EngineResult& r) { return r.cured.exact ? r.own.error : 0; };
  std::stable_sort(all.begin(), all.end(), [&](const EngineResult* x, const EngineResult* y) {
    return gain(*x) > gain(*y);
  });
  for (const EngineResult* r : all) {
    const bool is_new = std::none_of(shown.begin(), shown.end(), [&](const EngineResult* s) {
      return s->experiment == r->experiment;
    });
    if (is_new && shown.size() < max_shown) shown.push_back(r);
  }
  return shown;
}

}  // namespace

std::string engines_page(const EngineResults& results, const std::string& command) {
  json motions = json::array();
  for (const EngineResult* r : worth_seeing(results)) {
    const auto ended = [](const ExperimentResult& run) {
      return run.outcome == ExperimentResult::Outcome::crashed ||
             run.outcome == ExperimentResult::Outcome::timed_out;
    };
    if (!ended(r->own) && !ended(r->cured)) motions.push_back(motion_json(*r, results.step));
  }
  return render_page(Page::engines, {{"command", command},
                                     {"program", program_name({})},
                                     {"marks", json::object()},
                                     {"engines", to_json(results)},
                                     {"motions", motions}});
}

}  // namespace touchstone
