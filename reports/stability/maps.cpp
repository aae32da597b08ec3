#include <algorithm>
#include <stdexcept>

#include "properties/files/bytes.hpp"
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

/// Letters of each zoom and candidate, none where it has no routine for the pair.
using Letters = std::vector<std::vector<std::string>>;

Letters pictures(const CriticalPose& pose, const MapGrid& grid,
                 std::vector<CandidateProcess>& candidates, const Bar& bar) {
  std::vector<Configuration> asked;
  for (const Decade zoom : grid.zooms) {
    for (Configuration& c : pixels(pose, zoom, grid.stride)) asked.push_back(std::move(c));
  }
  const std::size_t of_zoom = asked.size() / grid.zooms.size();
  std::vector<oracle::Truth> truths;
  for (const Configuration& c : asked) truths.push_back(oracle::truth(c));
  std::vector<Judge> judges;
  for (std::size_t i = 0; i < asked.size(); ++i) judges.emplace_back(asked[i], truths[i], bar);
  Letters letters;
  for (CandidateProcess& candidate : candidates) {
    std::vector<std::string>& of_zooms = letters.emplace_back(grid.zooms.size());
    const std::vector<Answer> answers = candidate.answers(asked);
    for (std::size_t i = 0; i < asked.size(); ++i) {
      const Score s = judges[i].score(answers[i]);
      if (s.outcome != Outcome::unsupported) of_zooms[i / of_zoom] += map_letter(s);
    }
  }
  return letters;
}

FailureMaps::Pose collected(const CriticalPose& pose, const Letters& letters,
                            const std::vector<const Candidate*>& candidates) {
  std::vector<FailureMaps::Picture> pictures;
  for (std::size_t k = 0; k < candidates.size(); ++k) {
    pictures.push_back({candidates[k]->name, letters[k]});
  }
  std::erase_if(pictures, [](const auto& picture) { return picture.letters[0].empty(); });
  return {pose.name,        pose.description, pair_name(pair_of(pose.configuration)),
          pose.across.what, pose.up.what,     std::move(pictures)};
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
           [=, bar = study.bar](std::size_t i, std::vector<CandidateProcess>& candidates) {
             return to_bytes(pictures(*poses[i], grid, candidates, bar));
           }},
          [=, candidates = study.candidates](std::span<const std::string> texts) {
            FailureMaps maps{grid.stride, grid.zooms, {}};
            for (std::size_t p = 0; p < texts.size(); ++p) {
              if (texts[p].empty()) continue;  // interrupted before
              maps.poses.push_back(collected(*poses[p], from_bytes<Letters>(texts[p]), candidates));
            }
            return maps;
          }};
}

}  // namespace touchstone
