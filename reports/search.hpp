#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "properties/identity.hpp"
#include "properties/laws/check.hpp"

namespace touchstone {

/// What a search makes as large as it can; errors relative to error_size.
enum class Goal {
  distance,  ///< |signed distance − true one|; without a contact the depth that was missed
  normal,    ///< the normal regret
  points,    ///< |depth of the deepest point − true depth|
  hull,  ///< how far an unseen step moves the hull of the points, of the larger size (hull_law.cpp)
  time   ///< a query's instructions, or nanoseconds where these cannot be counted, over the
         ///< median of what the climb sampled
};
inline constexpr std::array all_goals = {Goal::distance, Goal::normal, Goal::points, Goal::hull,
                                         Goal::time};
/// All that do not depend on the machine.
inline constexpr std::array usual_goals = {Goal::distance, Goal::normal, Goal::points, Goal::hull};
const char* goal_name(Goal goal);
/// Throws InvalidInput (field "--goal") that lists the goals.
Goal parse_goal(std::string_view name);

/// What to look for, where to start, and how long.
struct Search {
  std::vector<Pair> pairs;
  std::vector<Goal> goals;
  ClassSelection starts;  ///< the pose classes that starts are drawn from
  std::uint64_t seed = 1;
  std::uint64_t budget = 10000;  ///< evaluations for each pair and goal
  Bar bar;
  unsigned workers = 1;
};

/// The highest place that a climb, or all climbs of a pair and goal, came to.
struct Summit {
  Configuration configuration;
  std::string start;   ///< identity of what it grew from
  double value = 0;    ///< infinite where the candidate gave no answer to judge
  double sampled = 0;  ///< the highest among the starts, which were drawn and not changed
};
struct GoalResult {
  Pair pair;
  Goal goal;
  std::uint64_t evaluations = 0, climbs = 0;
  std::uint64_t broken = 0;      ///< climbs that ended where a law is broken
  std::optional<Summit> summit;  ///< absent where the search was interrupted before
};

struct SearchResult {
  std::vector<GoalResult> goals;  ///< of each pair that the candidate has a routine for
  /// One of each cause: the highest, simplified. `met` counts climbs.
  std::vector<Failure> failures;
};

/// Climbs from many starts: draws configurations of the classes, takes the highest of them, and
/// goes on to the highest of some random steps from it (random_step.hpp) while they lead higher;
/// where none does for long it draws anew. A climb of `max_climb` evaluations is asked in one
/// session and depends on the seed and its number alone, so that the workers do not change what is
/// found. The truth of a step is enclosed to 1e-15 of the size; what a climb ends with is judged by
/// the laws "answers", "agreement", "points" and "hull" in a session of its own.
///
/// `progress` is told how many evaluations are done, of how many.
SearchResult search(const Candidate& candidate, const Search& search,
                    const std::function<void(std::uint64_t, std::uint64_t)>& progress);

/// Evaluations of one climb.
inline constexpr std::uint64_t max_climb = 1024;

/// {"goals": [{"pair", "goal", "evaluations", "climbs", "broken", "value", "sampled", "from",
/// "configuration"}], "failures": as check.md has them}; numbers in hexadecimal floats.
nlohmann::json to_json(const SearchResult& result);

}  // namespace touchstone
