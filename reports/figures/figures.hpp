#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "reports/report.hpp"

namespace touchstone {

/// Throws InvalidInput (field "--figures") unless gnuplot is there and `folder` can be written to.
void check_figures(const std::filesystem::path& folder);

/// Figures of a report for papers, each as SVG and PNG with its data as CSV: speed-accuracy of all
/// pairs and of each, errors-PAIR (cumulative distribution of the depth error) and classes-PAIR
/// (share that disagrees, by pose class and candidate), and the history of an engine. Throws
/// std::runtime_error with gnuplot's words if it fails.
void write_figures(const Report& report, const std::filesystem::path& folder);

/// gnuplot's mark and line of each candidate, as in "pointtype 7 linecolor '#0072b2' dashtype
/// solid": in its engine's colour, of which each has a symbol and a dash of its own, for a figure
/// may stand alone. Beyond fifteen of one colour they come again.
std::map<std::string, std::string> figure_styles(const std::vector<std::string>& candidates);

}  // namespace touchstone
