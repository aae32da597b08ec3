#pragma once

#include <cmath>
#include <cstring>
#include <functional>
#include <gtest/gtest.h>
#include <limits>
#include <string>
#include <vector>

#include "candidates/host/contained.hpp"
#include "simulation/engines/run_engines.hpp"

namespace touchstone {

/// What a test reads off the states of a scene's bodies.
using Probe = std::function<double(const std::vector<BodyState>&)>;

/// What the probe says after each step of a run in a process of its own, which an engine may end;
/// the largest double where the simulation is not sound. The simulator is called in that process.
inline std::vector<double> probed_run(const Scene& scene, const Probe& probe,
                                      const Simulator& simulator) {
  const Contained ran = run_contained(
      [&] {
        const auto world = simulator(scene);
        std::string bytes;
        for (int i = 0; i < std::lround(scene.duration / scene.step); ++i) {
          world->step();
          const double told =
              world->sound() ? probe(world->states()) : std::numeric_limits<double>::max();
          bytes.append(reinterpret_cast<const char*>(&told), sizeof told);
        }
        return bytes;
      },
      max_engine_seconds);
  EXPECT_EQ(ran.end, Contained::End::returned) << ran.text;
  std::vector<double> result(ran.text.size() / sizeof(double));
  std::memcpy(result.data(), ran.text.data(), result.size() * sizeof(double));
  return result;
}

}  // namespace touchstone
