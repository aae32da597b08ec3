#include "reports/stability/maps.hpp"

#include <algorithm>
#include <fmt/format.h>

#include "candidates/host/progress.hpp"
#include "candidates/host/worker_processes.hpp"

namespace touchstone {
namespace {

using nlohmann::json;

std::vector<Configuration> pixels(const CriticalPose& pose, Decade zoom, int stride) {
  std::vector<Configuration> result;
  for (int row = map_reach; row >= -map_reach; row -= stride) {
    for (int column = -map_reach; column <= map_reach; column += stride) {
      result.push_back(map_pixel(pose, zoom, column, row));
    }
  }
  return result;
}

/// "289." of 289 dots, "3m2." of mmm..
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

/// One string for each candidate, empty without a routine for the pair.
json picture(const std::vector<Configuration>& asked, std::vector<CandidateProcess>& candidates,
             const Bar& bar) {
  std::vector<oracle::Truth> truths;
  for (const Configuration& c : asked) truths.push_back(oracle::truth(c));
  json strings = json::array();
  for (CandidateProcess& candidate : candidates) {
    const std::vector<Answer> answers = candidate.answers(asked);
    std::string letters;
    for (std::size_t i = 0; i < asked.size(); ++i) {
      const Score s = score(asked[i], truths[i], answers[i], bar);
      if (s.outcome != Outcome::unsupported) letters += map_letter(s);
    }
    strings.push_back(run_lengths(letters));
  }
  return strings;
}

json of_pose(const CriticalPose& pose, const std::vector<json>& of_zooms,
             const std::vector<const Candidate*>& candidates) {
  json results = json::array();
  for (std::size_t k = 0; k < candidates.size(); ++k) {
    if (of_zooms[0][k] == "") continue;
    json strings = json::array();
    for (const json& of_zoom : of_zooms) strings.push_back(of_zoom[k]);
    results.push_back({{"candidate", candidates[k]->name}, {"maps", strings}});
  }
  return {{"pose", pose.name},
          {"description", pose.description},
          {"pair", pair_name(pair_of(pose.configuration))},
          {"columns", pose.across.what},
          {"rows", pose.up.what},
          {"results", results}};
}

}  // namespace

char map_letter(const Score& score) {
  const std::string meaning =
      score.outcome == Outcome::agree && score.coverage.value_or(1) < least_coverage
          ? "few-points"
          : outcome_name(score.outcome);
  for (const MapLetter& l : map_letters) {
    if (meaning == l.meaning) return l.letter;
  }
  throw std::logic_error("no letter for " + meaning);
}

std::string map_letters_of(const std::string& runs) {
  std::string letters;
  std::size_t count = 0;
  for (const char c : runs) {
    if (c >= '0' && c <= '9') {
      count = 10 * count + static_cast<std::size_t>(c - '0');
    } else {
      letters.append(std::max<std::size_t>(count, 1), c);
      count = 0;
    }
  }
  return letters;
}

json maps(const std::vector<const CriticalPose*>& poses, const MapGrid& grid, const Study& study) {
  const std::size_t zooms = grid.zooms.size();
  const auto side = static_cast<std::size_t>(2 * map_reach / grid.stride + 1);
  Progress progress("pixels", poses.size() * zooms * side * side);
  std::vector<CandidateProcess> candidates;  // each worker starts its own
  const auto results = run_in_processes(
      poses.size() * zooms, study.workers,
      [&](std::size_t i) {
        if (candidates.empty()) {
          candidates = start(study.candidates, study.bar.threshold, study.limits);
        }
        const auto asked = pixels(*poses[i / zooms], grid.zooms[i % zooms], grid.stride);
        return picture(asked, candidates, study.bar).dump();
      },
      [&](std::size_t i) {
        return fmt::format("map/{}/{}", poses[i / zooms]->name, grid.zooms[i % zooms].name());
      },
      [&](std::size_t done) { progress.update(done * side * side); });

  json zoom_names = json::array(), letters = json::object(), list = json::array();
  for (const Decade& zoom : grid.zooms) zoom_names.push_back(zoom.name());
  for (const MapLetter& l : map_letters) letters[std::string(1, l.letter)] = l.meaning;
  for (std::size_t p = 0; p < poses.size(); ++p) {
    std::vector<json> of_zooms;
    for (std::size_t z = 0; z < zooms; ++z) {
      const std::string& text = results[p * zooms + z];
      if (!text.empty()) of_zooms.push_back(json::parse(text));  // empty: interrupted before
    }
    if (of_zooms.size() == zooms) list.push_back(of_pose(*poses[p], of_zooms, study.candidates));
  }
  return {{"reach", map_reach},
          {"stride", grid.stride},
          {"zooms", zoom_names},
          {"letters", letters},
          {"poses", list}};
}

}  // namespace touchstone
