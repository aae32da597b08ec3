#pragma once

#include <string>
#include <vector>

#include "reports/report.hpp"

namespace touchstone {

/// One sentence on a candidate, and the command that shows it again.
struct Finding {
  std::string candidate, text, command;
};

/// What to see first of a report, at most three: what floors of triangles make of a plane at their
/// seams, where they were asked; the arrangement that a candidate passes and most clearly fails
/// once turned (or, where there is none, tilted); then the most frequent failures of
/// a pair in the first group of poses in which there are any. Each is of another engine as far as
/// there are some that fail, and of a simplified model, which fails by design, only where nothing
/// else does.
std::vector<Finding> findings(const Report& report);

}  // namespace touchstone
