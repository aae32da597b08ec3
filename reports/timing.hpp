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

/// Times the narrow phase alone, in this process and one thread: shapes are prepared beforehand,
/// the cell's configurations are queried one after the other, and candidates take turns within
/// every round in rotating order. times[cell][candidate]; absent where the pair is unsupported.
std::vector<std::vector<std::optional<QueryTime>>> time_queries(const Campaign& campaign);

}  // namespace touchstone
