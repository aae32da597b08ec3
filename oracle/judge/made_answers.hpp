#pragma once

#include <vector>

#include "oracle/judge/score.hpp"

// Made-up answers, for tests.

namespace touchstone {

/// A can of size 0.5 standing on a box, 1e-3 deep: truth −1e-3 along z, −2e-3 of the size.
inline const Configuration standing{Cylinder(0.5, 1),
                                    Pose(Vec3(0, 0, 1.999), Eigen::Quaterniond::Identity()),
                                    Box(Vec3(2, 2, 1)), Pose()};

inline ts_answer contact(double signed_distance, const Vec3& normal) {
  ts_answer a{};
  a.status = TS_CONTACT;
  a.signed_distance = signed_distance;
  for (int i = 0; i < 3; ++i) a.normal[i] = normal[i];
  a.point_count = 1;
  a.points[0] = {{0, 0, 1}, {normal.x(), normal.y(), normal.z()}, -signed_distance};
  return a;
}

inline ts_answer none() {
  ts_answer a{};
  a.status = TS_NONE;
  return a;
}

inline Score scored(const Configuration& c, const ts_answer& a, const Bar& bar = {}) {
  return score(c, oracle::truth(c), a, bar);
}

inline Configuration lifted(double by) {
  return {standing.a,
          Pose(standing.pose_a.position() + Vec3(0, 0, by), standing.pose_a.orientation()),
          standing.b, standing.pose_b};
}

inline const Vec3 up(0, 0, 1);

}  // namespace touchstone
