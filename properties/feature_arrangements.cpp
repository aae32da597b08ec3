
#include "properties/features.hpp"
#include "properties/pose_class.hpp"

namespace touchstone {
namespace {

using enum Feature;
using Orientations = Arrangement::Orientations;
using Quaternion = Eigen::Quaterniond;

const std::vector<Clearance> not_deep = {Clearance::shallow, Clearance::apart, Clearance::touching};

/// Random bodies whose given features meet. Their overlap is never deep: then other features would
/// be nearer.
Arrangement meeting(Pair pair, const char* name, const char* description, Feature on_a,
                    Feature on_b) {
  return {name, description, Orientations::random, not_deep,
          [pair, on_a, on_b](Draw& draw, const Modifiers& m) {
            const Bodies bodies = draw_bodies(draw, pair, m);
            const double distance = draw_clearance(draw, m.clearance(), smaller_size(bodies));
            return meet(draw, bodies, on_a, on_b, distance);
          }};
}

Configuration general(Draw& draw, Pair pair, const Modifiers& m) {
  const Bodies bodies = draw_bodies(draw, pair, m);
  if (m.clearance() == Clearance::deep) return overlap_deeply(draw, bodies, m.proportions());
  const FeaturePair features = draw_feature_pair(draw, pair);
  const double distance = draw_clearance(draw, m.clearance(), smaller_size(bodies));
  return meet(draw, bodies, features.on_a, features.on_b, distance);
}

Configuration concentric(Draw& draw, Pair pair, const Modifiers& m) {
  const Bodies bodies = draw_bodies(draw, pair, m);
  const Vec3 centre{draw.uniform(-1, 1), draw.uniform(-1, 1), draw.uniform(-1, 1)};
  return {bodies.a, Pose(centre, bodies.orientation_a), bodies.b,
          Pose(centre, bodies.orientation_b)};
}

const Quaternion z_to_x(0.5, 0.5, 0.5, 0.5);  // x to y, y to z

/// The rotation that takes a unit vector to z or −z, whichever is nearer.
Quaternion onto_z(const Vec3& n) {
  const double side = n.z() < 0 ? -1 : 1;
  return normalized(Quaternion(1 + side * n.z(), side * n.y(), -side * n.x(), 0));
}

/// The box's z edge, or an edge of the hull, lies across the cap, in its plane up to rounding.
Configuration edge_in_cap(Draw& draw, Pair pair, const Modifiers& m) {
  Bodies bodies = draw_bodies(draw, pair, m);
  const Quaternion heading = draw.turn_about_z();
  int which = 2;
  if (const auto* hull = std::get_if<Convex>(&bodies.b)) {
    const EdgeOfHull lying = draw_edge(draw, *hull);
    which = lying.number;
    bodies.orientation_b = product(product(bodies.orientation_a, heading), onto_z(lying.normal));
  } else {
    bodies.orientation_b =
        product(product(product(bodies.orientation_a, heading), z_to_x), draw.turn_about_z());
  }
  const double distance = draw_clearance(draw, m.clearance(), smaller_size(bodies));
  return meet_at(draw, bodies, cap, edge, distance, which);
}

/// Cap or side of A against B, whose orientation relative to A is `base` and any turn about its own
/// z axis, in whose place a hull has one of its edges.
Configuration nearly_aligned(Draw& draw, Pair pair, const Quaternion& base, const Modifiers& m) {
  Bodies bodies = draw_bodies(draw, pair, m);
  if (pair == Pair::plane) bodies.b = Plane(Vec3(0, 0, 1), draw.uniform(-1, 1));
  bodies.orientation_b = product(product(bodies.orientation_a, base), draw.turn_about_z());
  const double distance = draw_clearance(draw, m.clearance(), smaller_size(bodies));
  const bool cap_first = draw.coin();
  const Feature on_a = pair == Pair::plane ? rim : cap_first ? cap : side;
  const Feature on_b = pair == Pair::plane      ? cap
                       : pair == Pair::capsule  ? (draw.coin() ? side : end)
                       : pair == Pair::cylinder ? (draw.coin() ? side : rim)
                                                : (draw.coin() ? edge : vertex);
  if (const auto* hull = std::get_if<Convex>(&bodies.b)) {
    const EdgeOfHull aligned = draw_edge(draw, *hull);
    bodies.orientation_b = product(bodies.orientation_b, onto_z(aligned.along));
    return meet_at(draw, bodies, on_a, on_b, distance, aligned.number);
  }
  return meet(draw, bodies, on_a, on_b, distance);
}

void add_nearly_aligned(Pair pair, std::vector<Arrangement>& out) {
  const auto add = [&](const char* name, const char* description, const Quaternion& base) {
    const auto generate = [pair, base](Draw& draw, const Modifiers& m) {
      return nearly_aligned(draw, pair, base, m);
    };
    out.push_back({name, description, Orientations::nearly, not_deep, generate});
    out.back().across = base.x() != 0;
  };
  const Quaternion upright(1, 0, 0, 0);
  if (pair == Pair::plane) {
    // The plane's normal is B's z axis, so a lying cylinder is parallel to the plane's surface.
    add("parallel", "The cylinder lies but for rounding; tilted, it does so on one end.", z_to_x);
    add("perpendicular", "The cylinder stands but for rounding; tilted, it does so on its rim.",
        upright);
    return;
  }
  add("parallel",
      "Features meet while the axes (or the axis and an edge) are parallel but for rounding or "
      "a tilt: cross products lose their digits.",
      upright);
  add("perpendicular",
      "Features meet while the axes (or the axis and an edge) are perpendicular but for "
      "rounding or a tilt: discs are seen edge on.",
      z_to_x);
}

void add_cylinder_features(std::vector<Arrangement>& out) {
  out.push_back(meeting(
      Pair::cylinder, "rim-rim",
      "The rims cross at a random angle; the normal belongs to neither body alone.", rim, rim));
  out.push_back(meeting(Pair::cylinder, "rim-side",
                        "A's rim meets B's side; the normal jumps where the rim passes the end.",
                        rim, side));
  out.push_back(meeting(Pair::cylinder, "rim-face",
                        "A's rim meets B's cap in one point of a large flat face.", rim, cap));
  out.push_back(
      meeting(Pair::cylinder, "side-side",
              "Two sides cross at a random angle; the contact is a point that slides fast as "
              "the axes become parallel.",
              side, side));
}

/// Overlapping, the round end would be nearer to the cap or the side.
Arrangement rim_end() {
  Arrangement result = meeting(Pair::capsule, "rim-end",
                               "The cylinder's rim meets the capsule's round end.", rim, end);
  result.clearances = {Clearance::touching};
  result.own = Clearance::apart;
  result.generate = [make = result.generate](Draw& draw, const Modifiers& m) {
    Modifiers modified = m;
    if (m.clearance() == Clearance::usual) {
      modified[ModifierKind::clearance] = static_cast<int>(Clearance::apart);
    }
    return make(draw, modified);
  };
  return result;
}

void add_capsule_features(std::vector<Arrangement>& out) {
  out.push_back(meeting(Pair::capsule, "rim-side", "The cylinder's rim meets the capsule's side.",
                        rim, side));
  out.push_back(rim_end());
  out.push_back(
      meeting(Pair::capsule, "cap-end", "The capsule's round end meets the cap.", cap, end));
  out.push_back(
      meeting(Pair::capsule, "side-end", "The capsule's round end meets the side.", side, end));
  out.push_back(
      meeting(Pair::capsule, "side-side", "Two sides cross at a random angle.", side, side));
}

void add_sphere_features(std::vector<Arrangement>& out) {
  out.push_back(meeting(Pair::sphere, "side", "The sphere meets the side.", side, end));
  out.push_back(meeting(Pair::sphere, "cap", "The sphere meets the cap.", cap, end));
  out.push_back(
      meeting(Pair::sphere, "rim",
              "The sphere meets the rim, its centre in the rim's fan of normals: neither the cap's "
              "nor the side's normal is right.",
              rim, end));
}

/// Of boxes and hulls.
void add_face_features(Pair pair, std::vector<Arrangement>& out) {
  const auto add = [&](const char* name, const char* description, Feature on_a, Feature on_b) {
    out.push_back(meeting(pair, name, description, on_a, on_b));
  };
  add("rim-face", "The rim meets a face of B in one point.", rim, cap);
  add("edge-side", "An edge of B crosses the side.", side, edge);
  out.push_back({"edge-cap",
                 "An edge of B lies across the cap, parallel to it but for rounding: a line of "
                 "contact that ends at the edge's ends or at the rim.",
                 Orientations::nearly, not_deep,
                 [pair](Draw& draw, const Modifiers& m) { return edge_in_cap(draw, pair, m); }});
  add("edge-rim", "An edge of B meets the rim; the nearest point is the root of a quartic.", rim,
      edge);
  add("vertex-side", "A vertex of B meets the side.", side, vertex);
  add("vertex-cap", "A vertex of B meets the cap.", cap, vertex);
  add("vertex-rim", "A vertex of B meets the rim: two fans of normals, none of its own.", rim,
      vertex);
}

}  // namespace

std::vector<Arrangement> feature_arrangements(Pair pair) {
  std::vector<Arrangement> out;
  out.push_back({"general",
                 "Random features face each other, at a random angle.",
                 Orientations::random,
                 {Clearance::shallow, Clearance::apart, Clearance::touching, Clearance::deep},
                 [pair](Draw& draw, const Modifiers& m) { return general(draw, pair, m); }});
  switch (pair) {
    case Pair::plane:
      break;
    case Pair::sphere:
      add_sphere_features(out);
      break;
    case Pair::capsule:
      add_capsule_features(out);
      break;
    case Pair::cylinder:
      add_cylinder_features(out);
      break;
    case Pair::box:
    case Pair::convex:
      add_face_features(pair, out);
      break;
  }
  if (pair != Pair::plane) {
    out.push_back({"concentric",
                   "The centres coincide, at random orientations: every direction has its opposite "
                   "as an equal, and difference vectors vanish.",
                   Orientations::random,
                   {},
                   [pair](Draw& draw, const Modifiers& m) { return concentric(draw, pair, m); }});
    out.back().is_symmetric = true;
  }
  if (pair != Pair::sphere) add_nearly_aligned(pair, out);
  return out;
}

}  // namespace touchstone
