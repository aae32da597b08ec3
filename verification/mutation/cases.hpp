#pragma once

#include <cstdint>
#include <cstdio>
#include <string>
#include <vector>

#include "reference/configuration.hpp"
#include "verification/mutation/routines.hpp"

namespace touchstone::mutation {

/// The contact patch along one of the optimal normals, where it is more than a point. Where it is
/// one because the bodies lean, it is what both have within a part of the manifold's slack of their
/// support planes, for points asked for within `leaning_threshold` of the smaller size.
struct KnownPatch {
  Numbers3 normal;
  double leans;                   ///< 1 or 0
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
constexpr double leaning_threshold = 0.01;

/// Caches configurations with their truths, which take far longer than answers and are the same for
/// all mutants: `count` of each pair and pose class of the default report, or `count` of the
/// hostile class of each pair (an eighth for pairs without a search) and of hulls of all kinds
/// (reference/random_hulls_test.hpp).
void write_cases(const std::string& file, const std::string& net, std::uint64_t count);

/// Reads them one by one: most faults are found in the first few.
class CaseReader {
 public:
  explicit CaseReader(const std::string& file);
  ~CaseReader() { std::fclose(file_); }
  CaseReader(const CaseReader&) = delete;
  CaseReader& operator=(const CaseReader&) = delete;

  bool next(Case& c);

 private:
  std::FILE* file_;
};

RawConfiguration raw(const Configuration& configuration);

constexpr std::uint64_t case_seed = 17;

/// The configuration `index` of those that are asked without their truths: hostile ones that are
/// not in the cache; every fourth has two normals that nearly tie, of two cylinders another fourth
/// has rims that meet along a normal of any direction, and every 64th has lengths at the end of
/// what a double holds. Of hulls they are any of all kinds.
Case without_truth(int pair, std::uint64_t index);

}  // namespace touchstone::mutation
