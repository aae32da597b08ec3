#pragma once

#include <optional>
#include <vector>

#include "simulation/assembly.hpp"

namespace touchstone {

/// How an assembly hangs in the tree that hinges and sliders make.
struct Hanging {
  int joint = -1;   ///< index of the joint that it hangs on; −1: it is free, fixed or driven
  int parent = -1;  ///< index of the driven or free assembly that it hangs on; −1: of the world
  std::vector<int> children = {};  ///< assemblies that hang on it
};

/// By assembly, for engines that know the position of a body relative to another one. A tree that
/// nothing fixed or driven holds has the first assembly as its root that is no joint's first one.
/// Precondition: no joint closes a loop.
std::vector<Hanging> kinematic_tree(const Scene& scene, const std::vector<Assembly>& assemblies);

/// Index of the first hinge or slider between assemblies that earlier ones connect already, if only
/// through what is fixed or driven.
std::optional<int> loop_closing_joint(const Scene& scene);

}  // namespace touchstone
