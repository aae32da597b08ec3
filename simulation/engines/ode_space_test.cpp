// ODE's spaces: which of them report every pair of geoms whose boxes overlap. The first test is a
// program of ODE alone, for its maintainers and users.
//
// dxHashSpace puts a box of more than half a metre and at most one into cells of a metre, and finds
// cell x, y, z at (1000 level + 100 x + 10 y + z) modulo the table's size, in unsigned numbers, but
// steps from there to z + 1 by adding one: from a sum of -1, which wraps, it comes to another place
// than where sum 0 stands. So what reaches below z = 0 in cell x = 0, y = 0 is not found by what
// stands above it there.
#include <gtest/gtest.h>
#include <ode/ode.h>
#include <random>

#include "candidates/ode_library.hpp"
#include "simulation/each_world.hpp"
#include "simulation/mechanism_scenes.hpp"

namespace touchstone {
namespace {

dSpaceID hash_space() { return dHashSpaceCreate(nullptr); }
dSpaceID simple_space() { return dSimpleSpaceCreate(nullptr); }
dSpaceID sweep_space() { return dSweepAndPruneSpaceCreate(nullptr, dSAP_AXES_XYZ); }

/// Number of pairs that a space reports of two boxes: side lengths and centres.
int pairs_of(dSpaceID space, const Vec3& side_a, const Vec3& centre_a, const Vec3& side_b,
             const Vec3& centre_b) {
  const dGeomID a = dCreateBox(space, side_a.x(), side_a.y(), side_a.z());
  const dGeomID b = dCreateBox(space, side_b.x(), side_b.y(), side_b.z());
  dGeomSetPosition(a, centre_a.x(), centre_a.y(), centre_a.z());
  dGeomSetPosition(b, centre_b.x(), centre_b.y(), centre_b.z());
  int pairs = 0;
  dSpaceCollide(space, &pairs, [](void* count, dGeomID, dGeomID) { ++*static_cast<int*>(count); });
  dSpaceDestroy(space);
  return pairs;
}

TEST(OdeSpaces, AHashSpaceLosesABrickInATable) {
  initialise_ode();
  const Vec3 table(0.8, 0.8, 0.1), brick(0.06, 0.06, 0.06);
  const auto pairs = [&](dSpaceID space, const Vec3& place) {
    return pairs_of(space, table, Vec3::Zero(), brick, place);
  };
  for (const double x : {-0.2, 0.2}) {
    for (const double y : {-0.2, 0.2}) {
      for (const double z : {-0.04, 0.04}) {  // 4 cm deep in the table, from below or above
        const Vec3 place(x, y, z);
        const bool is_lost = x > 0 && y > 0 && z > 0;
        EXPECT_EQ(pairs(hash_space(), place), is_lost ? 0 : 1) << place.transpose();
        EXPECT_EQ(pairs(simple_space(), place), 1) << place.transpose();
        EXPECT_EQ(pairs(sweep_space(), place), 1) << place.transpose();
      }
    }
  }
}

/// What is lost of random boxes about the origin that overlap, some by a millionth of a millimetre.
TEST(OdeSpaces, TheOthersLoseNothing) {
  initialise_ode();
  std::mt19937 random(1);
  const auto draw = [&](double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random);
  };
  constexpr int count = 2000;
  constexpr double least_overlap = 1e-9;  // m
  int lost_by_hash = 0, lost_by_simple = 0, lost_by_sweep = 0;
  for (int i = 0; i < count; ++i) {
    Vec3 side_a, side_b, centre_a, centre_b;
    for (int axis = 0; axis < 3; ++axis) {
      side_a[axis] = draw(0.02, 1.5);
      side_b[axis] = draw(0.02, 1.5);
      centre_a[axis] = draw(-1, 1);
      const double reach = (side_a[axis] + side_b[axis]) / 2 - least_overlap;
      centre_b[axis] = centre_a[axis] + (i % 2 == 0 ? draw(-reach, reach) : reach);
    }
    const auto lost = [&](dSpaceID space) {
      return 1 - pairs_of(space, side_a, centre_a, side_b, centre_b);
    };
    lost_by_hash += lost(hash_space());
    lost_by_simple += lost(simple_space());
    lost_by_sweep += lost(sweep_space());
  }
  EXPECT_GT(lost_by_hash, 0);
  EXPECT_EQ(lost_by_simple, 0);
  EXPECT_EQ(lost_by_sweep, 0);
}

// With ODE's contacts and with ours, the coin's height after each step.
TEST(OdeSpaces, ACoinStaysOnARoundTableInOdesWorld) {
  Scene scene;
  scene.duration = 0.3;
  Body table{.name = "table", .shape = Cylinder(0.4, 0.05), .pose = at(0, 0, 0)};
  scene.bodies = {fixed(table),
                  {.name = "coin", .shape = Cylinder(0.03, 0.01), .pose = at(0.2, 0.2, 0.06)}};
  for (const bool cured : {false, true}) {
    const States end = states_of(scene, in_engine("ode", {.cured = cured})).back();
    EXPECT_NEAR(end[1].pose.position().z(), 0.06, 1e-3)
        << (cured ? "with our contacts" : "with ODE's");
  }
}

}  // namespace
}  // namespace touchstone
