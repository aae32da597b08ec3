// How contact points move when a body is tilted, turned or shifted: not at all while that cannot be
// seen, then together, until one is left.
//
// TOUCHSTONE_COUNT sets how many rests of bodies of equal sizes are tried, by default 40000, and
// how many standing caps, by default 20000.
#include <algorithm>
#include <array>
#include <cmath>
#include <gtest/gtest.h>
#include <random>
#include <rapidcheck.h>
#include <string>
#include <vector>

#include "reference/contact_of.hpp"
#include "reference/hull_movement_test.hpp"
#include "reference/points_on_both_test.hpp"
#include "reference/random_bodies_test.hpp"
#include "reference/random_hulls_test.hpp"

namespace touchstone {
namespace {

// A tilt of a hair keeps the manifold, 1.1 degrees leave the deepest point.
TEST(Manifold, FadesAsTheTiltGrows) {
  const struct {
    const char* name;
    Cylinder a;
    Vec3 position;
    Quaternion base;
    Shape b;
    std::size_t straight;
  } table[] = {
      {"standing on a plane", Cylinder(1, 2), {0, 0, 1.9}, upright, Plane({0, 0, 1}, 0), 3},
      {"lying on a plane", Cylinder(1, 2), {0, 0, 0.9}, along_x, Plane({0, 0, 1}, 0), 2},
      {"standing on a cylinder", Cylinder(1, 2), {0.3, 0, 3.9}, upright, Cylinder(2, 2), 3},
      {"standing on a box", Cylinder(1, 2), {0, 0, 2.9}, upright, Box({3, 3, 1}), 3},
      {"standing on a box's corner", Cylinder(1, 2), {3, 3, 2.9}, upright, Box({3, 3, 1}), 4},
      {"lying on a box", Cylinder(1, 2), {0, 0, 1.9}, along_x, Box({3, 3, 1}), 2},
      {"beside a capsule", Cylinder(1, 2), {1.4, 0, 0}, upright, Capsule(0.5, 2), 2},
      {"beside a cylinder", Cylinder(1, 2), {1.9, 0, 0}, upright, Cylinder(1, 2), 2},
  };
  for (const auto& row : table) {
    SCOPED_TRACE(row.name);
    const auto tilted = [&](double tilt) {
      const Quaternion turn(1, tilt / 2 * 0.6, tilt / 2 * 0.8, 0);
      return Configuration{row.a, Pose(row.position, turn * row.base), row.b, Pose()};
    };
    for (const double tilt : {0.0, 1e-15, 1e-12, 1e-9}) {
      EXPECT_EQ(contact(tilted(tilt), 0).points().size(), row.straight) << tilt;
    }
    EXPECT_EQ(contact(tilted(0.0192), 0).points().size(), 1u);
    // Points that stay are always on both bodies and never far above the deepest.
    for (double tilt = 1e-15; tilt < 0.1; tilt *= 1.1) {
      const Configuration c = tilted(tilt);
      const Contact answer = contact(c, 0);
      SCOPED_TRACE(tilt);
      expect_points_on_both(c, answer, 1e-8);
      for (const auto& p : answer.points()) EXPECT_GE(p.depth, -answer.signed_distance - 3e-3);
    }
  }
}

// However a body is turned by a step, the points that it had and those that it has then belong to
// the part of its surface that lies within the slack of the deepest point, before and after, but
// for what the step itself lifts.
TEST(Manifold, MovesNoFurtherThanThePatchInAStep) {
  constexpr double size = 1, slack = 1e-3 * size, depth = 0.01;
  const Shape grounds[] = {Plane({0, 0, 1}, 1), Box({3, 3, 1}), Cylinder(3, 1)};
  std::mt19937 random(1);
  std::uniform_real_distribution<double> uniform(-1, 1);
  for (const Shape& ground : grounds) {
    for (const Quaternion& base : {upright, along_x}) {
      for (int i = 0; i < 3000; ++i) {
        const auto axis_angle = [&](double angle) {
          const Vec3 axis(uniform(random), uniform(random), 0.1 * uniform(random));
          return Quaternion(Eigen::AngleAxisd(angle, axis.normalized()));
        };
        const double step = std::pow(10, -2 - 8 * std::abs(uniform(random)));
        const Quaternion before =
            axis_angle(std::pow(10, -1 - 11 * std::abs(uniform(random)))) * base.normalized();
        const Quaternion after = axis_angle(step) * before;
        const Cylinder can(size, size);
        // As high as leaves the depth.
        const auto posed_at = [&](const Quaternion& turn) {
          const double z = (turn * Vec3::UnitZ()).z();
          return Pose({0.3, 0.2, 1 + size * (std::abs(z) + std::sqrt((1 - z) * (1 + z))) - depth},
                      turn);
        };
        const Pose pose_before = posed_at(before), pose_after = posed_at(after);
        const auto expect_within = [&](const Pose& of, const Pose& at) {
          const Contact answer = contact({can, of, ground, Pose()}, 0);
          ASSERT_GT(answer.points().size(), 0u);
          for (const auto& p : answer.points()) {
            const Vec3 on_can = p.position - p.depth / 2 * answer.normal;
            const Vec3 local = of.rotation().transpose() * (on_can - of.position());
            const double height = (at.position() + at.rotation() * local).z() - (1 - depth);
            EXPECT_LE(height, slack + 4 * size * step) << step;
          }
        };
        expect_within(pose_before, pose_after);
        expect_within(pose_after, pose_before);
      }
    }
  }
}

// A tilt of a few 1e-4 is what one step of a simulation makes of a body that lost its support on
// one side: as long as that side overlaps it must keep a point.
TEST(Manifold, StandsOnAllSidesThatOverlap) {
  const Cylinder can(1, 1);
  const Plane ground({0, 0, 1}, 0);
  const auto standing = [&](double tilt, double depth) {
    const double height = std::cos(tilt) + std::sin(tilt) - depth;
    return contact({can, Pose({0, 0, height}, Quaternion(Eigen::AngleAxisd(tilt, Vec3::UnitY()))),
                    ground, Pose()},
                   0);
  };
  EXPECT_EQ(standing(4e-4, 1e-3).points().size(), 3u);  // all of the cap overlaps
  const Contact half = standing(4e-4, 4e-4);            // half of it does
  EXPECT_GT(half.points().size(), 2u);
  double least = 1;
  for (const auto& p : half.points()) least = std::min(least, p.position.x());
  EXPECT_NEAR(least, 0, 1e-3);
  EXPECT_EQ(standing(4e-4, 0).points().size(), 1u);
}

/// A contact, and what its tilts may turn about and its shifts run along without changing what is
/// seen.
struct Rest {
  std::string name;
  Cylinder a;
  Vec3 position;
  Quaternion base;
  Shape b;
  std::size_t points;
};
const std::vector<Rest>& rests() {
  const Cylinder can(1, 2);
  const Quaternion flipped(0, 1, 0, 0);
  const Box slab({3, 3, 1});
  static const std::vector<Rest> all = {
      {"standing on a plane", can, {0, 0, 1.9}, upright, Plane({0, 0, 1}, 0), 3},
      {"lying on a plane", can, {0, 0, 0.9}, along_x, Plane({0, 0, 1}, 0), 2},
      {"standing on a box", can, {0.1, 0.2, 2.9}, upright, slab, 3},
      {"over a box's edge", can, {2.7, 0.1, 2.9}, upright, slab, 5},
      {"lying on a box", can, {0, 0.1, 1.9}, along_x, slab, 2},
      {"cap within cap", can, {0.3, 0, 3.9}, upright, Cylinder(2, 2), 3},
      {"cap on the same cap, coaxial", can, {0, 0, 3.9}, upright, can, 3},
      {"upside down on the same cap", can, {0, 0, 3.9}, flipped, can, 3},
      {"caps partly overlapping", can, {0.7, 0.2, 3.9}, upright, can, 4},
      {"beside a capsule", can, {1.4, 0, 0.3}, upright, Capsule(0.5, 2), 2},
      {"beside a cylinder", can, {1.9, 0, 0.3}, upright, Cylinder(1.1, 2), 2},
  };
  return all;
}

Contact contact_at(const Rest& rest, const Vec3& turn, const Vec3& shift) {
  const Quaternion small(1, turn.x() / 2, turn.y() / 2, turn.z() / 2);
  return contact({rest.a, Pose(rest.position + shift, small * rest.base), rest.b, Pose()}, 0);
}

// Rounding decides which way a body at rest leans, and where the line of two caps' centres runs.
TEST(ManifoldMotion, PointsStayWhenNothingVisibleChanges) {
  const auto decade = [](int lo, int hi) { return std::pow(10, *rc::gen::inRange(lo, hi)); };
  const auto direction = [] {
    const auto coordinate = [] { return *rc::gen::inRange(-100, 101); };
    const Vec3 v(coordinate(), coordinate(), coordinate());
    return Vec3(v / std::max(v.norm(), 1.0));
  };
  for (const Rest& rest : rests()) {
    const Contact before = contact_at(rest, Vec3::Zero(), Vec3::Zero());
    ASSERT_EQ(before.points().size(), rest.points) << rest.name;
    EXPECT_TRUE(rc::check(rest.name, [&] {
      const double angle = decade(-16, -8), length = decade(-16, -8);
      const Contact after = contact_at(rest, angle * direction(), length * direction());
      RC_ASSERT(after.points().size() == before.points().size());
      constexpr double rounding = 2e-14;  // each point by its number
      for (std::size_t i = 0; i < after.points().size(); ++i) {
        const Vec3 way = after.points()[i].position - before.points()[i].position;
        RC_ASSERT(way.norm() <= 4 * (angle * 2 + length) + rounding);
      }
    }));
  }
}

/// A cap or side at rest on a box or cap, whose sizes and places are so often equal, tangent or
/// flush that rounding decides what lies within what.
class FlushRest : private Random {
 public:
  explicit FlushRest(std::uint64_t index) : Random(index) {}

  Configuration operator()() {
    const double r = size(), h = size();
    const bool lies = toss();
    const Quaternion base = !lies ? upright : toss() ? along_x : along_y;
    const double reach = lies ? h : r, height = lies ? r : h;
    Vec3 centre(0, 0, height - 1e-4 * std::min(r, h));
    const auto reach_or_size = [&] { return toss() ? reach : size(); };
    const Vec3 e(reach_or_size(), reach_or_size(), size());
    const bool on_box = toss();
    centre.x() = place(e.x(), reach), centre.y() = place(e.y(), reach), centre.z() += e.z();
    if (!on_box || (lies && toss())) (toss() ? centre.x() : centre.y()) = 0;
    const Shape b = on_box ? Shape(Box(e)) : Shape(Cylinder(e.x(), e.z()));
    return {Cylinder(r, h), Pose(centre, base), b, Pose()};
  }
  /// The same, turned and shifted by what cannot be seen.
  Configuration moved(const Configuration& c) {
    const double angle = power_of_ten(-17, -9), length = power_of_ten(-17, -9);
    const Quaternion turn(1, angle * uniform(), angle * uniform(), 0);
    const Vec3 shift = length * smaller_size(c) * Vec3(uniform(), uniform(), uniform());
    return {c.a, Pose(c.pose_a.position() + shift, turn * c.pose_a.orientation()), c.b, c.pose_b};
  }

 private:
  double uniform() { return Random::uniform(-1, 1); }
  double size() { return std::exp2(one_of(4) - 2); }
  double place(double edge, double reach) {
    const double places[] = {0, edge, edge - reach, reach, edge * uniform()};
    return sign() * places[one_of(5)];
  }
};

// A rim that is tangent to a face's edge, a corner on a rim, a side that only touches a rim: which
// side of each other they lie on is rounding. Of a side over a rim, which it leaves by a hair, the
// normal leans by the hair over the depth.
TEST(ManifoldMotion, PointsStayWhereSizesAreEqualOrTangent) {
  const std::uint64_t all = tried_of_each(40000);
  std::uint64_t rests = 0;
  for (std::uint64_t i = 0; i < all; ++i) {
    FlushRest rest(i);
    const Configuration c = rest(), moved = rest.moved(c);
    const Contact before = contact(c, 0), after = contact(moved, 0);
    constexpr double upwards = 0.99;
    if (!(before.normal.z() > upwards && after.normal.z() > upwards)) continue;
    ++rests;
    ASSERT_EQ(after.points().size(), before.points().size()) << i;
    for (std::size_t k = 0; k < after.points().size(); ++k) {
      const Vec3 way = after.points()[k].position - before.points()[k].position;
      EXPECT_LE(way.norm(), 1e-5 * larger_size(c)) << i;
    }
  }
  EXPECT_GE(rests, all / 2);
}

// From level to a tilt of which a tenth of the cap lies within the slack, and all around at each:
// no jump. Where an eleventh does, one point is left.
TEST(ManifoldMotion, HullOfAWholeCapNeverJumpsAsTheTiltGrowsOrTurns) {
  for (const Rest& rest : rests()) {
    // Of equal caps a tilt makes a lens.
    if (rest.points != 3 || rest.name.ends_with("same cap, coaxial") ||
        rest.name.ends_with("same cap")) {
      continue;
    }
    SCOPED_TRACE(rest.name);
    for (double heading = 0.05; heading < 6.3; heading += 0.7) {
      const auto leaning = [&](double tilt, double turned) {
        return contact_at(rest,
                          tilt * Vec3(std::cos(heading + turned), std::sin(heading + turned), 0),
                          {0, 0, 0});
      };
      Contact before = leaning(0, 0);
      for (double tilt = 1e-8; tilt < 0.0098; tilt *= 1.02) {
        const Contact after = leaning(tilt, 0);
        EXPECT_LE(hull_movement(before, after), 0.08) << tilt;
        EXPECT_LE(hull_movement(after, leaning(tilt, 0.01)), 0.04) << tilt;
        before = after;
      }
      EXPECT_EQ(leaning(0.0112, 0).points().size(), 1u);
    }
  }
}

/// A cap that stands on a box or on another cap, level or leaning by any tilt, often so that an
/// edge has just begun to cut it, two rims are all but concentric, or it leans straight over an
/// edge.
class StandingCap : private Random {
 public:
  explicit StandingCap(std::uint64_t index) : Random(index) {}

  /// So deep that it rests; moved and turned by these.
  struct Posed {
    Cylinder a{1, 1};
    Shape b;
    Vec3 position;
    Quaternion turn;
    Configuration moved(const Vec3& shift, const Vec3& turned) const {
      const Quaternion small(1, turned.x() / 2, turned.y() / 2, turned.z() / 2);
      return {a, Pose(position + shift, small * turn), b, Pose()};
    }
  };
  Posed operator()() {
    Posed cap{{1, 1}, toss() ? box() : other_cap(), Vec3(0, 0, 2), Quaternion(1, 0, 0, 0)};
    cap.position.head<2>() = place_;
    const double heading = toss() ? uniform(0, 6.3) : std::acos(0.0) * one_of(4);
    const Vec3 axis(std::cos(heading), std::sin(heading), 0);
    tilt = one_of(3) == 0 ? 0 : power_of_ten(-7, -2.2);
    const Quaternion spin(Eigen::AngleAxisd(toss() ? 0 : uniform(0, 6.3), Vec3::UnitZ()));
    cap.turn = Quaternion(Eigen::AngleAxisd(tilt, axis)) * spin;
    const double depth = power_of_ten(-5, -2);
    for (int i = 0; i < 4; ++i) {
      cap.position.z() -= signed_distance(cap.moved(Vec3::Zero(), Vec3::Zero())).value + depth;
    }
    return cap;
  }
  double tilt = 0;

 private:
  double hair() { return sign() * power_of_ten(-8, -1); }
  Shape box() {
    const auto half = [&] { return one_of(3) == 0 ? 1 + hair() : uniform(0.2, 1.6); };
    const Vec3 e(half(), half(), 1);
    for (int i = 0; i < 2; ++i) {
      const double places[] = {uniform(-1, 1) * (e[i] + 0.9), sign() * (e[i] - 1) + hair(), 0};
      place_[i] = places[one_of(3)];
    }
    return Box(e);
  }
  Shape other_cap() {
    const double radius = toss() ? uniform(0.4, 2.5) : toss() ? 1 : 1 + hair();
    const double within = std::abs(1 - radius);
    const double apart = toss() ? within + power_of_ten(-8, -0.5)
                                : within + uniform(0, 0.95) * (1 + radius - within);
    const double heading = uniform(0, 6.3);
    place_ = apart * Eigen::Vector2d(std::cos(heading), std::sin(heading));
    return Cylinder(radius, 1);
  }
  Eigen::Vector2d place_;
};

// Where the patch itself begins to have a corner, that moves as the root of the step.
TEST(ManifoldMotion, HullNeverJumpsHoweverACapStands) {
  constexpr double step = 1e-9;
  const double most = 8 * std::sqrt(step);
  const std::uint64_t all = tried_of_each(20000);
  std::uint64_t stand = 0;
  for (std::uint64_t i = 0; i < all; ++i) {
    StandingCap standing(i);
    const auto cap = standing();
    const Contact before = contact(cap.moved(Vec3::Zero(), Vec3::Zero()), 0);
    if (before.points().empty() || before.normal.z() < 0.99) continue;
    ++stand;
    Random random(i);
    for (int k = 0; k < 4; ++k) {
      const Vec3 way = step * random.direction();
      const Vec3 turned(standing.tilt * way.x(), standing.tilt * way.y(), way.z());
      const Configuration c =
          k % 2 == 0 ? cap.moved(way, Vec3::Zero()) : cap.moved(Vec3::Zero(), turned);
      const Contact after = contact(c, 0);
      if (after.points().empty() || (after.normal - before.normal).norm() > 1e-3) continue;
      EXPECT_LE(hull_movement(before, after), most) << i;
    }
  }
  EXPECT_GE(stand, all * 9 / 10);
}

/// A cap on a box, which a step moves to either side of where it is.
struct Step {
  Vec3 position;
  Box b;
  Vec3 tilt, shift, turn;
  Configuration taken(double way) const {
    const Vec3 by = (tilt + way * turn) / 2;
    return {Cylinder(1, 1), Pose(position + way * shift, Quaternion(1, by.x(), by.y(), by.z())), b,
            Pose()};
  }
};

// What is cut off of the points of the disc, and of those of the lens, has another hull each.
TEST(ManifoldMotion, HullNeverJumpsAsCapsThatLeanBeginToLeaveEachOther) {
  constexpr double step = 1e-9;
  const double most = 8 * std::sqrt(step);
  for (const double tilt : {1e-6, 1e-5, 1e-4}) {
    const Quaternion turn(Eigen::AngleAxisd(tilt, Vec3::UnitX()));
    const Vec3 to_cap = turn * Vec3(0, 0, -1);
    for (const double offset : {1e-6, 0.008101, 0.016201}) {
      for (double heading = 0.1; heading < 6.3; heading += 0.2) {
        const Vec3 way(std::cos(heading), std::sin(heading), 0);
        const auto at = [&](double apart) {
          const Vec3 cap = apart * way + Vec3(0, 0, 1);  // the deeper half of it overlaps
          return contact({Cylinder(1, 1), Pose(cap - to_cap, turn), Cylinder(1, 1), Pose()}, 0);
        };
        EXPECT_LE(hull_movement(at(offset - step), at(offset + step)), most) << tilt;
      }
    }
  }
}

// There the normal turns from one cap's to the other's while the rims' crossing moves by the square
// of the caps' offset: by a few hundred times the step.
TEST(ManifoldMotion, HullNeverJumpsWhereRimsCrossNextToTheDeepestPlace) {
  constexpr double step = 1e-9, depth = 2.6e-4;
  const double most = 8 * std::sqrt(step);
  for (const double tilt : {2.3e-3, 2.5e-3, 2.7e-3, 2.9e-3}) {
    const Quaternion turn(Eigen::AngleAxisd(tilt, Vec3::UnitX()));
    const Vec3 to_cap = turn * Vec3(0, 0, -1);
    for (double offset = -1e-5; offset < 1e-5; offset += 2e-7) {
      const auto at = [&](double way) {
        const Vec3 cap(-2.9e-3, offset + way, 1 + std::sin(tilt) - depth);
        return contact({Cylinder(1, 1), Pose(cap - to_cap, turn), Cylinder(1, 1), Pose()}, 0);
      };
      EXPECT_LE(hull_movement(at(0), at(step)), most) << tilt << " " << offset;
    }
  }
}

// An edge that hardly cuts is short; its ends are equally deep then, and rounding says which is the
// deeper one.
TEST(ManifoldMotion, DeepestPointStaysAsALeanTurnsAcrossAnEdge) {
  const auto deepest = [](const Contact& c) {
    const auto points = c.points();
    return std::max_element(points.begin(), points.end(),
                            [](const auto& p, const auto& q) { return p.depth < q.depth; })
        ->position;
  };
  for (const double cut : {1e-7, 1e-6, 1.9e-6}) {
    for (const double tilt : {1.5e-6, 1e-5, 1e-4}) {
      const Vec3 middle(-2 - cut - tilt, 0, 1.9999);  // so that the cap's own reaches that far
      const Step step{middle, Box({3, 3, 1}), {0, -tilt, 0}, {0, 0, 0}, {1e-9 * tilt, 0, 0}};
      const Contact one = contact(step.taken(-1), 0), other = contact(step.taken(1), 0);
      EXPECT_LE((deepest(one) - deepest(other)).norm(), 1e-5) << cut << " " << tilt;
    }
  }
}

// The edge has one point before and two from then on, of which the deepest place takes one.
TEST(ManifoldMotion, HullNeverJumpsAsTheLastEdgeBeginsToCutACapThatLeans) {
  constexpr double step = 1e-9;
  const double most = 4 * std::sqrt(step);
  for (double heading = 0.1; heading < 6.3; heading += 0.2) {
    for (const double tilt : {0.7e-6, 0.9e-6, 1.5e-6, 1e-5}) {
      const Vec3 lean(tilt * std::cos(heading), tilt * std::sin(heading), 0);
      // The cap's own middle, not the can's, lies over the box's.
      const Vec3 middle(lean.y(), -lean.x(), 1.99);
      for (const int i : {0, 1}) {
        Vec3 sides(0.97, 0.97, 1), shift(0, 0, 0);
        sides[i] = 1, shift[i] = step;
        const Step taken{middle, Box(sides), lean, shift, {0, 0, 0}};
        const Contact before = contact(taken.taken(-1), 0), after = contact(taken.taken(1), 0);
        EXPECT_LE(hull_movement(before, after), most) << heading << " " << tilt << " " << i;
      }
    }
  }
}

// Whichever way it leans: where an edge is first seen to cut it, and where all four are near.
TEST(ManifoldMotion, HullNeverJumpsAsAnEdgeBeginsToCountForACapThatLeans) {
  constexpr double step = 1e-9, seen = 2e-6, near = 0.05;
  const double most = 8 * std::sqrt(step);
  for (double heading = 0.1; heading < 6.3; heading += 0.2) {
    for (const double tilt : {0.9e-6, 5e-6, 1e-4}) {
      const Vec3 lean(tilt * std::cos(heading), tilt * std::sin(heading), 0);
      const struct {
        double x;
        Vec3 sides;
      } rows[] = {{0.5 + seen, {1.5, 1.5, 1}}, {0.03 - near, {1.03, 1.01, 1}}};
      for (const auto& row : rows) {
        const Step taken{
            Vec3(row.x + lean.y(), -lean.x(), 1.99), Box(row.sides), lean, {step, 0, 0}, {0, 0, 0}};
        const Contact before = contact(taken.taken(-1), 0), after = contact(taken.taken(1), 0);
        EXPECT_LE(hull_movement(before, after), most) << heading << " " << tilt;
      }
    }
  }
}

// Where they cross each other is no more than the step says: a box's edge or a hull's.
TEST(ManifoldMotion, HullNeverJumpsAsALyingSideGrazesAnEdge) {
  const Box box({0.7, 1, 1});
  constexpr double step = 5e-8;  // by as much do normals differ that are as good but for rounding
  for (const Shape& ground : {Shape(box), Shape(oracle::convex_hull(corners_of(box)))}) {
    for (double slant = 1e-9; slant < 2e-4; slant *= 2) {
      for (const double beyond : {-1e-9, 0.0, 1e-9}) {
        const Vec3 middle(0.3, 1 + beyond, 1.499);
        const auto at = [&](double way) {
          return contact({Cylinder(0.5, 1),
                          Pose(middle + Vec3(0, way, 0),
                               Quaternion(1, 0, 0, slant / 2) * along_x.normalized()),
                          ground, Pose()},
                         0);
        };
        EXPECT_LE(hull_movement(at(-step), at(step)), 0.01) << slant << " " << beyond;
      }
    }
  }
}

TEST(ManifoldMotion, HullNeverJumpsAsParallelSidesAreCrossed) {
  const Shape grounds[] = {Cylinder(1, 2), Capsule(1, 2)};
  for (const Shape& ground : grounds) {
    const auto turned = [&](double angle) {
      const Quaternion turn(Eigen::AngleAxisd(angle, Vec3::UnitZ()));
      return contact(
          {Cylinder(1, 2), Pose({0.1, 0, 1.99}, turn * along_x), ground, Pose({0, 0, 0}, along_x)},
          0);
    };
    Contact before = turned(0);
    EXPECT_EQ(before.points().size(), 2u);
    for (double angle = 1e-4; angle < 0.3; angle += 1e-4) {
      const Contact after = turned(angle);
      // The patch of two sides that cross shrinks as 1 / angle.
      EXPECT_LE(hull_movement(before, after), 0.03) << angle;
      before = after;
    }
    EXPECT_EQ(before.points().size(), 1u);
  }
}

// Four points take over from three as caps leave each other.
TEST(ManifoldMotion, HullNeverJumpsAsOneCapSlidesOffAnother) {
  const struct { double radius, most; } table[] = {{1.0, 0.05}, {1.4, 0.05}};
  for (const auto& row : table) {
    for (const double tilt : {0.0, 1e-9, 1e-5}) {
      const auto slid = [&](double way) {
        const Quaternion turn(1, tilt / 2, 0, 0);
        return contact({Cylinder(1, 1), Pose({0.6 * way, 0.8 * way, 1.99}, turn),
                        Cylinder(row.radius, 1), Pose()},
                       0);
      };
      Contact before = slid(0);
      for (double way = 2e-4; way < row.radius + 0.5; way += 2e-4) {
        const Contact after = slid(way);
        EXPECT_LE(hull_movement(before, after), row.most)
            << row.radius << " " << tilt << " " << way;
        before = after;
      }
      EXPECT_EQ(before.points().size(), tilt > 1e-6 ? 5u : 4u);
    }
  }
}

}  // namespace
}  // namespace touchstone
