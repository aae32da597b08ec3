// Exactly degenerate configurations: all lengths and offsets are whole steps of one Lattice.
#include <algorithm>

#include "properties/lattice.hpp"
#include "properties/pose_class.hpp"

namespace touchstone {
namespace {

Steps smallest(const Sizes& s) {
  return std::min({s.radius_a, s.half_a, s.radius_b, s.half_b, s.other_b});
}

/// An overlap of 1e-6 to 5% of the smallest size, in steps.
Steps draw_depth(Draw& draw, const Sizes& s) {
  const double size = static_cast<double>(smallest(s));
  return std::max<Steps>(1, static_cast<Steps>(size * draw.log_uniform(1e-6, 0.05)));
}
using Place = Placement (*)(Draw&, Pair, const Sizes&, Steps depth);

PoseClass exactly(Pair pair, const char* name, const char* description, Place where) {
  return {name, description, [pair, where](Draw& draw) {
            const Lattice lattice(draw);
            const Sizes sizes = draw_sizes(draw, lattice);
            const Steps depth = draw_depth(draw, sizes);
            const Placement p = where(draw, pair, sizes, depth);
            return place(draw, pair, lattice, sizes, p);
          }};
}

// Placements of A, with axes along z unless turned, in exact steps.

Placement parallel_side(Draw& draw, Pair pair, const Sizes& s, Steps depth) {
  const Steps max = pair == Pair::sphere ? s.half_a : (s.half_a + s.half_b) / 2;
  return {s.radius_a + s.radius_b - depth, 0, draw_offset(draw, max)};
}
Placement coaxial(Draw& draw, Pair pair, const Sizes& s, Steps) {
  return {0, 0, draw_offset(draw, s.half_a + reach_b(pair, s))};
}
Placement cap_centred(Draw&, Pair pair, const Sizes& s, Steps depth) {
  return {0, 0, s.half_a + reach_b(pair, s) - depth};
}
/// The offset is small enough that the cap does not miss what it stands on.
Placement cap_offset(Draw& draw, Pair pair, const Sizes& s, Steps depth) {
  const Steps beyond_x = pair == Pair::capsule ? 0 : s.radius_b;
  const Steps beyond_y = pair == Pair::capsule ? 0 : pair == Pair::box ? s.other_b : s.radius_b;
  return {draw_offset(draw, (s.radius_a + beyond_x) / 2),
          draw_offset(draw, (s.radius_a + beyond_y) / 2), s.half_a + reach_b(pair, s) - depth};
}
/// B's end against A's side: B lies along x.
Placement perpendicular_t(Draw& draw, Pair pair, const Sizes& s, Steps depth) {
  return {s.radius_a + reach_b(pair, s) - depth, 0, draw_offset(draw, s.half_a / 2), along_x};
}
/// Sides that cross at a right angle: B lies along x, A stands beside it in y.
Placement perpendicular_x(Draw& draw, Pair, const Sizes& s, Steps depth) {
  return {draw_offset(draw, s.half_b / 2), s.radius_a + s.radius_b - depth,
          draw_offset(draw, s.half_a / 2), along_x};
}
/// A's cap on B's side, B lying along x; B's generator may end inside the cap.
Placement cap_on_side(Draw& draw, Pair, const Sizes& s, Steps depth) {
  return {draw_offset(draw, s.half_b + s.radius_a / 2), draw_offset(draw, s.radius_a / 2),
          s.half_a + s.radius_b - depth, along_x};
}
/// A's side on a face of the box, which is turned so that its z face points along x.
Placement side_on_face(Draw& draw, Pair, const Sizes& s, Steps depth) {
  return {s.radius_a + s.half_b - depth, draw_offset(draw, s.other_b / 2),
          draw_offset(draw, s.half_a / 2), along_x};
}
/// A box's edge across the side at a right angle: the box is turned about y by arctan(3/4), so that
/// its edge lies at ((4 radius_b + 3 half_b)/5, (4 half_b - 3 radius_b)/5) in the x-z plane through
/// the box's centre.
Placement edge_across_side(Draw& draw, Pair, const Sizes& s, Steps depth) {
  const Steps edge_x = (4 * s.radius_b + 3 * s.half_b) / 5;
  const Steps edge_z = (4 * s.half_b - 3 * s.radius_b) / 5;
  return {s.radius_a + edge_x - depth, draw_offset(draw, s.other_b / 2),
          edge_z + draw_offset(draw, s.half_a / 2), Quaternion(3, 0, 1, 0)};
}
Placement same_centre(Draw&, Pair, const Sizes&, Steps) { return {0, 0, 0}; }

/// One of the exact contacts without overlap: σ = 0 to the last bit.
Configuration touching(Draw& draw, Pair pair) {
  const Lattice lattice(draw);
  const Sizes sizes = draw_sizes(draw, lattice);
  std::vector<Place> places = {cap_centred};
  if (pair != Pair::sphere) places.push_back(cap_offset);
  if (pair == Pair::capsule || pair == Pair::cylinder) {
    places.push_back(perpendicular_t);
    places.push_back(perpendicular_x);
    places.push_back(cap_on_side);
  }
  if (pair == Pair::box) places.push_back(side_on_face);
  places.push_back(parallel_side);
  const auto choice = draw.integer(0, static_cast<Steps>(places.size()) - 1);
  const Placement p = places[static_cast<std::size_t>(choice)](draw, pair, sizes, 0);
  return place(draw, pair, lattice, sizes, p);
}

/// The plane is z <= 0 of the lattice; the cylinder stands, or lies along x.
Configuration on_plane(Draw& draw, bool standing, Steps (*draw_overlap)(Draw&, const Sizes&)) {
  const Lattice lattice(draw);
  const Sizes s = draw_sizes(draw, lattice);
  const Steps overlap = draw_overlap(draw, s);
  const Steps height = (standing ? s.half_a : s.radius_a) - overlap;
  return place(draw, Pair::plane, lattice, s,
               {draw_offset(draw, Lattice::metre), draw_offset(draw, Lattice::metre), height,
                upright, standing ? upright : along_x});
}

void add_plane_classes(std::vector<PoseClass>& out) {
  out.push_back({"standing", "A cap lies exactly on the plane: a disc of equally deep points.",
                 [](Draw& draw) { return on_plane(draw, true, draw_depth); }});
  out.push_back({"lying", "A generator lies exactly on the plane: a line of equally deep points.",
                 [](Draw& draw) { return on_plane(draw, false, draw_depth); }});
  out.push_back(
      {"touching", "Standing or lying with distance zero to the last bit.", [](Draw& draw) {
         return on_plane(draw, draw.coin(), [](Draw&, const Sizes&) -> Steps { return 0; });
       }});
}

}  // namespace

std::vector<PoseClass> lattice_classes(Pair pair) {
  std::vector<PoseClass> out;
  const auto add = [&](const char* name, const char* description, Place where) {
    out.push_back(exactly(pair, name, description, where));
  };
  if (pair == Pair::plane) {
    add_plane_classes(out);
    return out;
  }
  add("coaxial",
      "The centre of B is exactly on A's axis, or the axes coincide: radial normals tie.", coaxial);
  if (pair == Pair::sphere) {
    add("cap-on-axis", "The sphere meets the cap exactly in its middle.", cap_centred);
  } else {
    add("parallel-side", "Exactly parallel axes, side by side: the contact is a line.",
        parallel_side);
  }
  if (pair == Pair::capsule || pair == Pair::cylinder) {
    add("perpendicular-t", "B's end meets A's side at exactly a right angle.", perpendicular_t);
    add("perpendicular-x", "Sides crossed at exactly a right angle.", perpendicular_x);
    add("cap-on-side", "B lies exactly across A's cap; its generator may end inside the disc.",
        cap_on_side);
  }
  if (pair == Pair::capsule) {
    add("cap-on-end-centred", "The capsule stands on the middle of the cap, axes in line.",
        cap_centred);
    add("cap-on-end-offset", "The capsule stands on the cap beside its middle.", cap_offset);
  }
  if (pair == Pair::cylinder) {
    add("cap-on-cap-centred",
        "Caps meet face to face with the axes in line: a full disc of contact.", cap_centred);
    add("cap-on-cap-offset", "Caps meet face to face beside each other: a lens of contact.",
        cap_offset);
  }
  if (pair == Pair::box) {
    add("cap-on-face-centred", "The cylinder stands in the middle of a face.", cap_centred);
    add("cap-on-face-offset", "The cylinder stands on a face or over its edge.", cap_offset);
    add("side-on-face", "The side lies exactly along a face.", side_on_face);
    add("perpendicular-x", "An edge of the box crosses the side at exactly a right angle.",
        edge_across_side);
  }
  add("concentric-aligned", "Centres and axes coincide exactly: every tie there is, at once.",
      same_centre);
  out.push_back(
      {"touching",
       "Exactly parallel or perpendicular bodies touch: the signed distance is zero to the "
       "last bit.",
       [pair](Draw& draw) { return touching(draw, pair); }});
  return out;
}

}  // namespace touchstone
