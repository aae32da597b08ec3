#include "properties/features.hpp"
#include "properties/pose_class.hpp"

namespace touchstone {
namespace {

using enum Feature;

/// Random bodies whose given features meet at a drawn clearance.
PoseClass meeting(Pair pair, std::string name, std::string description, Feature on_a, Feature on_b,
                  double (*draw_distance)(Draw&, double) = draw_near) {
  return {std::move(name), std::move(description), [pair, on_a, on_b, draw_distance](Draw& draw) {
            const Bodies bodies = draw_bodies(draw, pair);
            const double distance = draw_distance(draw, smaller_size(bodies));
            return meet(draw, bodies, on_a, on_b, distance);
          }};
}

Configuration general(Draw& draw, Pair pair, double (*draw_distance)(Draw&, double)) {
  const Bodies bodies = draw_bodies(draw, pair);
  const FeaturePair features = draw_feature_pair(draw, pair);
  const double distance = draw_distance(draw, smaller_size(bodies));
  return meet(draw, bodies, features.on_a, features.on_b, distance);
}

double draw_apart(Draw& draw, double size) { return size * draw.log_uniform(1e-6, 1); }
double draw_touching(Draw&, double) { return 0; }

Configuration deep(Draw& draw, Pair pair) {
  const Bodies bodies = draw_bodies(draw, pair);
  return overlap_deeply(draw, bodies, smaller_size(bodies));
}

Configuration concentric(Draw& draw, Pair pair) {
  const Bodies bodies = draw_bodies(draw, pair);
  const Vec3 centre{draw.uniform(-1, 1), draw.uniform(-1, 1), draw.uniform(-1, 1)};
  return {bodies.a, Pose(centre, bodies.orientation_a), bodies.b,
          Pose(centre, bodies.orientation_b)};
}

/// The box's z edge lies across the cap, in its plane up to rounding.
Configuration edge_in_cap(Draw& draw) {
  Bodies bodies = draw_bodies(draw, Pair::box);
  const Eigen::Quaterniond z_to_x(0.5, 0.5, 0.5, 0.5);
  const Eigen::Quaterniond heading = draw.turn_about_z();
  bodies.orientation_b =
      product(product(product(bodies.orientation_a, heading), z_to_x), draw.turn_about_z());
  const double distance = draw_near(draw, smaller_size(bodies));
  return meet_at(draw, bodies, cap, edge, distance, 2);
}

void add_cylinder_features(std::vector<PoseClass>& out) {
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

void add_capsule_features(std::vector<PoseClass>& out) {
  out.push_back(meeting(Pair::capsule, "rim-side", "The cylinder's rim meets the capsule's side.",
                        rim, side));
  out.push_back(meeting(Pair::capsule, "rim-end",
                        "The cylinder's rim meets the capsule's round end.", rim, end, draw_apart));
  out.push_back(
      meeting(Pair::capsule, "cap-end", "The capsule's round end meets the cap.", cap, end));
  out.push_back(
      meeting(Pair::capsule, "side-end", "The capsule's round end meets the side.", side, end));
  out.push_back(
      meeting(Pair::capsule, "side-side", "Two sides cross at a random angle.", side, side));
}

void add_sphere_features(std::vector<PoseClass>& out) {
  out.push_back(meeting(Pair::sphere, "side", "The sphere meets the side.", side, end));
  out.push_back(meeting(Pair::sphere, "cap", "The sphere meets the cap.", cap, end));
  out.push_back(
      meeting(Pair::sphere, "rim",
              "The sphere meets the rim, its centre in the rim's fan of normals: neither the cap's "
              "nor the side's normal is right.",
              rim, end));
}

void add_box_features(std::vector<PoseClass>& out) {
  const auto add = [&](const char* name, const char* description, Feature on_a, Feature on_b) {
    out.push_back(meeting(Pair::box, name, description, on_a, on_b));
  };
  add("rim-face", "The rim meets a face of the box in one point.", rim, cap);
  add("edge-side", "An edge of the box crosses the side.", side, edge);
  out.push_back({"edge-cap",
                 "An edge of the box lies across the cap, parallel to it but for rounding: a line "
                 "of contact that ends at the edge's ends or at the rim.",
                 edge_in_cap});
  add("edge-rim", "An edge of the box meets the rim; the nearest point is the root of a quartic.",
      rim, edge);
  add("vertex-side", "A vertex of the box meets the side.", side, vertex);
  add("vertex-cap", "A vertex of the box meets the cap.", cap, vertex);
  add("vertex-rim", "A vertex of the box meets the rim: two fans of normals, none of its own.", rim,
      vertex);
}

}  // namespace

double draw_shallow(Draw& draw, double size) { return -size * draw.log_uniform(1e-6, 0.05); }

double draw_near(Draw& draw, double size) {
  return draw.integer(0, 3) == 0 ? draw_apart(draw, size) : draw_shallow(draw, size);
}

std::vector<PoseClass> feature_classes(Pair pair) {
  std::vector<PoseClass> out;
  out.push_back({"general-separated",
                 "Random features face each other, 1e-6 to 1 of the smaller size apart: a contact "
                 "query must say no, a distance query how far.",
                 [pair](Draw& draw) { return general(draw, pair, draw_apart); }});
  out.push_back(
      {"general-shallow",
       "Random features overlap by 1e-6 to 5% of the smaller size, as resting contacts do.",
       [pair](Draw& draw) { return general(draw, pair, draw_shallow); }});
  out.push_back(
      {"general-deep",
       "The centres are closer than the smaller size; many directions compete to be the way "
       "out.",
       [pair](Draw& draw) { return deep(draw, pair); }});
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
      add_box_features(out);
      break;
  }
  out.push_back({"touching-rounded",
                 "Random features touch as nearly as doubles can say: the sign of the distance is "
                 "rounding, and normals from differences of points are noise.",
                 [pair](Draw& draw) { return general(draw, pair, draw_touching); }});
  if (pair != Pair::plane) {
    out.push_back(
        {"concentric",
         "The centres coincide, at random orientations: every direction has its opposite as "
         "an equal, and difference vectors vanish.",
         [pair](Draw& draw) { return concentric(draw, pair); }});
  }
  return out;
}

}  // namespace touchstone
