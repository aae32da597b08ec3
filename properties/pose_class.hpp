#pragma once

#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "properties/draw.hpp"

namespace touchstone {

/// A named family of configurations of one pair.
struct PoseClass {
  std::string name;
  std::string description;  ///< one sentence: the geometry, and why it is hard
  std::function<Configuration(Draw&)> generate;
  bool by_name_only = false;  ///< not in reports and checks of all classes
};

/// All classes of a pair in report order; those that run only when named come last.
const std::vector<PoseClass>& pose_class_table(Pair pair);

/// Throws InvalidInput that lists the pair's classes.
const PoseClass& find_pose_class(Pair pair, std::string_view name);

// The parts of the table, by how the geometry is made.

/// Random orientations, with chosen features in contact.
std::vector<PoseClass> feature_classes(Pair pair);
/// Exactly parallel, perpendicular and touching bodies on a Lattice.
std::vector<PoseClass> lattice_classes(Pair pair);
/// Bodies turned by 3-4-5 angles against each other that touch in a point or along an edge: signed
/// distance zero to the last bit, no cap, side or face aligned with another.
std::vector<PoseClass> touching_tilted_class(Pair pair);
/// Near-parallel and near-perpendicular tilts, aspect ratios, scales, distance from the origin.
std::vector<PoseClass> limit_classes(Pair pair);
/// Combinations of all difficulties; runs only when named.
std::vector<PoseClass> hostile_class(Pair pair);

/// Draws a clearance: an overlap of 1e-6 to 5% of `size`, log-uniform.
double draw_shallow(Draw& draw, double size);
/// Draws a clearance: shallow, or in one of four draws a separation of 1e-6 to 1 of `size`,
/// log-uniform.
double draw_near(Draw& draw, double size);

}  // namespace touchstone
