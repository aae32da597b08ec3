// How robots and worlds move with exact contacts, and the advice for them.
#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>

#include "candidates/candidates.hpp"
#include "simulation/scenes/choose.hpp"
#include "simulation/scenes/exact_motion.hpp"
#include "simulation/scenes/robot_files_fixture.hpp"

namespace touchstone {
namespace {

/// Ends of a run with exact contacts.
struct ExactRun {
  SceneFile file;
  Trajectory run;

  explicit ExactRun(const std::string& name, const RobotMotion& motion = {})
      : file(robot_scene(read_robot(scenes / name), motion)) {
    Processes processes{Limits()};
    CandidateModel exact(processes.of(find_candidate("reference")));
    run = run_scene(file.scene, exact);
  }
  Vec3 way(const std::string& name) const {
    const auto& bodies = file.scene.bodies;
    const auto b = std::ranges::find(bodies, name, &Body::name) - bodies.begin();
    return run.frames.back()[b].pose.position() - run.frames.front()[b].pose.position();
  }
};

const std::vector<std::pair<std::string, double>> forward = {{"front_left_wheel_joint", 5},
                                                             {"front_right_wheel_joint", 5},
                                                             {"rear_left_wheel_joint", 5},
                                                             {"rear_right_wheel_joint", 5}};

TEST(Rover, StandsAndDrivesAsFarAsItsWheelsTurn) {
  EXPECT_LT(ExactRun("rover.urdf").way("chassis").norm(), 2e-3);
  RobotMotion motion;
  motion.rates = forward;
  const ExactRun driving("rover.urdf", motion);
  // 5 rad/s on wheels of 0.1 m for 2 s, but for half of the 0.2 s in which they start.
  constexpr double way = 5 * 0.1 * 1.9;
  EXPECT_NEAR(driving.way("chassis").x(), way, 0.02 * way);
  EXPECT_LT(std::abs(driving.way("chassis").y()), 0.01);
}

TEST(Rover, ClosesItsFingersOnEachOther) {
  RobotMotion motion;
  motion.rates = {{"left_finger_joint", 0.05}, {"right_finger_joint", 0.05}};
  const ExactRun closing("rover.urdf", motion);
  // Of the 80 mm between them, rods of 12 mm radius leave 56 mm. Equal motors do not say where.
  EXPECT_NEAR(closing.way("right_finger").y() - closing.way("left_finger").y(), 0.056, 1e-3);
}

/// The advice for a robot or world, from few disturbances.
Choice choice_of(const std::string& name, const RobotMotion& motion,
                 const std::vector<std::string>& candidates) {
  ChooseOptions options;
  options.candidates = find_candidates(candidates);
  options.trials.disturbances = 2;
  SceneFile file = robot_scene(read_robot(scenes / name), motion);
  add_robot_needs(file,
                  exact_motion(file.scene, options.trials, options.workers, options.limits, name));
  return choose(file, options);
}

/// Name of the model that is chosen for pairs of which one body is called so.
std::string chosen_for(const Choice& choice, const std::string& name) {
  for (std::size_t k = 0; k < choice.kinds.all().size(); ++k) {
    if (choice.kinds.all()[k].bodies.find(name) == std::string::npos) continue;
    return choice.runs[choice.answer].models[k]->name;
  }
  return "nothing";
}

bool has_need(const Choice& choice, const std::string& text) {
  for (const auto& need : choice.file.needs) {
    if (need->text(choice.file.scene).starts_with(text)) return true;
  }
  return false;
}

TEST(Rover, GetsAdviceForItsWheelsAndItsFingers) {
  RobotMotion motion;
  motion.rates = forward;
  motion.rates.emplace_back("left_finger_joint", 0.05);
  motion.rates.emplace_back("right_finger_joint", 0.05);
  const Choice choice = choice_of("rover.urdf", motion, {"capsule", "spheres:2", "prism:16"});
  EXPECT_FALSE(choice.impossible);
  EXPECT_TRUE(has_need(choice, "front_left_wheel overlaps"));
  EXPECT_TRUE(has_need(choice, "left_finger overlaps"));
  EXPECT_TRUE(has_need(choice, "chassis ends within"));
  EXPECT_NE(chosen_for(choice, "wheel and ground"), "nothing");
  EXPECT_NE(chosen_for(choice, "left_finger"), "nothing");
  EXPECT_NE(chosen_for(choice, "wheel and ground"), "spheres:2");
}

TEST(CanGripper, GetsAdviceForTheCanThatItsMeshesGrip) {
  RobotMotion motion;
  motion.rates = {{"left_finger_joint", 0.1}, {"right_finger_joint", 0.1}, {"lift_joint", 0.02}};
  motion.duration = 1;
  const Choice choice = choice_of("can-gripper.urdf", motion, {"capsule", "prism:16"});
  EXPECT_FALSE(choice.impossible);
  EXPECT_NE(chosen_for(choice, "can and left_finger"), "nothing");
  EXPECT_TRUE(has_need(choice, "can overlaps"));
  // Its answer was asked for a can that the fingers hold and that stands on nothing.
  const auto& bodies = choice.file.scene.bodies;
  const auto can = std::ranges::find(bodies, "can", &Body::name) - bodies.begin();
  const double height = choice.exact_run.frames.back()[can].pose.position().z();
  EXPECT_GT(height, 0.06 + 0.01);
}

TEST(LoadingBay, GetsAdviceForTheCartsWheelsAndTheBarrel) {
  RobotMotion motion;
  for (const char* wheel : {"front_left", "front_right", "rear_left", "rear_right"}) {
    motion.rates.emplace_back(std::string("cart_1::") + wheel + "_wheel_axle", 4);
  }
  const Choice choice =
      choice_of("loading-bay.sdf", motion, {"bullet-hull:16", "capsule", "prism:16"});
  EXPECT_FALSE(choice.impossible);
  EXPECT_NE(chosen_for(choice, "_wheel and ground_plane"), "nothing");
  for (const Candidate* model : choice.runs[choice.answer].models) {
    EXPECT_NE(model->name,
              "bullet-hull:16");  // the prism is the model, not Bullet's routine for it
  }
  EXPECT_NE(chosen_for(choice, "barrel::link and ground"), "nothing");
  // 4 rad/s on wheels of 80 mm: it runs into the barrel.
  EXPECT_NE(chosen_for(choice, "barrel::link and cart_1::tray"), "nothing");
}

TEST(Pincer, GetsAdviceForItsFingers) {
  RobotMotion motion;
  motion.rates = {{"left", 0.1}, {"right", 0.1}};
  const Choice choice = choice_of("pincer.xml", motion, {"capsule", "prism:16"});
  EXPECT_FALSE(choice.impossible);
  EXPECT_NE(chosen_for(choice, "left_finger"), "nothing");
}

}  // namespace
}  // namespace touchstone
