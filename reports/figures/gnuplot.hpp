#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "reports/report.hpp"

namespace touchstone {

// Pieces that the figures of a report are made of.

/// "pointtype 7 linecolor '#0072b2'": a candidate's mark, coloured as on the report's page.
std::string style_of(const std::string& candidate);

/// Text within double quotes, for gnuplot.
std::string quoted(const std::string& text);
/// A cell of CSV.
std::string csv_cell(const std::string& text);

/// A figure's commands, once for NAME.svg and once for NAME.png of twice as many pixels.
std::string in_both_forms(const std::string& name, int width, int height,
                          const std::string& commands);

/// "errors-cylinder-box", and of another group of pose classes than everyday
/// "errors-cylinder-box-extreme".
std::string figure_name(const std::string& name, const std::string& group);
/// "cylinder-box, everyday poses".
std::string figure_title(const std::string& pair, const std::string& group);

/// Runs a script within `folder`. Throws std::runtime_error with gnuplot's words if it fails; the
/// script is then left there.
void run_gnuplot(const std::string& script, const std::filesystem::path& folder);

/// Share of the configurations with a routine on which the candidate agrees.
double agreement(const Statistics& statistics);

/// The charts of speed and accuracy in one group, together and of each pair (figures.hpp). Writes
/// their data as CSV and returns their commands, none where there is nothing to show.
std::string speed_figures(const Report& report, const std::string& group,
                          const std::vector<std::string>& pairs,
                          const std::filesystem::path& folder);

/// A mark of a chart that wants a label beside it. Lengths are in characters: one across, one line
/// up.
struct Label {
  double x, y;     ///< the mark, from the chart's lower left corner
  double length;   ///< of the text
  bool important;  ///< chooses its place before those that are not
};

/// Where a label's text begins (or ends, unless rightwards), from its mark.
struct LabelPlace {
  bool rightwards;
  double dx, dy;
};

/// Places in which no label lies on another, on a mark or beyond the chart. Absent where there is
/// no such place, except for important labels: they get the best there is.
std::vector<std::optional<LabelPlace>> label_places(const std::vector<Label>& labels, double width,
                                                    double height);

}  // namespace touchstone
