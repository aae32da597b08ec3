#pragma once

#include <filesystem>

#include <nlohmann/json.hpp>

namespace touchstone {

/// Writes a page, usable offline: what changed between two reports, and both fronts of speed and
/// accuracy one over the other. Throws InvalidInput (field "--html") where it cannot be written.
void write_compare_page(const nlohmann::json& comparison, const nlohmann::json& before,
                        const nlohmann::json& after, const std::filesystem::path& file);

}  // namespace touchstone
