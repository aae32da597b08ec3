#pragma once

#include <string>

#include <nlohmann/json.hpp>

#include "simulation/scenes/choose.hpp"

namespace touchstone {

/// choose.json (docs/scenes.md), from which the terminal's text and the page are made. `folder` is
/// where the configurations of failures will stand (write_evidence).
nlohmann::json to_json(const Choice& choice, const SceneFile& file, const std::string& command,
                       const std::string& folder);

/// A file for each failure that to_json names, for `touchstone replay`.
void write_evidence(const Choice& choice, const SceneFile& file, const std::string& folder);

}  // namespace touchstone
