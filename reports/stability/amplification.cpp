#include "reports/stability/amplification.hpp"

#include <algorithm>
#include <array>
#include <fmt/format.h>
#include <map>
#include <optional>

#include "candidates/host/progress.hpp"
#include "candidates/host/worker_processes.hpp"
#include "properties/motions/motion.hpp"
#include "properties/pose_class.hpp"
#include "reports/stability/short_number.hpp"

namespace touchstone {
namespace {

using nlohmann::json;

constexpr int amplitudes = Decade::max - Decade::min + 1;
Decade amplitude(int rung) { return Decade(Decade::min + rung); }

/// The largest of each measure on each rung; absent where there was nothing to measure.
using Rungs = std::array<std::optional<double>, amplitudes>;
void raise(std::optional<double>& most, const std::optional<double>& value) {
  if (value && !(most && *most >= *value)) most = value;
}
json to_json(const Rungs& rungs, json (*written)(const std::optional<double>&)) {
  json result = json::array();
  for (const auto& value : rungs) result.push_back(written(value));
  return result;
}

/// The worst step by one measure.
struct Worst {
  std::optional<double> value;
  std::string from, to;
  void take(const std::optional<double>& candidate, const std::string& base,
            const Perturbation& perturbation) {
    if (!candidate || (value && *value >= *candidate)) return;
    *this = {candidate, base, perturbed_name(base, perturbation)};
  }
};

/// What one candidate made of all steps of a cell.
struct Made {
  Rungs amplification, hull_excess, regret;
  std::optional<double> jump;
  std::array<int, amplitudes> points_changed{}, missed{}, unanswered{};
  Worst depth, manifold;

  void add(int rung, const ExaminedPose& from, const ExaminedPose& to, std::size_t k,
           const Bar& bar, const std::string& base, const Perturbation& perturbation) {
    const std::size_t i = static_cast<std::size_t>(rung);
    const CandidatePose& pose = to.of[k];
    missed[i] += pose.score.outcome == Outcome::missed;
    raise(regret[i], pose.score.normal_regret);
    const auto change = step_change(from, to, k, bar);
    if (!change) {
      ++unanswered[i];
      return;
    }
    raise(amplification[i], change->amplification);
    raise(jump, change->jump);
    raise(hull_excess[i], change->hull_excess);
    points_changed[i] += change->points_changed;
    depth.take(change->amplification, base, perturbation);
    manifold.take(change->hull_excess, base, perturbation);
  }

  json to_json() const {
    json worst = json::array();
    const auto add_worst = [&](const char* measure, const Worst& w) {
      if (!w.value || *w.value == 0) return;
      worst.push_back({{"measure", measure}, {"value", *w.value}, {"from", w.from}, {"to", w.to}});
    };
    add_worst("amplification", depth);
    add_worst("hull_excess", manifold);
    return {{"amplification", touchstone::to_json(amplification, rounded_up)},
            {"jump", short_number(jump)},
            {"hull_excess", touchstone::to_json(hull_excess, short_number)},
            {"regret", touchstone::to_json(regret, short_number)},
            {"points_changed", points_changed},
            {"missed", missed},
            {"unanswered", unanswered},
            {"worst", worst}};
  }
};

/// The configurations around which the steps of one cell are made; the number of each is also that
/// of its perturbations.
struct Bases {
  std::string pair, pose_class;
  std::uint64_t seed;
  std::vector<Subject> subjects;
};

Bases bases_of(const Cell& cell, const Ladder& ladder) {
  Bases bases{pair_name(cell.pair), cell.pose_class, ladder.seed, {}};
  for (std::uint64_t i = 0; i < ladder.count; ++i) {
    bases.subjects.push_back(subject(Identity{cell.pair, cell.pose_class, ladder.seed, i}));
  }
  return bases;
}

/// One result for each candidate that has a routine for the pair, and the truth's own.
json climb(const Bases& bases, std::vector<CandidateProcess>& candidates, const Bar& bar) {
  std::vector<Configuration> asked;
  for (std::uint64_t i = 0; i < bases.subjects.size(); ++i) {
    const Configuration& c = bases.subjects[i].configuration;
    asked.push_back(c);
    for (int rung = 0; rung < amplitudes; ++rung) {
      asked.push_back(perturbed(c, {amplitude(rung), bases.seed, i}));
    }
  }
  const std::vector<ExaminedPose> poses = examine(asked, candidates, bar);
  std::vector<Made> made(candidates.size());
  Rungs truth;
  for (std::uint64_t i = 0; i < bases.subjects.size(); ++i) {
    const ExaminedPose& from = poses[i * (1 + amplitudes)];
    for (int rung = 0; rung < amplitudes; ++rung) {
      const ExaminedPose& to = poses[i * (1 + amplitudes) + 1 + static_cast<std::size_t>(rung)];
      raise(truth[static_cast<std::size_t>(rung)], true_amplification(from, to, bar));
      for (std::size_t k = 0; k < made.size(); ++k) {
        made[k].add(rung, from, to, k, bar, bases.subjects[i].name,
                    {amplitude(rung), bases.seed, i});
      }
    }
  }
  json results = json::array();
  for (std::size_t k = 0; k < made.size(); ++k) {
    if (poses[0].of[k].score.outcome == Outcome::unsupported) continue;
    json result = made[k].to_json();
    result["pair"] = bases.pair;
    result["class"] = bases.pose_class;
    result["candidate"] = candidates[k].candidate().name;
    results.push_back(std::move(result));
  }
  return {{"results", results},
          {"truth",
           {{"pair", bases.pair},
            {"class", bases.pose_class},
            {"amplification", to_json(truth, rounded_up)}}}};
}

/// Of each pair and candidate the worst step by each measure, taken out of the results.
json take_worst(json& results) {
  std::map<std::tuple<std::string, std::string, std::string>, json> worst;
  for (json& result : results) {
    for (json& w : result["worst"]) {
      json& most = worst[{result["candidate"], result["pair"], w["measure"]}];
      if (!most.is_null() && most["value"] >= w["value"]) continue;
      w["candidate"] = result["candidate"];
      w["pair"] = result["pair"];
      w["class"] = result["class"];
      most = std::move(w);
    }
    result.erase("worst");
  }
  json list = json::array();
  for (auto& [key, w] : worst) list.push_back(std::move(w));
  return list;
}

json collected(const std::vector<json>& cells, std::uint64_t seed, std::uint64_t count) {
  json ladder = json::array(), results = json::array(), truth = json::array();
  for (int rung = 0; rung < amplitudes; ++rung) ladder.push_back(amplitude(rung).value());
  for (const json& cell : cells) {
    for (const json& result : cell["results"]) results.push_back(result);
    truth.push_back(cell["truth"]);
  }
  json worst = take_worst(results);
  return {{"amplitudes", ladder}, {"seed", seed},   {"count", count},
          {"results", results},   {"truth", truth}, {"worst", worst}};
}

}  // namespace

std::vector<Cell> degenerate_cells(const std::vector<Pair>& pairs) {
  std::vector<Cell> cells;
  for (const Pair pair : pairs) {
    for (const PoseClass& c : lattice_classes(pair)) cells.push_back({pair, c.name});
  }
  return cells;
}

json amplification(const Ladder& ladder, const Study& study) {
  const std::uint64_t of_cell = ladder.count * (1 + amplitudes);
  Progress progress("perturbed poses", ladder.cells.size() * of_cell);
  std::vector<CandidateProcess> candidates;  // each worker starts its own
  const auto results = run_in_processes(
      ladder.cells.size(), study.workers,
      [&](std::size_t i) {
        if (candidates.empty()) {
          candidates = start(study.candidates, study.bar.threshold, study.limits);
        }
        return climb(bases_of(ladder.cells[i], ladder), candidates, study.bar).dump();
      },
      [&](std::size_t i) {
        return fmt::format("{}/{}", pair_name(ladder.cells[i].pair), ladder.cells[i].pose_class);
      },
      [&](std::size_t done) { progress.update(done * of_cell); });
  std::vector<json> cells;
  for (const std::string& text : results) {
    if (!text.empty()) cells.push_back(json::parse(text));  // empty: interrupted before
  }
  return collected(cells, ladder.seed, ladder.count);
}

json amplification(const Subject& base, std::uint64_t seed, std::uint64_t count,
                   const Study& study) {
  const Bases bases{pair_name(pair_of(base.configuration)), base.name, seed,
                    std::vector<Subject>(count, base)};
  auto candidates = start(study.candidates, study.bar.threshold, study.limits);
  return collected({climb(bases, candidates, study.bar)}, seed, count);
}

}  // namespace touchstone
