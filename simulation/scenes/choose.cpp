#include "simulation/scenes/choose.hpp"

#include <algorithm>
#include <array>
#include <functional>
#include <iterator>
#include <tuple>
#include <utility>

#include "candidates/candidates.hpp"
#include "candidates/host/own_respondent.hpp"
#include "reference/invalid_input.hpp"
#include "simulation/assembly.hpp"

namespace touchstone {
namespace {

/// Seconds that the queries of a run may take; dearer candidates are not run.
constexpr double max_run_time = 3;

/// Largest number of parts of a model that gives the solver few points.
constexpr double max_simple = 2;

using Models = std::vector<const Candidate*>;

/// As Choice::is_sphere has it.
bool is_sphere_for(const PairKind& kind, const Scene& scene, const Candidate& candidate) {
  const bool is_capsule = candidate.family == "capsule";
  if (!is_capsule && !(candidate.family == "spheres" && candidate.value > 1)) return false;
  const JudgedAnswer& answer = kind.answers.front();
  return std::ranges::all_of(std::array{answer.a, answer.b}, [&](int body) {
    const auto* c = std::get_if<Cylinder>(&scene.bodies[body].shape);
    return !c || is_one_sphere(*c, is_capsule);
  });
}

/// As Choice::has_models_alone has it, the exact candidate apart.
bool is_model(const Candidate& candidate) {
  return (is_own(candidate) || candidate.added) && !candidate.models.empty();
}

class ModelSearch {
 public:
  ModelSearch(const ChooseOptions& options, Choice& choice)
      : choice_(choice),
        exact_(*choice.candidates[0]),
        judge_(choice.file, choice.kinds, exact_, options) {}

  void run() {
    choice_.spreads = take_undecidable(choice_.file, judge_.exact_runs());
    judge_new({named("exact", all_exact())});
    if (!choice_.runs[0].holds()) {
      choice_.impossible = true;
      return;
    }
    judge_new(uniform_runs());
    judge_promising(one_kind_changed());
    combine();
    settle();
    choice_.exact_spread =
        spread(choice_.runs[choice_.answer].straying, choice_.file.scene, judge_.exact_runs());
  }

 private:
  Models all_exact() const { return Models(choice_.kinds.all().size(), &exact_); }

  /// Nanoseconds of all queries of a run.
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

  std::optional<std::size_t> find(const Models& models) const {
    for (std::size_t i = 0; i < choice_.runs.size(); ++i) {
      if (choice_.runs[i].models == models) return i;
    }
    return std::nullopt;
  }

  /// Runs and judges those that have not been run yet.
  void judge_new(const std::vector<SceneRun>& wanted) {
    std::vector<SceneRun> runs = fresh(wanted, choice_.runs, &SceneRun::models);
    judge_.judge(runs, choice_.trials.disturbances);
    choice_.runs.insert(choice_.runs.end(), runs.begin(), runs.end());
  }

  /// The same, but leaves out those that hold as written and save neither queries' time nor points.
  void judge_promising(const std::vector<SceneRun>& wanted) {
    std::vector<SceneRun> runs = fresh(wanted, choice_.runs, &SceneRun::models);
    judge_.judge(runs, 0);
    std::erase_if(runs, [&](const SceneRun& r) { return r.holds() && !is_promising(r); });
    judge_.judge(runs, choice_.trials.disturbances);
    choice_.runs.insert(choice_.runs.end(), runs.begin(), runs.end());
  }

  bool can_be_answer(const SceneRun& run) const {
    return run.holds() && choice_.has_models_alone(run);
  }

  /// Can the run be cheaper than the exact one?
  bool is_promising(const SceneRun& run) const {
    const SceneRun& exact = choice_.runs[0];
    return run.nanoseconds < exact.nanoseconds || run.points < exact.points;
  }

  /// What a run takes, roughly, in seconds: what the exact one does, but with one and the same time
  /// for every point that it has less, as the solver's own has the noise of a single run.
  double estimate(const SceneRun& run) const {
    const SceneRun& exact = choice_.runs[0];
    const double most = exact.solver_seconds / choice_.steps() / std::max(1.0, exact.points);
    const double point = std::min(most, choice_.point_seconds().value_or(most));
    const double less = choice_.steps() * point * (exact.points - run.points);
    return 1e-9 * run.nanoseconds + exact.solver_seconds - less;
  }

  bool holds(const Models& models, const std::string& name) {
    judge_new({named(name, models)});
    return choice_.runs[*find(models)].holds();
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

  /// The model whose query is the next cheaper than another's.
  const Candidate* next_cheaper(std::size_t kind, const Candidate& model) const {
    const Candidate* result = nullptr;
    double most = 0;
    const double max_time = cheaper_share * choice_.nanoseconds(kind, model);
    for (const Candidate* c : choice_.candidates) {
      const double time = choice_.nanoseconds(kind, *c);
      const bool is_next = is_model(*c) && time < max_time && time > most;
      if (is_next) most = time, result = c;
    }
    return result;
  }

  SceneRun changed(Models models, std::size_t kind, const Candidate& to) const {
    models[kind] = &to;
    return named(to.name + " for " + choice_.kinds.all()[kind].name, models);
  }

  /// One kind with another model: all whose queries are cheaper, and those of few parts, which can
  /// save the solver points.
  std::vector<SceneRun> one_kind_changed() const {
    const Models exact = all_exact();
    std::vector<SceneRun> result;
    for (std::size_t k = 0; k < exact.size(); ++k) {
      const double max_time = cheaper_share * choice_.nanoseconds(k, exact_);
      for (const Candidate* c : choice_.candidates) {
        const double time = choice_.nanoseconds(k, *c);
        const bool is_simple = c->value <= max_simple && time < infinity;
        if (is_model(*c) && (time < max_time || is_simple)) result.push_back(changed(exact, k, *c));
      }
    }
    std::erase_if(result, [](const SceneRun& r) { return r.nanoseconds > max_run_time * 1e9; });
    return result;
  }

  /// The cheapest model of each kind that serves while the others are exact. While these do not
  /// serve together, the kind with the smallest saving goes back to its next dearer model.
  void combine() {
    const Models exact = all_exact();
    std::vector<std::vector<std::size_t>> serving(exact.size());  // runs, the dearest first
    Models models = exact;
    std::vector<double> cost;
    for (const SceneRun& run : choice_.runs) cost.push_back(estimate(run));
    for (std::size_t i = 0; i < choice_.runs.size(); ++i) {
      if (i > 0 && (!can_be_answer(choice_.runs[i]) || !(cost[i] < cost[0]))) continue;
      for (std::size_t k = 0; k < exact.size(); ++k) {
        Models others = choice_.runs[i].models;
        others[k] = &exact_;
        if (others == exact) serving[k].push_back(i);
      }
    }
    for (std::size_t k = 0; k < exact.size(); ++k) {
      std::ranges::stable_sort(serving[k], std::greater(), [&](std::size_t i) { return cost[i]; });
      models[k] = choice_.runs[serving[k].back()].models[k];
    }
    while (!holds(models, "combination")) {
      std::size_t back = exact.size();
      double min_saved = infinity;
      for (std::size_t k = 0; k < exact.size(); ++k) {
        if (serving[k].size() < 2) continue;
        const auto last = serving[k].rbegin();
        const double saved = cost[last[1]] - cost[last[0]];
        if (saved < min_saved) min_saved = saved, back = k;
      }
      serving[back].pop_back();  // one was left, because the exact run holds
      models[back] = choice_.runs[serving[back].back()].models[back];
    }
  }

  /// Order of preference of models that take much the same: exact ones first, then in the order of
  /// the candidates.
  std::size_t rank(const Models& models) const {
    const auto& all = choice_.candidates;
    std::size_t sum = 0;
    for (const Candidate* m : models) {
      sum += static_cast<std::size_t>(std::find(all.begin(), all.end(), m) - all.begin());
    }
    return sum;
  }

  /// A run as what may be the answer, if it takes so long.
  Finalist finalist(std::size_t i, double seconds) const {
    return {i, seconds, rank(choice_.runs[i].models)};
  }

  /// The engines' routines that hold and seem cheaper than every finalist, or than the exact run if
  /// there is none: what is said of them beside the answer is timed as that is.
  std::vector<std::size_t> rivals(const std::vector<std::size_t>& finalists) const {
    constexpr std::size_t max_count = 3;
    const auto cost = [&](std::size_t i) { return estimate(choice_.runs[i]); };
    const double limit = cost(finalists.empty() ? 0 : finalists.front());
    std::vector<std::size_t> result;
    for (std::size_t i = 1; i < choice_.runs.size(); ++i) {
      const SceneRun& run = choice_.runs[i];
      if (run.holds() && !can_be_answer(run) && cost(i) < limit) result.push_back(i);
    }
    std::ranges::stable_sort(result, {}, cost);
    if (result.size() > max_count) result.resize(max_count);
    return result;
  }

  /// Times what has to be timed and returns the run that is the answer.
  std::size_t best() {
    constexpr std::size_t few = 5, many = 10;
    std::vector<Finalist> promising;
    for (std::size_t i = 1; i < choice_.runs.size(); ++i) {
      const SceneRun& run = choice_.runs[i];
      if (can_be_answer(run) && is_promising(run)) promising.push_back(finalist(i, estimate(run)));
    }
    std::vector<std::size_t> last = finalists(promising);
    std::ranges::copy(rivals(last), std::back_inserter(last));
    const auto is_timed = [&](std::size_t i) { return choice_.runs[i].timing > 0; };
    if (!std::ranges::all_of(last, is_timed)) time(last, few);
    const std::size_t result = cheapest();
    // A busy machine's noise exceeds `noise_of_step` at times: what saves little must do so again,
    // in more rounds.
    const double max_seconds = (1 - 2 * noise_of_step) * choice_.runs[0].seconds();
    const bool saves_little = result != 0 && choice_.runs[result].seconds() > max_seconds;
    if (!saves_little || rounds_ == many) return result;
    time(last, many);
    return cheapest();
  }

  /// Times these runs together with the exact one, which is that of index 0, and with all that were
  /// timed before and hold: times compare only if they were taken in turns.
  void time(const std::vector<std::size_t>& runs, std::size_t rounds) {
    std::vector<SceneRun*> together = {&choice_.runs[0]};
    for (std::size_t i = 1; i < choice_.runs.size(); ++i) {
      SceneRun& run = choice_.runs[i];
      const bool is_new = std::ranges::find(runs, i) != runs.end();
      if (is_new || (run.timing > 0 && run.holds())) together.push_back(&run);
    }
    judge_.time(together, rounds);
    rounds_ = rounds;
  }

  /// The simplest of the timed runs that cost much the same as the cheapest of them; 0, the exact
  /// one, if none saves more than noise.
  std::size_t cheapest() const {
    std::vector<Finalist> costs;
    for (std::size_t i = 1; i < choice_.runs.size(); ++i) {
      const SceneRun& run = choice_.runs[i];
      if (run.timing == 0 || !can_be_answer(run)) continue;
      costs.push_back(finalist(i, run.seconds()));
    }
    const double limit = (1 - noise_of_step) * choice_.runs[0].seconds();
    return simplest_of_cheapest(costs, limit).value_or(0);
  }

  /// The simplest model of a kind that serves while the others are exact and costs no more than the
  /// cheapest of these, within noise; the exact one if none saves more than that. Otherwise noise
  /// would decide which of several such models is combined with those of other kinds.
  const Candidate* simplest_alike(std::size_t kind) const {
    std::vector<std::pair<const Candidate*, double>> serving;  // the simplest first
    double least = infinity;
    for (const Candidate* c : choice_.candidates) {
      const auto run = find(changed(all_exact(), kind, *c).models);
      if (!run || !can_be_answer(choice_.runs[*run])) continue;
      serving.emplace_back(c, estimate(choice_.runs[*run]));
      least = std::min(least, serving.back().second);
    }
    const double noise = (1 / cheaper_share - 1) * estimate(choice_.runs[choice_.answer]);
    return std::ranges::find_if(serving, [&](const auto& s) { return s.second <= least + noise; })
        ->first;
  }

  /// Finds the answer, and tries for each kind the next cheaper model and the simplest of those
  /// that cost much the same, until none of these is a better one.
  void settle() {
    do {
      choice_.answer = best();
      const Models models = choice_.runs[choice_.answer].models;
      std::vector<SceneRun> next;
      for (std::size_t k = 0; k < models.size(); ++k) {
        for (const Candidate* c : {next_cheaper(k, *models[k]), simplest_alike(k)}) {
          if (c) next.push_back(changed(models, k, *c));
        }
      }
      judge_new(next);
      choice_.cheaper.assign(models.size(), std::nullopt);
      for (std::size_t k = 0; k < models.size(); ++k) {
        const Candidate* c = next_cheaper(k, *models[k]);
        if (c) choice_.cheaper[k] = find(changed(models, k, *c).models);
      }
    } while (best() != choice_.answer || !is_confirmed());
  }

  /// Does the answer hold under the further disturbances? Where exact contacts do not, there is
  /// none.
  bool is_confirmed() {
    SceneRun& answer = choice_.runs[choice_.answer];
    std::vector<SceneRun> run = {answer};
    judge_.judge(run, choice_.trials.of_answer());
    answer = run[0];
    choice_.impossible = choice_.answer == 0 && !answer.holds();
    return choice_.impossible || answer.holds();
  }

  Choice& choice_;
  const Candidate& exact_;
  SceneJudge judge_;
  std::size_t rounds_ = 0;  ///< of the last timing
};

}  // namespace

bool Choice::is_sphere(std::size_t kind, const Candidate& candidate) const {
  return is_sphere_for(kinds.all()[kind], file.scene, candidate);
}

bool Choice::has_models_alone(const SceneRun& run) const {
  return std::ranges::all_of(
      run.models, [&](const Candidate* c) { return c == candidates[0] || is_model(*c); });
}

std::vector<std::string> Choice::contacts_of(const SceneRun& run) const {
  const Candidate& exact = *candidates[0];
  const Scene& scene = file.scene;
  const Touching may_touch(scene);
  bool are_all_known = true;
  for (int a = 0; a < static_cast<int>(scene.bodies.size()); ++a) {
    for (int b = 0; b < a; ++b) {
      const bool has_cylinder = std::holds_alternative<Cylinder>(scene.bodies[a].shape) ||
                                std::holds_alternative<Cylinder>(scene.bodies[b].shape);
      if (has_cylinder && may_touch(a, b) && kinds.of(a, b) < 0) are_all_known = false;
    }
  }
  const auto are_all = [&](const Candidate& candidate) {
    return std::ranges::all_of(run.models, [&](const Candidate* m) { return m == &candidate; });
  };
  if (are_all(exact)) return {exact.name};
  if (are_all_known && are_all(*run.models[0])) return {run.models[0]->name};
  std::vector<std::string> result;
  for (std::size_t k = 0; k < run.models.size(); ++k) {
    if (run.models[k] != &exact) result.push_back(kinds.all()[k].name + '=' + run.models[k]->name);
  }
  return result;
}

double Choice::nanoseconds(std::size_t kind, const Candidate& candidate) const {
  const auto at = std::find(candidates.begin(), candidates.end(), &candidate);
  return replayed[kind][static_cast<std::size_t>(at - candidates.begin())].nanoseconds.value_or(
      infinity);
}

double Choice::step_saved() const {
  double least = runs[answer].seconds();
  for (const SceneRun& run : runs) {
    const bool is_other = answer == 0 && run.timing > 0 && run.holds() && has_models_alone(run);
    if (is_other) least = std::min(least, run.seconds());
  }
  return 1 - least / runs[0].seconds();
}

double Choice::frame_seconds(const SceneRun& run) const {
  constexpr double frame = 1.0 / 60;
  return frame / file.scene.step * run.seconds() / steps();
}

std::optional<double> Choice::point_seconds() const {
  constexpr double min_spread = 0.1;  // of the mean number of points
  double count = 0, x = 0, y = 0, xx = 0, xy = 0;
  for (const SceneRun& run : runs) {
    if (!run.holds()) continue;
    const double points = run.points, seconds = run.solver_seconds / steps();
    count += 1, x += points, y += seconds, xx += points * points, xy += points * seconds;
  }
  const double variance = count * xx - x * x;
  if (count < 3 || !(variance > min_spread * min_spread * x * x)) return std::nullopt;
  const double slope = (count * xy - x * y) / variance;
  return slope > 0 ? std::optional(slope) : std::nullopt;
}

std::optional<BoxParts> box_parts(const Candidate& candidate, const Shape& shape) {
  const auto* box = std::get_if<Box>(&shape);
  const auto count = static_cast<int>(candidate.value);
  if (box && candidate.family == "box-spheres") return spheres_in_box(box->half_extents(), count);
  if (box && candidate.family == "box-capsules") return capsules_in_box(box->half_extents(), count);
  return std::nullopt;
}

std::size_t Choice::model_bytes(std::size_t kind, const Candidate& candidate) const {
  constexpr std::size_t sphere = 4, capsule = 7, corner = 3;  // numbers: centre, ends, radius
  const auto count = static_cast<std::size_t>(candidate.value);
  const auto other = static_cast<std::size_t>(kinds.all()[kind].answers.front().b);
  std::size_t numbers = 2;  // radius and half length of a cylinder or capsule on its axis
  if (candidate.family == "spheres") numbers = count * sphere;
  if (candidate.family == "prism") numbers = 2 * count * corner;
  if (const auto parts = box_parts(candidate, file.scene.bodies[other].shape)) {
    numbers = parts->centres.size() * (parts->half_length > 0 ? capsule : sphere);
  }
  return numbers * sizeof(double);
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
  const std::vector<const Candidate*> all = all_candidates();
  const auto place = [&](const Candidate* c) {
    const auto at = std::ranges::find(all, c->family, &Candidate::family);
    return std::tuple(at - all.begin(), c->value);
  };
  std::ranges::stable_sort(result.begin() + 1, result.end(), {}, place);
  return result;
}

Choice choose(const SceneFile& file, const ChooseOptions& options) {
  if (file.needs.empty()) {
    throw InvalidInput("needs", "missing", "must say what has to come out right");
  }
  auto candidates = exact_first(options.candidates);
  Processes processes(options.limits);
  CandidateModel exact(processes.of(*candidates[0]));
  Trajectory exact_run = run_scene(file.scene, exact);
  PairKinds kinds(file.scene, exact_run);
  if (kinds.all().empty()) {
    throw InvalidInput("bodies", "no cylinder near another body at any time",
                       "must hold a cylinder that touches something");
  }
  std::vector<const Candidate*> same_as_sphere;
  if (std::ranges::find(candidates, "spheres:1", &Candidate::name) != candidates.end()) {
    std::ranges::copy_if(candidates, std::back_inserter(same_as_sphere), [&](const Candidate* c) {
      return std::ranges::all_of(
          kinds.all(), [&](const PairKind& kind) { return is_sphere_for(kind, file.scene, *c); });
    });
  }
  std::erase_if(candidates, [&](const Candidate* c) {
    return std::ranges::find(same_as_sphere, c) != same_as_sphere.end();
  });
  auto replayed = replay(file.scene, exact_run, kinds.all(), candidates, options.limits);
  Choice choice{file, std::move(exact_run), std::move(kinds), candidates, std::move(replayed)};
  choice.trials = options.trials;
  choice.same_as_sphere = std::move(same_as_sphere);
  ModelSearch(options, choice).run();
  return choice;
}

std::vector<std::size_t> finalists(std::vector<Finalist> promising) {
  constexpr std::size_t max_count = 6;
  if (promising.empty()) return {};
  const Finalist cheapest = *std::ranges::min_element(promising, {}, &Finalist::seconds);
  const double limit = cheapest.seconds / (cheaper_share * cheaper_share);
  std::erase_if(promising, [&](const Finalist& f) { return f.seconds > limit; });
  std::ranges::sort(promising, {}, [&](const Finalist& f) {
    return std::tuple(f.index != cheapest.index, f.rank, f.index);
  });
  std::vector<std::size_t> result;
  for (const Finalist& f : promising) {
    if (result.size() < max_count) result.push_back(f.index);
  }
  return result;
}

std::optional<std::size_t> simplest_of_cheapest(const std::vector<Finalist>& finalists,
                                                double limit) {
  for (const Finalist& f : finalists) limit = std::min(limit, f.seconds / cheaper_share);
  const Finalist* result = nullptr;
  for (const Finalist& f : finalists) {
    if (f.seconds <= limit && (!result || f.rank < result->rank)) result = &f;
  }
  return result ? std::optional(result->index) : std::nullopt;
}

}  // namespace touchstone
