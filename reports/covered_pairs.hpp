#pragma once

#include <string>

#include "reports/report.hpp"

namespace touchstone {

/// Of the pairs that a report has in a group, on how many a candidate has a routine. What it shows
/// over all pairs is over these alone.
struct CoveredPairs {
  std::size_t covered = 0, all = 0;

  bool are_all() const { return covered == all; }
};
CoveredPairs covered_pairs(const Report& report, const std::string& group,
                           const std::string& candidate);

/// " (4 of 5 pairs)" beside the name of a row over all pairs; empty for other rows and where it is.
std::string covered_text(const Report& report, const ResultRow& row);

}  // namespace touchstone
