#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "properties/files/disk.hpp"
#include "properties/motions/critical_pose.hpp"
#include "reports/pages/page.hpp"
#include "reports/stability/stability.hpp"

namespace touchstone {
namespace {

using nlohmann::json;

json short_json(const std::optional<double>& value) {
  if (!value) return nullptr;
  const double shown = short_number(*value);
  return shown == 0 ? json(0) : json(shown);
}

json rounded_up_json(const std::optional<double>& ratio) {
  return ratio ? json(rounded_up(*ratio)) : json(nullptr);
}

json list(const ByAmplitude<std::optional<double>>& values,
          json (*to_json)(const std::optional<double>&)) {
  json result = json::array();
  for (const auto& value : values) result.push_back(to_json(value));
  return result;
}

json to_json(const Amplification& a) {
  json amplitudes = json::array(), results = json::array(), truth = json::array(),
       worst = json::array();
  for (std::size_t i = 0; i < amplitude_count; ++i) amplitudes.push_back(amplitude(i).value());
  for (const Amplification::Row& row : a.results) {
    results.push_back({{"pair", row.pair},
                       {"class", row.pose_class},
                       {"candidate", row.candidate},
                       {"amplification", list(row.amplification, rounded_up_json)},
                       {"jump", short_json(row.jump)},
                       {"hull_excess", list(row.hull_excess, short_json)},
                       {"regret", list(row.regret, short_json)},
                       {"points_changed", row.points_changed},
                       {"missed", row.missed},
                       {"unanswered", row.unanswered}});
  }
  for (const Amplification::TruthRow& row : a.truth) {
    truth.push_back({{"pair", row.pair},
                     {"class", row.pose_class},
                     {"amplification", list(row.amplification, rounded_up_json)}});
  }
  for (const Amplification::WorstStep& step : a.worst) {
    worst.push_back({{"pair", step.pair},
                     {"class", step.pose_class},
                     {"candidate", step.candidate},
                     {"measure", step.measure},
                     {"value", step.value},
                     {"from", step.from},
                     {"to", step.to}});
  }
  return {{"amplitudes", amplitudes}, {"seed", a.seed}, {"count", a.count},
          {"results", results},       {"truth", truth}, {"worst", worst}};
}

/// "289." for 289 dots, "3m2." for mmm..
std::string run_lengths(const std::string& letters) {
  std::string result;
  for (std::size_t start = 0; start < letters.size();) {
    const std::size_t end =
        std::min(letters.find_first_not_of(letters[start], start), letters.size());
    if (end - start > 1) result += std::to_string(end - start);
    result += letters[start];
    start = end;
  }
  return result;
}

json to_json(const FailureMaps& maps) {
  json zooms = json::array(), letters = json::object(), poses = json::array();
  for (const Decade& zoom : maps.zooms) zooms.push_back(zoom.name());
  for (const MapLetter& l : map_letters) letters[std::string(1, l.letter)] = l.meaning;
  for (const FailureMaps::Pose& pose : maps.poses) {
    json results = json::array();
    for (const FailureMaps::Picture& picture : pose.pictures) {
      json strings = json::array();
      for (const std::string& pixels : picture.letters) strings.push_back(run_lengths(pixels));
      results.push_back({{"candidate", picture.candidate}, {"maps", strings}});
    }
    poses.push_back({{"pose", pose.name},
                     {"description", pose.description},
                     {"pair", pose.pair},
                     {"columns", pose.columns},
                     {"rows", pose.rows},
                     {"results", results}});
  }
  return {{"reach", map_reach},
          {"stride", maps.stride},
          {"zooms", zooms},
          {"letters", letters},
          {"poses", poses}};
}

json to_json(const std::optional<Sequences::Peak>& peak) {
  if (!peak) return nullptr;
  return {{"value", short_json(peak->value)}, {"step", peak->step}};
}

json to_json(const Sequences& sequences) {
  json motions = json::array();
  for (const Sequences::Course& course : sequences.motions) {
    json results = json::array();
    for (const Sequences::Row& row : course.results) {
      results.push_back({{"candidate", row.candidate},
                         {"amplification", rounded_up_json(row.amplification)},
                         {"jump", to_json(row.jump)},
                         {"hull", to_json(row.hull)},
                         {"hull_excess", to_json(row.hull_excess)},
                         {"points_changed", row.points_changed},
                         {"missed", row.missed},
                         {"wrong", row.wrong},
                         {"unanswered", row.unanswered}});
    }
    motions.push_back({{"motion", course.motion},
                       {"description", course.description},
                       {"pair", course.pair},
                       {"displacement", short_json(course.displacement)},
                       {"truth",
                        {{"depth", short_json(course.true_depth_change)},
                         {"patch", short_json(course.true_patch_movement)}}},
                       {"results", results}});
  }
  return {{"steps", sequences.steps}, {"motions", motions}};
}

}  // namespace

double short_number(double value) {
  return value < 1e-15 ? 0 : std::strtod(fmt::format("{:.2g}", value).c_str(), nullptr);
}

double rounded_up(double ratio) {
  return ratio >= 10 ? short_number(ratio) : std::ceil(100 * ratio * (1 - 1e-9)) / 100;
}

json to_json(const Stability& s) {
  json result = {
      {"candidates", s.candidates}, {"tolerance", s.tolerance}, {"threshold", s.threshold}};
  if (s.amplification) result["amplification"] = to_json(*s.amplification);
  if (s.maps) result["maps"] = to_json(*s.maps);
  if (s.sequences) result["sequences"] = to_json(*s.sequences);
  return result;
}

std::string json_text(const Stability& stability) { return to_json(stability).dump(); }

void write_stability(const Stability& stability, const std::string& command,
                     const std::filesystem::path& folder) {
  check_writable(folder);
  json whole = to_json(stability);
  whole["schema"] = "touchstone-stability-1";
  whole["version"] = TOUCHSTONE_VERSION;
  whole["command"] = command;
  write_file(folder / "stability.json", whole.dump() + "\n", "--out");
  whole["marks"] = marks(whole["candidates"]);
  write_file(folder / "stability.html", render_page(Page::stability, whole), "--out");
}

}  // namespace touchstone
