#pragma once

#include <optional>
#include <vector>

#include "reports/report.hpp"
#include "reports/sampler.hpp"

namespace touchstone {

/// Cost of one candidate's queries on the configurations of one cell, in each repetition; empty
/// where the pair is unsupported, the candidate died, or the run was interrupted before.
using Repetitions = std::vector<QueryCost>;
using Times = std::vector<std::vector<Repetitions>>;  ///< [cell][candidate][repetition]

/// Times are repeated until they are settled, no less and no more often than this.
inline constexpr std::size_t min_repetitions = 5, max_repetitions = 11;

/// Do half of the times lie within 3% of each other? Between runs, times differ by more.
bool is_settled(const Repetitions& repetitions);

/// Times the narrow phase alone, as Google Benchmark does it: warm-up, repetitions, candidates in
/// random order within each (drawn from the campaign's seed), one at a time. Shapes are prepared
/// beforehand, a cell's configurations are queried one after the other. Each candidate reads the
/// clock in its own process around the loop of its queries; what isolation costs lies outside.
/// Configurations that ended a candidate's process or that it was not asked, as the samples of the
/// cells say, are left out. Timed are everyday and recorded classes, all arrangements alone, and
/// those of general, parallel and perpendicular with one modifier, of the tilts three; and all
/// classes of a campaign that names them. `candidates` are the campaign's.
Times time_queries(const Campaign& campaign, const std::vector<PoseClass>& cells,
                   const std::vector<std::optional<Sample>>& samples,
                   std::vector<CandidateProcess>& candidates);

std::optional<Spread> spread(std::vector<double> values);

/// Time of one candidate over several cells, but for the ratio. A repetition's value is the median
/// over the cells; a cell with fewer repetitions than another goes through its own again.
std::optional<QueryTime> query_time(const Times& times, const std::vector<std::size_t>& cells,
                                    std::size_t candidate);

/// Do 5% of the queries take more than four medians? The median is one of repetitions, p95 one of
/// configurations. Precondition: there is a p95.
bool has_slow_tail(const QueryTime& time);

/// Ratio of a candidate's time to another's, on the cells where both were timed. Both values of a
/// repetition were measured at nearly the same moment, so that disturbances of both cancel.
std::optional<Spread> time_ratio(const Times& times, const std::vector<std::size_t>& cells,
                                 std::size_t candidate, std::size_t other);

}  // namespace touchstone
