#include "candidates/candidates.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <dlfcn.h>
#include <filesystem>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <random>

#include "candidates/model.hpp"
#include "candidates/testing/plain_contacts.hpp"
#include "oracle/hull.hpp"
#include "oracle/truth.hpp"
#include "properties/files/own_folder_test.hpp"
#include "properties/pose_class.hpp"
#include "reference/invalid_input.hpp"

namespace touchstone {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;

std::vector<std::string> names(const std::vector<std::string>& asked) {
  std::vector<std::string> result;
  for (const Candidate* c : find_candidates(asked)) result.push_back(c->name);
  return result;
}

// A report asks each engine and model once or twice, not all of their settings.
TEST(DefaultCandidates, AreThoseWithoutVariants) {
  std::vector<std::string> asked, others;
  for (const Candidate* c : default_candidates()) {
    if (!c->added) asked.push_back(c->name);
  }
  EXPECT_THAT(asked, ElementsAre("reference", "bullet", "bullet-margin-0", "bullet-float", "ode",
                                 "fcl", "libccd-mpr", "mujoco", "capsule", "capsule-circumscribed",
                                 "spheres:8", "prism:16"));
  for (const Candidate* c : all_candidates()) {
    if (!c->added && std::ranges::find(asked, c->name) == asked.end()) others.push_back(c->name);
  }
  EXPECT_THAT(others, ElementsAre("bullet-persistent", "bullet-hull:16", "bullet-float-margin-0",
                                  "ode-mesh:16", "fcl-indep", "fcl-distance", "libccd-gjk",
                                  "box-spheres:8", "box-capsules:4"));
}

TEST(FindCandidate, NamesThoseThereAre) {
  EXPECT_THAT([] { find_candidate("bulet"); },
              testing::ThrowsMessage<InvalidInput>(
                  AllOf(HasSubstr("bulet"), HasSubstr("reference, bullet, "))));
}

TEST(FindCandidate, KeepsToWhatAParameterMayBe) {
  EXPECT_EQ(find_candidate("prism:12").value, 12);
  EXPECT_EQ(find_candidate("prism").name, "prism:16");
  for (const char* wrong : {"prism:2", "prism:8.5", "prism:", "prism:x", "prism:1e9"}) {
    EXPECT_THAT([&] { find_candidate(wrong); },
                testing::ThrowsMessage<InvalidInput>(
                    AllOf(HasSubstr(wrong), HasSubstr("number of sides"))));
  }
  EXPECT_THAT([] { find_candidate("reference:3"); },
              testing::ThrowsMessage<InvalidInput>(HasSubstr("takes no number")));
}

TEST(FindCandidates, ReadSweeps) {
  EXPECT_THAT(names({"bullet", "prism:8", "16", "32", "reference"}),
              ElementsAre("bullet", "prism:8", "prism:16", "prism:32", "reference"));
  EXPECT_THAT(names({"spheres:1..8"}),
              ElementsAre("spheres:1", "spheres:2", "spheres:4", "spheres:8"));
  EXPECT_THAT(names({"spheres:3..13"}), ElementsAre("spheres:3", "spheres:6", "spheres:12"));
  EXPECT_THAT(names({"libccd-gjk:1e-6..0.001"}), ElementsAre("libccd-gjk:1e-06", "libccd-gjk:1e-05",
                                                             "libccd-gjk", "libccd-gjk:0.001"));
  EXPECT_THAT(names({"bullet", "bullet"}), ElementsAre("bullet"));
  EXPECT_THROW(names({"spheres:8..1"}), InvalidInput);
  EXPECT_THROW(names({"spheres:1..inf"}), InvalidInput);
  EXPECT_THROW(names({"spheres:1..1e6"}), InvalidInput);
  EXPECT_THROW(names({"spheres:.."}), InvalidInput);
  EXPECT_THROW(names({"8"}), InvalidInput);
}

TEST(FindCandidate, ListsANameOnceThatACommandHasTaken) {
  add_command(R"(echo '{"touchstone": 1, "name": "havok", "version": "1", "settings": "mine",)"
              R"( "precision": "float", "runs": "script", "format": "lines",)"
              R"( "pairs": ["cylinder-plane"]}')");
  try {
    find_candidate("no-such-candidate");
    FAIL();
  } catch (const InvalidInput& e) {
    const auto first = e.remedy().find(" havok,");
    EXPECT_NE(first, std::string::npos);
    EXPECT_EQ(e.remedy().find(" havok,", first + 1), std::string::npos) << e.remedy();
  }
}

/// While it lives, node is a program that says what an adapter for a release would.
class PlayedNode {
 public:
  PlayedNode() {
    const auto node = folder_.with("node", R"(#!/bin/sh
if [ "$1" = physx.mjs ]; then echo "unsupported: it has no cylinder" >&2; exit 2; fi
read -r line
echo '{"touchstone":1,"name":"jolt-margin@'$TOUCHSTONE_RELEASE'","version":"0.30.0","settings":"",
"precision":"float","runs":"wasm","format":"lines",
"pairs":["cylinder-box"],"parameter":{"meaning":"margin","min":0,"max":1,"usual":0.5}}' | tr -d '\n'
echo; cat
)");
    std::filesystem::permissions(node, std::filesystem::perms::owner_all);
    for (const std::string package :
         {"jolt-physics@0.30", "jolt-physics@0.31", "physx-js-webidl@1"}) {
      folder_.with("versions/" + package + "/node_modules/" + package.substr(0, package.find('@')) +
                       "/package.json",
                   "{}");
    }
    setenv("PATH", (folder_.path.string() + ':' + path_).c_str(), 1);
    setenv("TOUCHSTONE_NPM", folder_.path.c_str(), 1);
  }
  ~PlayedNode() {
    setenv("PATH", path_.c_str(), 1);
    unsetenv("TOUCHSTONE_NPM");
  }

 private:
  const OwnFolder folder_;
  const std::string path_ = std::getenv("PATH");
};

TEST(FindCandidates, KnowTheReleasesOfAnEngineFromNpm) {
  const PlayedNode node;
  EXPECT_THAT(
      names({"jolt-margin@0.30", "jolt-margin:0.02@0.30", "0.03", "jolt-margin:0.02@0.31",
             "jolt-margin:1e-3..1e-2@0.31"}),
      ElementsAre("jolt-margin:0.5@0.30", "jolt-margin:0.02@0.30", "jolt-margin:0.03@0.30",
                  "jolt-margin:0.02@0.31", "jolt-margin:0.001@0.31", "jolt-margin:0.01@0.31"));
  EXPECT_EQ(find_candidate("jolt-margin:0.02@0.30").value, 0.02);
  const std::pair<const char*, const char*> wrong[] = {
      {"jolt-margin:2@0.30", "from 0 to 1"},
      {"jolt-margin:0.1@", "a release or its beginning"},
      {"rapier@1;exit", "a release or its beginning"},
      {"rapier@0.9", "@dimforge/rapier3d-compat@0.9 is not in "},
      {"physx@1", "is unsupported: it has no cylinder"},
      {"bullet@2", "must be one of reference, "}};
  for (const auto& [name, reason] : wrong) {
    EXPECT_THAT([&] { find_candidate(name); },
                testing::ThrowsMessage<InvalidInput>(AllOf(HasSubstr(name), HasSubstr(reason))));
  }
}

TEST(Candidates, EveryStandardPluginIsThereWhereItsEngineIs) {
  for (const Skipped& s : skipped_plugins()) {
    EXPECT_THAT(s.reason, HasSubstr("was not built")) << s.name;
  }
}

TEST(Candidates, PlaneNormalIsPassedWithUnitLength) {
  const ts_shape plane = to_ts_shape(Plane({0, 3, 4}, 10));
  EXPECT_EQ(plane.size[1], 0.6);
  EXPECT_EQ(plane.size[2], 0.8);
  EXPECT_EQ(plane.size[3], 2);
}

TEST(Candidates, QuaternionsAndNormalsThatOverflowWhenSquaredArePassedWithUnitLength) {
  for (const double length : {5e-324, 1e-320, 1e-162, 1e154, 1e308}) {
    const ts_pose pose = to_ts_pose(Pose(Vec3::Zero(), Eigen::Quaterniond(length, 0, -length, 0)));
    EXPECT_DOUBLE_EQ(pose.orientation[0], std::sqrt(0.5)) << length;
    EXPECT_DOUBLE_EQ(pose.orientation[2], -std::sqrt(0.5)) << length;
    const ts_shape plane = to_ts_shape(Plane({0, 0, -length}, 0));
    EXPECT_EQ(plane.size[2], -1) << length;
  }
}

// The simplified models against closed forms, and their exact routine against the definition of the
// signed distance, the largest gap over all directions.

constexpr double rounding = 1e-12;

const ts_shape can = to_ts_shape(Cylinder(0.5, 1)), ball = to_ts_shape(Sphere(0.25)),
               floor_below = to_ts_shape(Plane({0, 0, 1}, 0));

ts_pose at(const Vec3& position, const Quaternion& orientation = upright) {
  return to_ts_pose(Pose(position, orientation));
}

Separation between(const CylinderModel& model, const ts_shape& a, const ts_pose& pose_a,
                   const ts_shape& b, const ts_pose& pose_b) {
  return ModelPair(a, b, model).separation(pose_a, pose_b);
}

CylinderModel prism(int sides) {
  return [=](double r, double h) { return inscribed_prism(sides, r, h); };
}
CylinderModel spheres(int count) {
  return [=](double r, double h) { return inscribed_spheres(count, r, h); };
}

TEST(Models, InscribedCapsuleLosesTheRimAndKeepsCapAndSide) {
  EXPECT_NEAR(between(inscribed_capsule, can, at({0, 0, 0.9}), floor_below, at({0, 0, 0})).distance,
              -0.1, rounding);
  EXPECT_NEAR(between(inscribed_capsule, can, at({0, 0, 0.4}, along_x), floor_below, at({0, 0, 0}))
                  .distance,
              -0.1, rounding);
  // A sphere beside the upper rim: its distance is that of the round end from the corner.
  const auto s = between(inscribed_capsule, can, at({0, 0, 0}), ball, at({0.75, 0, 1}));
  EXPECT_NEAR(s.distance, std::hypot(0.75, 0.5) - 0.75, rounding);
}

TEST(Models, CircumscribedCapsuleStandsOnItsRoundEnd) {
  const auto s = between(circumscribed_capsule, can, at({0, 0, 1.5}), floor_below, at({0, 0, 0}));
  EXPECT_NEAR(s.distance, 0, rounding);
}

TEST(Models, AFlatCylinderIsASphereOfItsHalfLengthAsACapsule) {
  const ts_shape coin = to_ts_shape(Cylinder(1, 0.1));
  EXPECT_NEAR(
      between(inscribed_capsule, coin, at({0, 0, 0}, along_x), floor_below, at({0, 0, 0})).distance,
      -0.1, rounding);
}

TEST(Models, AWheelOfSpheresRollsWithARipple) {
  // Between two of k spheres of radius h on a ring of radius r − h, the wheel's height is lower by
  // (r − h)(1 − cos(π/k)).
  const ts_shape wheel = to_ts_shape(Cylinder(1, 0.2));
  const auto height = [&](double angle) {
    const Quaternion turned = Quaternion(Eigen::AngleAxisd(M_PI / 2, Vec3::UnitX())) *
                              Quaternion(Eigen::AngleAxisd(angle, Vec3::UnitZ()));
    return -between(spheres(8), wheel, at({0, 0, 0}, turned), floor_below, at({0, 0, 0})).distance;
  };
  EXPECT_NEAR(height(M_PI / 2), 1, rounding);
  EXPECT_NEAR(height(M_PI / 2 + M_PI / 8), 0.2 + 0.8 * std::cos(M_PI / 8), rounding);
}

TEST(Models, SpheresInARowReachBothCaps) {
  EXPECT_NEAR(between(spheres(4), can, at({0, 0, 0.9}), floor_below, at({0, 0, 0})).distance, -0.1,
              rounding);
  EXPECT_NEAR(between(spheres(1), can, at({0, 0, 0}), ball, at({0, 0, 0.8})).distance, 0.05,
              rounding);
}

TEST(Models, APrismIsShallowerByItsSagitta) {
  for (const int sides : {8, 16, 128}) {
    // With z up and an even number of sides, lying along y on the middle of a side.
    const Quaternion flat = Quaternion(Eigen::AngleAxisd(M_PI / 2, Vec3::UnitX())) *
                            Quaternion(Eigen::AngleAxisd(M_PI / 2 + M_PI / sides, Vec3::UnitZ()));
    EXPECT_NEAR(
        between(prism(sides), can, at({0, 0, 0}, flat), floor_below, at({0, 0, 0})).distance,
        -0.5 * std::cos(M_PI / sides), rounding)
        << sides;
  }
}

TEST(Models, APrismApartFromASphereKnowsFacesEdgesAndCorners) {
  const auto distance = [&](const Vec3& centre) {
    return between(prism(4), can, at({0, 0, 0}), ball, at(centre)).distance + 0.25;
  };
  EXPECT_NEAR(distance({0.1, 0.1, 2}), 1, rounding);  // cap
  EXPECT_NEAR(distance({1, 0, 0.3}), 0.5, rounding);  // edge along the axis
  EXPECT_NEAR(distance({1, 1, 0}), std::sqrt(2.0) - 0.5 / std::sqrt(2.0), rounding);  // side
  EXPECT_NEAR(distance({1, 0, 1.5}), std::hypot(0.5, 0.5), rounding);                 // corner
  EXPECT_NEAR(distance({0, 0, 0}), -0.5 / std::sqrt(2.0), rounding);                  // inside
}

TEST(Models, FourSidesAreABox) {
  // The prism's code against the box's, for the same solid.
  std::mt19937 random(2);
  std::normal_distribution<double> normal;
  auto square = RoundedPolytope::prism(4, std::sqrt(2.0) * 0.4, 0.7);
  auto box = RoundedPolytope::box({0.4, 0.4, 0.7});
  const Eigen::Matrix3d eighth = Eigen::AngleAxisd(M_PI / 4, Vec3::UnitZ()).toRotationMatrix();
  auto other = RoundedPolytope::prism(5, 0.6, 0.3);
  for (int i = 0; i < 200; ++i) {
    const Eigen::Matrix3d turn =
        Quaternion(normal(random), normal(random), normal(random), normal(random))
            .normalized()
            .toRotationMatrix();
    const Vec3 shift = 0.4 * Vec3(normal(random), normal(random), normal(random));
    square.place(turn * eighth, shift);
    box.place(turn, shift);
    const Separation x = separation(square, other), y = separation(box, other);
    EXPECT_NEAR(x.distance, y.distance, rounding);
  }
}

TEST(Models, MeetTheHullOfABoxAsTheBox) {
  const Box box({0.4, 0.3, 0.7});
  std::vector<Vec3> corners;
  for (int i = 0; i < 8; ++i) {
    corners.push_back(
        Vec3(i & 1 ? 1 : -1, i & 2 ? 1 : -1, i & 4 ? 1 : -1).cwiseProduct(box.half_extents()));
  }
  const Convex hull = oracle::convex_hull(corners);
  std::mt19937 random(3);
  std::normal_distribution<double> normal;
  for (const CylinderModel& model :
       {CylinderModel(inscribed_capsule), spheres(5), prism(5), prism(8)}) {
    for (int i = 0; i < 100; ++i) {
      const Quaternion turn =
          Quaternion(normal(random), normal(random), normal(random), normal(random)).normalized();
      const ts_pose pose = at(0.6 * Vec3(normal(random), normal(random), normal(random)), turn);
      const Separation of_box = between(model, can, pose, to_ts_shape(box), at({0, 0, 0})),
                       of_hull = between(model, can, pose, to_ts_shape(hull), at({0, 0, 0}));
      EXPECT_NEAR(of_hull.distance, of_box.distance, rounding);
      if (of_hull.distance > 0) continue;
      EXPECT_NEAR((of_hull.on_a - of_hull.on_b).dot(of_hull.normal), of_hull.distance, rounding);
    }
  }
}

TEST(Models, KnowFaceEdgeAndCornerOfATriangle) {
  const Convex triangle = oracle::convex_hull({{-2, -1, 0}, {2, -1, 0}, {0, 3, 0}});
  const ts_shape coin = to_ts_shape(Cylinder(0.5, 0.25));  // as one sphere of 0.25
  const auto distance = [&](const Vec3& centre) {
    return between(spheres(1), coin, at(centre), to_ts_shape(triangle), at({0, 0, 0})).distance +
           0.25;
  };
  EXPECT_NEAR(distance({0, 0, 0.5}), 0.5, rounding);       // face
  EXPECT_NEAR(distance({0, 0, -0.125}), 0.125, rounding);  // the other one
  EXPECT_NEAR(distance({0, 0, 0}), 0, rounding);           // on it
  EXPECT_NEAR(distance({0.5, -1.3, 0.4}), 0.5, rounding);  // edge
  EXPECT_NEAR(distance({0.5, -1.3, 0}), 0.3, rounding);    // in its plane
  EXPECT_NEAR(distance({0, 3.3, -0.4}), 0.5, rounding);    // corner
  // A capsule's segment that pierces it comes free along its own length or across an edge.
  const auto pierced = between(inscribed_capsule, to_ts_shape(Cylinder(0.25, 2)), at({0, -0.5, 0}),
                               to_ts_shape(triangle), at({0, 0, 0}));
  EXPECT_NEAR(pierced.distance, -0.75, rounding);
}

TEST(Models, NoDirectionHasALargerGapThanTheAnswer) {
  std::mt19937 random(1);
  std::normal_distribution<double> normal;
  for (const Pair pair : {Pair::capsule, Pair::cylinder, Pair::box}) {
    for (const CylinderModel& model :
         {CylinderModel(inscribed_capsule), CylinderModel(circumscribed_capsule), prism(7)}) {
      for (std::uint64_t i = 0; i < 10; ++i) {
        const Configuration c = make_configuration({pair, "general-deep", 4, i});
        const ts_pose a = to_ts_pose(c.pose_a), b = to_ts_pose(c.pose_b);
        const Separation s = between(model, to_ts_shape(c.a), a, to_ts_shape(c.b), b);
        auto part_a = model(c.a.radius(), c.a.half_length())[0];
        part_a.place(rotation_of(a), position_of(a));
        ASSERT_NEAR(s.normal.norm(), 1, rounding);
        EXPECT_NEAR((s.on_a - s.on_b).dot(s.normal), s.distance, 1e-9);
        if (pair == Pair::box) {
          auto part_b = RoundedPolytope::box(std::get<Box>(c.b).half_extents());
          part_b.place(rotation_of(b), position_of(b));
          for (int k = 0; k < 500; ++k) {
            const Vec3 n = Vec3(normal(random), normal(random), normal(random)).normalized();
            const double gap =
                part_a.support(-n).dot(n) - part_a.radius() - part_b.support(n).dot(n);
            EXPECT_LE(gap, s.distance + 1e-9);
          }
        }
      }
    }
  }
}

/// How far a point is outside a part; negative inside, if its core is no solid.
double outside(const RoundedPolytope& part, const Vec3& p) {
  if (part.is_solid()) return (p - part.closest_to(p)).norm();
  const Vec3 &from = part.vertices().front(), way = part.vertices().back() - from;
  const double along = way.norm() > 0 ? (p - from).dot(way) / way.squaredNorm() : 0;
  return (p - from - std::clamp(along, 0.0, 1.0) * way).norm() - part.radius();
}

/// What stands for a shape that is no plane, at its pose.
std::vector<RoundedPolytope> placed(const CylinderModel& model, const Shape& shape,
                                    const Pose& pose) {
  const ts_shape given = to_ts_shape(shape);
  const double* const size = given.size;
  std::vector<RoundedPolytope> parts;
  if (given.kind == TS_CYLINDER) parts = model(size[0], size[1]);
  if (given.kind == TS_SPHERE) parts = {RoundedPolytope::sphere(Vec3::Zero(), size[0])};
  if (given.kind == TS_CAPSULE) parts = {RoundedPolytope::capsule(size[0], size[1])};
  if (given.kind == TS_BOX) parts = {RoundedPolytope::box({size[0], size[1], size[2]})};
  const ts_pose at_pose = to_ts_pose(pose);
  for (RoundedPolytope& part : parts) part.place(rotation_of(at_pose), position_of(at_pose));
  return parts;
}

TEST(Models, WitnessPointsAreOnTheirBodies) {
  const auto from_nearest = [](const std::vector<RoundedPolytope>& parts, const Vec3& p) {
    double least = INFINITY;
    for (const RoundedPolytope& part : parts) least = std::min(least, outside(part, p));
    return least;
  };
  const CylinderModel models[] = {inscribed_capsule, spheres(8), prism(7), prism(16)};
  for (const Pair pair : {Pair::sphere, Pair::capsule, Pair::cylinder, Pair::box}) {
    for (const std::string& pose_class : pose_classes(pair)) {
      const Identity id(pair, pose_class, 6, 0);
      SCOPED_TRACE(to_string(id));
      const Configuration c = make_configuration(id);
      // Coordinates and sizes are rounded.
      const double allowed = rounding * std::max({larger_size(c), c.pose_a.position().norm(),
                                                  c.pose_b.position().norm()});
      for (const CylinderModel& model : models) {
        const Separation s = between(model, to_ts_shape(c.a), to_ts_pose(c.pose_a),
                                     to_ts_shape(c.b), to_ts_pose(c.pose_b));
        EXPECT_LT(from_nearest(placed(model, c.a, c.pose_a), s.on_a), allowed);
        EXPECT_LT(from_nearest(placed(model, c.b, c.pose_b), s.on_b), allowed);
      }
    }
  }
}

TEST(Models, ABoxOfPartsReachesItsFacesAndLosesItsEdges) {
  const Box plank({0.2, 1, 3});
  const Cylinder rod(0.1, 0.5);
  for (const char* name : {"box-spheres:8", "box-capsules:4"}) {
    // Across the plank at its faces' middles, where there is a part: parts are exact there.
    for (const double x : {0.299, -0.299}) {
      const Answer a = answer(name, {rod, Pose({x, 0.8, 3 - 0.2}, along_y), plank, Pose()});
      ASSERT_EQ(a.status, TS_CONTACT) << name;
      EXPECT_NEAR(a.signed_distance, -0.001, rounding) << name;
      EXPECT_NEAR(std::abs(a.normal[0]), 1, rounding) << name;
    }
    // Beside a long edge of the plank, 45° off its corner: the round is a corner's distance away.
    const double beyond = 0.07;
    const Configuration edge{rod, Pose({0.2 + beyond, 1 + beyond, 3 - 0.2}, upright), plank,
                             Pose()};
    EXPECT_NEAR(answer("reference", edge).signed_distance, std::sqrt(2.0) * beyond - 0.1, 1e-9);
    const Answer a = answer(name, edge);
    EXPECT_EQ(a.status, TS_NONE) << name;
    ASSERT_TRUE(a.model_distance);
    EXPECT_NEAR(*a.model_distance, std::sqrt(2.0) * (0.2 + beyond) - 0.2 - 0.1, rounding) << name;
  }
}

TEST(Models, ManySidesComeToTheCylinder) {
  for (const Pair pair : all_pairs) {
    for (std::uint64_t i = 0; i < 10; ++i) {
      const Configuration c = make_configuration({pair, "general-shallow", 5, i});
      const Answer a = answer("prism:128", c);
      ASSERT_TRUE(a.model_distance);
      const double truth = oracle::truth(c).signed_distance.midpoint();
      // An inscribed prism is not deeper, and shallower by at most the sagittas of both.
      EXPECT_GE(*a.model_distance, truth - 1e-9 * larger_size(c));
      const double sagitta = larger_size(c) * (1 - std::cos(M_PI / 128));
      if (pair != Pair::cylinder && !has_faces(pair)) {
        EXPECT_LE(*a.model_distance, truth + 2 * sagitta);
      }
      if (a.status == TS_CONTACT) {
        EXPECT_EQ(a.signed_distance, *a.model_distance);
      }
    }
  }
}

// Touchstone asks for the distance right after the query at the same poses; others need not.
TEST(Models, TellTheDistanceAtAnyPosesWhateverWasAskedBefore) {
  void* const library =
      dlopen(find_candidate("capsule").plugin()->file.c_str(), RTLD_NOW | RTLD_LOCAL);
  ASSERT_TRUE(library) << dlerror();
  const auto plugin =
      reinterpret_cast<const ts_plugin* (*)()>(dlsym(library, "touchstone_plugin"))();
  ASSERT_GE(plugin->count, 4);
  const ts_shape a = to_ts_shape(Cylinder(0.1, 0.5)), b = to_ts_shape(Sphere(0.2));
  const ts_pose near = at({0.25, 0, 0}), far = at({3, 0, 0}), origin = at({0, 0, 0});
  for (int i = 0; i < plugin->count; ++i) {
    const ts_candidate& model = plugin->candidates[i];
    const double parameter = model.parameter ? model.parameter->usual : 0;
    const auto prepare = [&] { return model.prepare(model.context, &a, &b, 1, parameter); };
    ts_prepared* const fresh = prepare();
    const double at_near = model.model_distance(fresh, &near, &origin);
    const double at_far = model.model_distance(fresh, &far, &origin);
    model.release(fresh);
    EXPECT_LT(at_near, 0.01) << model.name;
    EXPECT_GT(at_far, 2.5) << model.name;
    ts_prepared* const asked = prepare();
    ts_answer answer;
    model.query(asked, &near, &origin, nullptr, &answer);
    EXPECT_EQ(model.model_distance(asked, &far, &origin), at_far) << model.name;
    EXPECT_EQ(model.model_distance(asked, &near, &origin), at_near) << model.name;
    EXPECT_GT(model.model_distance(asked, &near, &far), 2) << model.name;
    model.release(asked);
  }
}

}  // namespace
}  // namespace touchstone
