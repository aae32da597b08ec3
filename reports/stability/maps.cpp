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

FailureMaps::Pose pictures(const CriticalPose& pose, const MapGrid& grid, const Study& study,
                           std::vector<CandidateProcess>& candidates) {
  std::vector<Configuration> asked;
  for (const Decade zoom : grid.zooms) {
    for (Configuration& c : pixels(pose, zoom, grid.stride)) asked.push_back(std::move(c));
  }
  const std::size_t of_zoom = asked.size() / grid.zooms.size();
  std::vector<oracle::Truth> truths;
  for (const Configuration& c : asked) truths.push_back(oracle::truth(c));
  std::vector<Judge> judges;
  for (std::size_t i = 0; i < asked.size(); ++i) {
    judges.emplace_back(asked[i], truths[i], study.bar);
  }
  FailureMaps::Pose result{
      pose.name,        pose.description, pair_name(pair_of(pose.configuration)),
      pose.across.what, pose.up.what,     {}};
  for (std::size_t k = 0; k < candidates.size(); ++k) {
    std::vector<std::string> letters(grid.zooms.size());
    const std::vector<Answer> answers = candidates[k].answers(asked);
    for (std::size_t i = 0; i < asked.size(); ++i) {
      const Score s = judges[i].score(answers[i]);
      if (s.outcome != Outcome::unsupported) letters[i / of_zoom] += map_letter(s);
    }
    if (letters[0].empty()) continue;  // it has no routine for the pair
    result.pictures.push_back({study.candidates[k]->name, std::move(letters)});
  }
  return result;
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

Measure<FailureMaps> maps(const std::vector<const CriticalPose*>& poses, const MapGrid& grid,
                          const Study& study) {
  const int across = 2 * map_reach / grid.stride + 1;
  const auto side = static_cast<std::size_t>(across);
  return {{poses.size(), grid.zooms.size() * side * side,
           [=](std::size_t i) { return "map/" + poses[i]->name; },
           [=](std::size_t i, std::vector<CandidateProcess>& candidates) {
             return to_bytes(pictures(*poses[i], grid, study, candidates));
           }},
          [=](std::span<const std::string> texts) {
            return FailureMaps{grid.stride, grid.zooms, finished<FailureMaps::Pose>(texts)};
          }};
}

}  // namespace touchstone
