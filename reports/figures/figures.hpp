#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "reports/report.hpp"

namespace touchstone {

/// Throws InvalidInput (field "--figures") unless gnuplot is there and `folder` can be written to.
void check_figures(const std::filesystem::path& folder);

/// Figures of a report for papers, each as SVG and PNG with its data as CSV: speed-accuracy of all
/// pairs and of each, errors-PAIR (cumulative distribution of the depth error) and classes-PAIR
/// (share that disagrees, by pose class and candidate). Throws std::runtime_error with gnuplot's
/// words if it fails.
void write_figures(const Report& report, const std::filesystem::path& folder);

/// gnuplot's mark and line of each candidate, as in "pointtype 7 linecolor '#0072b2' dashtype
/// solid": in its engine's colour, of which each has a symbol and a dash of its own, for a figure
/// may stand alone. Beyond fifteen of one colour they come again.
std::map<std::string, std::string> figure_styles(const std::vector<std::string>& candidates);

/// A mark of a chart that wants a label beside it. Lengths are in characters: one across, one line
/// up.
struct Label {
  double x, y;     ///< the mark, from the chart's lower left corner
  double length;   ///< of the text
  bool important;  ///< chooses its place before those that are not
};

/// A straight part of a line in the chart, in the same units; no label may lie on it.
struct Segment {
  double x1, y1, x2, y2;
};

/// Where a label's text begins (or ends, unless rightwards), from its mark.
struct LabelPlace {
  bool rightwards;
  double dx, dy;
};

/// Places in which no label lies on another, on a mark, on a line or beyond the chart. Absent where
/// there is no such place, except for important labels: they get the best there is.
std::vector<std::optional<LabelPlace>> label_places(const std::vector<Label>& labels, double width,
                                                    double height,
                                                    const std::vector<Segment>& lines = {});

}  // namespace touchstone
