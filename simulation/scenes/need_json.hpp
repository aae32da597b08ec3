#pragma once

#include <string>

#include <nlohmann/json.hpp>

#include "simulation/scenes/need.hpp"

namespace touchstone {

/// {"need": "stands", "body": "can", "degrees": 0.5} (docs/scenes.md). Throws InvalidInput with the
/// path of the field.
Need need_from_json(const nlohmann::json& value, const std::string& path, const Scene& scene);

}  // namespace touchstone
