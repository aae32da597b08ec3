#pragma once

#include <optional>
#include <vector>

namespace touchstone {

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
