#pragma once

#include <filesystem>

#include <nlohmann/json.hpp>

#include "reports/campaigns/shard_file.hpp"

namespace touchstone {

/// campaign.json (docs/campaign.md): the members of report.json that a campaign has. It holds
/// nothing of how, where and how fast the campaign ran.
nlohmann::json campaign_result(const Progressed& whole);

/// Writes campaign.json as a whole or not at all; returns its name. Throws InvalidInput (field
/// "--out") where that cannot be done.
std::filesystem::path write_result(const nlohmann::json& result,
                                   const std::filesystem::path& folder);

}  // namespace touchstone
