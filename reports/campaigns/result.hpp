#pragma once

#include <filesystem>
#include <string>

#include "reports/campaigns/shard_file.hpp"
#include "reports/report.hpp"

namespace touchstone {

/// The result of a campaign: of a report, what does not depend on how, where and how fast it ran.
Report campaign_result(const Progressed& whole);

/// campaign.json (docs/campaign.md): the members of report.json that a campaign has.
std::string campaign_json(const Progressed& whole);

/// Writes campaign.json as a whole or not at all; returns its name. Throws InvalidInput (field
/// "--out") where that cannot be done.
std::filesystem::path write_result(const Progressed& whole, const std::filesystem::path& folder);

}  // namespace touchstone
