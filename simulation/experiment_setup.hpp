#pragma once

#include <cmath>
#include <numbers>
#include <string>

#include "properties/moves.hpp"
#include "simulation/world.hpp"

// What the experiments share: the bodies of their scenes, and the bounds within which exact
// contacts meet the value on paper.
namespace touchstone {

inline constexpr double gravity = 9.81;     ///< m/s², along -z
inline constexpr double can_radius = 0.25;  ///< m
inline constexpr double can_half_length = 0.5;
inline const Cylinder can(can_radius, can_half_length);
inline constexpr double steel = 7800;  ///< kg/m³

inline double radians(double degrees) { return degrees * std::numbers::pi / 180; }

inline Scene scene_for(double step, double duration) {
  Scene scene;
  scene.step = step;
  scene.duration = duration;
  return scene;
}
inline Body fixed_body(const std::string& name, const Shape& shape, double friction,
                       const Pose& pose = {}) {
  return {name, shape, steel, {friction, 0}, pose, Vec3::Zero(), Vec3::Zero(), true};
}
inline Body moving_body(const std::string& name, const Shape& shape, double friction,
                        const Pose& pose) {
  return {name, shape, steel, {friction, 0}, pose};
}
inline Body ground(double friction) {
  return fixed_body("ground", Plane(Vec3::UnitZ(), 0), friction);
}

/// Rotates the local z, a cylinder's axis, to the world's x, up to rounding. The exact `along_x`
/// would change documented results: chaotic ones depend on the last bits (log-pile with Bullet).
inline Eigen::Quaterniond level() { return about(Vec3::UnitY(), std::numbers::pi / 2); }

/// The can's radius of gyration, metres, about a line parallel to a diameter of its caps: at
/// distance `from_axis` from its axis and, measured along the axis, `from_middle` from its centre.
inline double can_gyration(double from_axis, double from_middle) {
  return std::sqrt(can_radius * can_radius / 4 + can_half_length * can_half_length / 3 +
                   from_axis * from_axis + from_middle * from_middle);
}

/// Overlap, metres, of touching bodies at the start. Rigid bodies touch without overlap: an overlap
/// makes levers uncertain by as much, wherever in it a routine puts its points. This one is a
/// million times the spacing of doubles in these scenes. Engines that do not see so small a depth
/// let bodies sink until they do.
inline constexpr double touching = 1e-9;

/// Overlap, metres, of stacked bodies at the start: the middle of the surface layer, so that the
/// residual of the solver opens no contact. Nothing depends on this overlap.
inline double middle_of_layer(const Scene& scene) { return scene.surface_layer / 2; }

/// Kinetic energy, in weight × size, below which a body is at rest: a thousandth of what a fall of
/// one step gives, which is about what an iterative solver leaves of it.
inline double rest_energy(double step, double size) {
  return 1e-3 * gravity * step * step / (2 * size);
}

// Resolution of an experiment: how far from the value on paper exact contacts may end, whichever
// points they consist of. It follows from the overlap at the start, the world's settings, the step
// and the bisection alone, never from what a candidate did.

/// Distance, metres, by which a contact yields under a body's weight: its speed is CFM times force.
inline double sinking(double seconds) { return constraint_mixing * gravity * seconds; }

/// Angle, radians, by which a body may lean on the surface layer, within which all depths are alike
/// to the solver. `width`: that of the support across its narrowest direction, metres.
inline double lean_within_layer(double layer, double width) { return layer / width; }

/// Distance, metres, by which sinking and leaning within the surface layer may move a point `reach`
/// from the centre of a body whose centre is `height` above the support.
inline double displacement_within_layer(double layer, double width, double height, double reach) {
  return layer + lean_within_layer(layer, width) * (height + reach);
}

/// Distance, metres, by which a body may be pushed when it lands. It leans by a small angle on an
/// edge, its centre `arm` beyond the edge, with radius of gyration `gyration` about it, and rotates
/// until a point `across` from the edge lands. That point is found up to one step late, and so too
/// deep. Energy: (gyration × rate)² / 2 = g × arm × lean.
inline double displacement_of_late_landing(double lean, double arm, double gyration, double across,
                                           double step) {
  return across * std::sqrt(2 * gravity * arm * lean) / gyration * step;
}

/// Half width of the interval that bisection leaves, as a share of the initial interval.
inline double bisected(int halvings) { return std::ldexp(0.5, -halvings); }

}  // namespace touchstone
