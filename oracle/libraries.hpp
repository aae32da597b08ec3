#pragma once

#include <string>
#include <vector>

namespace touchstone::oracle {

/// The libraries that the truth is computed with, as in "MPFR 4.2.0"; of those that are linked
/// dynamically the version that runs.
std::vector<std::string> libraries();

}  // namespace touchstone::oracle
