#pragma once

#include <filesystem>
#include <string>

#include "simulation/scenes/scene_file.hpp"
#include "simulation/scenes/trajectory.hpp"

namespace touchstone {

/// Writes a run for POV-Ray 3.7: scene.pov (camera, light), frame-00001.inc, … (the bodies at
/// intervals of `every` seconds), and scene.ini; `povray scene.ini` draws all frames. Returns the
/// number of frames. Throws InvalidInput (field "--out") if a file cannot be written.
int write_povray(const SceneFile& file, const Trajectory& run, double every,
                 const std::filesystem::path& folder);

}  // namespace touchstone
