#pragma once

#include <optional>
#include <vector>

#include "reports/campaign.hpp"

namespace touchstone {

/// Nanoseconds per query of one candidate on the configurations of one cell.
struct QueryTime {
  double median;  ///< over the rounds
  double spread;  ///< interquartile range over the rounds
};

/// Times the narrow phase alone: shapes are prepared beforehand, a cell's configurations are
/// queried one after the other, and candidates take turns within every round in rotating order, one
/// at a time. Each reads the clock in its own process around the loop of its queries; what
/// isolation costs lies outside. Configurations that ended a candidate's process, as `scores` say,
/// are not asked of it. times[cell][candidate]; absent where the pair is unsupported.
std::vector<std::vector<std::optional<QueryTime>>> time_queries(
    const Campaign& campaign, const std::vector<CellScores>& scores);

}  // namespace touchstone
