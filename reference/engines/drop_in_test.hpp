#pragma once

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <string>
#include <thread>
#include <vector>

#include "properties/identity.hpp"
#include "reference/contact_of.hpp"
#include "reference/random_bodies_test.hpp"
#include "reference/reduce_points.hpp"

namespace touchstone {

/// A point as an engine reports it, with the normal from B to A.
struct EnginePoint {
  Vec3 position;  ///< halfway between the surfaces
  Vec3 normal;
  double depth;
};

inline std::vector<EnginePoint> turned_round(std::vector<EnginePoint> points) {
  for (EnginePoint& p : points) p.normal = -p.normal;
  return points;
}
/// Appends all numbers of points, to be compared to the last bit.
inline void append(std::vector<double>& numbers, const std::vector<EnginePoint>& points) {
  for (const EnginePoint& p : points) {
    for (int i = 0; i < 3; ++i) numbers.push_back(p.position[i]), numbers.push_back(p.normal[i]);
    numbers.push_back(p.depth);
  }
}

/// ask(0) alone, and ask(1) and ask(2) in two threads at once, have the same answers, and some.
/// Returns them.
template <class Ask>
auto expect_threads_answer_alike(Ask ask) {
  auto alone = ask(0);
  std::vector<decltype(ask(0))> at_once(2);
  std::vector<std::thread> threads;
  for (int i : {1, 2}) threads.emplace_back([&, i] { at_once[i - 1] = ask(i); });
  for (std::thread& t : threads) t.join();
  EXPECT_FALSE(alone.empty());
  for (const auto& answer : at_once) EXPECT_EQ(answer, alone);
  return alone;
}

/// What is uninstalled, also after it was installed twice, leaves the engine's own answers.
template <class Answers, class Install, class Uninstall>
void expect_uninstall_gives_back(Answers answers, Install install, Uninstall uninstall) {
  uninstall();
  const auto before = answers();
  install();
  install();
  EXPECT_NE(answers(), before);
  uninstall();
  EXPECT_EQ(answers(), before);
}

/// Configurations of every kind of everyday pose: general, aligned, at rest, apart.
inline std::vector<Identity> everyday_poses(Pair pair, std::uint64_t count) {
  std::vector<Identity> identities;
  for (const std::string& name : selected_classes(pair, {.groups = {Group::everyday}})) {
    for (std::uint64_t i = 0; i < count; ++i) identities.push_back({pair, name, 21, i});
  }
  return identities;
}

/// Does an engine take a point of a contact for one that it has kept?
using IsSame = bool (*)(const Contact& contact, const ContactPoint& point, const ContactPoint& kept,
                        double threshold);

/// An engine's points are those of our routine: the normal has the same clearance (where several
/// tie it may be another), as many points as the engine's limit lets through, the deepest as deep.
/// `precision` is that of the poses as the engine holds them, relative to the larger size; of the
/// points before it a point replaces the nearest one where `is_same` says so.
inline void expect_as_ours(const Configuration& c, double threshold, int max_points,
                           const std::vector<EnginePoint>& points, double precision,
                           IsSame is_same = nullptr) {
  const double rounding =
      precision * (larger_size(c) + c.pose_a.position().norm() + c.pose_b.position().norm());
  Contact ours = contact(c, threshold, nullptr, PointRange::within_threshold);
  if (std::abs(ours.signed_distance - threshold) <= rounding) return;
  reduce_points(ours, max_points);
  ASSERT_LE(static_cast<int>(points.size()), max_points);
  ASSERT_EQ(points.empty(), ours.points().empty());
  if (precision < 1e-9) {
    ASSERT_LE(points.size(), ours.points().size());
    // The engine's rounding may drop a point that is as far apart as the threshold.
    const auto is_within = [&](const ContactPoint& p) { return p.depth > rounding - threshold; };
    std::vector<ContactPoint> kept;
    for (const ContactPoint& p : ours.points()) {
      if (!is_within(p)) continue;
      const auto nearest = std::min_element(
          kept.begin(), kept.end(), [&](const ContactPoint& l, const ContactPoint& r) {
            return (l.position - p.position).norm() < (r.position - p.position).norm();
          });
      if (is_same && nearest != kept.end() && is_same(ours, p, *nearest, threshold)) {
        *nearest = p;
      } else {
        kept.push_back(p);
      }
    }
    ASSERT_GE(points.size(), kept.size());
  }
  if (points.empty()) return;
  double deepest = points[0].depth;
  for (const EnginePoint& p : points) {
    EXPECT_NEAR(p.normal.norm(), 1, precision);
    deepest = std::max(deepest, p.depth);
    if (!std::holds_alternative<Plane>(c.b)) {
      EXPECT_NEAR(gap(c, p.normal), ours.signed_distance, rounding);
    }
  }
  // Three points of a body at rest lack up to a millionth of the depth (reduce_points.hpp).
  EXPECT_NEAR(deepest, -ours.signed_distance, rounding + 2e-6 * larger_size(c));
  if ((points[0].normal - ours.normal).norm() > 1e-6 || precision > 1e-9) return;
  for (const EnginePoint& p : points) {
    double nearest = INFINITY;
    for (const ContactPoint& q : ours.points()) {
      nearest = std::min(nearest, (q.position - p.position).norm() + std::abs(q.depth - p.depth));
    }
    EXPECT_LE(nearest, 1e-7 * larger_size(c));
  }
}

}  // namespace touchstone
