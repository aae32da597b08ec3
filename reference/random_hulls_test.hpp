#pragma once

#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

#include "oracle/hull.hpp"
#include "reference/contact_of.hpp"
#include "reference/invalid_input.hpp"
#include "reference/random_bodies_test.hpp"

namespace touchstone {

// Hulls that tests draw: what people have, and what breaks routines.

inline std::vector<Vec3> corners_of(const Box& box) {
  std::vector<Vec3> corners;
  for (int i = 0; i < 8; ++i) {
    const Vec3 sign((i & 1) ? 1 : -1, (i & 2) ? 1 : -1, (i & 4) ? 1 : -1);
    corners.push_back(sign.cwiseProduct(box.half_extents()));
  }
  return corners;
}

enum class HullKind {
  random,          ///< of 4 to 64 points in a ball
  round,           ///< of 8 to 64 points of a sphere
  prism,           ///< of 3 to 40 sides
  triangle,        ///< of any proportions
  polygon,         ///< flat, of 4 to 12 corners
  needle,          ///< a random one, 1e-2 to 1e-9 as thick in two directions
  slab,            ///< in one
  wedge,           ///< two points of an edge, 1e-1 to 1e-12 apart, at the end of a triangle
  nearly_flat,     ///< a box whose vertices are off its faces by 1e-3 to 1e-16
  off_the_origin,  ///< a random one, away from its own origin
  lattice          ///< of halves of whole numbers, some off by the least that doubles can be
};
inline constexpr HullKind hull_kinds[] = {
    HullKind::random,      HullKind::round,          HullKind::prism,  HullKind::triangle,
    HullKind::polygon,     HullKind::needle,         HullKind::slab,   HullKind::wedge,
    HullKind::nearly_flat, HullKind::off_the_origin, HullKind::lattice};
inline const char* const hull_kind_names[] = {"random",      "round",          "prism",  "triangle",
                                              "polygon",     "needle",         "slab",   "wedge",
                                              "nearly_flat", "off_the_origin", "lattice"};

/// Points of about one metre.
inline std::vector<Vec3> hull_points(HullKind kind, Random& random) {
  std::vector<Vec3> points;
  // Mostly few.
  const auto some = [&](int least, int most) {
    const double range = std::log2(static_cast<double>(most) / least);
    return static_cast<int>(least * std::exp2(random.uniform(0, 1) * random.uniform(0, range)));
  };
  const auto cloud = [&](int count, double inner) {
    for (int i = 0; i < count; ++i) {
      points.push_back(std::cbrt(random.uniform(inner, 1)) * random.direction());
    }
  };
  const auto stretch = [&](const Vec3& by) {
    for (Vec3& p : points) p = p.cwiseProduct(by).eval();
  };
  switch (kind) {
    case HullKind::random:
      cloud(some(4, 64), 0);
      break;
    case HullKind::round:
      cloud(some(8, 64), 1);
      break;
    case HullKind::prism: {
      const int sides = some(3, 40);
      const double half_length = random.uniform(0.1, 1);
      for (int i = 0; i < sides; ++i) {
        const double angle = 2 * std::numbers::pi * i / sides;
        for (const double z : {-half_length, half_length}) {
          points.emplace_back(std::cos(angle), std::sin(angle), z);
        }
      }
      break;
    }
    case HullKind::triangle:
      for (int i = 0; i < 3; ++i) points.push_back(random.power_of_ten(-2, 0) * random.direction());
      break;
    case HullKind::polygon: {
      const int corners = 4 + random.one_of(9);
      for (int i = 0; i < corners; ++i) {
        const double angle = random.uniform(0, 2 * std::numbers::pi);
        points.emplace_back(std::cos(angle), std::sin(angle), 0);
      }
      stretch({1, random.power_of_ten(-2, 0), 1});
      break;
    }
    case HullKind::needle: {
      cloud(6 + random.one_of(15), 0);
      const double thin = random.power_of_ten(-9, -2);
      stretch({thin, thin, 1});
      break;
    }
    case HullKind::slab:
      cloud(6 + random.one_of(15), 0);
      stretch({1, 1, random.power_of_ten(-9, -2)});
      break;
    case HullKind::wedge: {
      points = {Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0.3, 0.7, 0)};
      points.push_back(points[2] + random.power_of_ten(-12, -1) * random.direction());
      break;
    }
    case HullKind::nearly_flat: {
      points =
          corners_of(Box({random.uniform(0.2, 1), random.uniform(0.2, 1), random.uniform(0.2, 1)}));
      const double off = random.power_of_ten(-16, -3);
      for (int i = 0; i < 6; ++i) {  // and more on its faces
        Vec3 p = points[0].cwiseProduct(Vec3(random.uniform(-1, 1), random.uniform(-1, 1), -1));
        points.push_back(p);
      }
      for (Vec3& p : points) p += off * random.direction();
      break;
    }
    case HullKind::off_the_origin: {
      cloud(4 + random.one_of(20), 0);
      const Vec3 away = random.uniform(0.5, 3) * random.direction();
      for (Vec3& p : points) p += away;
      break;
    }
    case HullKind::lattice: {
      const int count = 4 + random.one_of(12);
      const auto half = [&] { return (random.one_of(5) - 2) / 2.0; };
      for (int i = 0; i < count; ++i) {
        const double x = half(), y = half();
        points.emplace_back(x, y, half());
        for (double& coordinate : points.back()) {
          if (random.one_of(4) == 0) coordinate = std::nextafter(coordinate, random.sign());
        }
      }
      break;
    }
  }
  return points;
}

/// Poses beside, touching and within one another, at random and aligned with the hull.
inline Configuration with_hull(HullKind kind, Random& random) {
  for (;;) {
    std::vector<Vec3> points = hull_points(kind, random);
    if (random.one_of(4) == 0) {  // rounded coordinates
      const Eigen::Quaterniond turn = random.turn();
      for (Vec3& p : points) p = turn * p;
    }
    try {
      const Convex hull = oracle::convex_hull(points);
      const auto size = [&] {
        return random.one_of(3) == 0 ? random.power_of_ten(-3, 0) : random.uniform(0.1, 1);
      };
      const Cylinder a(size(), size());
      const auto& face = hull.faces()[static_cast<std::size_t>(
          random.one_of(static_cast<int>(hull.faces().size())))];
      const auto& edge = hull.edges()[static_cast<std::size_t>(
          random.one_of(static_cast<int>(hull.edges().size())))];
      const Vec3 from = hull.vertices()[edge.vertices[0]], to = hull.vertices()[edge.vertices[1]];
      const Vec3 tilt =
          random.toss() ? Vec3(0, 0, 0) : Vec3(random.power_of_ten(-16, -1) * random.direction());
      Vec3 axis = random.direction();
      const int aligned = random.one_of(6);
      if (aligned == 1) axis = face.normal + tilt;
      if (aligned == 2) axis = (to - from).stableNormalized() + tilt;
      if (aligned == 3) axis = face.normal.unitOrthogonal() + tilt;
      const Eigen::Quaterniond orientation = turn_between(Vec3::UnitZ(), axis);
      // Its centre: from a place of the hull along a normal, so that both are near or deep.
      const Vec3 place = random.toss() ? from + random.uniform(0, 1) * (to - from) : hull.middle();
      const Vec3 way = random.toss() ? face.normal : random.direction();
      const Vec3 centre = place + random.uniform(-0.2, 1.3) * (a.radius() + a.half_length()) * way;
      Configuration local{a, Pose(centre, orientation), hull, Pose()};
      if (random.toss()) return local;
      const Eigen::Quaterniond turn = random.turn();
      return {a, Pose(turn * centre, turn * orientation), hull, Pose(Vec3::Zero(), turn)};
    } catch (const InvalidInput&) {
      continue;  // points on a line
    }
  }
}

/// Moves A along its normal, so that the bodies lie so deep in each other, but for rounding and
/// where another normal gets better.
inline Configuration moved_to_depth(Configuration c, double depth) {
  for (int i = 0; i < 3; ++i) {
    const SignedDistance found = signed_distance(c);
    c.pose_a =
        Pose(c.pose_a.position() - (found.value + depth) * found.normal, c.pose_a.orientation());
  }
  return c;
}

/// All lengths together.
inline double lengths_of(const Configuration& c) {
  double far = 0;
  for (const Vec3& v : std::get<Convex>(c.b).vertices()) far = std::max(far, v.norm());
  return far + c.a.radius() + c.a.half_length() +
         (c.pose_a.position() - c.pose_b.position()).norm();
}

}  // namespace touchstone
