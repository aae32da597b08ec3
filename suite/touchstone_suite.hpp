// Reads touchstone-suite-1 and judges answers, in C++17; README.md explains the columns and rules.
//   for (const auto& c : touchstone_suite::read(stream)) verdict(c, what_my_routine_answers(c));
// CC0: do with it what you like.
#pragma once
#include <algorithm>
#include <cmath>
#include <istream>
#include <sstream>
#include <string>
#include <valarray>
#include <vector>

namespace touchstone_suite {

using Vector = std::valarray<double>;
struct Case {  // the columns that judging needs; of the normals the first
  std::string id, shape_b, contact;
  Vector size_a = Vector(2), position_a = Vector(3), position_b = Vector(3), normal = Vector(3);
  Vector orientation_a = Vector(4), orientation_b = Vector(4), size_b = Vector(4);
  double signed_distance, min_distance, max_distance, max_regret, min_point_depth;
};
struct Answer {
  std::string status;  // "contact", "none", …
  double signed_distance;
  Vector normal;
  std::vector<Vector> points;  // x, y, z, depth
};

inline std::istream& operator>>(std::istream& in, Vector& numbers) {
  for (double& x : numbers) in >> x;
  return in;
}
inline std::vector<Case> read(std::istream& csv) {
  std::vector<Case> cases;
  std::string line, skipped;
  for (std::getline(csv, line); std::getline(csv, line);) {  // below the header
    std::replace(line.begin(), line.end(), ',', ' ');
    std::istringstream row(line);
    Case& c = cases.emplace_back();
    row >> c.id >> skipped >> c.size_a >> c.position_a >> c.orientation_a >> c.shape_b >>
        c.size_b >> c.position_b >> c.orientation_b >> c.signed_distance >> skipped >> skipped >>
        skipped >> c.contact >> c.min_distance >> c.max_distance >> c.max_regret >>
        c.min_point_depth >> skipped >> c.normal;
  }
  return cases;
}

inline double dot(const Vector& a, const Vector& b) { return (a * b).sum(); }
inline double length(const Vector& v) { return std::sqrt(dot(v, v)); }
inline Vector cross(const Vector& a, const Vector& b) {
  return a.cshift(1) * b.cshift(2) - a.cshift(2) * b.cshift(1);
}
inline Vector in_frame(const Vector& q, const Vector& v) {  // q may have any length
  const Vector u = {q[1], q[2], q[3]}, t = cross(u, v);
  return v + 2 / dot(q, q) * (cross(u, t) - q[0] * t);
}
inline double gap(const Case& c, const Vector& n) {  // g(n): clearance along the unit vector n
  const Vector a = in_frame(c.orientation_a, n), b = in_frame(c.orientation_b, n), &size = c.size_b;
  const Vector d = c.position_a - c.position_b, xyz = {size[0], size[1], size[2]};
  const double r = c.size_a[0], h = c.size_a[1], rho = std::hypot(r, h);
  const double half_a = h * std::abs(a[2]) + r * std::hypot(a[0], a[1]);
  if (c.shape_b ==
      "plane") {  // against the half-space's column beneath the cylinder's circumsphere
    const Vector up = xyz / length(xyz);
    const double cosine = dot(b, up), sine = length(b - cosine * up);
    const double height = dot(in_frame(c.orientation_b, d), up) - size[3] / length(xyz);
    return height * cosine - half_a - rho * sine - 2 * rho * std::max(0.0, -cosine);
  }
  const double across = c.shape_b == "cylinder" ? std::hypot(b[0], b[1]) : 1;
  const double half_round = size[0] * across + size[1] * std::abs(b[2]);  // a sphere's is size[0]
  return dot(d, n) - half_a - (c.shape_b == "box" ? dot(xyz, std::abs(b)) : half_round);
}

inline bool is_finite(const Vector& v) {
  return std::all_of(begin(v), end(v), [](double x) { return std::isfinite(x); });
}
inline std::string verdict(const Case& c, const Answer& answer) {
  const auto& [status, distance, normal, points] = answer;
  const bool required = c.contact == "required";
  if (status != "contact") return status != "none" ? status : required ? "missed" : "agree";
  double min_depth = HUGE_VAL, max_depth = -HUGE_VAL;
  bool finite = std::isfinite(distance) && is_finite(normal);
  for (const Vector& p : points) {
    min_depth = std::min(min_depth, p[3]), max_depth = std::max(max_depth, p[3]);
    finite = finite && is_finite(p);
  }
  if (!finite) return "not-finite";
  if (c.contact == "forbidden") return "phantom";
  if (distance > c.max_distance) return "shallow";
  if (distance < c.min_distance) return "overdeep";
  if (!(std::abs(length(normal) - 1) <= 1e-6)) return "wrong-normal";
  const double regret = c.signed_distance - gap(c, normal / length(normal));
  if (regret > c.max_regret) return "wrong-normal";
  if (points.empty()) return required ? "shallow-points" : "agree";
  if (max_depth < -c.max_distance) return "shallow-points";
  if (max_depth > -c.min_distance) return "overdeep-points";
  return min_depth < c.min_point_depth ? "phantom-points" : "agree";
}
inline std::string right(const Case& c) {  // what would be right
  std::ostringstream text;
  text.precision(17);
  text << "contact " << c.contact << ", signed distance " << c.min_distance << " to "
       << c.max_distance << ", normal " << c.normal[0] << ' ' << c.normal[1] << ' ' << c.normal[2];
  return text.str();
}

}  // namespace touchstone_suite
