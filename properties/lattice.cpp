// Exactly degenerate configurations: all lengths and offsets are whole steps of one Lattice.
#include "properties/lattice.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <initializer_list>

#include "oracle/hull.hpp"
#include "properties/pose_class.hpp"

namespace touchstone {

Lattice::Lattice(Draw& draw, Frame frame) {
  do {
    const auto entry = [&] { return static_cast<double>(draw.integer(-4, 4)); };
    const double w = entry(), x = entry(), y = entry(), z = entry();
    q_ = Eigen::Quaterniond(w, x, y, z);
    norm_ = w * w + x * x + y * y + z * z;
  } while (norm_ == 0);
  if (frame == Frame::aligned) {
    q_ = Eigen::Quaterniond(1, 0, 0, 0);
    norm_ = 1;
  }
  // The largest power of two with norm · scale · metre <= 1 metre.
  int exponent = 0;
  std::frexp(norm_, &exponent);
  scale_ = std::ldexp(1, -25 - exponent);
}

double Lattice::length(std::int64_t steps) const {
  return static_cast<double>(steps) * norm_ * scale_;
}

Vec3 Lattice::at(std::int64_t x, std::int64_t y, std::int64_t z) const {
  const Axes a = axes(q_);
  const double i = static_cast<double>(x), j = static_cast<double>(y), k = static_cast<double>(z);
  // Sums of integers below 2^53, times a power of two: exact.
  return Vec3(((i * a.x.x() + j * a.y.x()) + k * a.z.x()) * scale_,
              ((i * a.x.y() + j * a.y.y()) + k * a.z.y()) * scale_,
              ((i * a.x.z() + j * a.y.z()) + k * a.z.z()) * scale_);
}

Eigen::Quaterniond Lattice::orientation(const Eigen::Quaterniond& turn) const {
  return product(q_, turn);
}

namespace {

/// A triangle with the edge x = radius_b, three times as long as the box's, about the box's middle
/// section.
std::vector<Vec3> triangle_points(const Lattice& l, const Sizes& s) {
  const auto point = [&](Steps x, Steps y) { return Vec3(l.length(x), l.length(y), 0); };
  return {point(s.radius_b, -3 * s.other_b), point(s.radius_b, 3 * s.other_b),
          point(-5 * s.radius_b, 0)};
}

/// A box, some of whose corners are cut off by up to a sixteenth of each edge: never those two on
/// which bodies touch that are turned by 3-4-5 angles.
std::vector<Vec3> cut_box_points(Draw& draw, const Lattice& l, const Sizes& s) {
  const std::array<Steps, 3> half = {s.radius_b, s.other_b, s.half_b};
  std::vector<Vec3> points;
  for (int corner = 0; corner < 8; ++corner) {
    std::array<Steps, 3> at = half;
    for (int i = 0; i < 3; ++i) {
      if ((corner >> i & 1) != 0) at[static_cast<std::size_t>(i)] *= -1;
    }
    const auto point = [&](const std::array<Steps, 3>& steps) {
      return Vec3(l.length(steps[0]), l.length(steps[1]), l.length(steps[2]));
    };
    const bool is_whole = s.hull == HullForm::of_box || (at[1] > 0 && at[2] > 0);
    if (is_whole || draw.coin()) {
      points.push_back(point(at));
      continue;
    }
    for (std::size_t i = 0; i < 3; ++i) {
      std::array<Steps, 3> on_edge = at;
      const Steps cut = draw.integer(1, std::max<Steps>(1, half[i] / 8));
      on_edge[i] += at[i] > 0 ? -cut : cut;
      points.push_back(point(on_edge));
    }
  }
  return points;
}

Shape other_shape(Draw& draw, Pair pair, const Lattice& l, const Sizes& s) {
  switch (pair) {
    case Pair::plane:
      return Plane(Vec3(0, 0, 1), 0);
    case Pair::sphere:
      return Sphere(l.length(s.radius_b));
    case Pair::capsule:
      return Capsule(l.length(s.radius_b), l.length(s.half_b));
    case Pair::cylinder:
      return Cylinder(l.length(s.radius_b), l.length(s.half_b));
    case Pair::convex:
      return oracle::convex_hull(s.hull == HullForm::triangle ? triangle_points(l, s)
                                                              : cut_box_points(draw, l, s));
    case Pair::box:
      break;
  }
  return Box(Vec3(l.length(s.radius_b), l.length(s.other_b), l.length(s.half_b)));
}

}  // namespace

Sizes draw_sizes(Draw& draw, const Lattice& lattice, const Modifiers& modifiers) {
  const Proportions proportions = modifiers.proportions();
  const auto size = [&] { return lattice.draw_size(draw); };
  Sizes s{size(), size(), size(), size(), size(), modifiers.hull()};
  const auto form = [](Form f, Steps& radius, Steps& half) {
    if (f == Form::usual) return;
    half = radius;
    (f == Form::needle ? radius : half) /= extreme_ratio;
  };
  const auto [form_a, form_b] = forms(proportions);
  form(form_a, s.radius_a, s.half_a);
  form(form_b, s.radius_b, s.half_b);
  const auto divide = [](std::initializer_list<Steps*> lengths, Steps by) {
    for (Steps* length : lengths) *length /= by;
  };
  if (proportions == Proportions::plate) {
    const std::array<bool, 3> is_thin = draw_thin_extents(draw);
    s.other_b = s.half_b = s.radius_b;
    if (is_thin[0]) divide({&s.radius_b}, extreme_ratio);
    if (is_thin[1]) divide({&s.other_b}, extreme_ratio);
    if (is_thin[2]) divide({&s.half_b}, extreme_ratio);
  } else if (proportions == Proportions::uneven) {
    const std::int64_t ratio = draw_uneven_ratio(draw);
    if (draw.coin()) {
      divide({&s.radius_a, &s.half_a}, ratio);
    } else {
      divide({&s.radius_b, &s.half_b, &s.other_b}, ratio);
    }
  }
  if (s.hull == HullForm::triangle) s.half_b = 0;
  return s;
}

Steps draw_offset(Draw& draw, Steps max) { return draw.integer(-max, max); }

Steps reach_b(Pair pair, const Sizes& s) {
  if (pair == Pair::capsule) return s.half_b + s.radius_b;
  return pair == Pair::sphere ? s.radius_b : s.half_b;
}

Configuration place(Draw& draw, Pair pair, const Lattice& l, const Sizes& s, const Placement& p) {
  const Steps x = draw_offset(draw, Lattice::metre), y = draw_offset(draw, Lattice::metre),
              z = draw_offset(draw, Lattice::metre);
  return {Cylinder(l.length(s.radius_a), l.length(s.half_a)),
          Pose(l.at(x + p.x, y + p.y, z + p.z), l.orientation(p.turn_a)),
          other_shape(draw, pair, l, s), Pose(l.at(x, y, z), l.orientation(p.turn_b))};
}

Steps draw_depth(Draw& draw, const Sizes& s, Clearance clearance) {
  Steps smallest = std::min({s.radius_a, s.half_a, s.radius_b, s.other_b});
  if (s.half_b > 0) smallest = std::min(smallest, s.half_b);
  const auto size = static_cast<double>(smallest);
  const auto steps = [&](double part) {
    return std::max<Steps>(1, static_cast<Steps>(size * part));
  };
  switch (clearance) {
    case Clearance::apart:
      return -steps(draw.log_uniform(1e-6, 1));
    case Clearance::touching:
      return 0;
    case Clearance::deep:
      return steps(draw.uniform(0.1, 1));
    default:
      return steps(draw.log_uniform(1e-6, 0.05));
  }
}

namespace {

using Place = Placement (*)(Draw&, Pair, const Sizes&, Steps depth);

Configuration placed(Draw& draw, Pair pair, Clearance clearance, const Modifiers& m,
                     const std::vector<Place>& places) {
  const Lattice lattice(draw, m.frame());
  const Sizes sizes = draw_sizes(draw, lattice, m);
  const Steps depth = draw_depth(draw, sizes, clearance);
  const Place where = places.size() == 1 ? places.front() : draw.any_of(places);
  const Placement p = where(draw, pair, sizes, depth);
  return place(draw, pair, lattice, sizes, p);
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
  const Steps beyond_y = pair == Pair::capsule ? 0 : has_faces(pair) ? s.other_b : s.radius_b;
  return {draw_offset(draw, (s.radius_a + beyond_x) / 2),
          draw_offset(draw, (s.radius_a + beyond_y) / 2), s.half_a + reach_b(pair, s) - depth};
}
/// B's end against A's side: B lies along x.
Placement perpendicular_t(Draw& draw, Pair pair, const Sizes& s, Steps depth) {
  return {s.radius_a + reach_b(pair, s) - depth, 0, draw_offset(draw, s.half_a / 2), along_x};
}
Placement perpendicular_t_centred(Draw&, Pair pair, const Sizes& s, Steps depth) {
  return {s.radius_a + reach_b(pair, s) - depth, 0, 0, along_x};
}
/// Sides that cross at a right angle: B lies along x, A stands beside it in y.
Placement perpendicular_x(Draw& draw, Pair, const Sizes& s, Steps depth) {
  return {draw_offset(draw, s.half_b / 2), s.radius_a + s.radius_b - depth,
          draw_offset(draw, s.half_a / 2), along_x};
}
Placement perpendicular_x_centred(Draw&, Pair, const Sizes& s, Steps depth) {
  return {0, s.radius_a + s.radius_b - depth, 0, along_x};
}
/// A's cap on B's side, B lying along x; B's generator may end inside the cap.
Placement cap_on_side(Draw& draw, Pair, const Sizes& s, Steps depth) {
  return {draw_offset(draw, s.half_b + s.radius_a / 2), draw_offset(draw, s.radius_a / 2),
          s.half_a + s.radius_b - depth, along_x};
}
Placement cap_on_side_centred(Draw&, Pair, const Sizes& s, Steps depth) {
  return {0, 0, s.half_a + s.radius_b - depth, along_x};
}
/// A's side on a face of B, which is turned so that its z face points along x.
Placement side_on_face(Draw& draw, Pair, const Sizes& s, Steps depth) {
  return {s.radius_a + s.half_b - depth, draw_offset(draw, s.other_b / 2),
          draw_offset(draw, s.half_a / 2), along_x};
}
Placement side_on_face_centred(Draw&, Pair, const Sizes& s, Steps depth) {
  return {s.radius_a + s.half_b - depth, 0, 0, along_x};
}
/// An edge across the side at a right angle: B is turned about y by arctan(3/4), so that its edge
/// lies at ((4 radius_b + 3 half_b)/5, (4 half_b - 3 radius_b)/5) in the x-z plane through B's
/// centre, but for less than a step.
Placement edge_across_side(Draw& draw, Pair, const Sizes& s, Steps depth) {
  const Steps edge_x = (4 * s.radius_b + 3 * s.half_b) / 5;
  const Steps edge_z = (4 * s.half_b - 3 * s.radius_b) / 5;
  return {s.radius_a + edge_x - depth, draw_offset(draw, s.other_b / 2),
          edge_z + draw_offset(draw, s.half_a / 2), Quaternion(3, 0, 1, 0)};
}
Placement same_centre(Draw&, Pair, const Sizes&, Steps) { return {0, 0, 0}; }

/// The cylinder stands on the plane, z <= 0 of the lattice, or lies along x.
Placement standing(Draw& draw, Pair, const Sizes& s, Steps depth) {
  const Steps x = draw_offset(draw, Lattice::metre), y = draw_offset(draw, Lattice::metre);
  return {x, y, s.half_a - depth};
}
Placement lying(Draw& draw, Pair, const Sizes& s, Steps depth) {
  const Steps x = draw_offset(draw, Lattice::metre), y = draw_offset(draw, Lattice::metre);
  return {x, y, s.radius_a - depth, upright, along_x};
}

/// All exact contacts of bodies that are both bounded.
std::vector<Place> contacts(Pair pair) {
  std::vector<Place> places = {cap_centred};
  if (pair != Pair::sphere) places.push_back(cap_offset);
  if (pair == Pair::capsule || pair == Pair::cylinder) {
    places.push_back(perpendicular_t);
    places.push_back(perpendicular_x);
    places.push_back(cap_on_side);
  }
  if (has_faces(pair)) places.push_back(side_on_face);
  places.push_back(parallel_side);
  return places;
}

const std::vector<Clearance> any_clearance = {Clearance::apart, Clearance::touching,
                                              Clearance::deep};

/// Collects arrangements of one pair.
struct Collector {
  Pair pair;
  std::vector<Arrangement> all;

  using Generate = decltype(Arrangement::generate);
  Arrangement& add(const char* name, const char* description, std::vector<Clearance> clearances,
                   Generate generate) {
    all.push_back({name, description, Arrangement::Orientations::exact, std::move(clearances),
                   std::move(generate)});
    return all.back();
  }
  Generate at(Place where) const {
    return [pair = pair, where](Draw& draw, const Modifiers& m) {
      return placed(draw, pair, m.clearance(), m, {where});
    };
  }
  Arrangement& contact(const char* name, const char* description, Place where) {
    Arrangement& result = add(name, description, any_clearance, at(where));
    result.own = Clearance::shallow;
    return result;
  }
  void across(const char* name, const char* description, Place where) {
    contact(name, description, where).across = true;
  }
  /// Where the bodies lie is all that there is to say of their clearance.
  void symmetric(const char* name, const char* description, Place where) {
    add(name, description, {}, at(where)).is_symmetric = true;
  }
};

}  // namespace

std::vector<Arrangement> lattice_arrangements(Pair pair) {
  Collector c{pair, {}};
  if (pair == Pair::plane) {
    c.contact("standing", "A cap lies exactly on the plane: a disc of equally deep points.",
              standing);
    c.across("lying", "A generator lies exactly on the plane: a line of equally deep points.",
             lying);
  } else {
    c.symmetric("coaxial",
                "The centre of B is exactly on A's axis, or the axes coincide: radial normals tie.",
                coaxial);
  }
  if (pair == Pair::sphere) {
    c.contact("cap-on-axis", "The sphere meets the cap exactly in its middle.", cap_centred);
  } else if (pair != Pair::plane) {
    c.contact("parallel-side", "Exactly parallel axes, side by side: the contact is a line.",
              parallel_side);
  }
  if (pair == Pair::capsule || pair == Pair::cylinder) {
    c.across("perpendicular-t", "B's end meets A's side at exactly a right angle.",
             perpendicular_t);
    c.across("perpendicular-x", "Sides crossed at exactly a right angle.", perpendicular_x);
    c.across("cap-on-side", "B lies exactly across A's cap; its generator may end inside the disc.",
             cap_on_side);
    c.across("perpendicular-t-centred",
             "B's end meets the middle of A's side: its axis passes through A's centre.",
             perpendicular_t_centred);
    c.across("perpendicular-x-centred", "Sides crossed at a right angle, in the middle of both.",
             perpendicular_x_centred);
    c.across("cap-on-side-centred", "B lies across the middle of A's cap, centre over centre.",
             cap_on_side_centred);
  }
  if (pair == Pair::capsule) {
    c.contact("cap-on-end-centred", "The capsule stands on the middle of the cap, axes in line.",
              cap_centred);
    c.contact("cap-on-end-offset", "The capsule stands on the cap beside its middle.", cap_offset);
  }
  if (pair == Pair::cylinder) {
    c.contact("cap-on-cap-centred",
              "Caps meet face to face with the axes in line: a full disc of contact.", cap_centred);
    c.contact("cap-on-cap-offset", "Caps meet face to face beside each other: a lens of contact.",
              cap_offset);
  }
  if (has_faces(pair)) {
    c.contact("cap-on-face-centred", "The cylinder stands in the middle of a face.", cap_centred);
    c.contact("cap-on-face-offset", "The cylinder stands on a face or over its edge.", cap_offset);
    c.across("side-on-face", "The side lies exactly along a face.", side_on_face);
    c.across("side-on-face-centred", "The side lies exactly along the middle of a face.",
             side_on_face_centred);
    c.contact("perpendicular-x", "An edge of B crosses the side at exactly a right angle.",
              edge_across_side)
        .clearances = {Clearance::apart, Clearance::deep};
  }
  if (pair != Pair::plane) {
    c.symmetric("concentric-aligned",
                "Centres and axes coincide exactly: every tie there is, at once.", same_centre);
  }
  const auto on_plane = [](Draw& draw, const Modifiers& m) {
    const Place where = draw.coin() ? standing : lying;
    return placed(draw, Pair::plane, Clearance::touching, m, {where});
  };
  const auto touching = [pair, places = contacts(pair)](Draw& draw, const Modifiers& m) {
    return placed(draw, pair, Clearance::touching, m, places);
  };
  using Generate = Collector::Generate;
  c.add("touching",
        "Exactly parallel or perpendicular bodies touch: the signed distance is zero to the last "
        "bit.",
        {}, pair == Pair::plane ? Generate(on_plane) : Generate(touching))
      .touches = true;
  return std::move(c.all);
}

}  // namespace touchstone
