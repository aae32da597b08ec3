#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

#include "reports/campaign.hpp"
#include "reports/report.hpp"

namespace touchstone {

/// Runs the campaign and the timing. `command` is the command line that a person would repeat. When
/// an end is asked for (interruption.hpp) the report is of what was done by then, and says so
/// (`partial`).
Report make_report(const Campaign& campaign, const std::string& command);

/// The machine that this runs on.
Machine describe_machine();

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
