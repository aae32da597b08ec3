#include "simulation/scenes/engine_choice.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <limits>
#include <numbers>
#include <numeric>

#include <nlohmann/json.hpp>

#include "candidates/host/contained.hpp"
#include "reference/invalid_input.hpp"
#include "simulation/scenes/choose.hpp"

namespace touchstone {
namespace {

using nlohmann::json;
using Kind = EngineShape::Kind;

constexpr double infinity = std::numeric_limits<double>::infinity();

bool is_bullet(const std::string& engine) { return engine.starts_with("bullet"); }

/// What an engine offers beside its default and our routines.
std::vector<EngineShape> own_shapes(const std::string& engine) {
  std::vector<EngineShape> result;
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

class Search {
 public:
  Search(const EngineChoiceOptions& options, EngineChoice& choice)
      : options_(options), choice_(choice) {
    for (const auto& need : choice.file.needs) {
      with_depths_ = with_depths_ || std::string(need->name) == "penetration";
    }
  }

  void run() {
    const EngineSetting exact = uniform({Kind::exact});
    std::vector<EngineSetting> fresh = {uniform({}), exact};
    for (const EngineShape& shape : own_shapes(choice_.engine.name)) {
      fresh.push_back(uniform(shape));
    }
    judge_and_time(std::move(fresh));
    for (;;) {
      choice_.answer = best();
      if (!choice_.answer) return;
      if (choice_.sizes.size() > 1 && judge_and_time(neighbours())) continue;
      if (endures()) return;
    }
  }

 private:
  EngineSetting uniform(const EngineShape& shape) const {
    return EngineSetting(std::vector<EngineShape>(choice_.sizes.size(), shape));
  }

  /// Settings in which the answer's shape for one size is another one. What is of a whole world
  /// stays as it is.
  std::vector<EngineSetting> neighbours() const {
    const EngineSetting& answer = choice_.settings[*choice_.answer];
    std::vector<EngineSetting> result;
    for (std::size_t size = 0; size < choice_.sizes.size(); ++size) {
      for (const EngineShape& shape : own_shapes(choice_.engine.name)) {
        const bool is_of_world = shape.kind == Kind::multipoint;
        const bool has_no_effect = shape.kind == Kind::no_margin && answer.has(Kind::exact);
        if (is_of_world || has_no_effect) continue;
        EngineSetting changed(answer.shapes);
        changed.shapes[size] = shape;
        result.push_back(std::move(changed));
      }
    }
    return result;
  }

  /// The first and the last frame of a run in a process of its own.
  Trajectory contained_ends(const EngineSetting& setting, const DisturbedScene& scene) const {
    const Contained ran =
        run_contained([&] { return ends_text(run_in_engine(choice_, setting, scene, false)); },
                      max_engine_seconds);
    if (ran.end != Contained::End::returned) {
      throw std::runtime_error("with our routines: " + ran.text);
    }
    return run_of_ends(ran.text, scene.scene.step);
  }

  Trial trial_of(const EngineSetting& setting, std::size_t disturbance) const {
    const DisturbedScene scene(choice_.file.scene, options_.trials.seed, disturbance);
    const Contained ran = run_contained(
        [&] {
          const Trajectory run =
              scene.turned_back(run_in_engine(choice_, setting, scene, with_depths_));
          Trial trial;
          trial.points = run.points;
          for (const auto& need : choice_.file.needs) {
            trial.verdicts.push_back(
                need->judge({choice_.file.scene, run, exact_runs_[disturbance]}));
          }
          return trial_text(trial);
        },
        max_engine_seconds);
    if (ran.end == Contained::End::returned) return trial_from(ran.text);
    Trial trial;
    trial.end = ran.text;
    trial.verdicts.assign(choice_.file.needs.size(), {infinity, 0, 0});
    return trial;
  }

  /// Adds those that are new, and returns whether there were any.
  bool judge_and_time(std::vector<EngineSetting> wanted) {
    std::erase_if(wanted, [&](const EngineSetting& setting) {
      return std::any_of(choice_.settings.begin(), choice_.settings.end(),
                         [&](const EngineSetting& s) { return s.shapes == setting.shapes; });
    });
    if (wanted.empty()) return false;
    judge(wanted, options_.trials.disturbances);
    const std::size_t first = choice_.settings.size();
    choice_.settings.insert(choice_.settings.end(), wanted.begin(), wanted.end());
    std::vector<EngineSetting*> timed;
    for (std::size_t i = first; i < choice_.settings.size(); ++i) {
      if (i < 2 || choice_.settings[i].holds()) timed.push_back(&choice_.settings[i]);
    }
    time(timed);
    return true;
  }

  void judge(std::vector<EngineSetting>& settings, std::size_t last) {
    const EngineSetting exact = uniform({Kind::exact});
    add_ends_of_runs(
        choice_.file.scene, options_.trials, last, options_.workers,
        [&](const DisturbedScene& scene) { return contained_ends(exact, scene); },
        choice_.file.name + " in " + choice_.engine.name, exact_runs_);
    std::vector<RepeatedRun*> runs;
    for (EngineSetting& setting : settings) runs.push_back(&setting);
    repeat(
        runs, last, options_.workers,
        [&](std::size_t i, std::size_t disturbance) { return trial_of(settings[i], disturbance); },
        [&](std::size_t) { return choice_.file.name + " in " + choice_.engine.name; });
  }

  /// Times of all steps of one run; none if the engine ended it.
  std::vector<double> step_seconds(const EngineSetting& setting) const {
    const DisturbedScene scene(choice_.file.scene, options_.trials.seed, 0);
    const Contained ran = run_contained(
        [&] { return json(run_in_engine(choice_, setting, scene, false).step_seconds).dump(); },
        max_engine_seconds);
    if (ran.end != Contained::End::returned) return {};
    return json::parse(ran.text).get<std::vector<double>>();
  }

  void time(const std::vector<EngineSetting*>& settings) const {
    const auto least = least_step_seconds(
        settings.size(), [&](std::size_t i) { return step_seconds(*settings[i]); });
    for (std::size_t i = 0; i < settings.size(); ++i) {
      if (least[i].empty()) continue;
      settings[i]->step_seconds = std::accumulate(least[i].begin(), least[i].end(), 0.0) /
                                  static_cast<double>(least[i].size());
    }
  }

  std::optional<std::size_t> best() const {
    std::optional<std::size_t> result;
    for (std::size_t i = 0; i < choice_.settings.size(); ++i) {
      const EngineSetting& s = choice_.settings[i];
      if (!s.holds() || !s.step_seconds || s.has(Kind::exact)) continue;
      const double share = result == 0U ? cheaper_share : 1;
      if (!result || *s.step_seconds < share * *choice_.settings[*result].step_seconds) result = i;
    }
    if (result) return result;
    for (std::size_t i = 1; i < choice_.settings.size(); ++i) {
      const EngineSetting& s = choice_.settings[i];
      if (!s.holds() || !s.step_seconds) continue;
      if (!result || *s.step_seconds < *choice_.settings[*result].step_seconds) result = i;
    }
    return result;
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
  bool with_depths_ = false;
  std::vector<Trajectory> exact_runs_;  ///< by disturbance: first and last frames alone
};

std::string bullet_lines(const EngineShape& shape, const Cylinder& c) {
  const double r = c.radius(), h = c.half_length(), inner = std::min(r, h);
  switch (shape.kind) {
    case Kind::cylinder:
      return fmt::format("new btCylinderShapeZ(btVector3({0:g}, {0:g}, {1:g}))", r, h);
    case Kind::no_margin:
      return fmt::format(
          "auto* shape = new btCylinderShapeZ(btVector3({0:g}, {0:g}, {1:g}));\n"
          "shape->setMargin(0);  // its size stays; its edges are sharp",
          r, h);
    case Kind::multipoint:
      return fmt::format(
          "configuration.setConvexConvexMultipointIterations(3, 3);  // btDefaultCollision…\n"
          "configuration.setPlaneConvexMultipointIterations(3, 3);\n"
          "new btCylinderShapeZ(btVector3({0:g}, {0:g}, {1:g}))",
          r, h);
    case Kind::capsule:
      return fmt::format("new btCapsuleShapeZ({:g}, {:g})", inner, 2 * (h - inner));
    case Kind::box:
      return fmt::format("new btBoxShape(btVector3({0:g}, {0:g}, {1:g}))", r, h);
    case Kind::spheres:
      return fmt::format(
          "auto* shape = new btCompoundShape;\n"
          "for (int i = 0; i < {0}; ++i) {{\n"
          "  {1}\n"
          "  shape->addChildShape(btTransform(btQuaternion::getIdentity(), centre),\n"
          "                       new btSphereShape({2:g}));\n"
          "}}",
          shape.count,
          h >= r ? fmt::format("const btVector3 centre(0, 0, {:g} * (2.0 * i / {} - 1));",
                               h - inner, std::max(1, shape.count - 1))
                 : fmt::format("const double a = SIMD_2_PI * i / {};\n"
                               "  const btVector3 centre({:g} * cos(a), {:g} * sin(a), 0);",
                               shape.count, r - inner, r - inner),
          inner);
    case Kind::hull:
      return fmt::format(
          "auto* shape = new btConvexHullShape;\n"
          "for (int i = 0; i < {0}; ++i) {{\n"
          "  const double a = SIMD_2_PI * i / {0}, x = {1:g} * cos(a), y = {1:g} * sin(a);\n"
          "  shape->addPoint(btVector3(x, y, -{2:g}), false);\n"
          "  shape->addPoint(btVector3(x, y, {2:g}), false);\n"
          "}}\n"
          "shape->setMargin(0);  // 0.04 would be added outside the hull\n"
          "shape->recalcLocalAabb();",
          shape.count, r, h);
    case Kind::exact:
      return fmt::format(
          "#include <touchstone/engines/bullet.hpp>\n"
          "touchstone::bullet::install(dispatcher);  // before the world's bodies meet\n"
          "new btCylinderShapeZ(btVector3({0:g}, {0:g}, {1:g}))",
          r, h);
  }
  return "";
}

std::string ode_lines(const EngineShape& shape, const Cylinder& c) {
  const double r = c.radius(), h = c.half_length(), inner = std::min(r, h);
  switch (shape.kind) {
    case Kind::capsule:
      return fmt::format("dCreateCapsule(space, {:g}, {:g});", inner, 2 * (h - inner));
    case Kind::box:
      return fmt::format("dCreateBox(space, {0:g}, {0:g}, {1:g});", 2 * r, 2 * h);
    case Kind::spheres:
      return fmt::format(
          "for (int i = 0; i < {0}; ++i) {{\n"
          "  dGeomID part = dCreateSphere(space, {1:g});\n"
          "  dGeomSetBody(part, body);\n"
          "  {2}\n"
          "}}",
          shape.count, inner,
          h >= r ? fmt::format("dGeomSetOffsetPosition(part, 0, 0, {:g} * (2.0 * i / {} - 1));",
                               h - inner, std::max(1, shape.count - 1))
                 : fmt::format("const double a = 2 * M_PI * i / {0};\n"
                               "  dGeomSetOffsetPosition(part, {1:g} * cos(a), {1:g} * sin(a), 0);",
                               shape.count, r - inner));
    case Kind::exact:
      return fmt::format(
          "#include <touchstone/engines/ode.hpp>\n"
          "touchstone::ode::install();  // once, after dInitODE2\n"
          "dCreateCylinder(space, {:g}, {:g});",
          r, 2 * h);
    default:
      return fmt::format("dCreateCylinder(space, {:g}, {:g});", r, 2 * h);
  }
}

std::string mujoco_lines(const EngineShape& shape, const Cylinder& c) {
  const double r = c.radius(), h = c.half_length(), inner = std::min(r, h);
  std::string cylinder = fmt::format("<geom type=\"cylinder\" size=\"{:g} {:g}\"/>", r, h);
  switch (shape.kind) {
    case Kind::multipoint:
      return "<option><flag multiccd=\"enable\"/></option>\n" + cylinder;
    case Kind::capsule:
      return fmt::format("<geom type=\"capsule\" size=\"{:g} {:g}\"/>", inner, h - inner);
    case Kind::box:
      return fmt::format("<geom type=\"box\" size=\"{0:g} {0:g} {1:g}\"/>", r, h);
    case Kind::spheres: {
      std::string lines;
      for (int i = 0; i < shape.count; ++i) {
        Vec3 p = Vec3::Zero();
        const double a = 2 * std::numbers::pi * i / shape.count;
        if (h < r && shape.count > 1) p = (r - inner) * Vec3(std::cos(a), std::sin(a), 0);
        if (h >= r && shape.count > 1) p.z() = (h - inner) * (2.0 * i / (shape.count - 1) - 1);
        lines += fmt::format("{}<geom type=\"sphere\" size=\"{:g}\" pos=\"{:.4g} {:.4g} {:.4g}\"/>",
                             i == 0 ? "" : "\n", inner, p.x(), p.y(), p.z());
      }
      return lines;
    }
    case Kind::hull: {
      std::string vertices;
      for (const double z : {-h, h}) {
        for (int i = 0; i < shape.count; ++i) {
          const double a = 2 * std::numbers::pi * i / shape.count;
          vertices += fmt::format("{}{:.6g} {:.6g} {:g}", vertices.empty() ? "" : "  ",
                                  r * std::cos(a), r * std::sin(a), z);
        }
      }
      return "<asset><mesh name=\"prism\" vertex=\"" + vertices +
             "\"/></asset>\n<geom type=\"mesh\" mesh=\"prism\"/>";
    }
    case Kind::exact:
      return "// C++: #include <touchstone/engines/mujoco.hpp>\n"
             "// touchstone::mujoco::install();  // once, before the first step\n" +
             cylinder;
    default:
      return cylinder;
  }
}

}  // namespace

bool EngineSetting::has(Kind kind) const {
  return std::any_of(shapes.begin(), shapes.end(),
                     [&](const EngineShape& s) { return s.kind == kind; });
}

Trajectory run_in_engine(const EngineChoice& choice, const EngineSetting& setting,
                         const DisturbedScene& scene, bool with_depths) {
  EngineSetup setup;
  setup.shapes.resize(scene.origin.size());
  for (std::size_t size = 0; size < choice.sizes.size(); ++size) {
    for (const int written : choice.sizes[size].bodies) {
      const auto at = std::find(scene.origin.begin(), scene.origin.end(), written);
      setup.shapes[static_cast<std::size_t>(at - scene.origin.begin())] = setting.shapes[size];
    }
  }
  return run_scene(scene.scene, in_engine(choice.engine.name, setup), with_depths);
}

std::string engine_lines(const std::string& engine, const EngineShape& shape,
                         const Cylinder& cylinder) {
  if (is_bullet(engine)) return bullet_lines(shape, cylinder);
  return engine == "ode" ? ode_lines(shape, cylinder) : mujoco_lines(shape, cylinder);
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
  Search(options, choice).run();
  return choice;
}

}  // namespace touchstone
