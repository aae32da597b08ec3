#include "simulation/scenes/engine_choice.hpp"

#include <algorithm>
#include <fmt/format.h>
#include <numeric>
#include <stdexcept>
#include <tuple>

#include "candidates/host/contained.hpp"
#include "reference/invalid_input.hpp"
#include "simulation/assembly.hpp"
#include "simulation/scenes/choose.hpp"

namespace touchstone {
namespace {

using Kind = EngineShape::Kind;

bool is_bullet(const std::string& engine) { return engine.starts_with("bullet"); }

/// What an engine offers beside our routines, the simplest first.
std::vector<EngineShape> own_shapes(const std::string& engine) {
  std::vector<EngineShape> result = {{Kind::cylinder}};
  if (is_bullet(engine)) result.push_back({Kind::no_margin});
  if (is_bullet(engine) || engine == "mujoco") result.push_back({Kind::multipoint});
  result.push_back({Kind::capsule});
  result.push_back({Kind::box});
  for (const int count : {1, 2, 4, 8, 16}) result.push_back({Kind::spheres, count});
  // ODE's convex geoms are not usable: two of them that touch end the process with an assertion,
  // and a rod of 15 mm radius sinks 1 to 3 mm into a box before it gets its one point.
  if (engine == "ode") return result;
  for (const int sides : {8, 12, 16, 24, 32, 64}) result.push_back({Kind::hull, sides});
  return result;
}

std::vector<CylinderSize> cylinder_sizes(const Scene& scene) {
  std::vector<CylinderSize> sizes;
  for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
    if (!std::holds_alternative<Cylinder>(scene.bodies[i].shape)) continue;
    const std::string name = shape_text(scene.bodies[i].shape);
    auto size = std::find_if(sizes.begin(), sizes.end(),
                             [&](const CylinderSize& s) { return s.name == name; });
    if (size == sizes.end()) size = sizes.insert(size, {name, {}});
    size->bodies.push_back(static_cast<int>(i));
  }
  return sizes;
}

std::vector<EngineShape> shapes_by_body(const EngineChoice& choice, const EngineSetting& setting,
                                        const DisturbedScene& scene) {
  std::vector<EngineShape> shapes(scene.origin.size());
  for (std::size_t size = 0; size < choice.sizes.size(); ++size) {
    for (const int written : choice.sizes[size].bodies) {
      const auto at = std::ranges::find(scene.origin, written);
      shapes[static_cast<std::size_t>(at - scene.origin.begin())] = setting.shapes[size];
    }
  }
  return shapes;
}

/// What is less of the setting that comes nearer to holding.
std::tuple<bool, std::ptrdiff_t, std::ptrdiff_t, double> failing(const EngineSetting& setting) {
  const auto broken = std::ranges::count_if(
      setting.verdicts, [](const Verdict& verdict) { return !verdict.holds(); });
  return {!setting.end.empty(), -static_cast<std::ptrdiff_t>(setting.held), broken,
          setting.error()};
}

class SettingSearch {
 public:
  SettingSearch(const EngineChoiceOptions& options, EngineChoice& choice)
      : options_(options), choice_(choice), shapes_(own_shapes(choice.engine.name)) {}

  void run() {
    run_exactly();
    std::vector<EngineSetting> fresh = {uniform({}), uniform({Kind::exact})};
    for (const EngineShape& shape : shapes_) fresh.push_back(uniform(shape));
    judge_and_time(fresh);
    for (;;) {
      if (!has_own_that_holds()) try_mixed();
      choice_.answer = best();
      if (!choice_.answer) return;
      if (choice_.sizes.size() > 1 && judge_and_time(neighbours(*choice_.answer))) continue;
      if (!endures()) continue;
      const Straying& strayed = choice_.settings[*choice_.answer].straying;
      choice_.exact_spread = spread(strayed, choice_.file.scene, exact_runs_);
      return;
    }
  }

 private:
  /// A shape as cylinders of a size can have it: some are one sphere by another name.
  EngineShape shape_for(std::size_t size, const EngineShape& shape) const {
    const auto body = static_cast<std::size_t>(choice_.sizes[size].bodies[0]);
    const auto& c = std::get<Cylinder>(choice_.file.scene.bodies[body].shape);
    const bool is_capsule = shape.kind == Kind::capsule;
    const bool is_round = is_capsule || shape.kind == Kind::spheres;
    return is_round && is_one_sphere(c, is_capsule) ? EngineShape{Kind::spheres, 1} : shape;
  }

  EngineSetting uniform(const EngineShape& shape) const {
    EngineSetting result(std::vector<EngineShape>(choice_.sizes.size()));
    for (std::size_t i = 0; i < result.shapes.size(); ++i) result.shapes[i] = shape_for(i, shape);
    return result;
  }

  static bool is_own(const EngineSetting& setting) { return !setting.has(Kind::exact); }

  bool has_own_that_holds() const {
    return std::ranges::any_of(choice_.settings,
                               [](const EngineSetting& s) { return is_own(s) && s.holds(); });
  }

  /// Settings in which another one's shape for one size is another. What is of a whole world stays
  /// as it is, and the engine's own cylinder has no effect where it is of a whole world.
  std::vector<EngineSetting> neighbours(std::size_t index) const {
    const EngineSetting& of = choice_.settings[index];
    std::vector<EngineSetting> result;
    for (std::size_t size = 0; size < choice_.sizes.size(); ++size) {
      for (const EngineShape& shape : shapes_) {
        const bool is_cylinder = shape.kind == Kind::cylinder || shape.kind == Kind::no_margin;
        const bool has_no_effect =
            (is_cylinder && of.has(Kind::exact)) ||
            (shape.kind == Kind::cylinder && of.shapes[size].kind == Kind::multipoint);
        if (shape.kind == Kind::multipoint || has_no_effect) continue;
        EngineSetting changed(of.shapes);
        changed.shapes[size] = shape_for(size, shape);
        result.push_back(std::move(changed));
      }
    }
    return result;
  }

  /// Looks for a setting that holds where no shape serves for all sizes: changes one size at a time
  /// in the settings that fail, those that break the fewest needs first. Of two sizes these are all
  /// combinations.
  void try_mixed() {
    constexpr std::size_t max_settings = 300;  // bounds what more than two sizes may take
    std::vector<bool> tried;
    while (!has_own_that_holds() && choice_.settings.size() < max_settings) {
      tried.resize(choice_.settings.size());
      std::optional<std::size_t> next;
      for (std::size_t i = 0; i < choice_.settings.size(); ++i) {
        if (tried[i] || !is_own(choice_.settings[i])) continue;
        if (!next || failing(choice_.settings[i]) < failing(choice_.settings[*next])) next = i;
      }
      if (!next || choice_.sizes.size() < 2) return;
      tried[*next] = true;
      judge_and_time(neighbours(*next));
    }
  }

  /// The ends of runs with our routines. Needs that ask for them are left out where the engine ends
  /// such a run.
  void run_exactly() {
    auto& needs = choice_.file.needs;
    const Scene& scene = choice_.file.scene;
    const auto asks = [](const auto& need) { return need->is_relative(); };
    const EngineSetting exact = uniform({Kind::exact});
    const auto make = [&](const DisturbedScene& disturbed) {
      const Contained ran = run_contained(
          [&] { return to_bytes(ends_of(disturbed.turned_back(run_of(exact, disturbed, false)))); },
          max_engine_seconds);
      return to_bytes(ran.end, ran.text);
    };
    const auto runs = exact_runs(scene, options_.trials.seed, options_.trials.of_answer(),
                                 options_.workers, name(), make);
    for (std::size_t i = 0; i < runs.size() && choice_.exact_end.empty(); ++i) {
      BytesIn in(runs[i]);
      const auto end = in.next<Contained::End>();
      const auto text = in.next<std::string>();
      if (end == Contained::End::returned) {
        exact_runs_.push_back(from_bytes<Trajectory>(text));
      } else {
        choice_.exact_end = text + (i == 0 ? "" : fmt::format(", disturbance {}", i));
      }
    }
    if (choice_.exact_end.empty()) {
      choice_.spreads = take_undecidable(choice_.file, exact_runs_);
      return;
    }
    exact_runs_.clear();
    for (const auto& need : needs) {
      if (asks(need)) choice_.not_judged.push_back(need->text(scene));
    }
    std::erase_if(needs, asks);
    if (needs.empty()) {
      throw std::runtime_error(name() + ": the engine ended a run with our routines (" +
                               choice_.exact_end + "), and all needs ask how that ends");
    }
  }

  std::string name() const { return choice_.file.name + " in " + choice_.engine.name; }

  Trajectory run_of(const EngineSetting& setting, const DisturbedScene& scene,
                    bool with_depths) const {
    return options_.run(choice_.engine.name, shapes_by_body(choice_, setting, scene), scene.scene,
                        with_depths);
  }

  Trial trial_of(const EngineSetting& setting, std::size_t disturbance) const {
    const DisturbedScene scene(choice_.file.scene, options_.trials.seed, disturbance);
    const Contained ran = run_contained(
        [&] {
          const Trajectory run = scene.turned_back(run_of(setting, scene, true));
          const Trajectory& exact = exact_runs_.empty() ? run : exact_runs_[disturbance];
          Trial trial;
          trial.points = run.points;
          trial.straying = straying(choice_.file.scene, run, exact);
          for (const auto& need : choice_.file.needs) {
            trial.verdicts.push_back(need->judge({choice_.file.scene, run, exact}));
          }
          return to_bytes(trial);
        },
        max_engine_seconds);
    if (ran.end == Contained::End::returned) return from_bytes<Trial>(ran.text);
    Trial trial;
    trial.end = ran.text;
    trial.verdicts.assign(choice_.file.needs.size(), {infinity, 0, 0});
    return trial;
  }

  /// Adds those that are new, and returns whether there were any.
  bool judge_and_time(const std::vector<EngineSetting>& wanted) {
    std::vector<EngineSetting> fresh =
        touchstone::fresh(wanted, choice_.settings, &EngineSetting::shapes);
    if (fresh.empty()) return false;
    judge(fresh, options_.trials.disturbances);
    const std::size_t first = choice_.settings.size();
    choice_.settings.insert(choice_.settings.end(), fresh.begin(), fresh.end());
    std::vector<std::size_t> timed;
    for (std::size_t i = first; i < choice_.settings.size(); ++i) {
      if (i < 2 || choice_.settings[i].holds()) timed.push_back(i);
    }
    time(timed);
    return true;
  }

  void judge(std::vector<EngineSetting>& settings, std::size_t last) {
    repeat(
        settings, last, options_.workers,
        [&](std::size_t i, std::size_t disturbance) { return trial_of(settings[i], disturbance); },
        [&](std::size_t) { return name(); });
  }

  /// Times of all steps of one run; none if the engine ended it.
  std::vector<double> step_seconds(const EngineSetting& setting) const {
    const DisturbedScene scene(choice_.file.scene, options_.trials.seed, 0);
    const Contained ran = run_contained(
        [&] { return to_bytes(run_of(setting, scene, false).step_seconds); }, max_engine_seconds);
    if (ran.end != Contained::End::returned) return {};
    return from_bytes<std::vector<double>>(ran.text);
  }

  /// Times settings together, by their indices, and the default and our routines with them. By
  /// these two the times of all other settings follow the machine's speed, which changes.
  void time(std::vector<std::size_t> settings) {
    if (settings.empty()) return;
    for (const std::size_t yardstick : {std::size_t{0}, std::size_t{1}}) {
      if (!has(settings, yardstick)) settings.push_back(yardstick);
    }
    const auto least = least_step_seconds(settings.size(), [&](std::size_t i) {
      return step_seconds(choice_.settings[settings[i]]);
    });
    std::optional<double> change;  // of the time that the same takes
    for (std::size_t i = 0; i < settings.size(); ++i) {
      auto& seconds = choice_.settings[settings[i]].step_seconds;
      const std::optional<double> before = seconds;
      seconds.reset();  // what was measured at another time does not compare
      if (least[i].empty()) continue;
      seconds = std::accumulate(least[i].begin(), least[i].end(), 0.0) /
                static_cast<double>(least[i].size());
      const bool is_first = settings[i] == 0 || !change;
      if (settings[i] < 2 && before && is_first) change = *seconds / *before;
    }
    for (std::size_t i = 0; change && i < choice_.settings.size(); ++i) {
      auto& seconds = choice_.settings[i].step_seconds;
      if (seconds && !has(settings, i)) *seconds *= *change;
    }
    timed_together_ = settings;
  }

  static bool has(const std::vector<std::size_t>& all, std::size_t i) {
    return std::ranges::find(all, i) != all.end();
  }

  /// Order of preference of settings that take much the same: in the order of the engine's shapes,
  /// and our routines last.
  std::size_t rank(std::size_t index) const {
    std::size_t sum = 0;
    for (const EngineShape& shape : choice_.settings[index].shapes) {
      sum += static_cast<std::size_t>(std::ranges::find(shapes_, shape) - shapes_.begin());
    }
    return sum;
  }

  /// The settings among which the answer is, with their times: the engine's own, or where none of
  /// them holds those with our routines.
  std::vector<Finalist> promising() const {
    std::vector<Finalist> result;
    const bool are_own = has_own_that_holds();
    for (std::size_t i = 0; i < choice_.settings.size(); ++i) {
      const EngineSetting& s = choice_.settings[i];
      if (!s.holds() || !s.step_seconds || is_own(s) != are_own) continue;
      result.push_back({i, *s.step_seconds, rank(i)});
    }
    return result;
  }

  /// Times the finalists together, and what are finalists by these times, too. Returns the simplest
  /// of those that take much the same as the cheapest.
  std::optional<std::size_t> best() {
    std::vector<std::size_t> last, compared;
    for (;;) {
      last = finalists(promising());
      if (last.empty()) return std::nullopt;
      for (const std::size_t i : last) {
        if (!has(compared, i)) compared.push_back(i);
      }
      const auto is_timed = [&](std::size_t i) { return has(timed_together_, i); };
      if (std::ranges::all_of(compared, is_timed)) break;
      time(compared);
    }
    std::vector<Finalist> costs;
    for (const std::size_t i : last) {
      costs.push_back({i, choice_.settings[i].step_seconds.value(), rank(i)});
    }
    return simplest_of_cheapest(costs, infinity);
  }

  /// Does the answer hold under the further disturbances of an answer?
  bool endures() {
    std::vector<EngineSetting> answer = {choice_.settings[*choice_.answer]};
    judge(answer, options_.trials.of_answer());
    choice_.settings[*choice_.answer] = answer[0];
    return answer[0].holds();
  }

  const EngineChoiceOptions& options_;
  EngineChoice& choice_;
  const std::vector<EngineShape> shapes_;
  std::vector<std::size_t> timed_together_;  ///< the settings that were timed last
  std::vector<Trajectory>
      exact_runs_;  ///< their ends, by disturbance; none if the engine ended one
};

}  // namespace

std::size_t EngineChoice::nearest() const {
  const auto least = std::ranges::min_element(settings, {}, failing);
  return static_cast<std::size_t>(least - settings.begin());
}

bool EngineSetting::has(Kind kind) const {
  return std::any_of(shapes.begin(), shapes.end(),
                     [&](const EngineShape& s) { return s.kind == kind; });
}

Trajectory run_in_world(const std::string& engine, const std::vector<EngineShape>& shapes,
                        const Scene& scene, bool with_depths) {
  return run_scene(scene, in_engine(engine, {.shapes = shapes}), with_depths);
}

Trajectory run_in_engine(const EngineChoice& choice, const EngineSetting& setting,
                         const DisturbedScene& scene, bool with_depths) {
  return run_in_world(choice.engine.name, shapes_by_body(choice, setting, scene), scene.scene,
                      with_depths);
}

std::string hulls_text(const std::string& engine, const Scene& scene) {
  const Touching may_touch(scene);
  const int count = static_cast<int>(scene.bodies.size());
  for (int a = 0; a < count; ++a) {
    for (int b = 0; std::holds_alternative<Cylinder>(scene.bodies[a].shape) && b < count; ++b) {
      if (!std::holds_alternative<Convex>(scene.bodies[b].shape) || !may_touch(a, b)) continue;
      return fmt::format(
          "contacts of cylinders with convex bodies, as of {} with {}, are {}'s own in all "
          "settings",
          scene.bodies[a].name, scene.bodies[b].name, engine);
    }
  }
  return "";
}

EngineChoice choose_in_engine(const SceneFile& file, const std::string& engine,
                              const EngineChoiceOptions& options) {
  EngineChoice choice{file, {}, describe_engine(engine), cylinder_sizes(file.scene)};
  choice.trials = options.trials;
  check_engine_scene(engine, file.scene);
  if (choice.sizes.empty()) throw InvalidInput("bodies", "no cylinder", "must hold a cylinder");
  auto& needs = choice.file.needs;
  const auto is_left_out = [](const auto& need) { return std::string(need->name) == "normals"; };
  for (const auto& need : needs) {
    if (is_left_out(need)) choice.left_out.push_back(need->text(file.scene));
  }
  std::erase_if(needs, is_left_out);
  if (needs.empty()) {
    throw InvalidInput("needs", "none that an engine's run can be judged by",
                       "must say what has to come out right");
  }
  SettingSearch(options, choice).run();
  return choice;
}

}  // namespace touchstone
