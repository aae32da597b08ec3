#include <algorithm>
#include <cmath>
#include <functional>
#include <gtest/gtest.h>
#include <limits>
#include <string>
#include <vector>

#include "reference/configuration.hpp"
#include "reference/contact_of.hpp"
#include "reference/convex_tables.hpp"
#include "reference/error_of_test.hpp"
#include "reference/invalid_input.hpp"
#include "reference/support.hpp"

namespace touchstone {
namespace {

using Quaternion = Eigen::Quaterniond;

constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr double infinite = std::numeric_limits<double>::infinity();

TEST(Vocabulary, RefusesWhatIsNoShapeOrPoseAndNamesTheField) {
  const struct {
    std::function<void()> make;
    const char* field;
    const char* value;
  } table[] = {
      {[] { Sphere(0); }, "radius", "0"},
      {[] { Sphere(-1); }, "radius", "-1"},
      {[] { Sphere{nan}; }, "radius", "nan"},
      {[] { Sphere{infinite}; }, "radius", "inf"},
      {[] { Cylinder(0, 1); }, "radius", "0"},
      {[] { Cylinder(1, 0); }, "half_length", "0"},
      {[] { Cylinder(1, -0.5); }, "half_length", "-0.5"},
      {[] { Capsule(nan, 1); }, "radius", "nan"},
      {[] { Capsule(1, infinite); }, "half_length", "inf"},
      {[] { Box(Vec3(1, 0, 1)); }, "half_extents[1]", "0"},
      {[] { Box(Vec3(1, 1, nan)); }, "half_extents[2]", "nan"},
      {[] { Plane(Vec3(0, 0, 0), 1); }, "normal", "[0, 0, 0]"},
      {[] { Plane(Vec3(0, nan, 0), 1); }, "normal[1]", "nan"},
      {[] { Plane(Vec3(0, 0, 1), infinite); }, "displacement", "inf"},
      {[] { Pose(Vec3(0, 0, nan), Quaternion(1, 0, 0, 0)); }, "position[2]", "nan"},
      {[] { Pose(Vec3(0, nan, 0)); }, "position[1]", "nan"},
      {[] { Pose(Vec3(infinite, 0, 0)); }, "position[0]", "inf"},
      {[] { Pose(Vec3::Zero(), Quaternion(0, 0, 0, 0)); }, "orientation", "[0, 0, 0, 0]"},
      {[] { Pose(Vec3::Zero(), Quaternion(1, infinite, 0, 0)); }, "orientation[1]", "inf"},
  };
  for (const auto& row : table) {
    const InvalidInput error = error_of(row.make);
    EXPECT_EQ(error.field(), row.field);
    EXPECT_EQ(error.value(), row.value);
    EXPECT_NE(error.remedy().find("must"), std::string::npos);
  }
}

TEST(Vocabulary, APoseOfAPositionAloneIsNotTurned) {
  for (const Vec3& position : {Vec3(1, 2, 3), Vec3(1e300, -1e308, 1e308)}) {
    const Pose pose(position);
    EXPECT_EQ(pose.position(), position);
    EXPECT_EQ(pose.rotation(), Eigen::Matrix3d::Identity());
  }
}

TEST(Vocabulary, FieldsAreNamedFromOutsideIn) {
  EXPECT_EQ(InvalidInput("radius", "-1", "must be positive").within("a").field(), "a.radius");
}

TEST(Vocabulary, KeepsTheOrientationAsGiven) {
  const Pose pose(Vec3::Zero(), Quaternion(2, 0, 0, 2));
  EXPECT_EQ(pose.orientation().w(), 2);
  EXPECT_TRUE(pose.rotation().isApprox(
      Eigen::AngleAxisd(std::acos(-1.0) / 2, Vec3::UnitZ()).toRotationMatrix()));
}

constexpr double min_double = std::numeric_limits<double>::denorm_min();

TEST(Vocabulary, QuaternionsOfAnyLengthGiveOneOrientation) {
  const Quaternion q(0.5, -1.25, 3, 0.75);
  const Pose pose(Vec3::Zero(), q);
  // Of the last two the squared length overflows, or vanishes.
  for (const int exponent : {-3, 300, 460, -500, 1000, -1000}) {
    const auto times = [exponent](double x) { return std::scalbn(x, exponent); };
    const Pose other(Vec3::Zero(),
                     Quaternion(times(q.w()), times(q.x()), times(q.y()), times(q.z())));
    EXPECT_EQ(other.unit_orientation().coeffs(), q.normalized().coeffs()) << exponent;
    EXPECT_EQ(other.rotation(), pose.rotation()) << exponent;
  }
}

TEST(Vocabulary, TheLongestAndTheShortestQuaternionHaveUnitLength) {
  constexpr double max_double = std::numeric_limits<double>::max();
  for (const double length :
       {min_double, 1e-320, 1e-300, 1e-162, 1e-154, 1e154, 1e300, max_double}) {
    for (const Quaternion& q :
         {Quaternion(length, 0, 0, 0), Quaternion(0, length, -length, 0),
          Quaternion(length, length, length, length), Quaternion(0, 0, length / 3, length)}) {
      const Pose pose(Vec3::Zero(), q);
      EXPECT_NEAR(pose.unit_orientation().norm(), 1, 4e-16) << length;
      EXPECT_TRUE((pose.rotation() * pose.rotation().transpose()).isIdentity(1e-15)) << length;
    }
  }
}

TEST(Vocabulary, APlanesNormalOfAnyLengthGivesAUnitVector) {
  for (const double length : {min_double, 1e-320, 1e-300, 1e-162, 1e154, 1e308}) {
    EXPECT_EQ(Plane(Vec3(0, 0, -length), 0).unit_normal(), Vec3(0, 0, -1)) << length;
    EXPECT_NEAR(Plane(Vec3(length, -length, length), 0).unit_normal().norm(), 1, 4e-16) << length;
  }
  EXPECT_EQ(Plane(Vec3(0, 0, 1e-320), 1e-320).unit_displacement(), 1);
}

TEST(Vocabulary, ACapsulesSizeDoesNotOverflow) {
  constexpr double max_double = std::numeric_limits<double>::max();
  EXPECT_EQ(largest_half_extent(Capsule(max_double, max_double)), max_double);
}

TEST(Vocabulary, PairsHaveBothNamesAndTheSmallestAndLargestHalfExtent) {
  const struct {
    Shape b;
    std::string name;
    double smaller, larger;
  } table[] = {{Plane(Vec3(0, 0, 1), 1e9), "plane", 0.5, 2},
               {Sphere(0.25), "sphere", 0.25, 2},
               {Sphere(3), "sphere", 0.5, 3},
               {Capsule(0.25, 3), "capsule", 0.25, 3.25},
               {Cylinder(3, 0.25), "cylinder", 0.25, 3},
               {Box(Vec3(0.25, 4, 3)), "box", 0.25, 4},
               {Box(Vec3(3, 0.25, 4)), "box", 0.25, 4},
               {Box(Vec3(4, 3, 0.25)), "box", 0.25, 4}};
  for (const auto& [b, name, smaller, larger] : table) {
    const Configuration c{Cylinder(0.5, 2), Pose(), b, Pose()};
    EXPECT_EQ(pair_name(pair_of(c)), "cylinder-" + name);
    EXPECT_EQ(shape_name(b), name);
    EXPECT_EQ(smaller_size(c), smaller) << name;
    EXPECT_EQ(larger_size(c), larger) << name;
  }
}

TEST(Support, IsTheFarthestExtentAlongADirection) {
  const Pose pose(Vec3(1, 2, 3), Quaternion(1, 0, 1, 0));  // local z along world x
  EXPECT_NEAR(support(Cylinder(0.5, 2), pose, Vec3(1, 0, 0)), 3, 1e-15);
  EXPECT_NEAR(support(Cylinder(0.5, 2), pose, Vec3(0, 1, 0)), 2.5, 1e-15);
  EXPECT_NEAR(support(Cylinder(3, 4), pose, Vec3(0.6, 0.8, 0)), 2.2 + 4 * 0.6 + 3 * 0.8, 1e-14);
  EXPECT_NEAR(support(Capsule(0.5, 2), pose, Vec3(1, 0, 0)), 3.5, 1e-15);
  EXPECT_NEAR(support(Sphere(0.5), pose, Vec3(0, 0, -1)), -2.5, 1e-15);
  EXPECT_NEAR(support(Box(Vec3(1, 2, 3)), pose, Vec3(1, 0, 0)), 4, 1e-15);
}

TEST(Gap, IsTheClearanceAlongTheNormalFromBToA) {
  const Configuration c{Cylinder(0.5, 1), Pose(Vec3(0, 0, 5), Quaternion::Identity()), Sphere(1),
                        Pose()};
  EXPECT_EQ(gap(c, Vec3(0, 0, 1)), 3);
  EXPECT_EQ(gap(c, Vec3(0, 0, -1)), -7);
}

TEST(Aabb, OfAHalfSpaceIsBoundedOnlyAlongItsNormal) {
  const Aabb ground = aabb(Plane({0, 0, 2}, 3), Pose({5, 6, 1}, {1, 0, 0, 0}));
  EXPECT_EQ(ground.upper.z(), 2.5);
  EXPECT_EQ(ground.lower.z(), -std::numeric_limits<double>::infinity());
  EXPECT_EQ(ground.upper.x(), std::numeric_limits<double>::infinity());
}

using Faces = std::vector<std::vector<int>>;

const std::vector<Vec3> tetrahedron_vertices = {{0, 0, 0}, {2, 0, 0}, {0, 3, 0}, {0, 0, 4}};
const Faces tetrahedron_faces = {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}};

Convex tetrahedron() { return {tetrahedron_vertices, tetrahedron_faces}; }
Convex triangle() { return {{{0, 0, 1}, {2, 0, 1}, {0, 8, 1}}, {{0, 1, 2}, {2, 1, 0}}}; }

TEST(ConvexBody, KnowsItsEdgesNormalsAndSizes) {
  const Convex c = tetrahedron();
  EXPECT_EQ(c.edges().size(), 6U);
  for (const Convex::Edge& e : c.edges()) {
    for (int side = 0; side < 2; ++side) {
      const std::vector<int>& v = c.faces()[static_cast<std::size_t>(e.faces[side])].vertices;
      const std::size_t at =
          static_cast<std::size_t>(std::find(v.begin(), v.end(), e.vertices[side]) - v.begin());
      ASSERT_LT(at, v.size());
      EXPECT_EQ(v[(at + 1) % v.size()], e.vertices[1 - side]);
    }
  }
  EXPECT_TRUE(c.faces()[0].normal.isApprox(Vec3(0, 0, -1)));
  EXPECT_TRUE(c.faces()[2].normal.isApprox(Vec3(6, 4, 3).normalized()));
  EXPECT_EQ(c.half_extents(), Vec3(1, 1.5, 2));
  EXPECT_EQ(c.middle(), Vec3(1, 1.5, 2));
  EXPECT_EQ(smallest_half_extent(Shape(c)), 1);
  EXPECT_EQ(largest_half_extent(Shape(c)), 2);
  EXPECT_FALSE(c.is_flat());
}

TEST(ConvexBody, APolygonHasTwoFacesAndASizeOfItsArea) {
  const Convex c = triangle();
  EXPECT_TRUE(c.is_flat());
  EXPECT_EQ(c.edges().size(), 3U);
  EXPECT_EQ(c.faces()[0].normal, -c.faces()[1].normal);
  EXPECT_DOUBLE_EQ(c.smallest_half_extent(), std::sqrt(8) / 2);
  // A square's is that of a box.
  const Convex square({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}, {{0, 1, 2, 3}, {3, 2, 1, 0}});
  EXPECT_EQ(square.smallest_half_extent(), 0.5);
}

TEST(ConvexBody, SizesAndNormalsNeitherOverflowNorVanish) {
  for (const double unit : {0x1p-900, 0x1p900}) {
    std::vector<Vec3> vertices = tetrahedron_vertices;
    for (Vec3& v : vertices) v *= unit;
    const Convex c(vertices, tetrahedron_faces);
    EXPECT_EQ(c.half_extents(), Vec3(unit * Vec3(1, 1.5, 2)));
    EXPECT_TRUE(c.faces()[2].normal.isApprox(Vec3(6, 4, 3).normalized()));
  }
  constexpr double most = std::numeric_limits<double>::max();
  const Convex c({{-most, 0, 0}, {most, 0, 0}, {0, most, 0}}, {{0, 1, 2}, {2, 1, 0}});
  EXPECT_EQ(c.half_extents(), Vec3(most, most / 2, 0));
}

// Vertices that are neighbours of each other: halved, so that no difference overflows, an edge of
// the least length would be none, and the faces beside it would face anywhere.
TEST(ConvexBody, ItsDirectionsAreThoseOfTheLeastEdges) {
  constexpr double least = std::numeric_limits<double>::denorm_min();
  const Convex c({{0, 0, 0}, {1, 0, 0}, {1, least, 0}, {0, 0, 1}},
                 {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}});
  const ConvexTables& tables = c.tables();
  for (const ConvexTables::Edge& e : tables.edges) {
    EXPECT_NEAR(e.along.norm(), 1, 1e-15);
    if (e.length == least) {
      EXPECT_EQ(e.along.cwiseAbs(), Vec3(0, 1, 0));
    }
  }
  EXPECT_EQ(tables.face_normal(0), Vec3(0, 0, -1));
  EXPECT_EQ(tables.face_normal(1), Vec3(0, -1, 0));
}

// The difference of two such vertices overflows.
TEST(ConvexBody, ItsDirectionsAreThoseOfTheLargestLengths) {
  constexpr double most = std::numeric_limits<double>::max();
  const auto with_corners_at = [](double by) {
    return Convex({{by, by, by}, {-by, -by, by}, {-by, by, -by}, {by, -by, -by}},
                  {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}});
  };
  const Convex large = with_corners_at(most), one = with_corners_at(1);
  for (int i = 0; i < 4; ++i) {
    EXPECT_TRUE(large.tables().face_normal(i).isApprox(one.tables().face_normal(i), 1e-15)) << i;
  }
  for (std::size_t i = 0; i < one.tables().edges.size(); ++i) {
    const auto &of_large = large.tables().edges[i], &of_one = one.tables().edges[i];
    EXPECT_TRUE(of_large.along.isApprox(of_one.along, 1e-15)) << i;
    EXPECT_TRUE(of_large.middle.isApprox(of_one.middle, 1e-15)) << i;
  }
}

TEST(ConvexBody, RefusesWhatIsNoClosedConvexSurfaceAndNamesWhere) {
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  const auto with = [](std::size_t i, const Vec3& v) {
    std::vector<Vec3> changed = tetrahedron_vertices;
    changed[i] = v;
    return changed;
  };
  std::vector<Vec3> five = tetrahedron_vertices;
  five.emplace_back(0.1, 0.1, 0.1);
  const struct {
    std::vector<Vec3> vertices;
    Faces faces;
    const char* field;
  } table[] = {
      {{{0, 0, 0}, {1, 0, 0}}, {{0, 1}}, "vertices"},
      {std::vector<Vec3>(Convex::max_vertices + 1, Vec3::Zero()), tetrahedron_faces, "vertices"},
      {with(2, Vec3(0, nan, 0)), tetrahedron_faces, "vertices[2][1]"},
      {tetrahedron_vertices, {{0, 2}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}}, "faces[0]"},
      {tetrahedron_vertices, {{0, 2, 4}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}}, "faces[0]"},
      {tetrahedron_vertices, {{0, 2, -1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}}, "faces[0]"},
      {tetrahedron_vertices, {{0, 2, 1}, {0, 2, 1}, {1, 2, 3}, {2, 0, 3}}, "faces[1]"},
      {tetrahedron_vertices, {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}}, "faces[0]"},  // open
      {five, tetrahedron_faces, "vertices[4]"},                               // in no face
      {tetrahedron_vertices,
       {{0, 1, 2}, {0, 3, 1}, {1, 3, 2}, {2, 3, 0}},
       "faces[0]"},  // inside out
      // Two tetrahedra: closed, not connected.
      {{{0, 0, 0}, {2, 0, 0}, {0, 3, 0}, {0, 0, 4}, {9, 9, 9}, {9, 8, 9}, {8, 9, 9}, {9, 9, 8}},
       {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}, {4, 6, 5}, {4, 5, 7}, {5, 6, 7}, {6, 4, 7}},
       "faces"},
      // Dented.
      {{{0, 0, 0}, {2, 0, 0}, {0, 3, 0}, {0.1, 0.1, -1}}, tetrahedron_faces, "faces[0]"},
  };
  for (std::size_t i = 0; i < std::size(table); ++i) {
    const InvalidInput error = error_of([&] { Convex(table[i].vertices, table[i].faces); });
    EXPECT_EQ(error.field(), table[i].field) << "row " << i << ": " << error.what();
  }
}

TEST(ConvexBody, SupportAndBoxAreThoseOfItsFarthestVertex) {
  const Pose pose(Vec3(10, 0, 0), Eigen::Quaterniond(0.5, 0.5, 0.5, 0.5));  // x to y to z to x
  const Shape c = tetrahedron();
  EXPECT_EQ(support(c, pose, Vec3(1, 0, 0)), 14);
  EXPECT_EQ(support(c, pose, Vec3(-1, 0, 0)), -10);
  EXPECT_EQ(support(c, pose, Vec3(0, 1, 0)), 2);
  const Aabb box = aabb(c, pose);
  EXPECT_EQ(box.lower, Vec3(10, 0, 0));
  EXPECT_EQ(box.upper, Vec3(14, 2, 3));
}

TEST(ConvexBody, HasAPairOfItsOwn) {
  const Configuration c{Cylinder(1, 1), Pose(), tetrahedron(), Pose()};
  EXPECT_EQ(pair_of(c), Pair::convex);
  EXPECT_STREQ(pair_name(Pair::convex), "cylinder-convex");
  EXPECT_STREQ(shape_name(c.b), "convex");
}

}  // namespace
}  // namespace touchstone
