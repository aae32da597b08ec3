#pragma once

#include <map>
#include <string>
#include <utility>
#include <vector>

#include "simulation/scenes/trajectory.hpp"

namespace touchstone {

/// All body pairs of a scene whose shapes have the same kind and sizes: one model serves them.
struct PairKind {
  std::string name;          ///< "cylinder ⌀0.1×0.3 on box 1×1×0.2"
  std::string bodies;        ///< "can-1 and ground", "6 pairs, as can-1 and can-2"
  Pair pair;                 ///< which shape meets the cylinder
  std::vector<Asked> asked;  ///< in order of time
};

/// The kinds that a run asked about, in the order in which they were first asked about.
class PairKinds {
 public:
  PairKinds(const Scene& scene, const Trajectory& run);
  const std::vector<PairKind>& all() const { return kinds_; }
  /// Of these bodies, in either order; −1 if they were never asked about, nor others like them.
  int of(int a, int b) const;

 private:
  std::vector<std::string> shapes_;  ///< by body
  std::map<std::pair<std::string, std::string>, int> index_;
  std::vector<PairKind> kinds_;
};

/// "cylinder ⌀0.1×0.3" (diameter and whole length), "box 1×2×0.5", "sphere ⌀0.2", "plane".
std::string shape_text(const Shape& shape);

}  // namespace touchstone
