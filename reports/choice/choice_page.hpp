#pragma once

#include <string>

#include <nlohmann/json.hpp>

#include "simulation/scenes/choose.hpp"

namespace touchstone {

/// What the page animates: the exact run, the answer, and runs that break a need; each is run
/// again.
nlohmann::json motion_json(const Choice& choice, const SceneFile& file, const Limits& limits);

/// One self-contained page of choose.json with its member "motion"; nothing is loaded from
/// elsewhere.
std::string choice_page(const nlohmann::json& choice);

}  // namespace touchstone
