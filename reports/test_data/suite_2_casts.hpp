#pragma once

#include <string>
#include <vector>

#include "candidates/host/ask_cast.hpp"
#include "reports/test_data/cast_limits.hpp"

namespace touchstone {

/// One cast of touchstone-suite-2, whose numbers are exact in single precision.
struct CastDatum {
  std::string id;  ///< "cylinder-box/head-on-cap"
  Group group;
  std::string about;  ///< what it is and why it is hard
  CastQuestion cast;
  oracle::FirstTouch truth;
  CastLimits limits, float_limits;  ///< of a routine in double and in single precision
};

/// The casts of touchstone-suite-2: pair by pair, everyday ones first.
std::vector<CastDatum> suite_2_casts();

/// The file of them: CSV beneath its licence, which ends with how many there are.
std::string cast_csv(const std::vector<CastDatum>& casts);

}  // namespace touchstone
