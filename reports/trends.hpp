#pragma once

#include <array>
#include <optional>
#include <vector>

#include "reports/campaign.hpp"
#include "reports/report.hpp"

namespace touchstone {

/// What an error may depend on. Absent where it has no meaning: a sphere has no tilt, apart bodies
/// have no depth.
enum class Variable {
  tilt,      ///< of the cylinder's axis from parallel or perpendicular to an axis of B, radians
  depth,     ///< true penetration, relative to the smaller size
  aspect,    ///< largest over smallest half extent, of the more extreme body
  distance,  ///< of the cylinder's centre from the origin, relative to the larger size
};
inline constexpr std::array all_variables = {Variable::tilt, Variable::depth, Variable::aspect,
                                             Variable::distance};
const char* variable_name(Variable variable);

/// `signed_distance` is the true one in metres.
std::optional<double> value_of(Variable variable, const Configuration& configuration,
                               double signed_distance);

/// Severity against each variable, by its decades: one trend for each pair × candidate × variable
/// with any values.
std::vector<Trend> trends(const Campaign& campaign, const std::vector<CellScores>& scores);

}  // namespace touchstone
