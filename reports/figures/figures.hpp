#pragma once

#include <filesystem>

#include "reports/report.hpp"

namespace touchstone {

/// Throws InvalidInput (field "--figures") unless gnuplot is there and `folder` can be written to.
void check_figures(const std::filesystem::path& folder);

/// Figures of a report for papers, each as SVG and PNG with its data as CSV: speed-accuracy of all
/// pairs and of each, errors-PAIR (cumulative distribution of the depth error) and classes-PAIR
/// (share that disagrees, by pose class and candidate). Throws std::runtime_error with gnuplot's
/// words if it fails.
void write_figures(const Report& report, const std::filesystem::path& folder);

}  // namespace touchstone
