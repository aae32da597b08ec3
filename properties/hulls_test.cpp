// What the pair cylinder-convex promises beside what all pairs do: the forms of its hulls, and that
// the features meet that an arrangement names.
#include "properties/hulls.hpp"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <map>
#include <set>
#include <string>

#include "oracle/hull.hpp"
#include "oracle/truth.hpp"
#include "properties/pose_classes_test.hpp"

namespace touchstone {
namespace {

const Convex& hull_of(const Configuration& c) { return std::get<Convex>(c.b); }

/// Calls expect(configuration) of samples of these classes of cylinder-convex.
template <class Expect>
void expect_of_hulls(const std::vector<std::string>& classes, Expect expect,
                     std::uint64_t count = samples) {
  expect_of_each(
      {Pair::convex}, classes, [&](const Configuration& c, Pair) { expect(c); }, count);
}

/// The same configuration with another body in the hull's place.
Configuration with(const Configuration& c, const Shape& b) { return {c.a, c.pose_a, b, c.pose_b}; }

TEST(HullForms, RegularOnesAreTheFiveSolidsWithPlaneFaces) {
  std::map<std::size_t, std::size_t> faces;  // by the number of vertices
  expect_of_hulls({"general+regular"}, [&](const Configuration& c) {
    faces[hull_of(c).vertices().size()] = hull_of(c).faces().size();
  });
  EXPECT_EQ(faces,
            (std::map<std::size_t, std::size_t>{{4, 4}, {6, 8}, {8, 6}, {12, 20}, {20, 12}}));
}

TEST(HullForms, UsualOnesHaveFourToThirtyTwoVerticesAboutTheOrigin) {
  std::set<std::size_t> counts;
  expect_of_hulls({"general"}, [&](const Configuration& c) {
    const Convex& hull = hull_of(c);
    counts.insert(hull.vertices().size());
    for (const Convex::Face& face : hull.faces()) {
      EXPECT_GT(face.normal.dot(hull.vertices()[static_cast<std::size_t>(face.vertices[0])]), 0);
    }
  });
  EXPECT_EQ(*counts.begin(), 4u);
  EXPECT_GT(counts.size(), 8u);
  EXPECT_LE(*counts.rbegin(), 32u);
}

TEST(HullForms, ThatOfABoxHasTheBoxsTruthToTheLastBit) {
  expect_of_hulls({"general+of-box", "edge-rim+of-box", "side-on-face+of-box",
                   "touching-tilted+of-box", "diagonal+of-box", "concentric+of-box"},
                  [](const Configuration& c) {
                    const auto of_hull = oracle::truth(c).signed_distance;
                    const Box box(hull_of(c).half_extents());
                    const auto of_box = oracle::truth(with(c, box)).signed_distance;
                    EXPECT_EQ(of_hull.lo, of_box.lo);
                    EXPECT_EQ(of_hull.hi, of_box.hi);
                  });
}

TEST(HullForms, ThatOfAPrismLiesInItsCylinderByNoMoreThanTheSagitta) {
  std::set<std::size_t> all_sides;
  expect_of_hulls({"general+of-prism"}, [&](const Configuration& c) {
    const Convex& hull = hull_of(c);
    const std::size_t sides = hull.faces().size() - 2;
    all_sides.insert(sides);
    EXPECT_EQ(hull.vertices().size(), 2 * sides);
    const double radius = hull.vertices()[0].x(),
                 sagitta = 1 - std::cos(M_PI / static_cast<double>(sides));
    const Cylinder around(radius, hull.half_extents().z());
    const double of_hull = oracle::truth(c).signed_distance.midpoint();
    const double of_cylinder = oracle::truth(with(c, around)).signed_distance.midpoint();
    constexpr double rounding = 1e-14;
    EXPECT_GE(of_hull, of_cylinder - rounding);
    EXPECT_LE(of_hull, of_cylinder + radius * sagitta + rounding);
  });
  EXPECT_EQ(all_sides, (std::set<std::size_t>{3, 4, 6, 8, 12, 16}));
}

TEST(HullForms, TrianglesAreFlatAlsoWhereTheyLieExactly) {
  expect_of_hulls({"general+triangle", "side-on-face+triangle", "diagonal+triangle"},
                  [](const Configuration& c) {
                    EXPECT_TRUE(hull_of(c).is_flat());
                    EXPECT_EQ(hull_of(c).vertices().size(), 3u);
                  });
}

TEST(HullForms, WedgesAndNearlyPlaneFacesAreSoByEveryPowerOfTen) {
  std::set<int> of_wedges, of_faces;
  expect_of_hulls(
      {"general+wedge"},
      [&](const Configuration& c) {
        const Vec3& half = hull_of(c).half_extents();
        of_wedges.insert(static_cast<int>(std::floor(std::log10(half.z() / half.x()))));
      },
      8 * samples);
  EXPECT_GE(of_wedges.size(), 5u);
  expect_of_hulls(
      {"general+nearly-coplanar"},
      [&](const Configuration& c) {
        double least = 1;
        for (const Convex::Edge& edge : hull_of(c).edges()) {
          const auto normal = [&](int i) {
            return hull_of(c).faces()[static_cast<std::size_t>(edge.faces[i])].normal;
          };
          least = std::min(least, normal(0).cross(normal(1)).norm());
        }
        of_faces.insert(static_cast<int>(std::floor(std::log10(std::max(least, 1e-18)))));
      },
      8 * samples);
  EXPECT_GE(of_faces.size(), 11u);
}

TEST(Hulls, RepeatedPointsMakeNoOther) {
  Draw draw{rc::Random(1)};
  std::vector<Vec3> points = draw_hull_points(draw, HullForm::regular);
  const Convex once = oracle::convex_hull(points);
  points.insert(points.end(), once.vertices().begin(), once.vertices().end());
  const Convex twice = oracle::convex_hull(points);
  EXPECT_EQ(twice.vertices(), once.vertices());
  EXPECT_EQ(twice.face_list(), once.face_list());
}

TEST(Hulls, PointsOnALineHaveNone) {
  EXPECT_FALSE(has_hull({Vec3(0, 0, 0), Vec3(1, 1, 1), Vec3(2, 2, 2)}));
  EXPECT_TRUE(has_hull({Vec3(0, 0, 0), Vec3(1, 1, 1), Vec3(2, 2, 2.5)}));
}

/// Which feature of A the normal is of, and how many vertices of the hull lie farthest along it.
struct Met {
  std::string of_a;
  int vertices;
};
Met met(const Configuration& c) {
  constexpr double rounding = 1e-7;
  const Vec3 n = oracle::truth(c).normals.front().n;
  const double along = std::abs(n.dot(c.pose_a.axis()));
  const Vec3 local = c.pose_b.rotation().transpose() * n;
  double highest = -1e9;
  for (const Vec3& v : hull_of(c).vertices()) highest = std::max(highest, v.dot(local));
  int vertices = 0;
  for (const Vec3& v : hull_of(c).vertices()) vertices += v.dot(local) > highest - rounding;
  return {along < rounding ? "side" : along > 1 - rounding ? "cap" : "rim", vertices};
}

// Apart, the normal is that along which the bodies were put together.
TEST(Hulls, MeetWithTheFeaturesThatAnArrangementNames) {
  const struct {
    const char* arrangement;
    const char* of_a;
    int vertices;
  } table[] = {{"rim-face", "rim", 3},  {"edge-side", "side", 2},   {"edge-cap", "cap", 2},
               {"edge-rim", "rim", 2},  {"vertex-side", "side", 1}, {"vertex-cap", "cap", 1},
               {"vertex-rim", "rim", 1}};
  for (const auto& row : table) {
    for (const char* form : {"", "+regular", "+of-box", "+of-prism", "+triangle"}) {
      int other = 0;
      expect_of_hulls(
          {std::string(row.arrangement) + "+apart" + form}, [&](const Configuration& c) {
            const Met found = met(c);
            other += found.of_a != row.of_a || std::min(found.vertices, 3) != row.vertices;
          });
      EXPECT_EQ(other, 0) << row.arrangement << form;
    }
  }
}

TEST(Hulls, HaveAnEdgeAlongOrAcrossTheAxisWhereTheyAreNearlyAligned) {
  constexpr double rounding = 1e-14;
  for (const bool is_along : {true, false}) {
    expect_of_hulls({is_along ? "parallel" : "perpendicular"}, [&](const Configuration& c) {
      double least = 1;
      for (const Convex::Edge& edge : hull_of(c).edges()) {
        const auto vertex = [&](int i) {
          return hull_of(c).vertices()[static_cast<std::size_t>(edge.vertices[i])];
        };
        const Vec3 along = c.pose_b.rotation() * (vertex(1) - vertex(0)).normalized();
        least = std::min(least, is_along ? along.cross(c.pose_a.axis()).norm()
                                         : std::abs(along.dot(c.pose_a.axis())));
      }
      EXPECT_LT(least, rounding);
    });
  }
}

}  // namespace
}  // namespace touchstone
