#pragma once

#include <functional>
#include <vector>

#include "candidates/rounded_polytope.hpp"

namespace touchstone {

/// What stands for a cylinder of that radius and half length, in its frame.
using CylinderModel =
    std::function<std::vector<RoundedPolytope>(double radius, double half_length)>;

/// Two shapes in which every cylinder is replaced by its model; the other shapes are themselves.
class ModelPair {
 public:
  ModelPair(const ts_shape& a, const ts_shape& b, const CylinderModel& model);

  /// Of the two parts that overlap most. When `all` is given, that of every part of A with the part
  /// of B closest to it, too.
  Separation separation(const ts_pose& a, const ts_pose& b, std::vector<Separation>* all = nullptr);

 private:
  std::vector<RoundedPolytope> a_, b_;
  ts_shape plane_{};
  bool is_plane_;
};

/// A capsule of the cylinder's length and, if it is no longer than wide, of its half length as
/// radius: it lies inside.
std::vector<RoundedPolytope> inscribed_capsule(double radius, double half_length);
/// A capsule around the cylinder's axis from cap to cap, of its radius: the cylinder lies inside.
std::vector<RoundedPolytope> circumscribed_capsule(double radius, double half_length);
/// Spheres that lie inside: in a row along the axis when the cylinder is longer than wide, else on
/// a ring as wide as it allows, beginning on +x.
std::vector<RoundedPolytope> inscribed_spheres(int count, double radius, double half_length);
/// The prism with its corners on the rims.
std::vector<RoundedPolytope> inscribed_prism(int sides, double radius, double half_length);

}  // namespace touchstone
