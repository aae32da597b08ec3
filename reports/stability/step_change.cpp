#include "reports/stability/step_change.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <iterator>
#include <limits>
#include <map>
#include <tuple>

#include "oracle/judge/hull.hpp"
#include "properties/motions/motion.hpp"
#include "properties/pose_class.hpp"
#include "reports/campaign.hpp"
#include "reports/stability/measure.hpp"

namespace touchstone {
namespace {

using oracle::ContactPatch;

double depth_within(double signed_distance, const Bar& bar) {
  return std::max(0.0, bar.threshold - signed_distance);
}
double true_depth(const ExaminedPose& pose, const Bar& bar) {
  return depth_within(pose.truth.signed_distance.midpoint(), bar);
}
double answered_depth(const Answer& answer, const Bar& bar) {
  return answer.status == TS_CONTACT ? depth_within(answer.signed_distance, bar) : 0;
}

ContactPatch patch_along(const Configuration& c, const Vec3& n) {
  return oracle::contact_patch(c, n, patch_depth * smaller_size(c));
}

/// The change of a depth by rounding alone, metres: four units in the last place of the bodies'
/// coordinates and sizes.
double rounding_of(const Configuration& c) {
  constexpr double units = 4;
  const double coordinates = std::max(c.pose_a.position().cwiseAbs().maxCoeff(),
                                      c.pose_b.position().cwiseAbs().maxCoeff());
  return units * std::numeric_limits<double>::epsilon() * (coordinates + larger_size(c));
}

/// The largest change of the true depth at a step, metres.
double allowance(const Configuration& from, const Configuration& to) {
  return largest_displacement(from, to) + std::max(rounding_of(from), rounding_of(to));
}

}  // namespace

std::vector<ExaminedPose> examine_poses(const std::vector<Configuration>& configurations,
                                        std::vector<CandidateProcess>& candidates, const Bar& bar) {
  std::vector<ExaminedPose> poses;
  const auto take = [&](const ScoredConfiguration& scored) {
    ExaminedPose& pose =
        poses.emplace_back(ExaminedPose{scored.configuration, scored.truth, {}, {}});
    std::vector<Vec3> normals;  // of its patches
    const auto patch_number = [&](const Vec3& n) {
      const auto found = std::find(normals.begin(), normals.end(), n);
      const auto number = static_cast<std::size_t>(found - normals.begin());
      if (found == normals.end()) {
        normals.push_back(n);
        pose.patches.push_back(patch_along(pose.configuration, n));
      }
      return number;
    };
    for (std::size_t k = 0; k < candidates.size(); ++k) {
      PoseAnswer& entry =
          pose.answers.emplace_back(PoseAnswer{scored.answers[k], scored.scores[k], {}, {}});
      const Vec3 n(entry.answer.normal);
      if (entry.answer.status == TS_CONTACT && entry.is_answered() &&
          entry.answer.point_count > 0 && !n.isZero(0)) {
        entry.hull = hull_of_points(entry.answer);
        entry.patch = patch_number(patch_normal(pose.truth, n));
      }
    }
  };
  score_configurations(configurations, pointers(candidates), bar, truth_width, take);
  return poses;
}

Step::Step(const ExaminedPose& from, const ExaminedPose& to, const Bar& bar)
    : from_(from),
      to_(to),
      bar_(bar),
      true_change_(true_depth(to, bar) - true_depth(from, bar)),
      allowance_(allowance(from.configuration, to.configuration)) {}

std::optional<StepChange> Step::change(std::size_t candidate) {
  const PoseAnswer &a = from_.answers[candidate], &b = to_.answers[candidate];
  if (!a.is_answered() || !b.is_answered()) return std::nullopt;
  const double size = smaller_size(from_.configuration);
  const double change = answered_depth(b.answer, bar_) - answered_depth(a.answer, bar_);
  StepChange result{};
  result.amplification = std::abs(change) / allowance_;
  result.jump = std::abs(change - true_change_) / size;
  if (a.hull && b.hull) {
    result.points_changed = a.score.points != b.score.points;
    result.hull = movement(*a.hull, *b.hull) / size;
    result.hull_excess = std::max(0.0, *result.hull - patch_movement(*a.patch, *b.patch) / size);
  }
  return result;
}

double Step::patch_movement(std::size_t from, std::size_t to) {
  const auto [known, is_new] = patch_movements_.try_emplace({from, to});
  if (is_new) known->second = movement(from_.patches[from], to_.patches[to]);
  return known->second;
}

double Step::true_amplification() const { return std::abs(true_change_) / allowance_; }

ContactPatch true_patch(const ExaminedPose& pose) {
  return patch_along(pose.configuration, pose.truth.normals.front().n);
}

namespace {

void raise(std::optional<double>& max, const std::optional<double>& value) {
  if (value && !(max && *max >= *value)) max = value;
}

/// The worst step by one measure: the amplitude's number, and that of the configuration around
/// which it is made.
struct Worst {
  std::optional<double> value;
  std::size_t base = 0, rung = 0;
};
void raise(Worst& worst, const std::optional<double>& value, std::size_t base, std::size_t rung) {
  if (value && !(worst.value && *worst.value >= *value)) worst = {value, base, rung};
}

/// Adds a step to a candidate's row by its score after it, and its change.
void add(Amplification::Row& row, const Score& score, const std::optional<StepChange>& change,
         std::size_t rung) {
  row.missed[rung] += score.outcome == Outcome::missed;
  raise(row.regret[rung], score.normal_regret);
  if (!change) {
    ++row.unanswered[rung];
    return;
  }
  raise(row.amplification[rung], change->amplification);
  raise(row.jump, change->jump);
  raise(row.hull_excess[rung], change->hull_excess);
  row.points_changed[rung] += change->points_changed;
}

/// The configurations around which the steps of one cell are made; the number of each is also that
/// of its perturbations.
struct Bases {
  std::string pair, pose_class;
  std::vector<Subject> subjects;
};

Bases bases_of(const PoseClass& cell, const Ladder& ladder) {
  Bases bases{pair_name(cell.pair), cell.name(), {}};
  for (std::uint64_t i = 0; i < ladder.count; ++i) {
    bases.subjects.push_back(subject(Identity{cell, ladder.seed, i}));
  }
  return bases;
}

/// Each base, and after it what its steps lead to.
std::vector<Configuration> steps_from(const Bases& bases, std::uint64_t seed) {
  std::vector<Configuration> asked;
  for (std::size_t i = 0; i < bases.subjects.size(); ++i) {
    const Configuration& c = bases.subjects[i].configuration;
    asked.push_back(c);
    for (std::size_t rung = 0; rung < amplitude_count; ++rung) {
      asked.push_back(perturbed(c, {amplitude(rung), seed, i}));
    }
  }
  return asked;
}

/// What the steps of one cell come to. `poses`: those of steps_from, examined.
Amplification climbed(const Bases& bases, std::span<const ExaminedPose> poses, std::uint64_t seed,
                      const Study& study) {
  Amplification result;
  result.truth.push_back({bases.pair, bases.pose_class, {}});
  const std::size_t candidates = study.candidates.size();
  std::vector<Amplification::Row> rows(candidates);
  std::vector<Worst> amplification(candidates), hull_excess(candidates);
  for (std::size_t i = 0; i < bases.subjects.size(); ++i) {
    const ExaminedPose* const from = &poses[i * (1 + amplitude_count)];
    for (std::size_t rung = 0; rung < amplitude_count; ++rung) {
      const ExaminedPose& to = from[1 + rung];
      Step step(*from, to, study.bar);
      raise(result.truth[0].amplification[rung], step.true_amplification());
      for (std::size_t k = 0; k < candidates; ++k) {
        const auto change = step.change(k);
        add(rows[k], to.answers[k].score, change, rung);
        if (!change) continue;
        raise(amplification[k], change->amplification, i, rung);
        raise(hull_excess[k], change->hull_excess, i, rung);
      }
    }
  }
  for (std::size_t k = 0; k < candidates; ++k) {
    if (poses[0].answers[k].score.outcome == Outcome::unsupported) continue;
    const std::string& candidate = study.candidates[k]->name;
    rows[k].pair = bases.pair;
    rows[k].pose_class = bases.pose_class;
    rows[k].candidate = candidate;
    result.results.push_back(std::move(rows[k]));
    for (const auto& [measure, worst] : {std::pair("amplification", &amplification[k]),
                                         std::pair("hull_excess", &hull_excess[k])}) {
      if (worst->value.value_or(0) == 0) continue;
      const std::string& name = bases.subjects[worst->base].name;
      const Perturbation step{amplitude(worst->rung), seed, worst->base};
      result.worst.push_back({bases.pair, bases.pose_class, candidate, measure, *worst->value, name,
                              perturbed_name(name, step)});
    }
  }
  return result;
}

/// Puts the cells' parts together; of each candidate and pair it keeps the worst step by each
/// measure.
Amplification together(std::vector<Amplification> parts, std::uint64_t seed, std::uint64_t count) {
  Amplification result;
  result.seed = seed;
  result.count = count;
  std::map<std::tuple<std::string, std::string, std::string>, Amplification::WorstStep> worst;
  for (Amplification& part : parts) {
    std::ranges::move(part.truth, std::back_inserter(result.truth));
    std::ranges::move(part.results, std::back_inserter(result.results));
    for (Amplification::WorstStep& step : part.worst) {
      const auto [at, is_new] = worst.try_emplace({step.candidate, step.pair, step.measure}, step);
      if (!is_new && step.value > at->second.value) at->second = step;
    }
  }
  for (auto& [key, step] : worst) result.worst.push_back(std::move(step));
  return result;
}

}  // namespace

std::vector<PoseClass> degenerate_cells(const std::vector<Pair>& pairs) {
  std::vector<PoseClass> cells;
  for (const Pair pair : pairs) {
    for (const Arrangement& a : arrangements(pair)) {
      if (a.is_exact()) cells.push_back({pair, &a, {}});
    }
  }
  return cells;
}

Measure<Amplification> amplification(const Ladder& ladder, const Study& study) {
  const std::size_t of_cell = ladder.count * (1 + amplitude_count);
  // A session costs a candidate as much as hundreds of answers, so that cells share one.
  constexpr std::size_t wanted_poses = 256;
  const std::size_t cells = std::max<std::size_t>(1, wanted_poses / of_cell);  // of a task
  const auto of_task = [=](std::size_t task) {
    return std::span(ladder.cells)
        .subspan(task * cells)
        .first(std::min(cells, ladder.cells.size() - task * cells));
  };
  return {{(ladder.cells.size() + cells - 1) / cells, cells * of_cell,
           [=](std::size_t task) {
             const auto all = of_task(task);
             return fmt::format("{}/{} to {}/{}", pair_name(all.front().pair), all.front().name(),
                                pair_name(all.back().pair), all.back().name());
           },
           [=](std::size_t task, std::vector<CandidateProcess>& candidates) {
             std::vector<Bases> bases;
             std::vector<Configuration> asked;
             for (const PoseClass& cell : of_task(task)) {
               bases.push_back(bases_of(cell, ladder));
               std::ranges::move(steps_from(bases.back(), ladder.seed), std::back_inserter(asked));
             }
             const std::vector<ExaminedPose> poses = examine_poses(asked, candidates, study.bar);
             std::vector<Amplification> parts;
             for (std::size_t i = 0; i < bases.size(); ++i) {
               const auto of_bases = std::span(poses).subspan(i * of_cell, of_cell);
               parts.push_back(climbed(bases[i], of_bases, ladder.seed, study));
             }
             return to_bytes(together(std::move(parts), ladder.seed, ladder.count));
           }},
          [=](std::span<const std::string> texts) {
            return together(finished<Amplification>(texts), ladder.seed, ladder.count);
          }};
}

Amplification amplification(const Subject& base, std::uint64_t seed, std::uint64_t count,
                            const Study& study) {
  const Bases bases{pair_name(pair_of(base.configuration)), base.name,
                    std::vector<Subject>(count, base)};
  auto candidates = start(study.candidates, study.bar.threshold, study.limits);
  const auto poses = examine_poses(steps_from(bases, seed), candidates, study.bar);
  return together({climbed(bases, poses, seed, study)}, seed, count);
}

}  // namespace touchstone
