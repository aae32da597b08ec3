#include "reports/covered_pairs.hpp"

#include <fmt/format.h>

namespace touchstone {

CoveredPairs covered_pairs(const Report& report, const std::string& group,
                           const std::string& candidate) {
  CoveredPairs result;
  for (const ResultRow& row : report.summary) {
    if (row.pair == "all" || row.pose_class != group || row.candidate != candidate) continue;
    ++result.all;
    result.covered += row.statistics.supported() > 0;
  }
  return result;
}

std::string CoveredPairs::text() const {
  return are_all() ? "" : fmt::format(" ({} of {} pairs)", covered, all);
}

std::string covered_text(const Report& report, const ResultRow& row) {
  return row.pair == "all" ? covered_pairs(report, row.pose_class, row.candidate).text() : "";
}

}  // namespace touchstone
