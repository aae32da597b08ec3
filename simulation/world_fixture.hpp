#pragma once

#include <gtest/gtest.h>

#include "candidates/candidates.hpp"
#include "simulation/world.hpp"

namespace touchstone {

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
