#include "simulation/scenes/trajectory.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <fmt/format.h>
#include <set>

#include "properties/files/given_text.hpp"
#include "reference/contact_of.hpp"
#include "reference/support.hpp"
#include "simulation/assembly.hpp"

namespace touchstone {
namespace {

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

/// Another model, whose answers are judged and recorded in a trajectory.
class JudgedModel : public ContactModel {
 public:
  JudgedModel(ContactModel& model, Trajectory& trajectory)
      : model_(model), trajectory_(trajectory) {}

  void begin() override { model_.begin(); }

  std::vector<Answer> answers(std::span<const PairQuestion> questions) override {
    const auto start = Clock::now();
    auto result = model_.answers(questions);
    for (std::size_t i = 0; i < questions.size(); ++i) {
      trajectory_.answers.push_back(judge(questions[i], result[i]));
    }
    seconds_ += seconds_since(start);
    return result;
  }

  /// In the model and in judging it.
  double seconds() const { return seconds_; }

 private:
  JudgedAnswer judge(const PairQuestion& question, const Answer& answer) const {
    const Configuration& c = question.configuration;
    const SignedDistance truth = touchstone::signed_distance(c);
    JudgedAnswer judged{static_cast<int>(trajectory_.frames.size()) - 1,
                        question.a,
                        question.b,
                        -truth.value,
                        answer.status,
                        0,
                        std::nullopt,
                        0};
    if (answer.status != TS_CONTACT) return judged;
    judged.signed_distance = answer.signed_distance;
    judged.points = answer.point_count;
    const Vec3 normal(answer.normal);
    const double regret = truth.value - gap(c, normal);
    if (!(regret < equal_regret * smaller_size(c))) judged.wrong_normal = normal;
    return judged;
  }

  ContactModel& model_;
  Trajectory& trajectory_;
  double seconds_ = 0;
};

/// Appends the true depths of the last frame, of cylinders and what they may touch.
void add_depths(const Scene& scene, const Touching& touching, Trajectory& trajectory) {
  const int frame = static_cast<int>(trajectory.frames.size()) - 1;
  const int count = static_cast<int>(scene.bodies.size());
  const auto is_cylinder = [&](int i) {
    return std::holds_alternative<Cylinder>(scene.bodies[i].shape);
  };
  for (int a = 0; a < count; ++a) {
    for (int b = 0; is_cylinder(a) && b < count; ++b) {
      if (a == b || (is_cylinder(b) && b < a) || !touching(a, b)) continue;
      JudgedAnswer answer{frame, a, b, 0, TS_NONE, 0, std::nullopt, 0};
      const Configuration c = trajectory.configuration(scene, answer);
      if (!aabb(c.a, c.pose_a).overlaps(aabb(c.b, c.pose_b))) continue;
      answer.depth = -touchstone::signed_distance(c).value;
      if (answer.depth > 0) trajectory.answers.push_back(answer);
    }
  }
}

struct ShapeText {
  std::string operator()(const Cylinder& s) const {
    return fmt::format("cylinder ⌀{:g}×{:g}", 2 * s.radius(), 2 * s.half_length());
  }
  std::string operator()(const Capsule& s) const {
    return fmt::format("capsule ⌀{:g}×{:g}", 2 * s.radius(), 2 * (s.half_length() + s.radius()));
  }
  std::string operator()(const Sphere& s) const {
    return fmt::format("sphere ⌀{:g}", 2 * s.radius());
  }
  std::string operator()(const Box& s) const {
    const Vec3 side = 2 * s.half_extents();
    return fmt::format("box {:g}×{:g}×{:g}", side.x(), side.y(), side.z());
  }
  std::string operator()(const Convex& s) const {
    const Vec3 side = 2 * s.half_extents();
    return fmt::format("convex {:g}×{:g}×{:g} of {} corners", side.x(), side.y(), side.z(),
                       s.vertices().size());
  }
  /// For a plane.
  template <class Other>
  std::string operator()(const Other& s) const {
    return shape_name(s);
  }
};

}  // namespace

double JudgedAnswer::depth_error() const {
  if (status != TS_CONTACT) return std::max(depth, 0.0);
  return std::abs(depth + signed_distance);
}

Configuration Trajectory::configuration(const Scene& scene, const JudgedAnswer& answer) const {
  const auto& states = frames[static_cast<std::size_t>(answer.frame)];
  return {std::get<Cylinder>(scene.bodies[answer.a].shape), states[answer.a].pose,
          scene.bodies[answer.b].shape, states[answer.b].pose};
}

Trajectory run_scene(const Scene& scene, ContactModel& model) {
  Trajectory trajectory;
  trajectory.step = scene.step;
  JudgedModel judged(model, trajectory);
  World world(scene, judged);
  trajectory.frames.push_back(world.states());
  while (world.time() < scene.duration - scene.step / 2) {
    const double before = judged.seconds();
    const auto start = Clock::now();
    world.step();
    trajectory.step_seconds.push_back(seconds_since(start) - (judged.seconds() - before));
    trajectory.points += static_cast<double>(world.points());
    if (!world.sound()) {
      trajectory.sound = false;
      break;
    }
    trajectory.frames.push_back(world.states());
  }
  trajectory.points /= std::max(1.0, static_cast<double>(trajectory.frames.size() - 1));
  return trajectory;
}

Trajectory run_scene(const Scene& scene, const Simulator& simulator, bool with_depths) {
  Trajectory trajectory;
  trajectory.step = scene.step;
  const auto world = simulator(scene);
  const Touching touching(scene);
  trajectory.frames.push_back(world->states());
  if (with_depths) add_depths(scene, touching, trajectory);
  const auto steps = static_cast<int>(std::lround(scene.duration / scene.step));
  for (int i = 0; i < steps && trajectory.sound; ++i) {
    const auto start = Clock::now();
    world->step();
    trajectory.step_seconds.push_back(seconds_since(start));
    trajectory.points += world->contacts().points;
    trajectory.sound = world->sound();
    if (!trajectory.sound) break;
    trajectory.frames.push_back(world->states());
    if (with_depths) add_depths(scene, touching, trajectory);
  }
  trajectory.points /= std::max(1.0, static_cast<double>(trajectory.frames.size() - 1));
  return trajectory;
}

std::string shape_text(const Shape& shape) { return std::visit(ShapeText{}, shape); }

PairKinds::PairKinds(const Scene& scene, const Trajectory& run) {
  for (const Body& body : scene.bodies) shapes_.push_back(shape_text(body.shape));
  std::vector<std::set<std::pair<int, int>>> pairs;
  for (const JudgedAnswer& answer : run.answers) {
    int kind = of(answer.a, answer.b);
    if (kind < 0) {
      kind = static_cast<int>(kinds_.size());
      index_[{shapes_[answer.a], shapes_[answer.b]}] = kind;
      kinds_.push_back({shapes_[answer.a] + " on " + shapes_[answer.b],
                        scene.bodies[answer.a].name + " and " + scene.bodies[answer.b].name,
                        pair_of(run.configuration(scene, answer)),
                        {}});
      pairs.emplace_back();
    }
    kinds_[kind].answers.push_back(answer);
    pairs[kind].insert({answer.a, answer.b});
  }
  for (std::size_t i = 0; i < kinds_.size(); ++i) {
    if (pairs[i].size() > 1) {
      kinds_[i].bodies = fmt::format("{} pairs, as {}", pairs[i].size(), kinds_[i].bodies);
    }
  }
}

int PairKinds::of(int a, int b) const {
  for (const auto& [first, second] : {std::pair(a, b), std::pair(b, a)}) {
    const auto found = index_.find({shapes_[first], shapes_[second]});
    if (found != index_.end()) return found->second;
  }
  return -1;
}

std::string motion_table(const Scene& scene, const Trajectory& run) {
  std::vector<std::optional<double>> depth(scene.bodies.size());
  for (const JudgedAnswer& answer : run.answers) {
    for (const int b : {answer.a, answer.b}) {
      depth[b] = std::max(depth[b].value_or(0), answer.depth);
    }
  }
  std::size_t width = 4;
  for (const Body& body : scene.bodies) width = std::max(width, body.name.size());
  if (std::ranges::all_of(scene.bodies, &Body::fixed)) return "  Nothing moves: all is fixed.\n";
  std::string text = fmt::format("  {:<{}}  {:>32}  {:>10}  {:>9}\n", "body", width, "ends at, m",
                                 "moved, m", "depth, m");
  for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
    if (scene.bodies[i].fixed) continue;
    const Vec3 from = run.frames.front()[i].pose.position();
    const Vec3 to = run.frames.back()[i].pose.position();
    text += fmt::format("  {:<{}}  {:>10.6f} {:>10.6f} {:>10.6f}  {:>10.6f}  {:>9}\n",
                        scene.bodies[i].name, width, to.x(), to.y(), to.z(), (to - from).norm(),
                        depth[i] ? fmt::format("{:.2g}", *depth[i]) : "");
  }
  const auto is_lost = [](const JudgedAnswer& a) {
    return a.status != TS_CONTACT && a.status != TS_NONE;
  };
  if (const auto lost = std::ranges::count_if(run.answers, is_lost); lost > 0) {
    text += fmt::format("  {} of {} had no answer, and those bodies no contact.\n", lost,
                        counted(run.answers.size(), "question"));
  }
  if (!run.sound) text += fmt::format("  The motion becomes absurd at {:.3f} s.\n", run.end());
  return text;
}

}  // namespace touchstone
