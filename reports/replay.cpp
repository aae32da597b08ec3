#include "reports/replay.hpp"

#include <cmath>
#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "properties/files/answer_json.hpp"
#include "properties/files/configuration_json.hpp"
#include "reports/pages/page.hpp"
#include "reports/report_json.hpp"

namespace touchstone {
namespace {

using nlohmann::json;

std::string coordinate(double x) { return std::isfinite(x) ? fmt::format("{:.17g}", x) : "nan"; }

std::string vector(const Vec3& v) {
  return fmt::format("({}, {}, {})", coordinate(v.x()), coordinate(v.y()), coordinate(v.z()));
}

std::string number(double x) { return std::isfinite(x) ? fmt::format("{:.17g}", x) : "-"; }

std::string rounded(const std::optional<double>& x) {
  return x && std::isfinite(*x) ? fmt::format("{:.3g}", *x) : "-";
}

std::string patch_text(const oracle::ContactPatch& patch) {
  using Kind = oracle::ContactPatch::Kind;
  std::string text = patch_kind_name(patch.kind());
  if (patch.kind() == Kind::segment) text += " of length " + rounded(patch.perimeter());
  if (patch.kind() == Kind::region) text += " of area " + rounded(patch.area());
  return text + " about " + vector(patch.centroid());
}

std::string truth_text(const Configuration& c, const oracle::Truth& truth) {
  const auto [low, high] = decimals(truth.signed_distance);
  std::string text = fmt::format("truth: signed distance between\n  {}\n  {}\n", low, high);
  for (const auto& normal : truth.normals) {
    text += fmt::format("  normal {}\n    patch: {}\n", vector(normal.n),
                        patch_text(oracle::contact_patch(c, normal)));
  }
  return text + fmt::format("  ties: {}\n\n", ties_name(truth.ties));
}

std::string answer_text(const ScoredAnswer& scored) {
  const auto& [candidate, answer, score] = scored;
  std::string text = fmt::format("{}: {}, {}\n", candidate, status_name(answer.status),
                                 outcome_name(score.outcome));
  if (!answer.reason.empty()) text += fmt::format("  {}\n", answer.reason);
  if (answer.status != TS_CONTACT) return text;
  text += fmt::format("  signed distance {}\n  normal          {}\n",
                      number(answer.signed_distance), vector(Vec3(answer.normal)));
  text += fmt::format("  depth error {}, normal regret {} (of the smaller size), angle {} deg\n",
                      rounded(score.depth_error), rounded(score.normal_regret),
                      rounded(score.normal_angle));
  text += fmt::format("  coverage {} of the contact patch, points off the bodies by {}\n",
                      rounded(score.coverage), rounded(score.point_error));
  text += fmt::format("  deepest point's error {}\n", rounded(score.deepest_error));
  for (int i = 0; i < answer.point_count; ++i) {
    const ts_point& p = answer.points[i];
    text += fmt::format("  point {}\n    depth {}\n", vector(Vec3(p.position)), number(p.depth));
  }
  return text;
}

}  // namespace

std::string replay_text(const Examination& e, const std::string& description) {
  json line = to_json(e.configuration);
  line["id"] = e.id;
  std::string text = e.id + '\n';
  if (!description.empty()) text += description + '\n';
  text += fmt::format(
      "\nconfiguration (a line for touchstone solve, as exact fractions, in hexadecimal):\n"
      "{}\n{}\n{}\n\n",
      line.dump(), to_exact_json(e.configuration).dump(), to_hex_json(e.configuration).dump());
  text += truth_text(e.configuration, *e.truth);
  for (const ScoredAnswer& answer : e.answers) text += answer_text(answer);
  return text;
}

std::string replay_json(const Examination& examination) {
  return to_json(examination).dump() + '\n';
}

std::string replay_page(const Examination& examination, const std::string& description) {
  json data = to_json(examination);
  data["hexadecimal"] = to_hex_json(examination.configuration);
  data["exact"] = to_exact_json(examination.configuration);
  data["description"] = description;
  std::vector<std::string> names;
  for (const ScoredAnswer& answer : examination.answers) names.push_back(answer.candidate);
  data["marks"] = marks(names);
  for (const std::string& name : names) {
    const std::string runs = runs_as(name);
    if (runs != "native") data["runs"][name] = runs;
  }
  return render_page(Page::replay, data);
}

}  // namespace touchstone
