#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

#include "reports/campaign.hpp"
#include "reports/replay.hpp"
#include "reports/report.hpp"
#include "reports/sampler.hpp"
#include "reports/timing.hpp"

namespace touchstone {

/// What a report is made of, wherever it was scored: in workers, or in shards that came in files.
struct Scored {
  std::vector<PoseClass> cells;
  std::vector<const Sample*> samples;  ///< of each cell; null: not all of it was scored
  Times times = {};                    ///< empty: nobody was timed
  /// What a configuration is called.
  std::function<std::string(const Identity&)> name = [](const Identity& i) { return to_string(i); };
  /// The command that shows it again.
  std::function<std::string(const Identity&, const std::vector<std::string>& candidates)> replay =
      [](const Identity& i, const auto& names) { return replay_command(to_string(i), names); };
};

/// The part of a report that follows from what was scored; `report` says already by whom and how.
void add_results(Report& report, const Scored& scored);

std::vector<const Sample*> pointers(const std::vector<std::optional<Sample>>& samples);

/// A report as it begins: of this program and machine, and all that has to be scored.
Report begun_report(const std::string& command, std::uint64_t seed, const Bar& bar,
                    const std::vector<std::uint64_t>& counts);

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
std::vector<Heading> headings(const std::vector<PoseClass>& cells,
                              const std::function<bool(std::size_t)>& is_scored);

PoseClassDescription description_of(const PoseClass& cell);

// Drake's protocol (drake_protocol.cpp):

/// Drake publishes the worst error of its queries for pairs of bodies of about 20 cm that overlap
/// by 2 mm: at chosen points of both surfaces (on a face, an edge, a vertex) the outward normals
/// are made opposite and the points brought 2 mm past each other, in two poses of the whole. These
/// are the same shapes, points and poses, for the pairs with a cylinder; two cylinders in both
/// orders. None for a pair that Drake publishes nothing of. Source: RobotLocomotion/drake,
/// geometry/proximity/test/characterization_utilities.cc (ShapeConfigurations, AlignPlanes, X_WAs).
std::vector<DrakeCase> drake_cases(Pair pair);

/// The worst absolute error of every candidate in signed distance beside those that Drake publishes
/// of itself.
DrakeProtocol drake_protocol(const Campaign& campaign, std::vector<CandidateProcess>& candidates);

}  // namespace touchstone
