// Faces that are plane but for a hair, as those of meshes in single precision are: what stands or
// lies on them has the points that it has on the plane, and these are on the faces.
//
// TOUCHSTONE_COUNT sets how many configurations of each kind are tried.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <gtest/gtest.h>
#include <limits>
#include <numbers>
#include <set>
#include <vector>

#include "reference/contact_of.hpp"
#include "reference/convex_tables.hpp"
#include "reference/curves.hpp"
#include "reference/hull_movement_test.hpp"
#include "reference/points_on_both_test.hpp"
#include "reference/random_hulls_test.hpp"

namespace touchstone {
namespace {

/// The points turned, as a file in single precision holds them.
Convex in_single_precision(std::vector<Vec3> points, const Quaternion& turn) {
  for (Vec3& p : points) p = (turn * p).cast<float>().cast<double>();
  return oracle::convex_hull(points);
}

/// How many facets there are for what is not sharp.
std::size_t flat_count(const Convex& hull) {
  const auto& flats = hull.tables().vertex_flats.items;
  return std::set(flats.begin(), flats.end()).size();
}

std::vector<Vec3> corners_of_prism(int sides, double radius, double half_length) {
  std::vector<Vec3> corners;
  for (int i = 0; i < sides; ++i) {
    const double angle = 2 * std::numbers::pi * i / sides;
    for (const double z : {half_length, -half_length}) {
      corners.emplace_back(radius * std::cos(angle), radius * std::sin(angle), z);
    }
  }
  return corners;
}

/// Of a box, and so many squared points more on each of two faces and their edges.
std::vector<Vec3> tessellated(const Box& box, int squares) {
  std::vector<Vec3> points = corners_of(box);
  for (int i = 0; i <= squares; ++i) {
    for (int k = 0; k <= squares; ++k) {
      for (const double side : {-1.0, 1.0}) {
        const Vec3 part(2.0 * i / squares - 1, 2.0 * k / squares - 1, side);
        points.push_back(part.cwiseProduct(box.half_extents()));
      }
    }
  }
  return points;
}

double support(const Contact& contact, const Vec3& way) {
  double most = -std::numeric_limits<double>::infinity();
  for (const ContactPoint& p : contact.points()) most = std::max(most, p.position.dot(way));
  return most;
}

/// What the deepest point of a rough facet may lack.
double unseen_depth(const Configuration& c) { return 1e-6 * smaller_size(c); }

/// Do the points reach as far to all sides of the other contact's middle as its own do, or nearly
/// half as far, as three points of a disc reach? They need not be the same ones.
void expect_same_span(const Contact& found, const Contact& other) {
  Vec3 middle = Vec3::Zero();
  for (const ContactPoint& p : other.points()) {
    middle += p.position / static_cast<double>(other.points().size());
  }
  constexpr int ways = 24;
  constexpr double part = 0.4;
  for (int i = 0; i < ways; ++i) {
    const double angle = 2 * std::numbers::pi * i / ways;
    const Vec3 way(std::cos(angle), std::sin(angle), 0);
    const double reach = support(other, way) - middle.dot(way);
    EXPECT_GE(support(found, way) - middle.dot(way), part * reach - 1e-6);
  }
}

TEST(RoughFacets, AreThoseOfTheBodyOfWhichAMeshIsMade) {
  const Quaternion turn = aslant.normalized();
  for (const int sides : {3, 4, 8, 64}) {
    const std::vector<Vec3> corners = corners_of_prism(sides, 1, 0.5);
    const Convex mesh = in_single_precision(corners, turn);
    EXPECT_GT(mesh.faces().size(), sides == 3 ? 5 : sides + 2);
    EXPECT_EQ(flat_count(mesh), sides + 2);
    EXPECT_EQ(flat_count(oracle::convex_hull(corners)), sides + 2);
  }
  const Convex mesh = in_single_precision(tessellated(Box({1, 2, 3}), 5), turn);
  EXPECT_GT(mesh.faces().size(), 20);
  EXPECT_EQ(flat_count(mesh), 6);
  for (const int f : mesh.tables().vertex_flats.items) {
    EXPECT_EQ(mesh.tables().facets[static_cast<std::size_t>(f)].corners.size(), 4);
  }
  // A roof that is plainly one.
  for (const double rise : {1e-2, 1e-4, 1e-5}) {
    std::vector<Vec3> corners = corners_of(Box({1, 1, 1}));
    corners.emplace_back(-1, 0, 1 + rise);
    corners.emplace_back(1, 0, 1 + rise);
    EXPECT_EQ(flat_count(oracle::convex_hull(corners)), 7) << rise;
  }
}

/// A mesh of a box whose top is at the world's height 0, in a place of its own, and the same box.
struct BoxMesh {
  Box box;
  Convex mesh;
  Pose of_box, of_mesh;

  explicit BoxMesh(Random& random)
      : BoxMesh(Box({random.uniform(0.2, 1), random.uniform(0.2, 1), random.uniform(0.2, 1)}),
                1 + random.one_of(5), random.turn(),
                Vec3(random.uniform(-9, 9), random.uniform(-9, 9), 0)) {}

 private:
  BoxMesh(const Box& of, int squares, const Quaternion& turn, const Vec3& place)
      : box(of),
        mesh(in_single_precision(tessellated(of, squares), turn)),
        of_box(place - Vec3(0, 0, of.half_extents().z()), Quaternion::Identity()),
        of_mesh(of_box.position(), turn.conjugate()) {}
};

void expect_as_on_the_box(const BoxMesh& b, const Cylinder& a, const Pose& pose) {
  constexpr double threshold = 1e-3, single_precision = 3e-7;
  const Configuration on_mesh{a, pose, b.mesh, b.of_mesh};
  const Contact found = contact(on_mesh, threshold);
  const Contact exact = contact({a, pose, b.box, b.of_box}, threshold);
  EXPECT_NEAR(found.signed_distance, exact.signed_distance, 4 * single_precision);
  expect_same_span(found, exact);
  // Beside an edge that is as rough, too.
  expect_points_on_both(on_mesh, found, single_precision, unseen_depth(on_mesh));
}

/// A can that stands or lies anywhere on the top, or over its edges; its depth is far above what
/// single precision leaves of the top.
void expect_as_on_boxes(std::uint64_t seed, bool is_lying) {
  Random random(seed);
  for (std::uint64_t i = 0; i < tried_of_each(2000); ++i) {
    SCOPED_TRACE(i);
    const BoxMesh b(random);
    const Cylinder a(random.uniform(0.05, 0.5), random.uniform(0.05, 0.5));
    const Vec3 e = b.box.half_extents(), place = b.of_box.position();
    const Eigen::AngleAxisd turned(random.uniform(0, 6), Vec3::UnitZ());
    const Eigen::AngleAxisd tilted(is_lying ? std::numbers::pi / 2 : 0, Vec3::UnitX());
    const Vec3 centre(place.x() + random.uniform(-0.9, 0.9) * e.x(),
                      place.y() + random.uniform(-0.9, 0.9) * e.y(),
                      (is_lying ? a.radius() : a.half_length()) - random.power_of_ten(-5, -3));
    expect_as_on_the_box(b, a, Pose(centre, turned * tilted));
    if (testing::Test::HasFailure()) return;
  }
}
TEST(RoughFacets, CarryACanAsTheirBoxDoes) { expect_as_on_boxes(1, false); }
TEST(RoughFacets, CarryALyingCylinderAsTheirBoxDoes) { expect_as_on_boxes(2, true); }

// Which of a mesh's triangles a body is said to stand on may change with any step; its points do
// not.
TEST(RoughFacets, KeepTheHullOfPointsWhereItIs) {
  Random random(4);
  for (std::uint64_t i = 0; i < tried_of_each(4000); ++i) {
    SCOPED_TRACE(i);
    const Quaternion turn = random.turn();
    const double radius = random.uniform(0.2, 1), half_length = random.uniform(0.2, 1);
    const std::vector<Vec3> corners = corners_of_prism(3 + random.one_of(30), radius, half_length);
    const Convex mesh = in_single_precision(corners, turn);
    const Pose of_mesh(Vec3(0, 0, -half_length), turn.conjugate());
    const Cylinder a(random.uniform(0.05, 0.5), random.uniform(0.05, 0.5));
    const bool is_lying = random.toss();
    const double lean = random.toss() ? 0 : random.power_of_ten(-12, -4);
    const double depth = random.power_of_ten(-6, -3), spin = random.uniform(0, 6);
    const Vec3 place(random.uniform(-1, 1) * radius, random.uniform(-1, 1) * radius,
                     (is_lying ? a.radius() : a.half_length()) - depth);
    const auto contact_after = [&](double step) {
      const double tilt = (is_lying ? std::numbers::pi / 2 : 0) + lean + step;
      const Eigen::AngleAxisd tilted(tilt, Vec3::UnitX()), turned(spin + step, Vec3::UnitZ());
      return contact({a, Pose(place + step * Vec3(1, 2, -1), turned * tilted), mesh, of_mesh},
                     1e-6);
    };
    EXPECT_LE(hull_movement(contact_after(0), contact_after(1e-10)),
              0.01 * std::max(a.radius(), a.half_length()));
    if (HasFailure()) return;
  }
}

// Tops that are bent by 1e-9 to 1e-3 of their size, one facet or many.
TEST(RoughFacets, OfBentTopsHavePointsOnBoth) {
  Random random(3);
  for (std::uint64_t i = 0; i < tried_of_each(2000); ++i) {
    SCOPED_TRACE(i);
    const double bend = random.power_of_ten(-9, -3);
    std::vector<Vec3> corners = {{-1, -1, -1}, {1, -1, -1}, {0, 1, -1}};
    const int count = 4 + random.one_of(40);
    for (int k = 0; k < count; ++k) {
      const Vec2 p(random.uniform(-1, 1), random.uniform(-1, 1));
      corners.emplace_back(p.x(), p.y(), -bend * p.squaredNorm());
    }
    const Cylinder a(random.uniform(0.05, 1), random.uniform(0.05, 1));
    const Vec3 axis = Vec3::UnitZ() + random.power_of_ten(-12, -2) * random.direction();
    const Configuration above{a,
                              Pose(Vec3(random.uniform(-1, 1), random.uniform(-1, 1), 1),
                                   Quaternion::FromTwoVectors(Vec3::UnitZ(), axis)),
                              oracle::convex_hull(corners), Pose(Vec3(1, 2, 3), aslant)};
    Configuration c = above;
    c.pose_a = Pose(c.pose_b.position() + aslant.normalized() * above.pose_a.position(),
                    aslant.normalized() * above.pose_a.orientation());
    c = moved_to_depth(c, random.power_of_ten(-6, -2) * smaller_size(c));
    expect_points_on_both(c, contact(c, 0), 1e-12, unseen_depth(c));
    if (HasFailure()) return;
  }
}

}  // namespace
}  // namespace touchstone
