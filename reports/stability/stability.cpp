#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "candidates/host/progress.hpp"
#include "candidates/host/worker_processes.hpp"
#include "oracle/judge/hull.hpp"
#include "reference/invalid_input.hpp"
#include "reports/stability/measure.hpp"
#include "reports/stability/step_change.hpp"

namespace touchstone {
namespace {

template <class Thing, class ConfigurationOf>
std::vector<const Thing*> of_pairs(const std::vector<Thing>& all, const std::vector<Pair>& pairs,
                                   ConfigurationOf configuration) {
  std::vector<const Thing*> result;
  for (const Thing& thing : all) {
    const Pair pair = pair_of(configuration(thing));
    if (std::find(pairs.begin(), pairs.end(), pair) != pairs.end()) result.push_back(&thing);
  }
  return result;
}

}  // namespace

StabilityPart parse_stability_part(std::string_view name) {
  if (name == "amplification") return StabilityPart::amplification;
  if (name == "maps") return StabilityPart::maps;
  if (name == "sequences") return StabilityPart::sequences;
  throw InvalidInput("--part", '"' + std::string(name) + '"',
                     "must be one of amplification, maps, sequences");
}

StabilityOptions thorough(const Study& study, std::uint64_t seed) {
  StabilityOptions options;
  options.study = study;
  options.pairs.assign(std::begin(all_pairs), std::end(all_pairs));
  options.ladder = {degenerate_cells(options.pairs), seed, 6};
  for (const int exponent : {-15, -12, -8, -4, -2}) options.grid.zooms.emplace_back(exponent);
  return options;
}

StabilityOptions brief(const Study& study, const std::vector<Pair>& pairs, std::uint64_t seed) {
  StabilityOptions options;
  options.study = study;
  options.pairs = pairs;
  options.ladder = {degenerate_cells(pairs), seed, 3};
  for (const int exponent : {-15, -8, -2}) options.grid.zooms.emplace_back(exponent);
  options.grid.stride = 2;
  options.steps = 100;
  return options;
}

Stability measure(const StabilityOptions& options) {
  const Study& study = options.study;
  Stability result{{}, study.bar.tolerance, study.bar.threshold, {}, {}, {}};
  for (const Candidate* c : study.candidates) result.candidates.push_back(c->name);
  // All works are run together: to start the candidates takes a second.
  std::vector<Work> works;
  std::vector<std::function<void(std::span<const std::string>)>> takers;
  const auto add = [&](auto measure, auto& place) {
    works.push_back(std::move(measure.work));
    takers.push_back([&place, of = std::move(measure.result)](std::span<const std::string> texts) {
      place = of(texts);
    });
  };
  if (options.parts.contains(StabilityPart::amplification)) {
    if (options.base) {
      result.amplification =
          amplification(*options.base, options.ladder.seed, options.ladder.count, study);
    } else {
      add(amplification(options.ladder, study), result.amplification);
    }
  }
  if (options.parts.contains(StabilityPart::maps)) {
    const auto poses = of_pairs(critical_poses(), options.pairs,
                                [](const CriticalPose& pose) { return pose.configuration; });
    add(maps(poses, options.grid, study), result.maps);
  }
  if (options.parts.contains(StabilityPart::sequences)) {
    const auto chosen = of_pairs(motions(), options.pairs,
                                 [](const Motion& motion) { return pose_at(motion, 0, 1); });
    add(sequences(chosen, options.steps, study), result.sequences);
  }
  const std::vector<std::string> texts = run_in_workers(study, works);
  std::span<const std::string> left = texts;
  for (std::size_t i = 0; i < works.size(); ++i) {
    takers[i](left.first(works[i].count));
    left = left.subspan(works[i].count);
  }
  return result;
}

std::vector<std::string> run_in_workers(const Study& study, std::span<const Work> works) {
  struct Task {
    const Work* work;
    std::size_t number;
  };
  std::vector<Task> tasks;
  std::size_t poses = 0;
  for (const Work& work : works) {
    for (std::size_t i = 0; i < work.count; ++i) tasks.push_back({&work, i});
    poses += work.count * work.poses_per_task;
  }
  if (tasks.empty()) return {};
  Progress progress("poses", poses);
  WorkerCandidates candidates(study.candidates, study.bar.threshold, study.limits);
  return run_in_processes(
      tasks.size(), study.workers,
      [&](std::size_t i) { return tasks[i].work->run(tasks[i].number, candidates.get()); },
      [&](std::size_t i) { return tasks[i].work->name(tasks[i].number); },
      [&](std::size_t done) { progress.update(poses * done / tasks.size()); });
}

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

namespace {

/// Keeps the first of equal values.
void raise(std::optional<Sequences::Peak>& peak, const std::optional<double>& value, int step) {
  if (value && !(peak && peak->value >= *value)) peak = {*value, step};
}

/// The course of candidate k. `steps`: between these poses.
Sequences::Row course(const std::vector<ExaminedPose>& poses, std::vector<Step>& steps,
                      std::size_t k) {
  Sequences::Row result;
  for (std::size_t i = 0; i < poses.size(); ++i) {
    const PoseAnswer& pose = poses[i].answers[k];
    result.missed += pose.score.outcome == Outcome::missed;
    result.wrong += !agrees(pose.score.outcome);
    result.unanswered += !pose.is_answered();
    if (i == 0) continue;
    const auto change = steps[i - 1].change(k);
    if (!change) continue;
    const int step = static_cast<int>(i);
    result.amplification = std::max(result.amplification.value_or(0), change->amplification);
    raise(result.jump, change->jump, step);
    raise(result.hull, change->hull, step);
    raise(result.hull_excess, change->hull_excess, step);
    result.points_changed += change->points_changed;
  }
  return result;
}

/// The truth along a motion: largest changes at one step.
void follow_truth(const std::vector<ExaminedPose>& poses, Sequences::Course& course) {
  const double size = smaller_size(poses[0].configuration);
  const auto depth = [](const ExaminedPose& p) { return p.truth.signed_distance.midpoint(); };
  std::vector<oracle::ContactPatch> patches;
  for (const ExaminedPose& pose : poses) patches.push_back(true_patch(pose));
  const auto raise_to = [&](double& max, double change) { max = std::max(max, change / size); };
  for (std::size_t i = 1; i < poses.size(); ++i) {
    const ExaminedPose &from = poses[i - 1], &to = poses[i];
    raise_to(course.displacement, largest_displacement(from.configuration, to.configuration));
    raise_to(course.true_depth_change, std::abs(depth(to) - depth(from)));
    raise_to(course.true_patch_movement, movement(patches[i - 1], patches[i]));
  }
}

Sequences::Course follow(const Motion& motion, int steps, const Study& study,
                         std::vector<CandidateProcess>& candidates) {
  std::vector<Configuration> asked;
  for (int i = 0; i <= steps; ++i) asked.push_back(pose_at(motion, i, steps));
  const std::vector<ExaminedPose> poses = examine_poses(asked, candidates, study.bar);
  std::vector<Step> between;
  for (std::size_t i = 1; i < poses.size(); ++i) {
    between.emplace_back(poses[i - 1], poses[i], study.bar);
  }
  Sequences::Course result{
      motion.name, motion.description, pair_name(pair_of(asked.front())), 0, 0, 0, {}};
  follow_truth(poses, result);
  for (std::size_t k = 0; k < candidates.size(); ++k) {
    if (poses[0].answers[k].score.outcome == Outcome::unsupported) continue;
    result.results.push_back(course(poses, between, k));
    result.results.back().candidate = study.candidates[k]->name;
  }
  return result;
}

}  // namespace

Measure<Sequences> sequences(const std::vector<const Motion*>& motions, int steps,
                             const Study& study) {
  return {{motions.size(), static_cast<std::size_t>(steps) + 1,
           [=](std::size_t i) { return "sequence/" + motions[i]->name; },
           [=](std::size_t i, std::vector<CandidateProcess>& candidates) {
             return to_bytes(follow(*motions[i], steps, study, candidates));
           }},
          [=](std::span<const std::string> texts) {
            return Sequences{steps, finished<Sequences::Course>(texts)};
          }};
}

}  // namespace touchstone
