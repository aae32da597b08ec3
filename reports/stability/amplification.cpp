#include <fmt/format.h>
#include <map>
#include <tuple>

#include "properties/motions/motion.hpp"
#include "properties/pose_class.hpp"
#include "reports/bytes.hpp"
#include "reports/stability/measure.hpp"
#include "reports/stability/step_change.hpp"

namespace touchstone {
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

/// All steps of a cell, as one candidate answered them, or as the truth has it: amplification
/// alone.
struct Climb {
  bool is_supported = true;
  ByAmplitude<std::optional<double>> amplification, hull_excess, regret;
  std::optional<double> jump;
  ByAmplitude<int> points_changed{}, missed{}, unanswered{};
  Worst worst_amplification, worst_hull_excess;

  /// Adds the step that candidate `k` was asked about.
  void add(const ExaminedPose& from, const ExaminedPose& to, std::size_t k, const Bar& bar,
           std::size_t base, std::size_t rung) {
    const Score& score = to.answers[k].score;
    missed[rung] += score.outcome == Outcome::missed;
    raise(regret[rung], score.normal_regret);
    const auto change = step_change(from, to, k, bar);
    if (!change) {
      ++unanswered[rung];
      return;
    }
    raise(amplification[rung], change->amplification);
    raise(jump, change->jump);
    raise(hull_excess[rung], change->hull_excess);
    points_changed[rung] += change->points_changed;
    raise(worst_amplification, change->amplification, base, rung);
    raise(worst_hull_excess, change->hull_excess, base, rung);
  }
};

/// The configurations around which the steps of one cell are made; the number of each is also that
/// of its perturbations.
struct Bases {
  std::string pair, pose_class;
  std::vector<Subject> subjects;
};

Bases bases_of(const Cell& cell, const Ladder& ladder) {
  Bases bases{pair_name(cell.pair), cell.pose_class, {}};
  for (std::uint64_t i = 0; i < ladder.count; ++i) {
    bases.subjects.push_back(subject(Identity{cell.pair, cell.pose_class, ladder.seed, i}));
  }
  return bases;
}

/// The truth first, then the candidates in their order.
std::vector<Climb> climb(const Bases& bases, std::uint64_t seed,
                         std::vector<CandidateProcess>& candidates, const Bar& bar) {
  std::vector<Configuration> asked;
  for (std::size_t i = 0; i < bases.subjects.size(); ++i) {
    const Configuration& c = bases.subjects[i].configuration;
    asked.push_back(c);
    for (std::size_t rung = 0; rung < amplitude_count; ++rung) {
      asked.push_back(perturbed(c, {amplitude(rung), seed, i}));
    }
  }
  const std::vector<ExaminedPose> poses = examine(asked, candidates, bar);
  std::vector<Climb> climbs(1 + candidates.size());
  for (std::size_t k = 0; k < candidates.size(); ++k) {
    climbs[1 + k].is_supported = poses[0].answers[k].score.outcome != Outcome::unsupported;
  }
  for (std::size_t i = 0; i < bases.subjects.size(); ++i) {
    const ExaminedPose* const from = &poses[i * (1 + amplitude_count)];
    for (std::size_t rung = 0; rung < amplitude_count; ++rung) {
      const ExaminedPose& to = from[1 + rung];
      raise(climbs[0].amplification[rung], true_amplification(*from, to, bar));
      for (std::size_t k = 0; k < candidates.size(); ++k) {
        climbs[1 + k].add(*from, to, k, bar, i, rung);
      }
    }
  }
  return climbs;
}

/// Puts the cells' climbs together; of each candidate and pair it keeps the worst step by each
/// measure.
class Collector {
 public:
  Collector(const Study& study, std::uint64_t seed, std::uint64_t count) : study_(study) {
    result_.seed = seed;
    result_.count = count;
  }

  void add(const Bases& bases, const std::vector<Climb>& climbs) {
    result_.truth.push_back({bases.pair, bases.pose_class, climbs[0].amplification});
    for (std::size_t k = 0; k < study_.candidates.size(); ++k) {
      const Climb& c = climbs[1 + k];
      if (!c.is_supported) continue;
      const std::string& candidate = study_.candidates[k]->name;
      result_.results.push_back({bases.pair, bases.pose_class, candidate, c.amplification,
                                 c.hull_excess, c.regret, c.jump, c.points_changed, c.missed,
                                 c.unanswered});
      add_worst(bases, candidate, "amplification", c.worst_amplification);
      add_worst(bases, candidate, "hull_excess", c.worst_hull_excess);
    }
  }

  Amplification result() && {
    for (auto& [key, step] : worst_) result_.worst.push_back(std::move(step));
    return std::move(result_);
  }

 private:
  void add_worst(const Bases& bases, const std::string& candidate, const char* measure,
                 const Worst& worst) {
    if (worst.value.value_or(0) == 0) return;
    const auto [at, is_new] = worst_.try_emplace({candidate, bases.pair, measure});
    if (!is_new && at->second.value >= *worst.value) return;
    const std::string& from = bases.subjects[worst.base].name;
    const Perturbation step{amplitude(worst.rung), result_.seed, worst.base};
    at->second = {bases.pair, bases.pose_class,          candidate, measure, *worst.value,
                  from,       perturbed_name(from, step)};
  }

  const Study& study_;
  Amplification result_;
  std::map<std::tuple<std::string, std::string, std::string>, Amplification::WorstStep> worst_;
};

}  // namespace

std::vector<Cell> degenerate_cells(const std::vector<Pair>& pairs) {
  std::vector<Cell> cells;
  for (const Pair pair : pairs) {
    for (const Arrangement& a : arrangements(pair)) {
      if (a.is_exact()) cells.push_back({pair, a.name});
    }
  }
  return cells;
}

Amplification amplification(const Ladder& ladder, const Study& study) {
  const Work work{ladder.cells.size(), "perturbed poses", ladder.count * (1 + amplitude_count),
                  [&](std::size_t i) {
                    const Cell& cell = ladder.cells[i];
                    return fmt::format("{}/{}", pair_name(cell.pair), cell.pose_class);
                  }};
  const auto results =
      run_in_workers(study, work, [&](std::size_t i, std::vector<CandidateProcess>& candidates) {
        ByteWriter bytes;
        bytes.put(climb(bases_of(ladder.cells[i], ladder), ladder.seed, candidates, study.bar));
        return bytes.take();
      });
  Collector collector(study, ladder.seed, ladder.count);
  for (std::size_t i = 0; i < results.size(); ++i) {
    if (results[i].empty()) continue;  // interrupted before
    collector.add(bases_of(ladder.cells[i], ladder), ByteReader(results[i]).get_all<Climb>());
  }
  return std::move(collector).result();
}

Amplification amplification(const Subject& base, std::uint64_t seed, std::uint64_t count,
                            const Study& study) {
  const Bases bases{pair_name(pair_of(base.configuration)), base.name,
                    std::vector<Subject>(count, base)};
  auto candidates = start(study.candidates, study.bar.threshold, study.limits);
  Collector collector(study, seed, count);
  collector.add(bases, climb(bases, seed, candidates, study.bar));
  return std::move(collector).result();
}

}  // namespace touchstone
