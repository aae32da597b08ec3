#pragma once

#include <filesystem>
#include <string>

#include "simulation/scenes/scene_file.hpp"
#include "simulation/scenes/trajectory.hpp"

namespace touchstone {

/// Writes a run for POV-Ray 3.7: scene.pov (camera, light), frame-00001.inc, … (the bodies, every
/// `every` seconds), and scene.ini, so that `povray scene.ini` draws all frames. Returns how many.
/// Throws InvalidInput (field "--out") where that cannot be done.
int write_povray(const SceneFile& file, const Trajectory& run, double every,
                 const std::filesystem::path& folder);

}  // namespace touchstone
