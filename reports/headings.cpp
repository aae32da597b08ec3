#include "reports/headings.hpp"

#include <utility>

namespace touchstone {

std::vector<Heading> headings(const std::vector<Cell>& cells,
                              const std::function<bool(std::size_t)>& is_scored) {
  std::vector<Group> groups;
  for (const Cell& cell : cells) groups.push_back(group_of(cell.pair, cell.pose_class));
  std::vector<Heading> result;
  for (const Group group : all_groups) {
    Heading all{"all", group, {}};
    std::size_t pairs = 0;
    for (std::size_t i = 0; i < cells.size(); ++i) {
      if (groups[i] != group || !is_scored(i)) continue;
      const char* pair = pair_name(cells[i].pair);
      if (pairs == 0 || result.back().pair != pair) {
        result.push_back({pair, group, {}});
        ++pairs;
      }
      result.back().cells.push_back(i);
      all.cells.push_back(i);
    }
    if (pairs > 1) result.push_back(std::move(all));
  }
  return result;
}

PoseClassDescription description_of(const Cell& cell) {
  auto [arrangement, modifiers] = parts_of(cell.pair, cell.pose_class);
  return {pair_name(cell.pair),
          cell.pose_class,
          describe_pose_class(cell.pair, cell.pose_class),
          group_name(group_of(cell.pair, cell.pose_class)),
          std::move(arrangement),
          std::move(modifiers)};
}

}  // namespace touchstone
