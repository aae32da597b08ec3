#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

#include "reports/campaign.hpp"
#include "reports/report.hpp"

namespace touchstone {

/// Cells (pair × class) of which one row tells: those of one group of pose classes, of a pair or of
/// all pairs. No row tells of all groups: how often an extreme class occurs in a report says
/// nothing of how often it occurs anywhere else.
struct Heading {
  std::string pair;  ///< or "all"
  Group group;
  std::vector<std::size_t> cells;  ///< indices, in order
};

/// Lists the headings of these cells: group by group, the pairs of each, then all pairs if there
/// are several. `is_scored`: of a cell; the others are left out.
std::vector<Heading> headings(const std::vector<Cell>& cells,
                              const std::function<bool(std::size_t)>& is_scored);

PoseClassDescription description_of(const Cell& cell);

}  // namespace touchstone
