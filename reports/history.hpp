#pragma once

#include <map>
#include <string>
#include <vector>

#include "reports/report.hpp"
#include "reports/terminal.hpp"

// The releases of one engine, side by side (report --history): a view over the scores of a report
// whose candidates they are, ENGINE@RELEASE, in the order in which it lists them.

namespace touchstone {

/// The names of the report's candidates that are releases of the engine: "rapier@0.14" of "rapier".
std::vector<std::string> releases_of(const Report& report, const std::string& engine);

/// The report of these candidates alone, under other names, so that two releases are compared.
Report part_of(const Report& report, const std::map<std::string, std::string>& new_names);

/// From one release to the next, the classes of which another twentieth or more is answered right,
/// or no longer; in the order of releases and pairs, the largest first.
std::vector<ReleaseStep> release_steps(const Report& report, const std::string& engine);

/// For a terminal of 80 columns: the releases, then for each pair which broke and which mended a
/// class first.
std::string history_text(const Report& report, const Terminal& terminal = {});

/// A page, usable offline: agreement and time of each pair over the releases, and the steps.
std::string history_page(const Report& report);

}  // namespace touchstone
