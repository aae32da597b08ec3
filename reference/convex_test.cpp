#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <limits>
#include <vector>

#include "reference/configuration.hpp"
#include "reference/convex_tables.hpp"
#include "reference/error_of_test.hpp"
#include "reference/invalid_input.hpp"
#include "reference/support.hpp"

namespace touchstone {
namespace {

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
