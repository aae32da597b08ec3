#pragma once

#include "reports/report.hpp"

namespace touchstone {

/// The machine that this runs on.
Machine describe_machine();

}  // namespace touchstone
