// Reads touchstone-suite-1 or -2 and judges answers, in C++17; README.md explains the columns and
// rules.
//   for (const auto& c : touchstone_suite::read(stream)) verdict(c, what_my_routine_answers(c));
//   for (const auto& c : touchstone_suite::read_casts(stream)) verdict(c, what_my_cast_answers(c));
// SPDX-License-Identifier: CC0-1.0
#pragma once
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <istream>
#include <locale>
#include <sstream>
#include <stdexcept>
#include <string>
#include <valarray>
#include <vector>

namespace touchstone_suite {

using Vector = std::valarray<double>;
struct Bodies {  // the columns that every file has and judging needs
  std::string id, shape_b;
  Vector size_a = Vector(2), position_a = Vector(3), position_b = Vector(3);
  Vector orientation_a = Vector(4), orientation_b = Vector(4), size_b = Vector(4);
  std::vector<Vector> vertices_b;  // of touchstone-suite-2
  std::string about;               // there, too: what the case is and why it is hard
};
struct Case : Bodies {  // of the normals the first
  std::string contact;
  Vector normal = Vector(3);
  double signed_distance, min_distance, max_distance, max_regret, min_point_depth;
  double float_tolerance = 0;  // of touchstone-suite-2
};
struct Answer {
  std::string status;  // "contact", "none", …
  double signed_distance;
  Vector normal;
  std::vector<Vector> points;  // x, y, z, depth
};
struct CastLimits {
  std::string touch;
  double tolerance, min_fraction, max_fraction;
};
struct Cast : Bodies {  // A moves by the sweep
  Vector sweep = Vector(3);
  std::string outcome;
  std::vector<Vector> normals;  // at the touch
  double fraction, start_depth;
  CastLimits limits, float_limits;
};
struct CastAnswer {
  std::string status;  // "touch", "from-start", "never", …
  double fraction;     // of the sweep, of a touch
  Vector normal;
};

constexpr std::size_t row_count = 5106;
// What touchstone-suite-1 starts with. Other test data of Touchstone have further columns.
inline const std::string columns_of_bodies =
    "id,group,radius_a,half_length_a,position_a_x,position_a_y,position_a_z,orientation_a_w,"
    "orientation_a_x,orientation_a_y,orientation_a_z,shape_b,size_b_1,size_b_2,size_b_3,"
    "size_b_4,position_b_x,position_b_y,position_b_z,orientation_b_w,orientation_b_x,"
    "orientation_b_y,orientation_b_z,";
inline const std::string columns =
    columns_of_bodies +
    "signed_distance,signed_distance_error,signed_distance_low,signed_distance_high,contact,"
    "min_distance,max_distance,max_regret,min_point_depth,ties,normal,patch_kind";
inline const std::string columns_2 = columns + ",vertices_b,float_tolerance,about";
inline const std::string columns_of_casts =
    columns_of_bodies +
    "sweep_x,sweep_y,sweep_z,outcome,fraction,fraction_low,fraction_high,start_depth,touch,"
    "tolerance,min_fraction,max_fraction,ties,normal,vertices_b,float_touch,float_tolerance,"
    "float_min_fraction,float_max_fraction,about";

class Row {  // hands out its cells one by one; what is wrong with one is a std::runtime_error
 public:
  Row(const std::string& line, const std::string& names, const std::string& place)
      : cells_(line), names_(names), place_(place) {
    number_.imbue(std::locale::classic());
  }
  Row& operator>>(std::string& cell) {
    std::getline(names_, name_, ',');
    if (!std::getline(cells_, cell, ',') || cell.empty()) {
      throw std::runtime_error(place_ + ": " + name_ +
                               " is missing: the file is cut off or damaged");
    }
    return *this;
  }
  Row& operator>>(double& x) {
    std::string cell;
    *this >> cell;
    return parse(cell, &x, 1);
  }
  Row& operator>>(Vector& numbers) {
    for (double& x : numbers) *this >> x;
    return *this;
  }
  Row& operator>>(CastLimits& limits) {
    return *this >> limits.touch >> limits.tolerance >> limits.min_fraction >> limits.max_fraction;
  }
  Row& operator>>(Bodies& b) {
    std::string group;
    return *this >> b.id >> group >> b.size_a >> b.position_a >> b.orientation_a >> b.shape_b >>
           b.size_b >> b.position_b >> b.orientation_b;
  }
  Row& operator>>(std::vector<Vector>& list) {  // "x y z;x y z" or "none"
    std::string cell, one;
    *this >> cell;
    std::istringstream parts(cell == "none" ? "" : cell);
    while (std::getline(parts, one, ';')) parse(one, &list.emplace_back(Vector(3))[0], 3);
    return *this;
  }
  Row& parse(const std::string& text, double* x, int count) {
    number_.clear();
    number_.str(text);
    for (int i = 0; i < count; ++i) number_ >> x[i];
    if (number_.fail() || number_.peek() != EOF) {
      throw std::runtime_error(place_ + ": " + name_ + " is \"" + text + "\": must be " +
                               (count == 1 ? "a number" : "numbers"));
    }
    return *this;
  }

 private:
  std::istringstream cells_, names_, number_;
  std::string place_, name_;
};

// Reads a file's rows as `take(row, header)` does; their columns are to begin with `first`.
template <class One>
std::vector<One> read_rows(std::istream& csv, const std::string& file, const std::string& first,
                           const std::string& names, One (*take)(Row&, const std::string&)) {
  const auto next_line = [&csv](std::string& line) {
    if (!std::getline(csv, line)) return false;
    if (!line.empty() && line.back() == '\r') line.pop_back();
    return true;
  };
  std::vector<One> all;
  std::string line;
  std::size_t number = 1;
  bool is_readable = next_line(line);
  const bool is_2 = is_readable && line.compare(0, 1, "#") == 0;
  while (is_readable && line.compare(0, 1, "#") == 0) is_readable = next_line(line), ++number;
  if (!is_readable) throw std::runtime_error(file + ":1: nothing can be read");
  if (line.compare(0, first.size(), first) != 0) {
    throw std::runtime_error(file + ":1: must be the columns of " +
                             (first == columns ? "touchstone-suite-1" : "casts") + ", \"" +
                             first.substr(0, 17) + "…\"; unpack a .gz by gzip -d");
  }
  const std::string header = line;
  std::string end = line;
  while (next_line(line)) {
    end = line, ++number;
    if (line.compare(0, 1, "#") == 0) continue;
    Row row(line, names, file + ':' + std::to_string(number));
    all.push_back(take(row, header));
  }
  const std::string count = std::to_string(all.size());
  if (is_2 && end != "# " + count + " configurations") {
    throw std::runtime_error(file + ':' + std::to_string(number) + ": must be \"# " + count +
                             " configurations\"; the file is cut off");
  }
  if (csv.bad() || (header == columns && all.size() != row_count)) {
    throw std::runtime_error(file + ": has " + count + " configurations: must have " +
                             std::to_string(row_count) +
                             "; the file is cut off or not touchstone-suite-1");
  }
  return all;
}

// Reads the unpacked file; `file` is its name in messages. Throws std::runtime_error, with the line
// and what was expected there, if that is not what it gives.
inline std::vector<Case> read(std::istream& csv, const std::string& file = "the suite's file") {
  return read_rows<Case>(csv, file, columns, columns_2, [](Row& row, const std::string& header) {
    Case c;
    std::string skipped, normals;
    row >> c >> c.signed_distance >> skipped >> skipped >> skipped >> c.contact >> c.min_distance >>
        c.max_distance >> c.max_regret >> c.min_point_depth >> skipped >> normals;
    row.parse(normals.substr(0, normals.find(';')), &c.normal[0], 3) >> skipped;
    if (header == columns_2) row >> c.vertices_b >> c.float_tolerance >> c.about;
    return c;
  });
}

// The same of touchstone-suite-2-casts.
inline std::vector<Cast> read_casts(std::istream& csv,
                                    const std::string& file = "the suite's file") {
  return read_rows<Cast>(
      csv, file, columns_of_casts, columns_of_casts, [](Row& row, const std::string&) {
        Cast c;
        std::string skipped;
        row >> c >> c.sweep >> c.outcome >> c.fraction >> skipped >> skipped >> c.start_depth >>
            c.limits >> skipped >> c.normals >> c.vertices_b >> c.float_limits >> c.about;
        return c;
      });
}

// One of touchstone-suite-2, with the limits for a routine in single precision.
inline Case in_float(Case c) {
  const double t = c.float_tolerance, distance = c.signed_distance;
  c.contact = distance < -t ? "required" : distance > t ? "forbidden" : "optional";
  c.min_distance = distance - t, c.max_distance = distance + t;
  c.max_regret = t, c.min_point_depth = -t;
  return c;
}

inline Cast in_float(Cast c) {
  c.limits = c.float_limits;
  return c;
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
inline double gap(const Bodies& c, const Vector& n) {  // g(n): clearance along the unit vector n
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
  if (c.shape_b == "convex") {
    double furthest = -HUGE_VAL;
    for (const Vector& v : c.vertices_b) furthest = std::max(furthest, dot(v, b));
    return dot(d, n) - half_a - furthest;
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

inline std::string verdict(const Cast& c, const CastAnswer& answer) {
  const auto& [status, fraction, normal] = answer;
  const auto& [touch, tolerance, min_fraction, max_fraction] = c.limits;
  if (status == "never") return touch == "required" ? "missed" : "agree";
  if (status != "touch" && status != "from-start") return status;
  const double t = status == "touch" ? fraction : 0;
  if (!std::isfinite(t) || !is_finite(normal)) return "not-finite";
  if (t < min_fraction || t > max_fraction) {
    return c.outcome == "never" ? "made-up" : t < min_fraction ? "early" : "late";
  }
  if (length(normal) == 0) return "agree";  // a routine that has no normals
  if (!(std::abs(length(normal) - 1) <= 1e-6)) return "wrong-normal";
  Bodies there = static_cast<const Bodies&>(c);
  there.position_a += t * c.sweep;
  double distance = -std::max(c.start_depth, tolerance);  // it is no less, nor than along a normal
  for (const Vector& n : c.normals) distance = std::max(distance, gap(there, n));
  const double regret = distance - gap(there, normal / length(normal));
  return regret > tolerance ? "wrong-normal" : "agree";
}
inline std::string right(const Cast& c) {
  if (c.limits.touch == "forbidden") return "touch forbidden";
  std::ostringstream text;
  text.precision(17);
  text << "touch " << c.limits.touch << ", fraction " << c.limits.min_fraction << " to "
       << c.limits.max_fraction << ", normal";
  for (const Vector& n : c.normals) text << ' ' << n[0] << ' ' << n[1] << ' ' << n[2];
  return text.str();
}

}  // namespace touchstone_suite
