#include <algorithm>
#include <fmt/format.h>
#include <sstream>
#include <stdexcept>

#include "reports/stability/measure.hpp"

namespace touchstone {
namespace {

std::vector<Configuration> pixels(const CriticalPose& pose, Decade zoom, int stride) {
  std::vector<Configuration> result;
  for (int row = map_reach; row >= -map_reach; row -= stride) {
    for (int column = -map_reach; column <= map_reach; column += stride) {
      result.push_back(map_pixel(pose, zoom, column, row));
    }
  }
  return result;
}

/// A line of letters for each candidate, empty where it has no routine for the pair.
std::string pictures(const std::vector<Configuration>& asked,
                     std::vector<CandidateProcess>& candidates, const Bar& bar) {
  std::vector<oracle::Truth> truths;
  for (const Configuration& c : asked) truths.push_back(oracle::truth(c));
  std::vector<Judge> judges;
  for (std::size_t i = 0; i < asked.size(); ++i) judges.emplace_back(asked[i], truths[i], bar);
  std::string lines;
  for (CandidateProcess& candidate : candidates) {
    const std::vector<Answer> answers = candidate.answers(asked);
    for (std::size_t i = 0; i < asked.size(); ++i) {
      const Score s = judges[i].score(answers[i]);
      if (s.outcome != Outcome::unsupported) lines += map_letter(s);
    }
    lines += '\n';
  }
  return lines;
}

/// Adds the pictures of one zoom; `lines` is what pictures() gives.
void add_zoom(std::vector<FailureMaps::Picture>& of_candidates, const std::string& lines) {
  std::istringstream in(lines);
  for (FailureMaps::Picture& picture : of_candidates) {
    std::getline(in, picture.letters.emplace_back());
  }
}

FailureMaps::Pose named(const CriticalPose& pose) {
  return {pose.name,        pose.description, pair_name(pair_of(pose.configuration)),
          pose.across.what, pose.up.what,     {}};
}

}  // namespace

char map_letter(const Score& score) {
  const std::string meaning =
      score.outcome == Outcome::agree && score.coverage.value_or(1) < min_coverage
          ? "few-points"
          : outcome_name(score.outcome);
  for (const MapLetter& l : map_letters) {
    if (meaning == l.meaning) return l.letter;
  }
  throw std::logic_error("no letter for " + meaning);
}

FailureMaps maps(const std::vector<const CriticalPose*>& poses, const MapGrid& grid,
                 const Study& study) {
  const std::size_t zooms = grid.zooms.size();
  const auto side = static_cast<std::size_t>(2 * map_reach / grid.stride + 1);
  const Work work{poses.size() * zooms, "pixels", side * side, [&](std::size_t i) {
                    return fmt::format("map/{}/{}", poses[i / zooms]->name,
                                       grid.zooms[i % zooms].name());
                  }};
  const auto results =
      run_in_workers(study, work, [&](std::size_t i, std::vector<CandidateProcess>& candidates) {
        const auto asked = pixels(*poses[i / zooms], grid.zooms[i % zooms], grid.stride);
        return pictures(asked, candidates, study.bar);
      });

  FailureMaps maps{grid.stride, grid.zooms, {}};
  for (std::size_t p = 0; p < poses.size(); ++p) {
    FailureMaps::Pose pose = named(*poses[p]);
    std::vector<FailureMaps::Picture> of_candidates;
    for (const Candidate* c : study.candidates) of_candidates.push_back({c->name, {}});
    const auto first = results.begin() + static_cast<std::ptrdiff_t>(p * zooms);
    const auto last = first + static_cast<std::ptrdiff_t>(zooms);
    if (std::find(first, last, "") != last) continue;  // interrupted before
    for (auto lines = first; lines != last; ++lines) add_zoom(of_candidates, *lines);
    for (FailureMaps::Picture& picture : of_candidates) {
      if (!picture.letters[0].empty()) pose.pictures.push_back(std::move(picture));
    }
    maps.poses.push_back(std::move(pose));
  }
  return maps;
}

}  // namespace touchstone
