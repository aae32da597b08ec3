#include "reports/replay.hpp"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "properties/files/configuration_json.hpp"
#include "reports/worst.hpp"

namespace touchstone {
namespace {

using nlohmann::json;

std::string vector(const json& v) {
  if (v.is_null()) return "-";
  const auto coordinate = [&](int i) {
    return v[i].is_null() ? std::string("nan") : fmt::format("{:.17g}", v[i].get<double>());
  };
  return fmt::format("({}, {}, {})", coordinate(0), coordinate(1), coordinate(2));
}

std::string number(const json& v) {
  return v.is_null() ? "-" : fmt::format("{:.17g}", v.get<double>());
}

std::string short_number(const json& v) {
  return v.is_null() ? "-" : fmt::format("{:.3g}", v.get<double>());
}

std::string patch_text(const json& patch) {
  std::string text = patch["kind"];
  if (text == "segment") text += " of length " + short_number(patch["perimeter"]);
  if (text == "region") text += " of area " + short_number(patch["area"]);
  return text + " about " + vector(patch["centroid"]);
}

std::string answer_text(const std::string& name, const json& a) {
  const json& score = a["score"];
  std::string text = fmt::format("{}: {}, {}\n", name, a["status"].get<std::string>(),
                                 score["outcome"].get<std::string>());
  if (a.contains("reason")) text += fmt::format("  {}\n", a["reason"].get<std::string>());
  if (a["status"] != "contact") return text;
  text += fmt::format("  signed distance {}\n  normal          {}\n", number(a["signed_distance"]),
                      vector(a["normal"]));
  text += fmt::format("  depth error {}, normal regret {} (of the smaller size), angle {} deg\n",
                      short_number(score["depth_error"]), short_number(score["normal_regret"]),
                      short_number(score["normal_angle"]));
  text += fmt::format("  coverage {} of the contact patch, points off the bodies by {}\n",
                      short_number(score["coverage"]), short_number(score["point_error"]));
  text += fmt::format("  deepest point's error {}\n", short_number(score["deepest_error"]));
  for (const json& p : a["points"]) {
    text += fmt::format("  point {}\n    depth {}\n", vector(p["position"]), number(p["depth"]));
  }
  return text;
}

}  // namespace

std::string replay_text(const Subject& subject, const json& examined,
                        const std::vector<CandidateProcess>& candidates) {
  json line = examined["configuration"];
  line["id"] = subject.name;
  std::string text = subject.name + '\n';
  if (!subject.description.empty()) text += subject.description + '\n';
  text += '\n';
  text += fmt::format(
      "configuration (a line for touchstone solve, as exact fractions, in hexadecimal):\n"
      "{}\n{}\n{}\n\n",
      line.dump(), to_exact_json(subject.configuration).dump(),
      to_hex_json(subject.configuration).dump());
  const json& truth = examined["truth"];
  text += fmt::format("truth: signed distance between\n  {}\n  {}\n",
                      truth["signed_distance"][0].get<std::string>(),
                      truth["signed_distance"][1].get<std::string>());
  for (std::size_t i = 0; i < truth["normals"].size(); ++i) {
    text += fmt::format("  normal {}\n    patch: {}\n", vector(truth["normals"][i]),
                        patch_text(truth["patch"][i]));
  }
  text += fmt::format("  ties: {}\n\n", truth["ties"].get<std::string>());
  for (const CandidateProcess& process : candidates) {
    const std::string& name = process.candidate().name;
    text += answer_text(name, examined["answers"][name]);
  }
  return text;
}

}  // namespace touchstone
