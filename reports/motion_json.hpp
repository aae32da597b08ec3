#pragma once

#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "simulation/scene.hpp"

// Motions as pages read them (pages/motion.js).
namespace touchstone {

/// Names, shapes and initial poses of a scene's bodies.
nlohmann::json bodies_json(const Scene& scene);

/// The bytes of numbers in base64 (RFC 4648).
std::string base64(const std::vector<float>& numbers);

}  // namespace touchstone
