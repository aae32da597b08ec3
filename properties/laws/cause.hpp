#pragma once

#include <string>
#include <vector>

#include "properties/laws/check.hpp"
#include "properties/laws/failure_file.hpp"

namespace touchstone {

/// The features of both bodies that meet along the optimal normal, A's first, as in "rim-face": of
/// a cylinder cap, side or rim, of a capsule side or end, of a box face, edge or vertex. A normal
/// within 1e-6 rad of an axis counts as along it, since no engine tells them apart. "tied" where
/// several normals are optimal.
std::string meeting_features(const Configuration& configuration);

/// What failures have in common that are likely to have one cause.
struct Cause {
  std::string law;
  Pair pair;
  std::string features, failure;

  bool operator==(const Cause&) const = default;
  bool operator<(const Cause& other) const;
};
Cause cause_of(const Failure& failure);
/// "agreement, cylinder-box, rim-face, missed"
std::string to_string(const Cause& cause);

/// Those of all laws, the one to start with first: in the order of the laws, for a routine that
/// breaks one often breaks later ones by it; of a law the most frequent first, then the simplest.
std::vector<Failure> in_order(const std::vector<LawResult>& results);

/// The results without failures whose cause is that of a known one; what is left is new.
std::vector<LawResult> new_ones(std::vector<LawResult> results, const std::vector<Failure>& known);

}  // namespace touchstone
