// Reads touchstone-suite-1 and judges answers, in C++17; README.md explains the columns and rules.
//   for (const auto& c : touchstone_suite::read(stream)) verdict(c, what_my_routine_answers(c));
// CC0: do with it what you like.
#pragma once
#include <algorithm>
#include <array>
#include <cmath>
#include <istream>
#include <sstream>
#include <string>
#include <vector>

namespace touchstone_suite {

template <std::size_t N>
using Numbers = std::array<double, N>;

struct Case {  // the columns that judging needs; of the normals the first
  std::string id, shape_b, contact;
  Numbers<2> size_a;
  Numbers<3> position_a, position_b, normal;
  Numbers<4> orientation_a, orientation_b, size_b;
  double signed_distance, min_distance, max_distance, max_regret, min_point_depth;
};
struct Answer {
  std::string status;  // "contact", "none", …
  double signed_distance;
  Numbers<3> normal;
  std::vector<Numbers<4>> points;  // x, y, z, depth
};

template <std::size_t N>
std::istream& operator>>(std::istream& in, Numbers<N>& numbers) {
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

inline Numbers<3> in_frame(const Numbers<4>& q, const Numbers<3>& v) {  // q may have any length
  const auto [w, x, y, z] = q;
  const double s = 2 / (w * w + x * x + y * y + z * z);
  return {v[0] + s * (v[1] * (x * y + w * z) + v[2] * (x * z - w * y) - v[0] * (y * y + z * z)),
          v[1] + s * (v[2] * (y * z + w * x) + v[0] * (x * y - w * z) - v[1] * (x * x + z * z)),
          v[2] + s * (v[0] * (x * z + w * y) + v[1] * (y * z - w * x) - v[2] * (x * x + y * y))};
}
inline double dot(const Numbers<3>& a, const Numbers<3>& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
inline double gap(const Case& c, const Numbers<3>& n) {  // g(n): clearance along the unit vector n
  const auto [r, h] = c.size_a;
  const auto [b1, b2, b3, b4] = c.size_b;
  const Numbers<3> a = in_frame(c.orientation_a, n), b = in_frame(c.orientation_b, n),
                   &p = c.position_a, &q = c.position_b,
                   d = {p[0] - q[0], p[1] - q[1], p[2] - q[2]};
  const double half_a = h * std::abs(a[2]) + r * std::hypot(a[0], a[1]), g = dot(d, n) - half_a;
  if (c.shape_b == "sphere") return g - b1;
  if (c.shape_b == "capsule") return g - b1 - b2 * std::abs(b[2]);
  if (c.shape_b == "cylinder") return g - b2 * std::abs(b[2]) - b1 * std::hypot(b[0], b[1]);
  if (c.shape_b == "box")
    return g - b1 * std::abs(b[0]) - b2 * std::abs(b[1]) - b3 * std::abs(b[2]);
  // A plane: against the column of the half-space beneath the cylinder's circumsphere.
  const double length = std::hypot(b1, b2, b3), rho = std::hypot(r, h);
  const Numbers<3> up = {b1 / length, b2 / length, b3 / length};
  const double cosine = dot(b, up), height = dot(in_frame(c.orientation_b, d), up) - b4 / length;
  const double sine =
      std::hypot(b[0] - cosine * up[0], b[1] - cosine * up[1], b[2] - cosine * up[2]);
  return height * cosine - half_a - rho * sine - 2 * rho * std::max(0.0, -cosine);
}

inline std::string verdict(const Case& c, const Answer& answer) {
  const auto& [status, distance, normal, points] = answer;
  const bool required = c.contact == "required";
  if (status == "none") return required ? "missed" : "agree";
  if (status != "contact") return status;
  double min_depth = HUGE_VAL, max_depth = -HUGE_VAL;
  bool finite = std::isfinite(distance);
  for (const double x : normal) finite = finite && std::isfinite(x);
  for (const auto& p : points) {
    for (const double x : p) finite = finite && std::isfinite(x);
    min_depth = std::min(min_depth, p[3]), max_depth = std::max(max_depth, p[3]);
  }
  if (!finite) return "not-finite";
  if (c.contact == "forbidden") return "phantom";
  if (distance > c.max_distance) return "shallow";
  if (distance < c.min_distance) return "overdeep";
  const double length = std::hypot(normal[0], normal[1], normal[2]);
  if (!(std::abs(length - 1) <= 1e-6)) return "wrong-normal";
  const Numbers<3> n = {normal[0] / length, normal[1] / length, normal[2] / length};
  if (c.signed_distance - gap(c, n) > c.max_regret) return "wrong-normal";
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
