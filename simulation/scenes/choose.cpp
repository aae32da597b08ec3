#include "simulation/scenes/choose.hpp"

#include <algorithm>
#include <limits>

#include "candidates/candidates.hpp"
#include "reference/invalid_input.hpp"

namespace touchstone {
namespace {

/// Seconds that the queries of a run may take; dearer candidates are not run.
constexpr double max_run_time = 3;

constexpr double infinity = std::numeric_limits<double>::infinity();

using Models = std::vector<const Candidate*>;

class Search {
 public:
  Search(const ChooseOptions& options, Choice& choice)
      : choice_(choice),
        exact_(*choice.candidates[0]),
        judge_(choice.file, choice.kinds, exact_, options) {}

  void run() {
    judge_new({named("exact", all_exact())});
    if (!choice_.runs[0].holds()) {
      choice_.impossible = true;
      return;
    }
    judge_new(uniform_runs());
    const auto by_kind = one_kind_changed(all_exact());
    judge_new(by_kind);
    combine();
    settle();
  }

 private:
  Models all_exact() const { return Models(choice_.kinds.all().size(), &exact_); }

  double cost(const Models& models) const {
    double sum = 0;
    for (std::size_t k = 0; k < models.size(); ++k) {
      sum += choice_.nanoseconds(k, *models[k]) *
             static_cast<double>(choice_.kinds.all()[k].answers.size());
    }
    return sum;
  }

  SceneRun named(const std::string& name, const Models& models) const {
    return {name, models, cost(models)};
  }

  const SceneRun* find(const Models& models) const {
    for (const SceneRun& run : choice_.runs) {
      if (run.models == models) return &run;
    }
    return nullptr;
  }

  /// Runs and judges those that have not been run yet.
  void judge_new(const std::vector<SceneRun>& wanted) {
    std::vector<SceneRun> fresh;
    for (const SceneRun& run : wanted) {
      const bool twice = std::any_of(fresh.begin(), fresh.end(), [&](const SceneRun& other) {
        return other.models == run.models;
      });
      if (!twice && !find(run.models)) fresh.push_back(run);
    }
    judge_.judge(fresh, choice_.trials.disturbances);
    choice_.runs.insert(choice_.runs.end(), fresh.begin(), fresh.end());
  }

  bool holds(const Models& models, const std::string& name) {
    judge_new({named(name, models)});
    return find(models)->holds();
  }

  /// Each candidate for all kinds that it supports.
  std::vector<SceneRun> uniform_runs() {
    std::vector<SceneRun> result;
    for (const Candidate* candidate : choice_.candidates) {
      Models models = all_exact();
      for (std::size_t k = 0; k < models.size(); ++k) {
        if (choice_.nanoseconds(k, *candidate) < infinity) models[k] = candidate;
      }
      if (cost(models) > max_run_time * 1e9) {
        choice_.too_slow.push_back(candidate);
      } else if (candidate != &exact_ && models != all_exact()) {
        result.push_back(named(candidate->name, models));
      }
    }
    return result;
  }

  /// Candidates cheaper than the model for the kind, the dearest first.
  Models cheaper(std::size_t kind, const Candidate& model) const {
    Models result;
    const double max_time = cheaper_share * choice_.nanoseconds(kind, model);
    for (const Candidate* c : choice_.candidates) {
      if (choice_.nanoseconds(kind, *c) < max_time) result.push_back(c);
    }
    std::stable_sort(result.begin(), result.end(), [&](const Candidate* x, const Candidate* y) {
      return choice_.nanoseconds(kind, *x) > choice_.nanoseconds(kind, *y);
    });
    return result;
  }

  SceneRun changed(Models models, std::size_t kind, const Candidate& to) const {
    models[kind] = &to;
    return named(to.name + " for " + choice_.kinds.all()[kind].name, models);
  }

  std::vector<SceneRun> one_kind_changed(const Models& from) const {
    std::vector<SceneRun> result;
    for (std::size_t k = 0; k < from.size(); ++k) {
      for (const Candidate* c : cheaper(k, *from[k])) result.push_back(changed(from, k, *c));
    }
    return result;
  }

  /// The cheapest model of each kind that serves while the others are exact. While these do not
  /// serve together, the kind with the smallest saving goes back to its next dearer model.
  void combine() {
    const Models exact = all_exact();
    std::vector<Models> serving(exact.size());
    Models models = exact;
    for (std::size_t k = 0; k < exact.size(); ++k) {
      serving[k] = {&exact_};
      for (const Candidate* c : cheaper(k, exact_)) {
        if (find(changed(exact, k, *c).models)->holds()) serving[k].push_back(c);
      }
      models[k] = serving[k].back();
    }
    while (!holds(models, "combination")) {
      std::size_t back = exact.size();
      double min_saved = infinity;
      for (std::size_t k = 0; k < exact.size(); ++k) {
        if (serving[k].size() < 2) continue;
        const Candidate& dearer = *serving[k][serving[k].size() - 2];
        const double saved = (choice_.nanoseconds(k, dearer) - choice_.nanoseconds(k, *models[k])) *
                             static_cast<double>(choice_.kinds.all()[k].answers.size());
        if (saved < min_saved) min_saved = saved, back = k;
      }
      serving[back].pop_back();  // one was left, because the exact run holds
      models[back] = serving[back].back();
    }
  }

  /// Is every model the exact one, or cheaper?
  bool nowhere_dearer(const Models& models) const {
    for (std::size_t k = 0; k < models.size(); ++k) {
      const double max_time = cheaper_share * choice_.nanoseconds(k, exact_);
      if (models[k] != &exact_ && !(choice_.nanoseconds(k, *models[k]) < max_time)) return false;
    }
    return true;
  }

  /// Finds the cheapest run that holds and tries the next cheaper model of each kind, until none of
  /// these holds.
  void settle() {
    for (;;) {
      choice_.answer = 0;
      for (std::size_t i = 0; i < choice_.runs.size(); ++i) {
        const SceneRun &best = choice_.runs[choice_.answer], &run = choice_.runs[i];
        if (run.holds() && nowhere_dearer(run.models) && run.nanoseconds < best.nanoseconds) {
          choice_.answer = i;
        }
      }
      const Models models = choice_.runs[choice_.answer].models;
      std::vector<SceneRun> next;
      choice_.cheaper.assign(models.size(), std::nullopt);
      for (std::size_t k = 0; k < models.size(); ++k) {
        const Models all = cheaper(k, *models[k]);
        if (!all.empty()) next.push_back(changed(models, k, *all.front()));
      }
      judge_new(next);
      bool better = false;
      std::size_t at = 0;
      for (std::size_t k = 0; k < models.size(); ++k) {
        if (cheaper(k, *models[k]).empty()) continue;
        const SceneRun* run = find(next[at++].models);
        choice_.cheaper[k] = static_cast<std::size_t>(run - choice_.runs.data());
        better = better || run->holds();
      }
      if (!better && is_confirmed()) return;
    }
  }

  /// Does the answer hold under the further disturbances?
  bool is_confirmed() {
    SceneRun& answer = choice_.runs[choice_.answer];
    if (choice_.answer == 0) return true;  // exact contacts are what the others are held to
    std::vector<SceneRun> run = {answer};
    judge_.judge(run, choice_.trials.of_answer());
    answer = run[0];
    return answer.holds();
  }

  Choice& choice_;
  const Candidate& exact_;
  const SceneJudge judge_;
};

}  // namespace

double Choice::nanoseconds(std::size_t kind, const Candidate& candidate) const {
  const auto at = std::find(candidates.begin(), candidates.end(), &candidate);
  return replayed[kind][static_cast<std::size_t>(at - candidates.begin())].nanoseconds.value_or(
      infinity);
}

double Choice::rest_of_step() const {
  return exact_run.solver_seconds / static_cast<double>(exact_run.frames.size() - 1);
}

double Choice::step_saved() const {
  const double exact = 1e-9 * runs[0].nanoseconds;
  return (exact - 1e-9 * runs[answer].nanoseconds) / (exact + exact_run.solver_seconds);
}

double Choice::frame_seconds(const SceneRun& run) const {
  constexpr double frame = 1.0 / 60;
  const auto steps = static_cast<double>(exact_run.frames.size() - 1);
  return frame / file.scene.step * (1e-9 * run.nanoseconds / steps + rest_of_step());
}

std::optional<double> Choice::point_seconds() const {
  constexpr double min_spread = 0.1;  // of the mean number of points
  const auto steps = static_cast<double>(exact_run.frames.size() - 1);
  double count = 0, x = 0, y = 0, xx = 0, xy = 0;
  for (const SceneRun& run : runs) {
    if (!run.holds()) continue;
    const double points = run.points, seconds = run.solver_seconds / steps;
    count += 1, x += points, y += seconds, xx += points * points, xy += points * seconds;
  }
  const double variance = count * xx - x * x;
  if (count < 3 || !(variance > min_spread * min_spread * x * x)) return std::nullopt;
  const double slope = (count * xy - x * y) / variance;
  return slope > 0 ? std::optional(slope) : std::nullopt;
}

bool Choice::is_worthwhile() const { return answer != 0 && step_saved() >= noise_of_step; }

std::size_t model_bytes(const Candidate& candidate) {
  const auto count = static_cast<std::size_t>(candidate.value);
  if (candidate.family == "spheres") return count * 4 * sizeof(double);    // centre and radius
  if (candidate.family == "prism") return 2 * count * 3 * sizeof(double);  // corners
  return 2 * sizeof(double);  // radius and half length of a cylinder or capsule
}

std::vector<const Candidate*> swept_candidates() {
  std::vector<std::string> names;
  for (const Candidate* c : all_candidates()) {
    std::string name = c->name;
    if (c->family == "spheres") name = "spheres:1..64";
    if (c->family == "prism") name = "prism:8..128";
    if (c->family == "box-spheres") name = "box-spheres:2..32";
    if (c->family == "box-capsules") name = "box-capsules:1..16";
    names.push_back(name);
  }
  return find_candidates(names);
}

std::vector<const Candidate*> exact_first(const std::vector<const Candidate*>& candidates) {
  std::vector<const Candidate*> result = {&find_candidate("reference")};
  for (const Candidate* c : candidates) {
    if (c != result[0]) result.push_back(c);
  }
  return result;
}

Choice choose(const SceneFile& file, const ChooseOptions& options) {
  if (file.needs.empty()) {
    throw InvalidInput("needs", "missing", "must say what has to come out right");
  }
  const auto candidates = exact_first(options.candidates);
  Processes processes(options.limits);
  CandidateModel exact(processes.of(*candidates[0]));
  Trajectory exact_run = run_scene(file.scene, exact);
  PairKinds kinds(file.scene, exact_run);
  if (kinds.all().empty()) {
    throw InvalidInput("bodies", "no cylinder near another body at any time",
                       "must hold a cylinder that touches something");
  }
  auto replayed = replay(file.scene, exact_run, kinds.all(), candidates, options.limits);
  Choice choice{file, std::move(exact_run), std::move(kinds), candidates, std::move(replayed)};
  choice.trials = options.trials;
  Search(options, choice).run();
  return choice;
}

}  // namespace touchstone
