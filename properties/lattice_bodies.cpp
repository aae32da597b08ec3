#include "properties/lattice_bodies.hpp"

#include <stdexcept>

namespace touchstone {
namespace {

Shape other_shape(Pair pair, const Lattice& l, const Sizes& s) {
  switch (pair) {
    case Pair::plane:
      return Plane(Vec3(0, 0, 1), 0);
    case Pair::sphere:
      return Sphere(l.length(s.radius_b));
    case Pair::capsule:
      return Capsule(l.length(s.radius_b), l.length(s.half_b));
    case Pair::cylinder:
      return Cylinder(l.length(s.radius_b), l.length(s.half_b));
    case Pair::box:
      return Box(Vec3(l.length(s.radius_b), l.length(s.other_b), l.length(s.half_b)));
  }
  throw std::logic_error("no such pair");
}

}  // namespace

Sizes draw_sizes(Draw& draw, const Lattice& lattice) {
  const auto size = [&] { return lattice.draw_size(draw); };
  return {size(), size(), size(), size(), size()};
}

Steps draw_offset(Draw& draw, Steps most) { return draw.integer(-most, most); }

Steps reach_b(Pair pair, const Sizes& s) {
  if (pair == Pair::capsule) return s.half_b + s.radius_b;
  return pair == Pair::sphere ? s.radius_b : s.half_b;
}

Configuration place(Draw& draw, Pair pair, const Lattice& l, const Sizes& s, const Placement& p) {
  const Steps x = draw_offset(draw, Lattice::metre), y = draw_offset(draw, Lattice::metre),
              z = draw_offset(draw, Lattice::metre);
  return {Cylinder(l.length(s.radius_a), l.length(s.half_a)),
          Pose(l.at(x + p.x, y + p.y, z + p.z), l.orientation(p.turn_a)), other_shape(pair, l, s),
          Pose(l.at(x, y, z), l.orientation(p.turn_b))};
}

}  // namespace touchstone
