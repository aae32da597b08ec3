#include "simulation/resolution.hpp"

#include <cmath>

#include "simulation/experiment_bodies.hpp"
#include "simulation/world.hpp"

namespace touchstone {

double sinking(double seconds) { return constraint_mixing * gravity * seconds; }

double lean_within_layer(double layer, double width) { return layer / width; }

double way_within_layer(double layer, double width, double height, double reach) {
  return layer + lean_within_layer(layer, width) * (height + reach);
}

// Energy: (gyration × rate)² / 2 = g × arm × lean.
double way_of_late_landing(double lean, double arm, double gyration, double across, double step) {
  return across * std::sqrt(2 * gravity * arm * lean) / gyration * step;
}

double bisected(int halvings) { return std::ldexp(0.5, -halvings); }

}  // namespace touchstone
