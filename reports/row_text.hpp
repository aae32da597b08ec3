#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>

#include "reports/report.hpp"
#include "reports/terminal.hpp"

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

// What tables in the terminal say of a row of a report; "-" where it has no such number.

/// Percentage of the configurations that the candidate has a routine for; cut downwards, so that
/// only a candidate without a failure shows 100.0. ">=27.0" of one that was not asked all.
std::string agreement_text(const Statistics& statistics);

/// "1.2e-05"; "0" also for what is below the normal doubles, of which a campaign's histogram knows
/// but the bin that zero is in.
std::string scientific(const std::optional<Quantiles>& quantiles, double Quantiles::*which);
std::string signed_median(const std::optional<SignedMedian>& bias);

/// In few characters, cut downwards: "999", "1k", "340k".
std::string brief_count(std::uint64_t count);

std::string whole(const std::optional<double>& value);
/// Of a query, nanoseconds; and as a multiple of Bullet's, with "~" where they tie.
std::string median_time(const ResultRow& row);
std::string multiple_of_bullet(const ResultRow& row);

/// The candidate's name in a table, with a star where it does not run as native code, and in a row
/// over all pairs with "4/5" where it has no routine for some.
std::string marked_name(const Report& report, const ResultRow& row);

/// Says of a report that was interrupted how far it came.
std::string partial_text(const Report& report, const Terminal& terminal);

/// Says of a report without a row that counts why it has none; empty of others.
std::string nothing_scored_text(const Report& report, const Terminal& terminal);

/// What the marks at names and shares mean, where a report has them.
std::string marks_text(const Report& report, const Terminal& terminal);

}  // namespace touchstone
