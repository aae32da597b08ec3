// Floors of triangles: that they are where they should be, and what engines make of them in
// contacts that are known on paper; docs/engines.md has it in words. The tests detect a new version
// that changes it.
#include "candidates/floor.hpp"

#include <cmath>
#include <gtest/gtest.h>
#include <limits>

#include "candidates/testing/plain_contacts.hpp"

namespace touchstone {
namespace {

constexpr double rounding_of_floor = 1e-12;

const ts_shape log_shape = sized(TS_CYLINDER, 0.5, 1);
const ts_shape crate = sized(TS_BOX, 1, 2, 3);

Vec3 normal_of(const Floor& floor, const Floor::Triangle& triangle) {
  const Vec3 &u = floor.corners()[triangle[0]], &v = floor.corners()[triangle[1]],
             &w = floor.corners()[triangle[2]];
  return (v - u).cross(w - u);
}

TEST(Floor, OfABoxIsItsSurfaceSeenFromOutside) {
  const Floor floor(log_shape, crate, 3);
  EXPECT_EQ(floor.triangles().size(), 6U * 3 * 3 * 2);
  double area = 0, volume = 0;
  for (const Floor::Triangle& t : floor.triangles()) {
    const Vec3 n = normal_of(floor, t);
    area += n.norm() / 2;
    volume += n.dot(floor.corners()[t[0]]) / 6;
  }
  EXPECT_NEAR(area, 4 * 2 * (1 * 2 + 2 * 3 + 3 * 1), rounding_of_floor);
  EXPECT_NEAR(volume, 8 * 1 * 2 * 3, rounding_of_floor);
}

TEST(Floor, OfAPlaneLooksAlongItsNormalWhereverItIsPosed) {
  const Vec3 n = Vec3(1, 2, -2) / 3;
  const ts_shape plane = sized(TS_PLANE, n.x(), n.y(), n.z(), 0.7);
  const Quaternion turned = Quaternion(0.5, -0.1, 0.7, 0.3).normalized();
  const ts_pose a = to_ts_pose(Pose({3, -40, 5})), b = to_ts_pose(Pose({1, 2, 3}, turned));
  for (const int count : {2, 5}) {
    const Floor floor(log_shape, plane, count);
    const ts_pose at = floor.at(a, b);
    const Vec3 up = turned * n;
    for (const Floor::Triangle& t : floor.triangles()) {
      EXPECT_GT((rotation_of(at) * normal_of(floor, t)).normalized().dot(up),
                1 - rounding_of_floor);
    }
    for (const Vec3& c : floor.corners()) {
      const Vec3 corner = rotation_of(at) * c + position_of(at);
      EXPECT_NEAR(up.dot(corner - Vec3(1, 2, 3)), 0.7, 1e-13 * 40);
    }
  }
}

TEST(Floor, OfAPlaneIsUnderTheWholeCylinderAndMovesByWholeSquares) {
  const ts_shape ground = sized(TS_PLANE, 0, 0, 1, 0);
  const double reach = std::hypot(0.5, 1);
  for (const int count : {2, 3, 8, 9}) {
    const Floor floor(log_shape, ground, count);
    for (const double x : {0.0, 0.3, 1.0, -7.77, 1234.5}) {
      const ts_pose at = floor.at(to_ts_pose(Pose({x, -x, 0.4})), to_ts_pose(Pose()));
      double low = std::numeric_limits<double>::infinity(),
             high = -std::numeric_limits<double>::infinity();
      for (const Vec3& c : floor.corners()) {
        const double of_corner = c.x() + at.position[0];
        low = std::min(low, of_corner), high = std::max(high, of_corner);
        const double squares = of_corner / floor.side();
        EXPECT_NEAR(squares, std::round(squares), 1e-9);
      }
      EXPECT_LE(low, x - reach);
      EXPECT_GE(high, x + reach);
    }
  }
}

// Squares of 2.8 m, of a floor of 2 × 2: the can is 1 m wide and fits into a triangle of them, and
// the log is 2 m long. Of 8 × 8 both lie across several.
const double side_of_two = 5 * std::hypot(0.5, 1) / 2;
constexpr double sunk = 0.01;

Configuration can_at(double x, double y) {
  return {Cylinder(0.5, 1), Pose({x, y, 1 - sunk}, upright), Plane({0, 0, 1}, 0), Pose()};
}
Configuration log_at(const Quaternion& along, double x, double y) {
  return {Cylinder(0.5, 1), Pose({x, y, 0.5 - sunk}, along), Plane({0, 0, 1}, 0), Pose()};
}

/// A contact whose sunk is `sunk` and whose normal points up.
struct FloorContact {
  const char* name;
  Configuration configuration;
};
std::vector<FloorContact> floor_contacts() {
  return {{"can in a triangle", can_at(2 * side_of_two / 3, side_of_two / 3)},
          {"can on a seam", can_at(side_of_two / 2, 0)},
          {"can on a diagonal", can_at(side_of_two / 2, side_of_two / 2)},
          {"can on a vertex", can_at(0, 0)},
          {"log in a triangle", log_at(along_x, 0.7 * side_of_two, 0.2 * side_of_two)},
          {"log along a seam", log_at(along_x, side_of_two / 2, 0)},
          {"log across a seam", log_at(along_y, side_of_two / 2, 0)},
          {"log across a vertex", log_at(along_y, 0, 0)}};
}

/// What a floor makes of a contact: its depth, and the largest angle, degrees, between a point's
/// normal and the plane's.
struct AtSeam {
  const char *candidate, *contact;
  double depth, angle;
};
/// Where that is not the truth.
constexpr AtSeam wrong_at_seams[] = {
    {"bullet-floor:8", "can in a triangle", 0.01, 11.03},
    {"bullet-heights:8", "can in a triangle", 0.01, 11.03},
    {"bullet-heights:8", "log in a triangle", 0.01, 2.95},
    // The can's side is beside an edge, which is as deep in it as it is below: a point along x or
    // y.
    {"ode-floor:8", "can on a seam", 0.01, 90},
    {"ode-floor:8", "can on a diagonal", 0.01, 90},
    {"ode-floor:8", "can on a vertex", 0.01, 90},
    {"fcl-floor:8", "can on a seam", 0.01, 90},
    {"fcl-floor:8", "can on a diagonal", 0.01, 90},
    {"fcl-floor:8", "can on a vertex", 0.01, 90},
    {"fcl-floor:2", "log along a seam", 0.0203, 61.6},
    {"fcl-floor:2", "log across a vertex", 0.0346, 75.1},
    {"fcl-floor:8", "log along a seam", 0.0136, 43.1},
    {"fcl-floor:8", "log across a seam", 0.0132, 41.1},
    {"fcl-floor:8", "log across a vertex", 0.0136, 43.0},
    {"mujoco-heights:2", "log along a seam", 0.0103, 0.33},
    {"mujoco-heights:2", "log across a vertex", 0.0114, 0.65},
};

constexpr const char* floors[] = {
    "bullet-floor", "bullet-floor-edges", "bullet-heights", "bullet-heights-edges",
    "ode-floor",    "ode-heights",        "fcl-floor",      "mujoco-heights"};

AtSeam expected(const std::string& candidate, const std::string& contact) {
  const auto found = std::ranges::find_if(wrong_at_seams, [&](const AtSeam& s) {
    return s.candidate == candidate && s.contact == contact;
  });
  return found == std::end(wrong_at_seams) ? AtSeam{"", "", sunk, 0} : *found;
}

double largest_angle(const Answer& a, const Vec3& up) {
  double angle = 0;
  for (int i = 0; i < a.point_count; ++i) {
    const double cosine = Vec3(a.points[i].normal).dot(up);
    angle = std::max(angle, std::acos(std::clamp(cosine, -1.0, 1.0)) * 180 / M_PI);
  }
  return angle;
}

TEST(FloorContacts, AreThePlanesButAtSeams) {
  // MPR stops within 1e-6 of the depth, which on a side is √(2e-6/0.5) off in the direction.
  constexpr double length = 2e-4, degrees = 0.2;
  for (const std::string family : floors) {
    for (const char* count : {":2", ":8"}) {
      for (const FloorContact& c : floor_contacts()) {
        const std::string name = family + count;
        SCOPED_TRACE(name + ' ' + c.name);
        const AtSeam e = expected(name, c.name);
        const Answer a = answer(name, c.configuration);
        ASSERT_EQ(a.status, TS_CONTACT) << a.reason;
        EXPECT_NEAR(a.signed_distance, -e.depth, length);
        EXPECT_NEAR(largest_angle(a, Vec3::UnitZ()), e.angle, degrees);
      }
    }
  }
}

TEST(FloorContacts, TurnWithTheWorld) {
  const Quaternion turn = Quaternion(0.5, -0.1, 0.7, 0.3).normalized();
  const Vec3 shift(0.3, -0.2, 0.5), up = turn * Vec3::UnitZ();
  // The middle of a triangle of a plane, and of a box.
  for (const Shape& flat : {Shape(Plane(Vec3::UnitZ(), 1)), Shape(Box({3, 3, 1}))}) {
    for (const std::string family : floors) {
      const Candidate& candidate = find_candidate(family + ":2");
      const Configuration c{Cylinder(0.5, 1), Pose(turn * Vec3(2, 1, 2 - sunk) + shift, turn), flat,
                            Pose(shift, turn)};
      if (!candidate.has_routine_for(pair_of(c))) continue;
      SCOPED_TRACE(family + ' ' + pair_name(pair_of(c)));
      const Answer a = answer(candidate.name, c);
      ASSERT_EQ(a.status, TS_CONTACT) << a.reason;
      EXPECT_NEAR(a.signed_distance, -sunk, 1e-6);
      EXPECT_LT(largest_angle(a, up), 1e-3);
      const Answer none =
          answer(candidate.name,
                 {c.a, Pose(c.pose_a.position() + 2 * sunk * up, turn), flat, Pose(shift, turn)});
      EXPECT_EQ(none.status, TS_NONE);
    }
  }
}

// Its cap is the octagon about the disc.
TEST(FloorContacts, OfOdesMeshAreBesideTheCan) {
  const Answer a = answer("ode-floor:2", can_at(2 * side_of_two / 3, side_of_two / 3));
  ASSERT_EQ(a.point_count, 8);
  for (int i = 0; i < a.point_count; ++i) {
    const Vec3 p = Vec3(a.points[i].position) - Vec3(2 * side_of_two / 3, side_of_two / 3, 0);
    EXPECT_NEAR(p.head<2>().norm(), 0.5 / std::cos(M_PI / 8), 1e-6);
  }
}

// A floor has no inside, but for a heightfield's.
TEST(FloorContacts, AreNoneWhollyBelowTheSurface) {
  const Configuration below{Cylinder(0.5, 1), Pose({0.3, 0.4, -1.5}, upright),
                            Plane(Vec3::UnitZ(), 0), Pose()};
  for (const std::string family : floors) {
    EXPECT_EQ(answer(family + ":8", below).status,
              family == "ode-heights" || family == "mujoco-heights" ? TS_CONTACT : TS_NONE)
        << family;
  }
}

TEST(FloorContacts, AreOfPlanesAndBoxesAlone) {
  for (const std::string family : floors) {
    const Candidate& candidate = find_candidate(family);
    EXPECT_TRUE(candidate.has_routine_for(Pair::plane)) << family;
    EXPECT_FALSE(candidate.has_routine_for(Pair::sphere)) << family;
    EXPECT_FALSE(candidate.has_routine_for(Pair::convex)) << family;
  }
}

}  // namespace
}  // namespace touchstone
