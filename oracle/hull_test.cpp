// Each hull is proven to be one, exactly, by what defines it; which faces it has is then no
// question of another program's answer.
#include "oracle/hull.hpp"

#include <algorithm>
#include <cmath>
#include <gmpxx.h>
#include <gtest/gtest.h>
#include <random>
#include <set>
#include <string>
#include <vector>

#include "oracle/as_hull.hpp"
#include "oracle/ball.hpp"
#include "reference/error_of_test.hpp"
#include "reference/invalid_input.hpp"

namespace touchstone::oracle {
namespace {

using Exact = Vector3<mpq_class>;

Exact exactly(const Vec3& v) { return {v.x(), v.y(), v.z()}; }

/// Of the directed edge from p to q of a face with this normal, which side is x on? 1: the face's.
int inner_side(const Exact& normal, const Exact& p, const Exact& q, const Exact& x) {
  return sgn(dot(normal, cross(q - p, x - p)));
}

/// All points are in the body, all vertices are points, and no vertex, edge or face could be left
/// out: faces are plane, with their angles below 180°, as are those between faces.
void expect_hull_of(const std::vector<Vec3>& points, const Convex& body) {
  std::vector<Exact> at;
  for (const Vec3& v : body.vertices()) at.push_back(exactly(v));
  std::size_t next = 0;
  for (const Vec3& p : points) {
    if (next < at.size() && p == body.vertices()[next]) ++next;
  }
  EXPECT_EQ(next, at.size()) << "the vertices are points, in their order";

  std::vector<Exact> normals;
  for (const Convex::Face& face : body.faces()) {
    const auto& on = face.vertices;
    const Exact& first = at[on[0]];
    normals.push_back(cross(at[on[1]] - first, at[on[2]] - first));
    const Exact& normal = normals.back();
    ASSERT_FALSE(is_zero(normal));
    for (std::size_t i = 0; i < on.size(); ++i) {
      EXPECT_EQ(dot(normal, at[on[i]] - first), 0) << "plane";
      const Exact &p = at[on[i]], &q = at[on[(i + 1) % on.size()]];
      EXPECT_GT(inner_side(normal, p, q, at[on[(i + 2) % on.size()]]), 0) << "a corner";
      if (!body.is_flat()) continue;
      for (const Vec3& x : points) {
        EXPECT_GE(inner_side(normal, p, q, exactly(x)), 0) << "around all";
      }
    }
    for (const Vec3& x : points) EXPECT_LE(dot(normal, exactly(x) - first), 0) << "outside";
  }
  if (body.is_flat()) return;
  for (const Convex::Edge& edge : body.edges()) {
    EXPECT_FALSE(is_zero(cross(normals[edge.faces[0]], normals[edge.faces[1]]))) << "an edge";
  }
}

std::vector<Vec3> random_points(int count, unsigned seed) {
  std::mt19937 random(seed);
  std::normal_distribution<double> normal;
  std::vector<Vec3> points;
  for (int i = 0; i < count; ++i) {
    points.push_back(Vec3(normal(random), normal(random), normal(random)));
  }
  return points;
}

TEST(Hull, OfABoxHasSixFacesWhateverElseIsGiven) {
  std::vector<Vec3> points{{0, 0, 0}, {1, 0, 0}, {1, 2, 0}, {0.25, 0.5, 3}};  // in, on faces, edges
  for (const Vec3& v : corners_of_box({1, 2, 3})) points.push_back(v), points.push_back(v);
  const Convex box = convex_hull(points);
  expect_hull_of(points, box);
  EXPECT_EQ(box.vertices(), corners_of_box({1, 2, 3}));
  EXPECT_EQ(box.faces().size(), 6u);
  EXPECT_EQ(box.edges().size(), 12u);
}

TEST(Hull, SplitsAFaceThatIsNotPlaneByOneUlp) {
  for (const double moved : {std::nextafter(1.0, 2.0), std::nextafter(1.0, 0.0)}) {
    std::vector<Vec3> points = corners_of_box({1, 1, 1});
    points[7].z() = moved;
    const Convex body = convex_hull(points);
    expect_hull_of(points, body);
    // The faces across x and y stay plane.
    EXPECT_EQ(body.faces().size(), 7u) << moved;
  }
}

TEST(Hull, OfPointsOfASmallGridHasNoPointsOnEdgesOrFaces) {
  std::mt19937 random(1);
  std::uniform_int_distribution<int> coordinate(0, 3);
  int flat = 0, thick = 0;
  for (int i = 0; i < 300; ++i) {
    SCOPED_TRACE(i);
    std::vector<Vec3> points;
    for (int k = 0; k < 4 + i % 17; ++k) {
      points.emplace_back(coordinate(random), coordinate(random), i % 5 ? coordinate(random) : 1);
    }
    try {
      const Convex body = convex_hull(points);
      expect_hull_of(points, body);
      ++(body.is_flat() ? flat : thick);
    } catch (const InvalidInput& e) {
      EXPECT_EQ(e.field(), "vertices");
    }
  }
  EXPECT_GT(flat, 30);
  EXPECT_GT(thick, 150);
}

TEST(Hull, OfTwoPrismsOnOneBaseHasTheirCorners) {
  std::vector<Vec3> points;
  for (int i = 0; i < 100; ++i) {
    const double angle = 2 * M_PI * i / 100;
    for (const double z : {-1.0, 0.0, 1.0}) {
      points.emplace_back(std::cos(angle), std::sin(angle), z);
    }
  }
  const Convex prism = convex_hull(points);
  expect_hull_of(points, prism);
  EXPECT_EQ(prism.vertices().size(), 200u);
  EXPECT_EQ(prism.faces().size(), 102u);
}

TEST(Hull, IsTheSameWhateverTheUnit) {
  for (const double unit : {1e300, 1e-300, 1e-320}) {
    std::vector<Vec3> points = random_points(12, 3);
    for (Vec3& p : points) p *= unit;
    SCOPED_TRACE(unit);
    expect_hull_of(points, convex_hull(points));
  }
  const std::vector<Vec3> mixed{
      {1e300, 0, 0}, {0, 1e-300, 0}, {0, 0, 1}, {-1e300, 1, 5e-324}, {0, 0, 0}};
  expect_hull_of(mixed, convex_hull(mixed));
}

TEST(Hull, OfPointsInOnePlaneIsAPolygonWithTwoFaces) {
  const std::vector<Vec3> triangle{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  expect_hull_of(triangle, convex_hull(triangle));
  std::vector<Vec3> points{{1, 1, 0}, {0.5, 0.5, 1}};
  for (const Vec3& v : corners_of_box({1, 1, 1})) {
    points.emplace_back(v.x(), v.x(), v.y());
  }
  const Convex square = convex_hull(points);
  expect_hull_of(points, square);
  EXPECT_TRUE(square.is_flat());
  EXPECT_EQ(square.vertices().size(), 4u);
}

TEST(Hull, DoesNotDependOnTheOrderOfThePoints) {
  std::vector<Vec3> points = corners_of_box({1, 1, 1});
  for (const Vec3& v : random_points(40, 5)) points.push_back(v);
  const auto faces = [](const Convex& body) {
    std::set<std::set<std::array<double, 3>>> result;
    for (const Convex::Face& face : body.faces()) {
      std::set<std::array<double, 3>> on;
      for (const int v : face.vertices) {
        const Vec3& p = body.vertices()[v];
        on.insert({p.x(), p.y(), p.z()});
      }
      result.insert(on);
    }
    return result;
  };
  const auto before = faces(convex_hull(points));
  std::mt19937 random(7);
  for (int i = 0; i < 10; ++i) {
    std::shuffle(points.begin(), points.end(), random);
    EXPECT_EQ(faces(convex_hull(points)), before);
  }
}

TEST(Hull, HasAsManyCornersAsThereMayBeAndNoMore) {
  std::vector<Vec3> points = random_points(Convex::max_vertices, 11);
  for (Vec3& p : points) p.normalize();
  const Convex body = convex_hull(points);
  EXPECT_GT(body.vertices().size(), 4000u);
  EXPECT_EQ(body.faces().size(), 2 * body.vertices().size() - 4);
  points.push_back(Vec3::Zero());  // of points inside there may be any number
  EXPECT_EQ(convex_hull(points).vertices(), body.vertices());
  for (const Vec3& p : random_points(200, 12)) points.push_back(p.normalized());
  EXPECT_EQ(error_of([&] { convex_hull(points); }).remedy(), "must be at most 4096");
}

std::string refusal(const std::vector<Vec3>& points) {
  return error_text_of([&] { convex_hull(points); });
}

TEST(Hull, SaysWhatPointsAreNotOne) {
  const std::string remedy = ": must have three that are not on one line";
  EXPECT_EQ(refusal({}), "vertices is 0 different points" + remedy);
  EXPECT_EQ(refusal({{1, 2, 3}, {1, 2, 3}, {0, 0, 0}}), "vertices is 2 different points" + remedy);
  EXPECT_EQ(refusal({{0, 0, 0}, {1, 1, 1}, {3, 3, 3}, {2, 2, 2}}),
            "vertices is 4 points on one line" + remedy);
  EXPECT_EQ(refusal({{0, 0, 0}, {1, 0, 0}, {0, INFINITY, 0}}),
            "vertices[2] is not finite: must be finite");
}

}  // namespace
}  // namespace touchstone::oracle
