#pragma once

#include <functional>
#include <string>
#include <vector>

#include "properties/draw.hpp"

namespace touchstone {

/// A named family of configurations of one pair.
struct PoseClass {
  std::string name;
  std::string description;  ///< one sentence: which geometry, and why it is hard
  std::function<Configuration(Draw&)> generate;
  bool by_name_only = false;  ///< part of no report or check that asks for all classes
};

/// In report order, those that are asked for by name only at the end.
const std::vector<PoseClass>& pose_class_table(Pair pair);

// The parts of the table, by how the geometry is made.

/// Random orientations, with chosen features brought together.
std::vector<PoseClass> feature_classes(Pair pair);
/// Exactly parallel, perpendicular and touching bodies on a Lattice.
std::vector<PoseClass> lattice_classes(Pair pair);
/// Near-parallel and near-perpendicular tilts, aspect ratios, scales, distance from the origin.
std::vector<PoseClass> limit_classes(Pair pair);
/// What nobody thought of, by name only.
std::vector<PoseClass> hostile_class(Pair pair);

/// A clearance relative to `size`: overlap of 1e-6 to 5%, log-uniform.
double draw_shallow(Draw& draw, double size);
/// Mostly shallow, one in four apart by 1e-6 to 1, log-uniform.
double draw_near(Draw& draw, double size);

}  // namespace touchstone
