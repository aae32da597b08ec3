#pragma once

#include <string>

#include "reports/report.hpp"

namespace touchstone {

/// How many of a group's pairs in a report a candidate has a routine for. Its figures over all
/// pairs are over these alone.
struct CoveredPairs {
  std::size_t covered = 0, all = 0;

  bool are_all() const { return covered == all; }
  /// " (5 of 6 pairs)"; empty where they are all.
  std::string text() const;
};
CoveredPairs covered_pairs(const Report& report, const std::string& group,
                           const std::string& candidate);

/// That text of a row over all pairs; empty for other rows.
std::string covered_text(const Report& report, const ResultRow& row);

}  // namespace touchstone
