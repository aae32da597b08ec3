#include "simulation/scenes/trajectory.hpp"

#include <chrono>
#include <cmath>
#include <numbers>

#include "reference/contact_of.hpp"
#include "reference/support.hpp"

namespace touchstone {
namespace {

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

/// Regrets below this share of the smaller size are those of a normal that is as good.
constexpr double as_good = 1e-6;

/// Asks another model, and the truth after it.
class WatchedModel : public ContactModel {
 public:
  WatchedModel(ContactModel& model, Trajectory& trajectory)
      : model_(model), trajectory_(trajectory) {}

  void begin() override { model_.begin(); }

  std::vector<Answer> answers(std::span<const PairQuestion> questions) override {
    const auto start = Clock::now();
    auto result = model_.answers(questions);
    trajectory_.contact_seconds += seconds_since(start);
    for (std::size_t i = 0; i < questions.size(); ++i) {
      trajectory_.asked.push_back(judged(questions[i], result[i]));
    }
    return result;
  }

 private:
  Asked judged(const PairQuestion& question, const Answer& answer) const {
    const Configuration& c = question.configuration;
    const SignedDistance truth = touchstone::signed_distance(c);
    Asked asked{static_cast<int>(trajectory_.frames.size()) - 1,
                question.a,
                question.b,
                -truth.value,
                answer.status,
                0,
                std::nullopt,
                0};
    if (answer.status != TS_CONTACT) return asked;
    asked.signed_distance = answer.signed_distance;
    asked.points = answer.point_count;
    const Vec3 normal(answer.normal);
    const double regret = truth.value - gap(c, normal);
    const double sine = normal.cross(truth.normal).norm(), cosine = normal.dot(truth.normal);
    asked.normal_angle =
        regret < as_good * smaller_size(c) ? 0 : std::atan2(sine, cosine) * 180 / std::numbers::pi;
    return asked;
  }

  ContactModel& model_;
  Trajectory& trajectory_;
};

}  // namespace

double Asked::depth_error() const {
  if (status != TS_CONTACT) return std::max(depth, 0.0);
  return std::abs(depth + signed_distance);
}

Configuration Trajectory::configuration(const Scene& scene, const Asked& question) const {
  const auto& states = frames[static_cast<std::size_t>(question.frame)];
  return {std::get<Cylinder>(scene.bodies[question.a].shape), states[question.a].pose,
          scene.bodies[question.b].shape, states[question.b].pose};
}

Trajectory run_scene(const Scene& scene, ContactModel& model) {
  Trajectory trajectory;
  trajectory.step = scene.step;
  WatchedModel watched(model, trajectory);
  World world(scene, watched);
  trajectory.frames.push_back(world.states());
  const auto start = Clock::now();
  while (world.time() < scene.duration - scene.step / 2) {
    world.step();
    if (!world.sound()) {
      trajectory.sound = false;
      break;
    }
    trajectory.frames.push_back(world.states());
  }
  trajectory.seconds = seconds_since(start);
  return trajectory;
}

}  // namespace touchstone
