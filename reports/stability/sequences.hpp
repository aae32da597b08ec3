#pragma once

#include <nlohmann/json.hpp>

#include "properties/motions/motion.hpp"
#include "reports/stability/examined_pose.hpp"

namespace touchstone {

/// Member "sequences" of stability.json (docs/stability.md): each of these motions in so many
/// steps.
nlohmann::json sequences(const std::vector<const Motion*>& motions, int steps, const Study& study);

}  // namespace touchstone
