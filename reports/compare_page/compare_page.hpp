#pragma once

#include <string>

#include <nlohmann/json.hpp>

namespace touchstone {

/// A page, usable offline: what changed between two reports, and both fronts of speed and accuracy
/// one over the other.
std::string compare_page(const nlohmann::json& comparison, const nlohmann::json& before,
                         const nlohmann::json& after);

}  // namespace touchstone
