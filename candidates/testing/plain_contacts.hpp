#pragma once

#include <cmath>
#include <map>
#include <string>
#include <vector>

#include "candidates/candidates.hpp"
#include "candidates/host/candidate_process.hpp"
#include "oracle/hull.hpp"

namespace touchstone {

using Quaternion = Eigen::Quaterniond;

inline const Quaternion upright(1, 0, 0, 0);
inline const Quaternion along_x = Quaternion(Eigen::AngleAxisd(M_PI / 2, Vec3::UnitY()));
inline const Quaternion along_y = Quaternion(Eigen::AngleAxisd(M_PI / 2, Vec3::UnitX()));

inline Vec3 normal_of(const ts_answer& a) { return Vec3(a.normal[0], a.normal[1], a.normal[2]); }

/// A contact that every engine must get right as it is called here: between faces and sides,
/// without rounded edges.
struct PlainContact {
  const char* name;
  Configuration configuration;
  double signed_distance;
  Vec3 normal;
};

inline std::vector<PlainContact> plain_contacts() {
  const Cylinder a(0.5, 1);
  const Vec3 up(0, 0, 1);
  // A box whose origin is elsewhere.
  std::vector<Vec3> corners;
  for (int i = 0; i < 8; ++i) corners.emplace_back(i & 1 ? 5 : 1, i & 2 ? 3 : -1, i & 4 ? -1 : -3);
  const Convex hull = oracle::convex_hull(corners);
  const Pose of_hull({-3, -1, 2}, upright);
  return {
      {"standing on a plane", {a, Pose({3, 2, 2.99}, upright), Plane(up, 2), Pose()}, -0.01, up},
      {"lying on a posed plane",
       {a, Pose({3, 2, 1.49}, along_x), Plane(up, 0), Pose({0, 0, 1}, upright)},
       -0.01,
       up},
      {"sphere at the side",
       {a, Pose({1, 0, 0}, upright), Sphere(0.55), Pose({0, 0, 0.3}, upright)},
       -0.05,
       {1, 0, 0}},
      {"sphere under the cap",
       {a, Pose({0, 0, 1.45}, upright), Sphere(0.5), Pose({0.1, 0.1, 0}, upright)},
       -0.05,
       up},
      {"crossed capsule",
       {a, Pose({0, 0, 0.95}, along_x), Capsule(0.5, 1), Pose({0, 0, 0}, along_y)},
       -0.05,
       up},
      {"crossed cylinder",
       {a, Pose({0, 0, 0.95}, along_x), Cylinder(0.5, 1), Pose({0, 0, 0}, along_y)},
       -0.05,
       up},
      {"standing on a box",
       {a, Pose({0.2, 0.1, 1.95}, upright), Box({2, 2, 1}), Pose()},
       -0.05,
       up},
      {"lying on a box", {a, Pose({0.2, 0.1, 1.45}, along_x), Box({2, 2, 1}), Pose()}, -0.05, up},
      {"standing on a hull", {a, Pose({0.2, 0.1, 1.95}, upright), hull, of_hull}, -0.05, up},
      {"lying on a hull", {a, Pose({0.2, 0.1, 1.45}, along_x), hull, of_hull}, -0.05, up},
  };
}

/// One process for each candidate and threshold, kept for the lifetime of a test program.
inline CandidateProcess& process(const Candidate& candidate, double threshold = 0) {
  static std::map<std::pair<std::string, double>, CandidateProcess> processes;
  return processes.try_emplace({candidate.name, threshold}, candidate, threshold).first->second;
}

inline Answer answer(const std::string& candidate, const Configuration& configuration,
                     double threshold = 0) {
  return process(find_candidate(candidate), threshold).answer(configuration);
}

}  // namespace touchstone
