#pragma once

namespace touchstone {

// What experiments resolve: how far from the paper exact contacts may end, whichever points they
// consist of. It follows from the overlap at the start, World's settings, the step and the
// bisection, and from nothing that a candidate did. docs/simulation.md has the sums.

/// Metres that what rests on something overlaps it by at the start. Rigid bodies touch: an overlap
/// makes levers uncertain by as much, wherever in it a routine puts its points. This is a million
/// times the spacing of doubles in these scenes. Engines that see no depth so small let bodies sink
/// until they do.
inline constexpr double touching = 1e-9;

/// Metres that a contact gives way by under a body's weight: its speed is CFM times force.
double sinking(double seconds);

/// Radians that a body may lean by on the surface layer, in which all depths are alike to the
/// solver. The support is `width` metres across the narrowest way.
double lean_within_layer(double layer, double width);
/// Metres that a point `reach` from the body's centre, which is `height` above the support, may
/// move by on the surface layer: sinking, and leaning.
double way_within_layer(double layer, double width, double height, double reach);

/// Metres that a body may be pushed by when it comes down. It leans by a small angle on an edge,
/// its centre `arm` beyond, its radius of gyration about the edge `gyration`, and turns on to a
/// point `across` from the edge. That point is found up to one step late, this much too deep.
double way_of_late_landing(double lean, double arm, double gyration, double across, double step);

/// What bisection leaves of an interval's middle either way, as a share of the interval.
double bisected(int halvings);

}  // namespace touchstone
