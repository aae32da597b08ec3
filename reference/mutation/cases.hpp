#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "reference/mutation/routines.hpp"

namespace touchstone::mutation {

/// The contact patch along one of the optimal normals, where it is more than a point.
struct KnownPatch {
  Numbers3 normal;
  std::vector<Numbers3> outline;  ///< corners in order, arcs as chords
};

/// A configuration, and what the oracle knows of it.
struct Case {
  std::string identity;
  RawConfiguration raw;
  long double signed_distance;
  std::vector<Numbers3> normals;  ///< optimal ones
  std::vector<KnownPatch> patches;
};

/// Of every pair `per_class` configurations of each pose class of the default report, or `hostile`
/// of the hostile class.
std::vector<Case> make_cases(const std::string& net, std::uint64_t count);

// The cache: truths take far longer than answers and are the same for all mutants.
void write_cases(const std::string& file, const std::vector<Case>& cases);
std::vector<Case> read_cases(const std::string& file);

}  // namespace touchstone::mutation
