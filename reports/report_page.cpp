// report.html and engines.html.
#include <array>
#include <cstdlib>
#include <fmt/format.h>
#include <map>
#include <optional>
#include <string>

#include <nlohmann/json.hpp>

#include "oracle/first_touch.hpp"
#include "oracle/judge/cast_score.hpp"
#include "properties/casts.hpp"
#include "properties/files/answer_json.hpp"
#include "properties/files/configuration_json.hpp"
#include "reports/findings.hpp"
#include "reports/pages/page.hpp"
#include "reports/replay.hpp"
#include "reports/report_json.hpp"
#include "reports/timing.hpp"

namespace touchstone {
namespace {

using nlohmann::json;

/// What the page shows of report.json, whose twenty thousand rows of classes alone would make it
/// three times as large: members that are not named are left out, "*" names all others. What stands
/// for a member says with how many digits its numbers are shown (pictures of bodies a million
/// metres away need ten), or that it is shown as it is.
const json& shown_parts() {
  static const json parts = json::parse(R"({
    "results": {
      "pair": true, "class": true, "candidate": true, "count": true, "outcomes": true,
      "points": true, "worst_index": true, "severity": {"max": 2}, "depth_error": {"p99": 2},
      "normal_regret": {"p99": 2}, "coverage": {"mean": 4}, "nanoseconds": {"median": 4, "p95": 4},
      "has_slow_tail": true
    },
    "summary": 4, "factors": 4, "contrasts": 4,
    "trends": {"bins": {"median": 2, "max": 2, "*": true}, "*": true},
    "casts": {
      "worst": {
        "truth": {
          "signed_distance": true, "normals": 10, "ties": true,
          "patch": {"kind": true, "centroid": 10, "outline": 10}
        },
        "*": true
      },
      "*": true
    },
    "worst": {
      "id": true, "pair": true, "group": true, "class": true, "candidate": true, "outcome": true,
      "severity": 10, "replay": true, "configuration": true, "faces": true,
      "truth": {
        "signed_distance": true, "normals": 10, "ties": true,
        "patch": {"kind": true, "centroid": 10, "outline": 10}
      },
      "answers": {"*": {
        "status": true, "reason": true, "signed_distance": 10, "normal": 10,
        "points": {"position": 10, "normal": 10},
        "score": {
          "outcome": true, "depth_error": 3, "normal_regret": 3, "normal_angle": 3, "coverage": 3
        }
      }}
    },
    "*": true
  })");
  return parts;
}

/// The same JSON with these parts alone.
json cut_to(const json& value, const json& parts) {
  if (value.is_number_float() && parts.is_number()) {
    return std::strtod(fmt::format("{:.{}g}", value.get<double>(), parts.get<int>()).c_str(),
                       nullptr);
  }
  if (!value.is_structured() || parts.is_boolean()) return value;
  json result = value.is_array() ? json::array() : json::object();
  for (const auto& [name, member] : value.items()) {
    if (value.is_array()) {
      result.push_back(cut_to(member, parts));
    } else if (parts.is_number()) {
      result[name] = cut_to(member, parts);
    } else if (const auto part = parts.find(parts.contains(name) ? name : "*");
               part != parts.end()) {
      result[name] = cut_to(member, *part);
    }
  }
  return result;
}

/// The first few worst cases of each pair × group × candidate, with the faces of their hulls.
json first_worst(const std::vector<WorstCase>& worst) {
  constexpr int max_shown = 2;
  std::map<std::array<std::string, 3>, int> seen;
  json cases = json::array();
  for (const WorstCase& w : worst) {
    if (++seen[{w.pair, w.group, w.candidate}] > max_shown) continue;
    cases.push_back(to_json(w));
    const json faces = faces_json(w.examination.configuration.b);
    if (!faces.empty()) cases.back()["faces"] = faces;
  }
  return cases;
}

/// What a picture of each worst cast needs: the cast, where A touches if it does, and the truth
/// there or, without a touch, where A starts.
void add_pictures(json& worst) {
  for (json& w : worst) {
    const auto [c, sweep] = make_cast(parse_cast_identity(w["id"].get<std::string>()));
    const oracle::FirstTouch touch = oracle::first_touch(c, Sweep(sweep));
    w["configuration"] = to_json(c, Sweep(sweep));
    w["faces"] = faces_json(c.b);
    w["touch"] = touch.there ? json(touch.fraction.hi.get_d()) : json(nullptr);
    w["truth"] = touch.there
                     ? to_json(swept(c, Sweep(sweep), touch.fraction.hi.get_d()), *touch.there)
                     : to_json(c, oracle::truth(c));
  }
}

json findings_json(const Report& report) {
  json list = json::array();
  for (const Finding& f : findings(report)) {
    list.push_back({{"candidate", f.candidate}, {"text", f.text}, {"command", f.command}});
  }
  return list;
}

}  // namespace

std::string report_page(const Report& report) {
  json data = to_json(report);
  data["worst"] = first_worst(report.worst);
  data["findings"] = findings_json(report);
  if (report.casts) add_pictures(data["casts"]["worst"]);
  for (std::size_t i = 0; i < report.results.size(); ++i) {
    const std::optional<QueryTime>& time = report.results[i].time;
    if (time && time->p95 && has_slow_tail(*time)) data["results"][i]["has_slow_tail"] = true;
  }
  std::map<std::string, std::string> runs;
  for (const CandidateDescription& c : report.candidates) runs[c.name] = c.runs;
  return render_page(Page::report, with_candidates(cut_to(data, shown_parts()), runs));
}

std::string engines_page(const EngineResults& results, const std::string& command,
                         const nlohmann::json& motions) {
  return render_page(
      Page::engines,
      with_candidates({{"command", command}, {"engines", to_json(results)}, {"motions", motions}},
                      {}));
}

}  // namespace touchstone
