#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "oracle/judge/cast_score.hpp"

namespace touchstone {

struct Campaign;
struct Report;
struct Terminal;

/// What candidates make of casts: how far a moving cylinder comes before it touches.
struct Casts {
  /// One candidate on one pair in one group of poses.
  struct Row {
    std::string pair, group, candidate;
    std::uint64_t count = 0;
    std::map<CastOutcome, std::uint64_t> outcomes;
    std::map<std::string, std::uint64_t> wrong_by_motion;  ///< those that do not agree
    /// Signed distance that is left at an answered touch, or passed into; magnitudes, relative to
    /// the smaller size. Absent without an answered touch.
    std::optional<double> distance_p99, distance_max;
  };
  /// The worst of a pair, group and candidate.
  struct Worst {
    std::string id, pair, group, candidate;
    CastOutcome outcome = CastOutcome::agree;
    std::optional<double> distance, normal_regret;
    std::string replay;                   ///< the command that shows it again
    std::optional<double> fraction = {};  ///< answered; absent where there was no answer
  };
  std::uint64_t count = 0;  ///< casts of each motion in a pair and group
  std::vector<Row> results;
  std::vector<Worst> worst;
};

/// Asks the campaign's candidates that have casts, upon the classes of its pairs in each group that
/// is drawn. Parts that were interrupted are left out.
Casts measure_casts(const Campaign& campaign);

/// A sentence on everyday poses, or of the first group there is, and the command that shows the
/// worst cast of an engine. Empty where no candidate but our own has casts.
std::string casts_text(const Report& report, const Terminal& terminal);

}  // namespace touchstone
