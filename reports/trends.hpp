#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "reports/bytes.hpp"
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

/// Value of a variable; `signed_distance` is the true one in metres.
std::optional<double> value_of(Variable variable, const Configuration& configuration,
                               double signed_distance);

/// Severity of judged answers against each variable, by its decades. Tallies of the parts, added in
/// any order, give the trends of the whole.
class TrendTally {
 public:
  /// `scores`: of every candidate on this configuration.
  void add(const Configuration& configuration, double signed_distance,
           const std::vector<Score>& scores);
  void add(const TrendTally& other);

  /// Trends of one pair and group: of each candidate and variable with any values.
  std::vector<Trend> trends(const std::string& pair, const std::string& group,
                            const std::vector<std::string>& candidates) const;

  void write(ByteWriter& out) const;
  static TrendTally read(ByteReader& in);

 private:
  struct Key {
    std::size_t candidate;
    Variable variable;
    std::optional<int> decade;  ///< absent, which comes first: zero, and what is lost in rounding
    auto operator<=>(const Key&) const = default;
  };
  struct Bin {
    std::vector<double> severity;
    std::uint64_t missed = 0;
  };
  std::map<Key, Bin> bins_;
};

}  // namespace touchstone
