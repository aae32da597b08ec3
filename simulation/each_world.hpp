#pragma once

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <string>
#include <vector>

#include "candidates/candidates.hpp"
#include "candidates/host/contained.hpp"
#include "properties/files/bytes.hpp"
#include "simulation/engines/run_engines.hpp"
#include "simulation/experiment.hpp"
#include "simulation/world.hpp"

namespace touchstone {

/// States of the bodies of a scene, in their order.
using States = std::vector<BodyState>;

/// The states after each step of a run in a process of its own, which an engine may end. The
/// simulator is called in that process.
inline std::vector<States> states_of(const Scene& scene, const Simulator& simulator) {
  const auto steps = static_cast<std::size_t>(std::lround(scene.duration / scene.step));
  const Contained ran = run_contained(
      [&] {
        const auto world = simulator(scene);
        std::vector<States> all;
        while (all.size() < steps && world->sound()) {
          world->step();
          all.push_back(world->states());
        }
        return to_bytes(world->sound(), all);
      },
      max_engine_seconds);
  EXPECT_EQ(ran.end, Contained::End::returned) << ran.text;
  if (ran.end != Contained::End::returned) {
    return {States(scene.bodies.size(), {Pose(), Vec3::Zero(), Vec3::Zero()})};
  }
  BytesIn in(ran.text);
  EXPECT_TRUE(in.next<bool>()) << "the motion left all bounds";
  return in.next<std::vector<States>>();
}

/// Tests that hold our own world and each engine's to the same paper. Contacts are ours, so that
/// what is tested is what a world makes of a scene.
class EachWorld : public testing::TestWithParam<std::string> {
 public:
  /// "ours", then all_engines().
  static std::vector<std::string> all() {
    std::vector<std::string> worlds = all_engines();
    worlds.insert(worlds.begin(), "ours");
    return worlds;
  }
  static std::string plain_name(const testing::TestParamInfo<std::string>& world) {
    std::string name = world.param;
    std::erase(name, '-');
    return name;
  }

 protected:
  bool is_ours() const { return GetParam() == "ours"; }
  bool is_mujoco() const { return GetParam() == "mujoco"; }
  bool is_bullet() const { return GetParam().starts_with("bullet"); }
  bool is_single() const { return GetParam() == "bullet-float"; }

  /// To be called in a process of its own.
  Simulator simulator(bool has_best_solver = false) const {
    if (!is_ours()) {
      return in_engine(GetParam(), {.cured = true, .best_solver = has_best_solver});
    }
    return [](const Scene& scene) {
      static CandidateProcess process(find_candidate("reference"), simulation_threshold);
      static CandidateModel model(process);
      return in_our_world(model)(scene);
    };
  }
  /// States after each step.
  std::vector<States> run(const Scene& scene, bool has_best_solver = false) const {
    return states_of(scene, simulator(has_best_solver));
  }
  States end(const Scene& scene, bool has_best_solver = false) const {
    return run(scene, has_best_solver).back();
  }
  /// Time at which what `value` reads off the states, positive at the start, first is not.
  template <class Value>
  static double zero_crossing(const std::vector<States>& all, const Scene& scene, Value value) {
    const auto at = std::ranges::find_if(all, [&](const States& s) { return value(s) <= 0; });
    return static_cast<double>(at - all.begin() + 1) * scene.step;
  }
};

/// Tests of worlds with the contacts of `reference`.
struct WorldFixture : testing::Test {
  World run(const Scene& scene) {
    World world(scene, model);
    while (world.time() < scene.duration - scene.step / 2) world.step();
    return world;
  }
  CandidateProcess process{find_candidate("reference"), simulation_threshold};
  CandidateModel model{process};
};

}  // namespace touchstone
