#include "simulation/scenes/scene_judge.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <functional>
#include <limits>
#include <numeric>
#include <set>

#include "candidates/candidates.hpp"
#include "candidates/host/own_respondent.hpp"
#include "candidates/host/progress.hpp"
#include "oracle/judge/score.hpp"
#include "oracle/truth.hpp"
#include "reference/invalid_input.hpp"

namespace touchstone {
namespace {

constexpr std::size_t timing_rounds = 9;

std::vector<Configuration> sample(const Scene& scene, const Trajectory& run, const PairKind& kind) {
  const std::size_t count = std::min(max_replayed, kind.answers.size());
  std::vector<Configuration> result;
  for (std::size_t i = 0; i < count; ++i) {
    result.push_back(run.configuration(scene, kind.answers[i * kind.answers.size() / count]));
  }
  return result;
}

/// Error of the answered depth, metres, as ReplayScore has it.
double depth_error(const Score& s, double size) {
  if (s.depth_error) return std::abs(*s.depth_error) * size;
  if (agrees(s.outcome) || s.outcome == Outcome::missed) return s.severity * size;
  return std::numeric_limits<double>::infinity();
}

ReplayScore score_all(const std::vector<Configuration>& configurations,
                      const std::vector<oracle::Truth>& truths,
                      const std::vector<Answer>& answers) {
  ReplayScore result;
  for (std::size_t i = 0; i < configurations.size(); ++i) {
    const Score s = score(configurations[i], truths[i], answers[i], Bar{});
    ++result.count;
    if (agrees(s.outcome)) ++result.agree;
    const double error = depth_error(s, error_size(configurations[i], Bar{}));
    if (error > result.depth_error) result.depth_error = error, result.worst_depth = i;
    const double angle =
        s.normal_regret.value_or(0) > equal_regret ? s.normal_angle.value_or(0) : 0;
    if (angle > result.normal_angle) result.normal_angle = angle, result.worst_angle = i;
  }
  return result;
}

/// A candidate for each pair of bodies, and one batch of questions for each candidate in a step.
class PairwiseModel : public ContactModel {
 public:
  /// The process that answers for bodies a and b, always the same one for the same pair.
  using Choice = std::function<CandidateProcess&(int a, int b)>;
  explicit PairwiseModel(Choice choice) : choice_(std::move(choice)) {}
  void begin() override { begun_.clear(); }
  std::vector<Answer> answers(std::span<const PairQuestion> questions) override {
    std::vector<CandidateProcess*> chosen;
    for (const PairQuestion& q : questions) {
      chosen.push_back(&choice_(q.a, q.b));
      if (std::find(begun_.begin(), begun_.end(), chosen.back()) != begun_.end()) continue;
      chosen.back()->restart();
      begun_.push_back(chosen.back());
    }
    std::vector<Answer> result(questions.size());
    for (CandidateProcess* process : begun_) {
      std::vector<PairQuestion> batch;
      for (std::size_t i = 0; i < questions.size(); ++i) {
        if (chosen[i] == process) batch.push_back(questions[i]);
      }
      if (batch.empty()) continue;
      auto answers = CandidateModel(*process, Unsupported::refused).answers(batch);
      auto next = answers.begin();
      for (std::size_t i = 0; i < questions.size(); ++i) {
        if (chosen[i] == process) result[i] = std::move(*next++);
      }
    }
    return result;
  }

 private:
  Choice choice_;
  std::vector<CandidateProcess*> begun_;
};

/// Largest number of answers of a run that are compared with the oracle.
constexpr std::size_t max_scored = 24;

/// Answers of models other than the exact one, up to a time, for bodies that touch or that the
/// model takes to touch: those that concern one of `bodies` if there are any, otherwise all.
std::vector<JudgedAnswer> suspects(const Trajectory& run, double time,
                                   const std::vector<int>& bodies, const auto& is_exact) {
  std::vector<JudgedAnswer> all, concerned;
  for (const JudgedAnswer& a : run.answers) {
    if (run.step * a.frame > time + run.step / 2) break;
    const bool touches = a.depth > 0 || a.status != TS_NONE;
    if (!touches || is_exact(a)) continue;
    all.push_back(a);
    const auto named = [&](int body) {
      return std::find(bodies.begin(), bodies.end(), body) != bodies.end();
    };
    if (named(a.a) || named(a.b)) concerned.push_back(a);
  }
  return concerned.empty() ? all : concerned;
}

/// The answer with the largest error of depth, and others evenly over time.
std::vector<JudgedAnswer> worth_scoring(std::vector<JudgedAnswer> all) {
  if (all.size() <= max_scored) return all;
  std::vector<JudgedAnswer> result = {
      *std::max_element(all.begin(), all.end(), [](const JudgedAnswer& x, const JudgedAnswer& y) {
        return x.depth_error() < y.depth_error();
      })};
  for (std::size_t i = 1; i < max_scored; ++i) {
    result.push_back(all[i * (all.size() - 1) / (max_scored - 1)]);
  }
  return result;
}

/// Coverage of the contact patch below which evidence mentions it.
constexpr double poor_coverage = 0.5;

std::string in_words(const Score& s, const Configuration& c) {
  const double size = error_size(c, Bar{});
  std::string text = outcome_name(s.outcome);
  switch (s.outcome) {
    case Outcome::agree:
    case Outcome::unseen:
      text = "depth and normal are right";
      break;
    case Outcome::missed:
      return fmt::format("missed, {:.2g} m deep", s.severity * size);
    case Outcome::wrong_normal:
      return fmt::format("normal wrong by {:.2g}°", s.normal_angle.value_or(0));
    case Outcome::phantom:
    case Outcome::shallow:
    case Outcome::overdeep:
      text += fmt::format(" by {:.2g} m", std::abs(*s.depth_error) * size);
      break;
    case Outcome::shallow_points:
    case Outcome::overdeep_points:
    case Outcome::phantom_points:
    case Outcome::off_body:
    case Outcome::no_points:
      return text + fmt::format(" by {:.2g} m", s.severity * size);
    default:
      return text;
  }
  if (s.coverage.value_or(1) >= poor_coverage) {
    return agrees(s.outcome) ? "even the worst answer looked at is right" : text;
  }
  return text + fmt::format(", but {} {:.2f} of the contact patch",
                            s.points == 1 ? "its 1 point spans"
                                          : fmt::format("its {} points span", s.points),
                            *s.coverage);
}

/// Rank of an answer as evidence: points that span nothing of the patch count as much as an error
/// of a tenth of the size in depth or normal.
double badness(const Score& s) {
  const bool no_answer = !agrees(s.outcome) && s.severity == 0;
  if (no_answer) return std::numeric_limits<double>::infinity();
  return 10 * s.severity + 1 - s.coverage.value_or(1);
}

/// Worst answer of a run, against the oracle, up to the moment at which a need broke: of the need's
/// own bodies if their models were asked. Absent when only the exact candidate was asked.
/// `model_of` gives the candidate of two bodies of the disturbed scene.
std::optional<Evidence> find_evidence(const Need& need, double broken, const DisturbedScene& scene,
                                      const Trajectory& run, const auto& model_of,
                                      const Candidate& exact, Processes& processes) {
  std::vector<int> bodies;
  for (std::size_t i = 0; i < scene.origin.size(); ++i) {
    const bool is_named =
        std::find(need.bodies.begin(), need.bodies.end(), scene.origin[i]) != need.bodies.end();
    if (is_named) bodies.push_back(static_cast<int>(i));
  }
  const auto all = suspects(run, broken, bodies,
                            [&](const JudgedAnswer& a) { return &model_of(a.a, a.b) == &exact; });
  std::optional<Evidence> worst;
  double max_badness = -1;
  for (const JudgedAnswer& a : worth_scoring(all)) {
    const Candidate& model = model_of(a.a, a.b);
    const Configuration c = run.configuration(scene.scene, a);
    const Score s = score(c, oracle::truth(c), processes.of(model).answer(c), Bar{});
    if (badness(s) <= max_badness) continue;
    max_badness = badness(s);
    const auto& named = scene.scene.bodies;
    worst = {c, named[a.a].name + " and " + named[a.b].name, model.name, in_words(s, c),
             run.step * a.frame};
  }
  return worst;
}

/// As PairKind has it.
std::string kind_name(const Body& a, const Body& b) {
  return shape_text(a.shape) + " on " + shape_text(b.shape);
}

}  // namespace

std::vector<ReplayScore> replay(const std::vector<Configuration>& configurations,
                                std::vector<CandidateProcess>& candidates) {
  std::vector<oracle::Truth> truths;
  for (const Configuration& c : configurations) truths.push_back(oracle::truth(c));
  std::vector<ReplayScore> result(candidates.size());
  std::vector<bool> ready(candidates.size());
  for (std::size_t k = 0; k < candidates.size(); ++k) {
    if (!candidates[k].candidate().has_routine_for(pair_of(configurations.front()))) continue;
    result[k] = score_all(configurations, truths, candidates[k].answers(configurations));
    ready[k] = candidates[k].prepare_timing(configurations);
  }
  std::vector<std::vector<double>> times(candidates.size());
  for (std::size_t round = 0; round < timing_rounds; ++round) {
    for (std::size_t turn = 0; turn < candidates.size(); ++turn) {
      const std::size_t k = (round + turn) % candidates.size();
      if (!ready[k]) continue;
      if (const auto cost = candidates[k].cost_per_query()) times[k].push_back(cost->nanoseconds);
    }
  }
  for (std::size_t k = 0; k < candidates.size(); ++k) {
    if (times[k].size() < timing_rounds) continue;  // unsupported, or it died on the way
    std::nth_element(times[k].begin(), times[k].begin() + timing_rounds / 2, times[k].end());
    result[k].nanoseconds = times[k][timing_rounds / 2];
  }
  return result;
}

std::vector<std::vector<ReplayScore>> replay(const Scene& scene, const Trajectory& run,
                                             const std::vector<PairKind>& kinds,
                                             const std::vector<const Candidate*>& candidates,
                                             const Limits& limits) {
  Progress progress("kinds of pairs replayed", kinds.size());
  auto processes = start(candidates, simulation_threshold, limits);
  std::vector<std::vector<ReplayScore>> result;
  for (const PairKind& kind : kinds) {
    result.push_back(replay(sample(scene, run, kind), processes));
    progress.update(result.size());
  }
  return result;
}

CandidateProcess& Processes::of(const Candidate& candidate) {
  const auto found = processes_.find(&candidate);
  if (found != processes_.end()) return found->second;
  const Candidate asked = is_own(candidate) ? asked_here(candidate) : candidate;
  return processes_.emplace(&candidate, CandidateProcess(asked, simulation_threshold, limits_))
      .first->second;
}

Trajectory run_with(const DisturbedScene& scene, const PairKinds& kinds,
                    const std::vector<const Candidate*>& models, const Candidate& exact,
                    Processes& processes) {
  PairwiseModel model([&](int a, int b) -> CandidateProcess& {
    const int kind = kinds.of(scene.origin[a], scene.origin[b]);
    return processes.of(kind >= 0 && models[kind] ? *models[kind] : exact);
  });
  return run_scene(scene.scene, model);
}

NamedContacts read_contacts(const std::vector<std::string>& names, const Scene& scene) {
  const auto candidate = [](const std::string& name) {
    try {
      return &find_candidate(name);
    } catch (const InvalidInput& e) {
      throw InvalidInput("--contacts", e.value(), e.remedy());
    }
  };
  NamedContacts result;
  if (names.size() == 1 && names[0].find('=') == names[0].npos) {
    result.for_all = candidate(names[0]);
    return result;
  }
  std::set<std::string> kinds;
  for (const Body& a : scene.bodies) {
    for (const Body& b : scene.bodies) {
      if (&a != &b && std::holds_alternative<Cylinder>(a.shape)) kinds.insert(kind_name(a, b));
    }
  }
  for (const std::string& name : names) {
    const std::size_t equals = name.rfind('=');
    const std::string kind = name.substr(0, equals);
    if (equals == name.npos || !kinds.contains(kind)) {
      throw InvalidInput(
          "--contacts", '"' + name + '"',
          fmt::format("must be one candidate, or a kind of pairs and a candidate, as "
                      "\"{}=capsule\"",
                      kinds.empty() ? "cylinder on plane" : *kinds.begin()));
    }
    result.by_kind[kind] = candidate(name.substr(equals + 1));
  }
  return result;
}

Trajectory run_with(const DisturbedScene& scene, const NamedContacts& contacts,
                    const Candidate& exact, Processes& processes) {
  const std::vector<Body>& bodies = scene.scene.bodies;
  PairwiseModel model([&](int a, int b) -> CandidateProcess& {
    if (contacts.for_all) return processes.of(*contacts.for_all);
    for (const auto& [first, second] : {std::pair(a, b), std::pair(b, a)}) {
      const auto found = contacts.by_kind.find(kind_name(bodies[first], bodies[second]));
      if (found != contacts.by_kind.end()) return processes.of(*found->second);
    }
    return processes.of(exact);
  });
  return run_scene(scene.scene, model);
}

SceneJudge::SceneJudge(const SceneFile& file, const PairKinds& kinds, const Candidate& exact,
                       const ChooseOptions& options)
    : file_(file), kinds_(kinds), exact_(exact), options_(options) {}

const std::vector<Trajectory>& SceneJudge::exact_runs() {
  if (!exact_runs_.empty()) return exact_runs_;
  Processes processes(options_.limits);  // each worker process starts its own
  const auto make = [&](const DisturbedScene& scene) {
    CandidateModel model(processes.of(exact_));
    return to_bytes(ends_of(scene.turned_back(run_scene(scene.scene, model))));
  };
  for (const std::string& run :
       touchstone::exact_runs(file_.scene, options_.trials.seed, options_.trials.of_answer(),
                              options_.workers, file_.name, make)) {
    exact_runs_.push_back(from_bytes<Trajectory>(run));
  }
  return exact_runs_;
}

void SceneJudge::judge(std::vector<SceneRun>& runs, std::size_t last) {
  const std::vector<Trajectory>& exact_runs = this->exact_runs();
  Processes processes(options_.limits);  // each worker process starts its own candidates
  const auto trial_of = [&](std::size_t index, std::size_t disturbance) {
    const SceneRun& run = runs[index];
    const DisturbedScene scene(file_.scene, options_.trials.seed, disturbance);
    const Trajectory trajectory = run_with(scene, kinds_, run.models, exact_, processes);
    const Trajectory as_written = scene.turned_back(trajectory);
    Trial trial;
    trial.points = trajectory.points;
    trial.solver_seconds =
        std::accumulate(trajectory.step_seconds.begin(), trajectory.step_seconds.end(), 0.0);
    trial.straying = straying(file_.scene, as_written, exact_runs[disturbance]);
    for (const auto& need : file_.needs) {
      trial.verdicts.push_back(need->judge({file_.scene, as_written, exact_runs[disturbance]}));
    }
    const int broken = first_broken(trial.verdicts);
    if (broken < 0) return trial;
    const auto model_of = [&](int a, int b) -> const Candidate& {
      const int kind = kinds_.of(scene.origin[a], scene.origin[b]);
      return kind >= 0 && run.models[kind] ? *run.models[kind] : exact_;
    };
    trial.evidence = find_evidence(*file_.needs[broken], trial.verdicts[broken].time, scene,
                                   trajectory, model_of, exact_, processes);
    return trial;
  };
  repeat(runs, last, options_.workers, trial_of,
         [&](std::size_t run) { return file_.name + " with " + runs[run].name; });
}

void SceneJudge::time(const std::vector<SceneRun*>& runs, std::size_t rounds) {
  Processes processes(options_.limits);
  const DisturbedScene as_written(file_.scene, options_.trials.seed, 0);
  const auto run = [&](std::size_t i) {
    return run_with(as_written, kinds_, runs[i]->models, exact_, processes).step_seconds;
  };
  const auto least = least_step_seconds(runs.size(), run, rounds);
  ++timings_;
  for (std::size_t i = 0; i < runs.size(); ++i) {
    runs[i]->solver_seconds = std::accumulate(least[i].begin(), least[i].end(), 0.0);
    runs[i]->timing = timings_;
  }
}

}  // namespace touchstone
