#include "reports/test_data/suite_2_casts.hpp"

#include <fmt/format.h>
#include <stdexcept>

#include "oracle/hull.hpp"
#include "properties/moves.hpp"
#include "reports/test_data/small_numbers.hpp"

namespace touchstone {
namespace {

// Casts that a person would choose, in numbers that a person would write: a cylinder comes from
// above (z) or along x to a body B that stands at the origin.

/// B, and how far it reaches along z and x; a half-space has all beneath z = 0.
struct CastTarget {
  Shape b;
  double top, side;
};

/// One kind of cast, upon each of the targets.
struct CastKind {
  const char* name;
  Group group;
  const char* about;
  CastQuestion (*towards)(const CastTarget& target);
  bool is_of_bounded = false;  ///< a half-space has no side to pass, nor an edge
};

const Cylinder can(0.25, 0.5);
/// By which bodies graze, metres: ten times what is tolerated, and a thousandth of the can.
constexpr double hair = 0x1p-12;

CastQuestion cast_of(const CastTarget& target, const Cylinder& a, const Eigen::Quaterniond& turned,
                     const Vec3& start, const Vec3& sweep) {
  return {{a, Pose(start, turned), target.b, Pose()}, sweep};
}
/// The standing can, its cap so far above B.
CastQuestion fall(const CastTarget& target, double gap, const Vec3& sweep) {
  return cast_of(target, can, upright, {0, 0, target.top + 0.5 + gap}, sweep);
}
/// The standing can moves over B and misses it by `clearance`; a half-space at the sweep's end.
CastQuestion graze(const CastTarget& target, double clearance) {
  if (std::holds_alternative<Plane>(target.b)) {
    return cast_of(target, can, upright, {-3, 0, 1.5}, {6, 0, clearance - 1});
  }
  return cast_of(target, can, upright, {-3, 0, target.top + 0.5 + clearance}, {6, 0, 0});
}
/// The standing can falls beside B, so far from it.
CastQuestion pass(const CastTarget& target, double clearance) {
  return cast_of(target, can, upright, {target.side + 0.25 + clearance, 0, target.top + 1.5},
                 {0, 0, -4});
}

using enum Group;
const CastKind cast_kinds[] = {
    {"head-on-cap", everyday,
     "A standing cylinder falls and lands on its cap half way. The first to get right: what is "
     "answered is a fraction of the sweep and no length; the normal points up.",
     [](const CastTarget& b) {
       return fall(b, 0.5, {0, 0, -1});
     }},
    {"head-on-side", everyday,
     "A lying cylinder falls on its side. A routine that takes the wrong local axis lands early or "
     "late.",
     [](const CastTarget& b) {
       return cast_of(b, can, along_x, {0, 0, b.top + 0.75}, {0, 0, -1});
     }},
    {"head-on-rim", everyday,
     "A leaning cylinder falls on its rim. The rim is where approximations of the cylinder by a "
     "prism or with rounded edges differ from it.",
     [](const CastTarget& b) {
       return cast_of(b, can, {3, 1, 0, 0}, {0, 0.125, b.top + 1.5}, {0, 0, -2});
     }},
    {"rim-to-edge", everyday,
     "The lower rim comes slanting to where B ends: of a box its edge; of a cylinder its rim. "
     "Where two edges meet in a point rounding decides which normal is found: all between up and "
     "sideways are right.",
     [](const CastTarget& b) {
       return cast_of(b, can, upright, {-b.side - 1.25, 0, b.top + 1.5}, {2, 0, -2});
     },
     true},
    {"oblique", everyday,
     "Both bodies are turned anyhow and the way is slanting as in a game. What works along axes "
     "alone fails here.",
     [](const CastTarget& b) {
       CastQuestion cast = cast_of(b, can, {5, 1, -2, 3}, {2, -1.25, 1}, {-3, 2, -1});
       cast.configuration.pose_b = Pose({0.25, -0.125, 0.5}, {7, 2, -1, 3});
       return cast;
     }},
    {"stops-short", everyday,
     "A falls straight upon B and its sweep ends 1/256 m above it. A margin or a target distance "
     "that is not taken off again makes a touch of it.",
     [](const CastTarget& b) {
       return fall(b, 0.5, {0, 0, -0.49609375});
     }},
    {"onto-leaning", everyday,
     "B leans and A falls upon it. An edge or a rim of the one meets a face; an edge or a rim of "
     "the other: the normal need be no axis of either.",
     [](const CastTarget& b) {
       CastQuestion cast = cast_of(b, can, upright, {0.125, -0.0625, 2.5}, {0, 0, -4});
       cast.configuration.pose_b = Pose(Vec3::Zero(), {4, 1, 2, 0});
       return cast;
     }},
    {"beside", everyday,
     "A falls past B at a distance of 1/4 m. Bounding boxes and spheres overlap on the way; the "
     "bodies do not.",
     [](const CastTarget& b) { return pass(b, 0.25); }, true},
    {"near", everyday,
     "A starts 1/128 m above B and moves by twice that as in a step of a simulation. Thresholds in "
     "metres are of the order of the whole sweep.",
     [](const CastTarget& b) {
       return fall(b, 0x1p-7, {0, 0, -0x1p-6});
     }},
    {"inside-leaves", everyday,
     "A starts inside B and moves out of it. There is no way to a touch: the fraction is zero and "
     "the normal that of the overlap.",
     [](const CastTarget& b) {
       return cast_of(b, can, upright, {0.125, 0, b.top - 0.25}, {0, 0, 4});
     }},
    {"ends-touching", degenerate,
     "The sweep ends where the bodies touch. By rounding it may end sooner: never is right as "
     "well; a fraction well before the end is not.",
     [](const CastTarget& b) {
       return fall(b, 0.5, {0, 0, -0.5});
     }},
    {"graze-hit", degenerate,
     "A moves across and would overlap B by no more than 1/4096 m. Samples or a tolerance in time "
     "miss it.",
     [](const CastTarget& b) { return graze(b, -hair); }},
    {"graze-touch", degenerate,
     "A moves across and touches B without overlapping it. On a round B this is a double root in "
     "time: the fraction is known to the root of the precision; never is right as well.",
     [](const CastTarget& b) { return graze(b, 0); }, true},
    {"graze-miss", degenerate,
     "A moves across and leaves 1/4096 m free. A margin or a loose tolerance makes a touch of it.",
     [](const CastTarget& b) { return graze(b, hair); }},
    {"side-hit", degenerate,
     "A falls along the side of B and its rim catches 1/4096 m of it. On a flat top the first "
     "touch has a normal up; the least overlap afterwards is sideways.",
     [](const CastTarget& b) { return pass(b, -hair); }, true},
    {"side-touch", degenerate,
     "A falls along the side of B and touches it without overlapping it. Engines differ here by "
     "rounding alone: never is right as well.",
     [](const CastTarget& b) { return pass(b, 0); }, true},
    {"touching-leaves", degenerate,
     "A stands on B and moves away. They touch from the start but by no more than rounding: never "
     "is right as well.",
     [](const CastTarget& b) {
       return fall(b, 0, {0, 0, 1});
     }},
    {"touching-enters", degenerate,
     "A stands on B and moves into it. There is no distance to find a normal by: an iteration that "
     "divides by it finds none and passes through.",
     [](const CastTarget& b) {
       return fall(b, 0, {0, 0, -1});
     }},
    {"near-parallel", degenerate,
     "A cylinder that lies but for 0.03 degrees falls on its side. On a flat B one end touches "
     "first; what takes it for level lands late there.",
     [](const CastTarget& b) {
       return cast_of(b, can, {1, 0, 1 - 0x1p-11, 0}, {0, 0, b.top + 0.75}, {0, 0, -1});
     }},
    {"through", extreme,
     "The sweep is eight thousand times the gap and leads right through B. Steps of a fixed part "
     "of the sweep jump over it; so does an iteration with too few of them.",
     [](const CastTarget& b) {
       return fall(b, 0.5, {0, 0, -4096});
     }},
    {"from-afar", extreme,
     "A comes from 65 km away. In single precision the fraction alone is exact to 4 mm of the way; "
     "in double nothing is lost.",
     [](const CastTarget& b) {
       return cast_of(b, can, upright, {0.0625, 0, 0x1p16}, {0, 0, -0x1p17});
     }},
    {"needle-tip", extreme,
     "A needle of radius 1/1024 m falls tip first. It is thinner than most margins: with its rim "
     "rounded away nothing is left.",
     [](const CastTarget& b) {
       return cast_of(b, Cylinder(0x1p-10, 1), upright, {0.0625, 0.03125, b.top + 3}, {0, 0, -16});
     }},
    {"coin-edge", extreme,
     "A coin of 1/512 m falls on its edge. It is thinner than most margins and as wide as B.",
     [](const CastTarget& b) {
       return cast_of(b, Cylinder(0.5, 0x1p-10), along_x, {0.0625, 0, b.top + 2.5}, {0, 0, -16});
     }},
    {"far", extreme,
     "A falls on B nine kilometres from the origin. In single precision positions there are exact "
     "to 1 mm: what is computed from their difference is not worse.",
     [](const CastTarget& b) {
       CastQuestion cast = fall(b, 0.5, {0, 0, -1});
       const Vec3 origin(4096, -8192, 2048);
       const Pose& a = cast.configuration.pose_a;
       cast.configuration.pose_a = Pose(a.position() + origin, a.orientation());
       cast.configuration.pose_b = Pose(origin);
       return cast;
     }}};

std::vector<CastTarget> cast_targets() {
  const std::vector<Vec3> octahedron = {{0.75, 0, 0},  {-0.75, 0, 0}, {0, 0.75, 0},
                                        {0, -0.75, 0}, {0, 0, 0.75},  {0, 0, -0.75}};
  return {{Plane({0, 0, 1}, 0), 0, 0},          {Sphere(0.75), 0.75, 0.75},
          {Capsule(0.5, 0.75), 1.25, 0.5},      {Cylinder(0.75, 0.5), 0.5, 0.75},
          {Box({0.75, 0.625, 0.5}), 0.5, 0.75}, {oracle::convex_hull(octahedron), 0.75, 0.75}};
}

/// Issue 2103 of JoltPhysics, whose y axis is our z: its x is our y.
CastQuestion jolt_2103() {
  const Pose start({-7.63574218, -0.951660156, -2.09155273}, upright);
  return {{Cylinder(0.4975, 0.3), start, Capsule(7.19732189, 2.03114343), Pose()},
          {0.0029296875, 0.00244140625, -0.0068359375}};
}

CastDatum cast_datum(const std::string& name, Group group, const std::string& about,
                     const CastQuestion& asked) {
  const CastQuestion cast{in_floats(asked.configuration), asked.sweep.cast<float>().cast<double>()};
  const Configuration& c = cast.configuration;
  const std::string id = std::string(pair_name(pair_of(c))) + '/' + name;
  const oracle::FirstTouch truth = oracle::first_touch(c, Sweep(cast.sweep));
  if (truth.status == oracle::FirstTouch::Status::undecided || !is_in_floats(c)) {
    throw std::logic_error(id + ": needs numbers for which the first touch can be proven");
  }
  const double tolerance = Bar().tolerance * error_size(c, Bar());
  const double in_single = tolerance + moved_by_rounding(c) + float_rounding * cast.sweep.norm();
  return {id,
          group,
          about,
          cast,
          truth,
          cast_limits(c, cast.sweep, truth, tolerance),
          cast_limits(c, cast.sweep, truth, in_single)};
}

}  // namespace

std::vector<CastDatum> suite_2_casts() {
  std::vector<CastDatum> result;
  for (const CastTarget& target : cast_targets()) {
    const bool is_plane = std::holds_alternative<Plane>(target.b);
    for (const CastKind& kind : cast_kinds) {
      if (is_plane && kind.is_of_bounded) continue;
      result.push_back(cast_datum(kind.name, kind.group, kind.about, kind.towards(target)));
    }
    if (std::holds_alternative<Capsule>(target.b)) {
      result.push_back(
          cast_datum("jolt-2103", degenerate,
                     "The numbers of Jolt's issue 2103; which was answered 7.25 m deep. The "
                     "bodies overlap by 4.4e-6 m before A moves and the sweep is short.",
                     jolt_2103()));
    }
  }
  return result;
}

}  // namespace touchstone
