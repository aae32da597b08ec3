// Bodies that touch at exact tilts. A meeting is a point of A and a point of B, in body
// coordinates, with opposite normals in the lattice; the two points are made to coincide. A
// rotation by atan(3/4) about a lattice axis has the entries 0, ±3/5, ±4/5 and 1, and a product of
// two has the denominator 25: with sizes that are multiples of 25 steps all supporting points lie
// at whole steps, so that nothing is rounded.
#include <cassert>

#include "properties/lattice.hpp"
#include "properties/pose_class.hpp"

namespace touchstone {
namespace {

const Quaternion pitch(3, 0, 1, 0);       // about y: z to (3, 0, 4)/5, x to (4, 0, -3)/5
const Quaternion roll(3, 1, 0, 0);        // about x: z to (0, -3, 4)/5, y to (0, 4, 3)/5
const Quaternion yaw(3, 0, 0, 1);         // about z: x to (4, 3, 0)/5, y to (-3, 4, 0)/5
const Quaternion askew(9, 3, 3, -1);      // pitch after roll
constexpr Steps common_denominator = 25;  // of pitch, roll, yaw and askew

struct Point {
  Steps x, y, z;
};

Point turned(const Quaternion& turn, const Point& p) {
  const Axes a = axes(turn);
  const double norm =
      ((turn.w() * turn.w() + turn.x() * turn.x()) + turn.y() * turn.y()) + turn.z() * turn.z();
  const Vec3 point{static_cast<double>(p.x), static_cast<double>(p.y), static_cast<double>(p.z)};
  const auto along = [&](int i) {
    const double scaled = (point.x() * a.x[i] + point.y() * a.y[i]) + point.z() * a.z[i];
    const auto steps = static_cast<Steps>(scaled / norm);
    assert(static_cast<double>(steps) * norm == scaled);
    return steps;
  };
  return {along(0), along(1), along(2)};
}

/// The supporting points that coincide, each in its body's coordinates, and the bodies'
/// orientations.
struct Meeting {
  Quaternion turn_a;
  Point on_a;
  Quaternion turn_b;
  Point on_b;
};
using Way = Meeting (*)(Draw&, const Sizes&);

// Points of A, which lies above B (towards z) or beside it (towards x).

Point lowest_of_rim(const Sizes& s) { return {s.radius_a, 0, -s.half_a}; }  // A pitched
Point on_lower_cap(Draw& draw, const Sizes& s) {
  const Steps x = draw_offset(draw, s.radius_a / 2), y = draw_offset(draw, s.radius_a / 2);
  return {x, y, -s.half_a};
}
Point on_side(Draw& draw, const Sizes& s) {
  return {-s.radius_a, 0, draw_offset(draw, s.half_a / 2)};
}

Meeting rim_on_plane(Draw& draw, const Sizes& s) {
  const Steps x = draw_offset(draw, Lattice::metre), y = draw_offset(draw, Lattice::metre);
  return {pitch, lowest_of_rim(s), upright, {x, y, 0}};
}

Meeting sphere_on_rim(Draw&, const Sizes& s) {
  return {pitch, lowest_of_rim(s), upright, {0, 0, s.radius_b}};
}
Meeting sphere_on_cap(Draw& draw, const Sizes& s) {
  return {upright, on_lower_cap(draw, s), upright, {0, 0, s.radius_b}};
}
Meeting sphere_on_side(Draw& draw, const Sizes& s) {
  return {upright, on_side(draw, s), upright, {s.radius_b, 0, 0}};
}

Meeting end_on_rim(Draw&, const Sizes& s) {
  return {pitch, lowest_of_rim(s), upright, {0, 0, s.half_b + s.radius_b}};
}
Meeting end_on_cap(Draw& draw, const Sizes& s) {
  const Point highest{-3 * s.radius_b / 5, 0, s.half_b + 4 * s.radius_b / 5};
  return {upright, on_lower_cap(draw, s), pitch, highest};
}
Meeting end_on_side(Draw& draw, const Sizes& s) {
  const Point foremost{4 * s.radius_b / 5, 0, s.half_b + 3 * s.radius_b / 5};
  return {upright, on_side(draw, s), pitch, foremost};
}

/// B lies along x, under the rim.
Meeting rim_on_side(Draw& draw, const Sizes& s) {
  return {pitch, lowest_of_rim(s), along_x, {-s.radius_b, 0, draw_offset(draw, s.half_b / 2)}};
}
Meeting rim_on_cap(Draw& draw, const Sizes& s) {
  const Steps x = draw_offset(draw, s.radius_b / 2), y = draw_offset(draw, s.radius_b / 2);
  return {pitch, lowest_of_rim(s), upright, {x, y, s.half_b}};
}
Meeting rim_on_rim(Draw&, const Sizes& s) {
  return {pitch, lowest_of_rim(s), roll, {0, s.radius_b, s.half_b}};
}

Meeting rim_on_face(Draw& draw, const Sizes& s) {
  const Steps x = draw_offset(draw, s.radius_b / 2), y = draw_offset(draw, s.other_b / 2);
  return {pitch, lowest_of_rim(s), upright, {x, y, s.half_b}};
}
Meeting edge_on_cap(Draw& draw, const Sizes& s) {
  const Point on_a = on_lower_cap(draw, s);
  return {upright, on_a, pitch, {-s.radius_b, draw_offset(draw, s.other_b / 2), s.half_b}};
}
Meeting edge_across_rim(Draw& draw, const Sizes& s) {
  const Point lowest_rolled{0, -s.radius_a, -s.half_a};
  return {roll, lowest_rolled, pitch, {-s.radius_b, draw_offset(draw, s.other_b / 2), s.half_b}};
}
Meeting edge_across_side(Draw& draw, const Sizes& s) {
  const Point on_a = on_side(draw, s);
  return {upright, on_a, pitch, {s.radius_b, draw_offset(draw, s.other_b / 2), s.half_b}};
}
Meeting edge_along_side(Draw& draw, const Sizes& s) {
  const Point on_a = on_side(draw, s);
  return {upright, on_a, yaw, {s.radius_b, -s.other_b, draw_offset(draw, s.half_b / 2)}};
}
Meeting vertex_on_cap(Draw& draw, const Sizes& s) {
  return {upright, on_lower_cap(draw, s), askew, {-s.radius_b, s.other_b, s.half_b}};
}
Meeting vertex_on_side(Draw& draw, const Sizes& s) {
  return {upright, on_side(draw, s), askew, {s.radius_b, s.other_b, s.half_b}};
}
Meeting vertex_on_rim(Draw&, const Sizes& s) {
  return {pitch, lowest_of_rim(s), askew, {-s.radius_b, s.other_b, s.half_b}};
}

std::vector<Way> ways_of(Pair pair) {
  switch (pair) {
    case Pair::plane:
      return {rim_on_plane};
    case Pair::sphere:
      return {sphere_on_rim, sphere_on_cap, sphere_on_side};
    case Pair::capsule:
      return {end_on_rim, end_on_cap, end_on_side, rim_on_side};
    case Pair::cylinder:
      return {rim_on_side, rim_on_cap, rim_on_rim};
    case Pair::box:
    case Pair::convex:
      break;
  }
  return {rim_on_face,     edge_on_cap,   edge_across_rim, edge_across_side,
          edge_along_side, vertex_on_cap, vertex_on_side,  vertex_on_rim};
}

Sizes draw_divisible_sizes(Draw& draw, const Lattice& lattice, const Modifiers& modifiers) {
  const auto divisible = [](Steps s) { return s - s % common_denominator; };
  const Sizes s = draw_sizes(draw, lattice, modifiers);
  return {divisible(s.radius_a), divisible(s.half_a),  divisible(s.radius_b),
          divisible(s.half_b),   divisible(s.other_b), s.hull};
}

}  // namespace

Arrangement touching_tilted(Pair pair) {
  const auto generate = [pair, ways = ways_of(pair)](Draw& draw, const Modifiers& modifiers) {
    const Lattice lattice(draw, modifiers.frame());
    const Sizes sizes = draw_divisible_sizes(draw, lattice, modifiers);
    const auto choice = draw.integer(0, static_cast<Steps>(ways.size()) - 1);
    const Meeting m = ways[static_cast<std::size_t>(choice)](draw, sizes);
    const Point a = turned(m.turn_a, m.on_a), b = turned(m.turn_b, m.on_b);
    return place(draw, pair, lattice, sizes, {b.x - a.x, b.y - a.y, b.z - a.z, m.turn_b, m.turn_a});
  };
  Arrangement result{"touching-tilted",
                     "Bodies turned by 3-4-5 angles touch in a point or along an edge, at distance "
                     "zero to the last bit: rims, edges and vertices with nothing aligned to say "
                     "which normal counts.",
                     Arrangement::Orientations::pitched,
                     {},
                     generate};
  result.touches = true;
  return result;
}

}  // namespace touchstone
