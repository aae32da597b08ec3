#include "reports/search.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>
#include <limits>
#include <map>
#include <optional>
#include <utility>

#include <nlohmann/json.hpp>

#include "candidates/host/worker_processes.hpp"
#include "oracle/truth.hpp"
#include "properties/files/bytes.hpp"
#include "properties/files/configuration_json.hpp"
#include "properties/laws/failure_file.hpp"
#include "properties/named.hpp"
#include "properties/random_step.hpp"
#include "properties/stable_hash.hpp"
#include "reference/invalid_input.hpp"

namespace touchstone {

namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();

/// Width of the truth of what is climbed over, relative to the larger size: far below any bar.
constexpr double step_width = 1e-15;

/// Configurations that a climb draws before it takes the highest, and steps that are asked
/// together. So many rounds without a higher place end a climb.
constexpr std::uint64_t starts_of_climb = 64, steps_of_round = 16, patience = 16;

/// Errors of an answer that is a contact; see Goal.
double contact_error(Goal goal, const Configuration& c, const Answer& a,
                     const oracle::Truth& truth) {
  const double sigma = truth.signed_distance.midpoint();
  if (goal == Goal::distance) return std::abs(a.signed_distance - sigma);
  if (goal == Goal::normal) return oracle::normal_regret(c, truth, Vec3(a.normal));
  if (a.point_count == 0) return std::max(0.0, -sigma);
  double deepest = -infinite;
  for (int i = 0; i < a.point_count; ++i) deepest = std::max(deepest, a.points[i].depth);
  return std::abs(deepest + sigma);
}

/// How high an answer stands. Infinite where it cannot be judged; negative where the bodies are
/// beyond the threshold and so said to be, by how far, so that climbs lead to a contact.
double height(Goal goal, const Configuration& c, const Answer& a, const Bar& bar) {
  if (find_law("answers").judge(c, {&a, 1}, bar)) return infinite;
  const oracle::Truth truth = oracle::truth(c, step_width);
  const double size = error_size(c, bar), sigma = truth.signed_distance.midpoint();
  if (a.status == TS_CONTACT) return contact_error(goal, c, a, truth) / size;
  if (sigma < 0) return goal == Goal::distance ? -sigma / size : 0;
  return std::min(0.0, (bar.threshold - sigma) / size);
}

/// Asks a candidate about configurations, in the session that `begin` begins.
class Heights {
 public:
  Heights(CandidateProcess& candidate, Goal goal, const Bar& bar)
      : candidate_(candidate), goal_(goal), bar_(bar) {}

  void begin() { candidate_.ask_within(bar_.threshold); }

  std::vector<double> of(const std::vector<Configuration>& all) {
    if (goal_ == Goal::time) return costs(all);
    if (goal_ == Goal::hull) return hull_jumps(all);
    const std::vector<Answer> answers = candidate_.answer(all);
    std::vector<double> result;
    for (std::size_t i = 0; i < all.size(); ++i) {
      result.push_back(height(goal_, all[i], answers[i], bar_));
    }
    return result;
  }

 private:
  std::vector<double> hull_jumps(const std::vector<Configuration>& all) {
    const Law& law = find_law("hull");
    std::vector<Configuration> asked;
    std::vector<std::size_t> ends;
    for (const Configuration& c : all) {
      asked.push_back(c);
      if (law.applies(c)) {
        for (Configuration& step : law.questions(c, bar_)) asked.push_back(std::move(step));
      }
      ends.push_back(asked.size());
    }
    const std::vector<Answer> answers = candidate_.answer(asked);
    std::vector<double> result;
    for (std::size_t i = 0, first = 0; i < all.size(); first = ends[i++]) {
      const auto of_one = std::span(answers).subspan(first, ends[i] - first);
      const bool is_judged = !find_law("answers").judge(all[i], of_one.first(1), bar_);
      result.push_back(is_judged ? hull_jump(all[i], of_one, bar_) : infinite);
    }
    return result;
  }

  std::vector<double> costs(const std::vector<Configuration>& all) {
    std::vector<double> result;
    for (const Configuration& c : all) {
      const bool is_ready = candidate_.prepare_timing({&c, 1});
      const auto cost = is_ready ? candidate_.cost_per_query() : std::nullopt;
      result.push_back(cost ? cost->instructions.value_or(cost->nanoseconds) : infinite);
    }
    return result;
  }

  CandidateProcess& candidate_;
  Goal goal_;
  Bar bar_;
};

/// One climb of a pair and goal, by its number.
struct ClimbTask {
  std::size_t of_goal;  ///< place in the results
  Pair pair;
  Goal goal;
  std::uint64_t number, budget;

  std::string name() const {
    return fmt::format("climb {} of {}, {}", number, pair_name(pair), goal_name(goal));
  }
};

/// Keeps the higher place, and what was sampled at most.
void keep_higher(std::optional<Summit>& highest, const Summit& other) {
  const double sampled = highest ? std::max(highest->sampled, other.sampled) : other.sampled;
  if (!highest || other.value > highest->value) highest = other;
  highest->sampled = sampled;
}

class Climb {
 public:
  Climb(const ClimbTask& task, const Search& search, CandidateProcess& candidate)
      : task_(task),
        search_(search),
        classes_(selected(task.pair, search.starts)),
        heights_(candidate, task.goal, search.bar),
        draw_(rc::Random(rc::Random::Key{
            search.seed, task.number,
            stable_hash(fmt::format("{}/{}", pair_name(task.pair), goal_name(task.goal))), 1})) {}

  /// The highest place of all that fits into the budget.
  Summit run() {
    heights_.begin();
    std::optional<Summit> best;
    while (left() > 0) {
      Summit at = highest_start();
      climb(at);
      keep_higher(best, at);
      if (std::isinf(best->value)) break;
    }
    if (task_.goal == Goal::time) in_medians(*best);
    return *best;
  }

  std::uint64_t evaluations() const { return done_; }

 private:
  std::uint64_t left() const { return task_.budget - done_; }

  std::vector<double> heights(const std::vector<Configuration>& all) {
    done_ += all.size();
    return heights_.of(all);
  }

  Summit highest_start() {
    constexpr std::int64_t max_index = std::int64_t{1} << 40;
    std::vector<Identity> names;
    std::vector<Configuration> all;
    for (std::uint64_t i = std::min(left(), starts_of_climb); i > 0; --i) {
      const PoseClass& pose_class = draw_.any_of(classes_);
      const auto index = static_cast<std::uint64_t>(draw_.integer(0, max_index));
      names.push_back({pose_class, search_.seed, index});
      all.push_back(make_configuration(names.back()));
    }
    const std::vector<double> found = heights(all);
    if (task_.goal == Goal::time) sampled_.insert(sampled_.end(), found.begin(), found.end());
    const auto highest = std::max_element(found.begin(), found.end());
    const auto i = static_cast<std::size_t>(highest - found.begin());
    return {all[i], to_string(names[i]), *highest, *highest};
  }

  void climb(Summit& at) {
    RandomStep step(at.configuration, draw_);
    double likely = 0;
    for (std::uint64_t stood = 0; left() > 0 && stood < patience && !std::isinf(at.value);) {
      std::vector<Configuration> all;
      std::vector<double> magnitudes;
      for (std::uint64_t i = std::min(left(), steps_of_round); i > 0; --i) {
        Neighbour next = step.from(at.configuration, likely);
        all.push_back(std::move(next.configuration));
        magnitudes.push_back(next.magnitude);
      }
      const std::vector<double> found = heights(all);
      const auto highest = std::max_element(found.begin(), found.end());
      const auto i = static_cast<std::size_t>(highest - found.begin());
      ++stood;
      if (*highest < at.value) continue;
      if (*highest > at.value) stood = 0, likely = magnitudes[i];
      at.configuration = all[i];
      at.value = *highest;
    }
  }

  void in_medians(Summit& s) {
    const auto middle = sampled_.begin() + static_cast<std::ptrdiff_t>(sampled_.size() / 2);
    std::nth_element(sampled_.begin(), middle, sampled_.end());
    s.value /= *middle;
    s.sampled /= *middle;
  }

  const ClimbTask& task_;
  const Search& search_;
  std::vector<PoseClass> classes_;
  Heights heights_;
  Draw draw_;
  std::uint64_t done_ = 0;
  std::vector<double> sampled_;  ///< costs of all starts
};

/// What a climb came to, and the law that is broken there.
struct ClimbResult {
  Summit summit = blank<Summit>();
  std::uint64_t evaluations = 0;
  std::optional<MetFailure> failure;
};

std::string climb_from(const Summit& summit) { return "a climb from " + summit.start; }

std::optional<MetFailure> failure_at(const Summit& summit, Goal goal, CandidateProcess& candidate,
                                     const Bar& bar) {
  // Points are judged where depth and normal are right.
  std::vector<const char*> laws = {"answers"};
  if (goal == Goal::hull) laws.push_back("hull");
  if (goal != Goal::hull && goal != Goal::time) laws.push_back("agreement");
  if (goal == Goal::points) laws.push_back("points");
  for (const char* name : laws) {
    const Law& law = find_law(name);
    const auto violation = broken(law, summit.configuration, candidate, bar);
    if (!violation) continue;
    return MetFailure{&law, climb_from(summit), summit.configuration, *violation,
                      meeting_features(summit.configuration)};
  }
  return std::nullopt;
}

std::vector<ClimbTask> climbs_of(const Search& s, const std::vector<GoalResult>& goals) {
  std::vector<ClimbTask> tasks;
  for (std::size_t i = 0; i < goals.size(); ++i) {
    for (std::uint64_t first = 0; first < s.budget; first += max_climb) {
      tasks.push_back({i, goals[i].pair, goals[i].goal, first / max_climb,
                       std::min(max_climb, s.budget - first)});
    }
  }
  return tasks;
}

/// The failure farthest beyond the bar for each cause, and how many climbs met that cause.
struct Cases {
  std::map<Cause, std::pair<MetFailure, std::uint64_t>> worst;

  void add(const MetFailure& met) {
    const Cause cause{met.law->name, pair_of(met.configuration), met.features,
                      met.violation.failure};
    const auto [at, is_new] = worst.try_emplace(cause, met, 0);
    ++at->second.second;
    if (!is_new && met.violation.amount > at->second.first.violation.amount) {
      at->second.first = met;
    }
  }
};

std::vector<Failure> simplified_cases(const Cases& cases, const Candidate& candidate,
                                      const Search& s) {
  std::vector<const std::pair<MetFailure, std::uint64_t>*> all;
  for (const auto& [cause, entry] : cases.worst) all.push_back(&entry);
  WorkerCandidates own({&candidate}, s.bar.threshold, {});
  const auto texts = run_in_processes(
      all.size(), s.workers,
      [&](std::size_t i) {
        return to_bytes(simplest(all[i]->first, trials_of_first, own.get().front(), s.bar));
      },
      [&](std::size_t i) { return all[i]->first.identity; }, [](std::size_t) {});
  CandidateProcess process(candidate, s.bar.threshold);
  std::vector<Failure> failures;
  for (std::size_t i = 0; i < all.size(); ++i) {
    if (texts[i].empty()) continue;  // interrupted before
    failures.push_back(
        failure_of(all[i]->first, from_bytes<Configuration>(texts[i]), process, s.bar));
    failures.back().met = all[i]->second;
  }
  return failures;
}

}  // namespace

const char* goal_name(Goal goal) {
  constexpr std::array names = {"distance", "normal", "points", "hull", "time"};
  return names[static_cast<std::size_t>(goal)];
}

Goal parse_goal(std::string_view name) { return named(all_goals, name, "--goal", goal_name); }

SearchResult search(const Candidate& candidate, const Search& s,
                    const std::function<void(std::uint64_t, std::uint64_t)>& progress) {
  SearchResult result;
  for (const Pair pair : s.pairs) {
    if (!candidate.has_routine_for(pair) || selected_classes(pair, s.starts).empty()) continue;
    for (const Goal goal : s.goals) result.goals.push_back({pair, goal, 0, 0, 0, {}});
  }
  const std::vector<ClimbTask> tasks = climbs_of(s, result.goals);
  const std::uint64_t all = s.budget * result.goals.size();
  WorkerCandidates own({&candidate}, s.bar.threshold, {});
  const auto texts = run_in_processes(
      tasks.size(), s.workers,
      [&](std::size_t i) {
        CandidateProcess& process = own.get().front();
        Climb climb(tasks[i], s, process);
        ClimbResult found{climb.run(), 0, {}};
        found.evaluations = climb.evaluations();
        found.failure = failure_at(found.summit, tasks[i].goal, process, s.bar);
        return to_bytes(found);
      },
      [&](std::size_t i) { return tasks[i].name(); },
      [&](std::size_t done) { progress(all * done / tasks.size(), all); });
  Cases cases;
  for (std::size_t i = 0; i < tasks.size(); ++i) {
    if (texts[i].empty()) continue;  // interrupted before
    const auto found = from_bytes<ClimbResult>(texts[i]);
    GoalResult& of_goal = result.goals[tasks[i].of_goal];
    ++of_goal.climbs;
    of_goal.evaluations += found.evaluations;
    keep_higher(of_goal.summit, found.summit);
    if (!found.failure) continue;
    ++of_goal.broken;
    cases.add(*found.failure);
  }
  result.failures = simplified_cases(cases, candidate, s);
  return result;
}

nlohmann::json to_json(const SearchResult& result) {
  nlohmann::json goals = nlohmann::json::array(), failures = nlohmann::json::array();
  for (const GoalResult& r : result.goals) {
    if (!r.summit) continue;
    // No number in JSON is infinite: an answer that could not be judged is null.
    goals.push_back({{"pair", pair_name(r.pair)},
                     {"goal", goal_name(r.goal)},
                     {"evaluations", r.evaluations},
                     {"climbs", r.climbs},
                     {"broken", r.broken},
                     {"value", r.summit->value},
                     {"sampled", r.summit->sampled},
                     {"from", r.summit->start},
                     {"configuration", to_hex_json(r.summit->configuration)}});
  }
  for (const Failure& f : result.failures) failures.push_back(to_json(f));
  return {{"goals", goals}, {"failures", failures}};
}

}  // namespace touchstone
