#pragma once

#include <cstddef>
#include <string>

#include <nlohmann/json_fwd.hpp>

#include "simulation/scene.hpp"

// Readers of what moves the bodies of a scene file (docs/scenes.md). All throw InvalidInput with
// the path of the field. Angles are in degrees there.

namespace touchstone {

/// Bound on the bodies of a scene, of which each step tests all pairs.
inline constexpr std::size_t max_bodies = 1000;

/// Reads {"velocity", "angular_velocity"}, {"oscillation"} or {"waypoints"}.
Drive drive_from_json(const nlohmann::json& value, const std::string& path);

/// Index of the body of the scene that a file names.
int body_index(const nlohmann::json& name, const std::string& path, const Scene& scene);

/// Reads an element of "joints" or "pushes", whose bodies are in the scene.
Joint joint_from_json(const nlohmann::json& value, const std::string& path, const Scene& scene);
Push push_from_json(const nlohmann::json& value, const std::string& path, const Scene& scene);

/// Reads an element of "drops" and adds its bodies, copies of `like`, to the scene: at random poses
/// within a box, above all planes, such that none overlaps another's axis-aligned bounding box.
void add_drop(const nlohmann::json& value, const std::string& path, Body like, Scene& scene);

}  // namespace touchstone
