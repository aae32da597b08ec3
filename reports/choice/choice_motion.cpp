#include <algorithm>
#include <cmath>
#include <cstring>
#include <fmt/format.h>
#include <functional>
#include <map>
#include <optional>
#include <set>

#include <nlohmann/json.hpp>

#include "candidates/host/contained.hpp"
#include "candidates/model.hpp"
#include "properties/files/configuration_json.hpp"
#include "reports/choice/choice.hpp"
#include "reports/pages/page.hpp"
#include "simulation/engines/run_engines.hpp"

namespace touchstone {
namespace {

using nlohmann::json;

constexpr double frames_per_second = 60;

std::size_t steps_of_frame(const Scene& scene) {
  return std::max<std::size_t>(
      1, static_cast<std::size_t>(std::lround(1 / (frames_per_second * scene.step))));
}

/// Poses of the moving bodies in every frame that is shown.
std::vector<float> poses(const Scene& scene, const Trajectory& run) {
  std::vector<float> numbers;
  for (std::size_t i = 0; i < run.frames.size(); i += steps_of_frame(scene)) {
    append_poses(scene, run.frames[i], numbers);
  }
  return numbers;
}

/// Where two runs part: the first body that is a tenth of its smallest width from where it is in
/// the other one, or leans by three degrees more.
struct Parting {
  double time;  ///< s
  std::string body;
};

std::optional<Parting> parting(const Scene& scene, const std::vector<float>& one,
                               const std::vector<float>& other) {
  constexpr double far = 0.1, min_cosine = 0.9986;  // of 3°
  constexpr std::size_t numbers = 7;
  std::vector<const Body*> moving;
  for (const Body& body : scene.bodies) {
    if (!body.fixed) moving.push_back(&body);
  }
  const std::size_t count = std::min(one.size(), other.size()) / numbers;
  for (std::size_t i = 0; i < count; ++i) {
    const Body& body = *moving[i % moving.size()];
    const auto pose = [&](const std::vector<float>& all) {
      const float* p = &all[numbers * i];
      return Pose(Vec3(p[0], p[1], p[2]), Eigen::Quaterniond(p[3], p[4], p[5], p[6]));
    };
    const Pose a = pose(one), b = pose(other);
    const double apart = (a.position() - b.position()).norm();
    const bool leans =
        !std::holds_alternative<Sphere>(body.shape) && a.axis().dot(b.axis()) < min_cosine;
    if (leans || apart > far * 2 * smallest_half_extent(body.shape)) {
      const std::size_t frame = i / moving.size();
      return Parting{static_cast<double>(frame * steps_of_frame(scene)) * scene.step, body.name};
    }
  }
  return std::nullopt;
}

/// A ball, or a capsule along local z.
json round_shape(double radius, double half_length) {
  if (half_length > 0) {
    return {{"shape", "capsule"}, {"radius", radius}, {"half_length", half_length}};
  }
  return {{"shape", "sphere"}, {"radius", radius}};
}

/// Parts of what stands for a cylinder, in its frame; none where that is itself.
json shape_parts(const std::string& family, int count, const Cylinder& c) {
  const double r = c.radius(), h = c.half_length();
  if (family == "prism") {
    return {{{"shape", {{"shape", "prism"}, {"sides", count}, {"radius", r}, {"half_length", h}}},
             {"centre", {0, 0, 0}}}};
  }
  if (family == "box") {
    return {{{"shape", {{"shape", "box"}, {"half_extents", {r, r, h}}}}, {"centre", {0, 0, 0}}}};
  }
  std::vector<RoundedPolytope> parts;
  if (family == "capsule") parts = inscribed_capsule(r, h);
  if (family == "capsule-circumscribed") parts = circumscribed_capsule(r, h);
  if (family == "spheres") parts = inscribed_spheres(count, r, h);
  json result = json::array();
  for (RoundedPolytope& part : parts) {
    part.place(Eigen::Matrix3d::Identity(), Vec3::Zero());
    const auto& core = part.vertices();
    const Vec3 centre = (core.front() + core.back()) / 2;
    result.push_back(
        {{"shape", round_shape(part.radius(), (core.back() - core.front()).norm() / 2)},
         {"centre", to_json(centre)}});
  }
  return result;
}

/// Parts of what stands for a box with a candidate, in its frame; none where that is itself.
json parts_of_box(const Candidate& candidate, const Shape& box) {
  json result = json::array();
  const auto parts = box_parts(candidate, box);
  if (!parts) return result;
  const Eigen::Quaterniond& q = parts->along;
  for (const Vec3& centre : parts->centres) {
    result.push_back({{"shape", round_shape(parts->radius, parts->half_length)},
                      {"centre", to_json(centre)},
                      {"orientation", {q.w(), q.x(), q.y(), q.z()}}});
  }
  return result;
}

/// What stands for the bodies in a run: [{body, parts}].
json models_of(const Choice& choice, const SceneRun& run) {
  const auto& bodies = choice.file.scene.bodies;
  json result = json::array();
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    const auto* c = std::get_if<Cylinder>(&bodies[i].shape);
    std::set<const Candidate*> models;
    for (std::size_t k = 0; k < bodies.size(); ++k) {
      const int kind = choice.kinds.of(static_cast<int>(i), static_cast<int>(k));
      if (k != i && kind >= 0 && run.models[kind]) models.insert(run.models[kind]);
    }
    json parts = json::array();
    for (const Candidate* m : models) {
      for (const json& part : c ? shape_parts(m->family, static_cast<int>(m->value), *c)
                                : parts_of_box(*m, bodies[i].shape)) {
        parts.push_back(part);
      }
    }
    if (!parts.empty()) result.push_back({{"body", i}, {"parts", parts}});
  }
  return result;
}

json models_of(const EngineChoice& choice, const EngineSetting& setting) {
  using Kind = EngineShape::Kind;
  json result = json::array();
  for (std::size_t size = 0; size < choice.sizes.size(); ++size) {
    const auto [kind, count] = setting.shapes[size];
    const std::string family = kind == Kind::capsule   ? "capsule"
                               : kind == Kind::box     ? "box"
                               : kind == Kind::spheres ? "spheres"
                               : kind == Kind::hull    ? "prism"
                                                       : "";
    for (const int body : choice.sizes[size].bodies) {
      const Shape& shape = choice.file.scene.bodies[static_cast<std::size_t>(body)].shape;
      const json parts = shape_parts(family, count, std::get<Cylinder>(shape));
      if (!parts.empty()) result.push_back({{"body", body}, {"parts", parts}});
    }
  }
  return result;
}

/// Indices of the runs to show beside the exact one: the answer, some with the next cheaper model
/// of a kind, and well-known models for all pairs.
std::vector<std::size_t> worth_showing(const Choice& choice) {
  std::vector<std::size_t> result;
  if (choice.answer != 0) result.push_back(choice.answer);
  for (const auto& cheaper : choice.cheaper) {
    if (cheaper && result.size() < 4) result.push_back(*cheaper);
  }
  for (std::size_t i = 0; i < choice.runs.size(); ++i) {
    const std::string& name = choice.runs[i].name;
    const bool is_capsule =
        name == (choice.same_as_sphere.empty() ? "capsule" : "spheres:1");  // as it is called here
    const bool is_known = is_capsule || name == "spheres:8" || name == "prism:16";
    if (is_known && std::find(result.begin(), result.end(), i) == result.end()) result.push_back(i);
  }
  return result;
}

/// The runs that a page animates. Each is shown beside one that holds under the same disturbance,
/// from shortly before the moment at which they part.
class Motions {
 public:
  explicit Motions(const SceneFile& file) : file_(file) {}

  /// Adds a run and returns its index; `is_listed`: a person can choose it.
  std::size_t add(const std::string& name, const std::string& note, std::vector<float> motion,
                  const json& models, std::size_t beside, bool is_listed) {
    json run = {{"name", name},     {"note", note},      {"poses", base64(motion)},
                {"models", models}, {"beside", beside},  {"listed", is_listed},
                {"from", nullptr},  {"command", nullptr}};
    if (beside < poses_.size()) {
      if (const auto at = parting(file_.scene, poses_[beside], motion)) {
        run["from"] = at->time;
        run["note"] = fmt::format("{} {} parts from the run beside it at {:.2f} s.", note, at->body,
                                  at->time);
      }
    }
    runs_.push_back(run);
    poses_.push_back(std::move(motion));
    return runs_.size() - 1;
  }

  /// Index of the run that stands on the left under this disturbance, which `make` adds once.
  std::size_t beside(std::size_t disturbance, const std::function<std::size_t()>& make) {
    const auto [at, is_new] = beside_.try_emplace(disturbance, 0);
    if (is_new) at->second = make();
    return at->second;
  }

  /// The command that draws the run that was added last.
  void add_command(const std::string& command) { runs_.back()["command"] = command; }

  json to_json() const {
    const Scene& scene = file_.scene;
    return {{"bodies", bodies_json(scene)},
            {"interval", static_cast<double>(steps_of_frame(scene)) * scene.step},
            {"duration", scene.duration},
            {"camera",
             {{"position", touchstone::to_json(file_.camera.position)},
              {"look_at", touchstone::to_json(file_.camera.look_at)}}},
            {"runs", runs_}};
  }

 private:
  const SceneFile& file_;
  json runs_ = json::array();
  std::vector<std::vector<float>> poses_;
  std::map<std::size_t, std::size_t> beside_;  // by disturbance
};

std::string note(const SceneFile& file, const RepeatedRun& run) {
  if (run.holds()) return "All needs hold.";
  if (!run.end.empty()) return run.end + '.';
  const int broken = run.first_broken();
  return fmt::format("Breaks at {:.2f} s{}: {}.", run.verdicts[broken].time, in_disturbance(run),
                     file.needs[broken]->text(file.scene));
}

}  // namespace

json choice_motion(const Choice& choice, const Limits& limits) {
  const Scene& scene = choice.file.scene;
  Processes processes(limits);
  const auto run = [&](const SceneRun& models, std::size_t disturbance) {
    const DisturbedScene disturbed(scene, choice.trials.seed, disturbance);
    return poses(scene, disturbed.turned_back(run_with(disturbed, choice.kinds, models.models,
                                                       *choice.candidates[0], processes)));
  };
  Motions motions(choice.file);
  // Where exact contacts fail, how they do is all that there is to see.
  const auto shown_runs = choice.impossible ? std::vector<std::size_t>{} : worth_showing(choice);
  const SceneRun& answer = choice.runs[choice.answer];
  const bool fails_disturbed = choice.impossible && answer.disturbance > 0;
  motions.add("exact", "The exact cylinder for all pairs.", poses(scene, choice.exact_run),
              json::array(), 0, shown_runs.empty() && !fails_disturbed);
  if (fails_disturbed) {
    motions.add("exact, disturbed", note(choice.file, answer), run(answer, answer.disturbance),
                json::array(), 0, true);
    motions.add_command(render_command(choice, answer));
  }
  const auto holding = [&](std::size_t disturbance) {
    if (choice.answer == 0 && disturbance == 0) return std::size_t{0};
    return motions.add(choice.answer == 0 ? "exact" : "the answer", "", run(answer, disturbance),
                       models_of(choice, answer), 0, false);
  };
  for (const std::size_t i : shown_runs) {
    const SceneRun& shown = choice.runs[i];
    const bool is_answer = i == choice.answer;
    const std::size_t disturbance = is_answer ? 0 : shown.disturbance;
    const std::size_t beside =
        is_answer ? 0 : motions.beside(disturbance, [&] { return holding(disturbance); });
    motions.add(is_answer ? "the answer" : shown.name, note(choice.file, shown),
                run(shown, disturbance), models_of(choice, shown), beside, true);
    if (disturbance == shown.disturbance) motions.add_command(render_command(choice, shown));
  }
  return motions.to_json();
}

namespace {

/// Poses of a run in the engine, in a process of its own; none if the engine ended it.
std::vector<float> contained_poses(const EngineChoice& choice, const EngineSetting& setting,
                                   std::size_t disturbance) {
  const Scene& scene = choice.file.scene;
  const DisturbedScene disturbed(scene, choice.trials.seed, disturbance);
  const Contained ran = run_contained(
      [&] {
        const auto numbers =
            poses(scene, disturbed.turned_back(run_in_engine(choice, setting, disturbed, false)));
        return std::string(reinterpret_cast<const char*>(numbers.data()),
                           numbers.size() * sizeof(float));
      },
      max_engine_seconds);
  if (ran.end != Contained::End::returned) return {};
  std::vector<float> numbers(ran.text.size() / sizeof(float));
  std::memcpy(numbers.data(), ran.text.data(), ran.text.size());
  return numbers;
}

}  // namespace

json choice_motion(const EngineChoice& choice) {
  constexpr std::size_t max_shown = 8;
  Motions motions(choice.file);
  const std::size_t best = choice.answer.value_or(1);
  const EngineSetting& answer = choice.settings[best];
  const auto add = [&](const EngineSetting& setting, std::size_t disturbance, std::size_t beside,
                       bool is_listed) {
    return motions.add(setting_name(setting), note(choice.file, setting),
                       contained_poses(choice, setting, disturbance), models_of(choice, setting),
                       beside, is_listed);
  };
  std::size_t listed = 0;
  for (std::size_t i = 0; i < choice.settings.size() && listed < max_shown; ++i) {
    const EngineSetting& shown = choice.settings[i];
    if (i == best || !shown.end.empty()) continue;
    const std::size_t disturbance = shown.disturbance;
    add(shown, disturbance,
        motions.beside(disturbance, [&] { return add(answer, disturbance, 0, false); }), true);
    ++listed;
  }
  return motions.to_json();
}

}  // namespace touchstone
