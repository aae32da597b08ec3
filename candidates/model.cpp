#include "candidates/model.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>

#include "reference/pose.hpp"

namespace touchstone {
namespace {

struct Interval {
  double low, high;
};

Interval project(const std::vector<Vec3>& vertices, const Vec3& n) {
  Interval i{std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity()};
  for (const Vec3& v : vertices) {
    const double x = v.dot(n);
    i.low = std::min(i.low, x);
    i.high = std::max(i.high, x);
  }
  return i;
}

/// Closest points of the segments p + s d and q + t e with s, t in [0, 1] (Ericson, 5.1.9).
std::pair<Vec3, Vec3> closest_of_segments(const Vec3& p, const Vec3& d, const Vec3& q,
                                          const Vec3& e) {
  const Vec3 r = p - q;
  const double a = d.dot(d), b = d.dot(e), c = d.dot(r), ee = e.dot(e), f = e.dot(r);
  double s = 0, t = 0;
  if (a <= 0) {
    t = ee > 0 ? std::clamp(f / ee, 0.0, 1.0) : 0;
  } else if (ee <= 0) {
    s = std::clamp(-c / a, 0.0, 1.0);
  } else {
    // |d × e|² rather than a·ee − b², which cancels for nearly parallel segments.
    const double determinant = d.cross(e).squaredNorm();
    s = determinant > 0 ? std::clamp((b * f - c * ee) / determinant, 0.0, 1.0) : 0;
    t = (b * s + f) / ee;
    if (t < 0 || t > 1) {
      t = std::clamp(t, 0.0, 1.0);
      s = std::clamp((b * t - c) / a, 0.0, 1.0);
    }
  }
  return {p + s * d, q + t * e};
}

/// The point of a convex polygon that is closest to p; its corners go counterclockwise about the
/// normal.
Vec3 closest_in_polygon(const std::vector<Vec3>& vertices, const std::vector<int>& corners,
                        const Vec3& normal, const Vec3& p) {
  Vec3 best = p - (p - vertices[corners[0]]).dot(normal) * normal;
  double min_squared = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const Vec3& u = vertices[corners[i]];
    const Vec3 along = vertices[corners[(i + 1) % corners.size()]] - u, from = p - u;
    if (along.cross(from).dot(normal) >= 0) continue;  // p is on the inner side
    const Vec3 at = u + std::clamp(from.dot(along) / along.squaredNorm(), 0.0, 1.0) * along;
    if ((p - at).squaredNorm() < min_squared) {
      min_squared = (p - at).squaredNorm();
      best = at;
    }
  }
  return best;
}

/// Of vertices that are a polygon and then another one, `sides` further on, each counterclockwise
/// seen from above.
std::vector<std::vector<int>> faces_of_prism(int sides) {
  std::vector<std::vector<int>> faces(2);
  for (int i = 0; i < sides; ++i) {
    const int next = (i + 1) % sides;
    faces[0].push_back(sides - 1 - i);
    faces[1].push_back(sides + i);
    faces.push_back({i, next, next + sides, i + sides});
  }
  return faces;
}

}  // namespace

void RoundedPolytope::add_faces(const std::vector<std::vector<int>>& faces) {
  for (const std::vector<int>& corners : faces) {
    const Vec3& first = local_vertices_[corners[0]];
    Vec3 area = Vec3::Zero();
    for (std::size_t i = 2; i < corners.size(); ++i) {
      area += (local_vertices_[corners[i - 1]] - first).cross(local_vertices_[corners[i]] - first);
    }
    faces_.push_back({corners, area.stableNormalized()});
  }
}

RoundedPolytope RoundedPolytope::sphere(const Vec3& centre, double radius) {
  RoundedPolytope body;
  body.radius_ = radius;
  body.local_vertices_ = {centre};
  body.place(Eigen::Matrix3d::Identity(), Vec3::Zero());
  return body;
}

RoundedPolytope RoundedPolytope::capsule(double radius, double half_length) {
  if (half_length == 0) return sphere(Vec3::Zero(), radius);
  RoundedPolytope body;
  body.radius_ = radius;
  body.local_vertices_ = {Vec3(0, 0, -half_length), Vec3(0, 0, half_length)};
  body.local_edge_directions_ = {Vec3::UnitZ()};
  body.edges_ = {{0, 1}};
  body.place(Eigen::Matrix3d::Identity(), Vec3::Zero());
  return body;
}

RoundedPolytope RoundedPolytope::box(const Vec3& h) {
  RoundedPolytope body;
  // As in a prism: the lower face counterclockwise, then the upper one.
  for (const double z : {-h.z(), h.z()}) {
    for (const auto& [x, y] : {std::pair(-1, -1), {1, -1}, {1, 1}, {-1, 1}}) {
      body.local_vertices_.emplace_back(x * h.x(), y * h.y(), z);
    }
  }
  body.local_normals_ = {Vec3::UnitX(), Vec3::UnitY(), Vec3::UnitZ()};
  body.local_edge_directions_ = body.local_normals_;
  for (int i = 0; i < 4; ++i) {
    body.edges_.insert(body.edges_.end(), {{i, (i + 1) % 4}, {i + 4, (i + 1) % 4 + 4}, {i, i + 4}});
  }
  body.add_faces(faces_of_prism(4));
  body.place(Eigen::Matrix3d::Identity(), Vec3::Zero());
  return body;
}

RoundedPolytope RoundedPolytope::prism(int sides, double radius, double half_length) {
  RoundedPolytope body;
  const auto corner = [&](double i) {
    const double angle = 2 * std::numbers::pi * i / sides;
    return Vec3(std::cos(angle), std::sin(angle), 0);
  };
  for (const double z : {-half_length, half_length}) {
    for (int i = 0; i < sides; ++i) {
      body.local_vertices_.emplace_back(radius * corner(i) + Vec3(0, 0, z));
    }
  }
  body.local_normals_ = {Vec3::UnitZ()};
  body.local_edge_directions_ = {Vec3::UnitZ()};
  // If the number is even, opposite sides are parallel.
  for (int i = 0; i < (sides % 2 == 0 ? sides / 2 : sides); ++i) {
    const Vec3 normal = corner(i + 0.5);
    body.local_normals_.push_back(normal);
    body.local_edge_directions_.emplace_back(-normal.y(), normal.x(), 0);
  }
  for (int i = 0; i < sides; ++i) {
    const int next = (i + 1) % sides;
    body.edges_.insert(body.edges_.end(), {{i, next}, {i + sides, next + sides}, {i, i + sides}});
  }
  body.add_faces(faces_of_prism(sides));
  body.place(Eigen::Matrix3d::Identity(), Vec3::Zero());
  return body;
}

RoundedPolytope RoundedPolytope::hull(const ts_shape& convex) {
  RoundedPolytope body;
  for (int i = 0; i < convex.vertex_count; ++i) {
    body.local_vertices_.emplace_back(
        Eigen::Map<const Vec3>(convex.vertices + std::ptrdiff_t{3} * i));
  }
  body.add_faces(faces_of(convex));
  for (const Face& face : body.faces_) {
    body.local_normals_.push_back(face.normal);
    for (std::size_t i = 0; i < face.corners.size(); ++i) {
      const int from = face.corners[i], to = face.corners[(i + 1) % face.corners.size()];
      if (from > to) continue;  // the other face's turn
      body.edges_.emplace_back(from, to);
      body.local_edge_directions_.push_back(
          (body.local_vertices_[to] - body.local_vertices_[from]).stableNormalized());
    }
  }
  if (body.faces_.size() == 2) {
    // A polygon is a prism of no height: its sides part it from what lies in its plane.
    const Vec3 normal = body.faces_[0].normal;
    for (const Vec3& edge : body.local_edge_directions_) {
      body.local_normals_.push_back(edge.cross(normal));
    }
    body.local_edge_directions_.push_back(normal);
  }
  body.place(Eigen::Matrix3d::Identity(), Vec3::Zero());
  return body;
}

void RoundedPolytope::place(const Eigen::Matrix3d& rotation, const Vec3& position) {
  rotation_ = rotation;
  position_ = position;
  const auto turn = [&](const std::vector<Vec3>& from, std::vector<Vec3>& to, const Vec3& shift) {
    to.resize(from.size());
    for (std::size_t i = 0; i < from.size(); ++i) to[i] = rotation * from[i] + shift;
  };
  turn(local_vertices_, vertices_, position);
  turn(local_normals_, normals_, Vec3::Zero());
  turn(local_edge_directions_, edge_directions_, Vec3::Zero());
}

const Vec3& RoundedPolytope::support(const Vec3& n) const {
  return *std::max_element(vertices_.begin(), vertices_.end(),
                           [&](const Vec3& x, const Vec3& y) { return x.dot(n) < y.dot(n); });
}

Vec3 RoundedPolytope::closest_to(const Vec3& p) const {
  const Vec3 local = rotation_.transpose() * (p - position_);
  Vec3 closest = local;
  double min_squared = std::numeric_limits<double>::infinity();
  const bool is_flat = faces_.size() == 2;
  for (const Face& face : faces_) {
    const bool is_in_front = (local - local_vertices_[face.corners[0]]).dot(face.normal) > 0;
    if (!is_in_front && !is_flat) continue;
    const Vec3 at = closest_in_polygon(local_vertices_, face.corners, face.normal, local);
    if ((local - at).squaredNorm() < min_squared) {
      min_squared = (local - at).squaredNorm();
      closest = at;
    }
  }
  return rotation_ * closest + position_;
}

namespace {

/// The largest gap over the candidate separating axes; −infinity if there are none (two points, or
/// parallel segments).
double largest_gap(const RoundedPolytope& a, const RoundedPolytope& b, Separation& best) {
  best.distance = -std::numeric_limits<double>::infinity();
  const auto consider = [&](const Vec3& n) {
    const Interval in_a = project(a.vertices(), n), in_b = project(b.vertices(), n);
    if (in_a.low - in_b.high > best.distance) {
      best.distance = in_a.low - in_b.high;
      best.normal = n;
    }
    if (in_b.low - in_a.high > best.distance) {
      best.distance = in_b.low - in_a.high;
      best.normal = -n;
    }
  };
  for (const Vec3& n : a.normals()) consider(n);
  for (const Vec3& n : b.normals()) consider(n);
  for (const Vec3& u : a.edge_directions()) {
    for (const Vec3& v : b.edge_directions()) {
      const Vec3 n = u.cross(v);
      const double length = n.norm();
      // Parallel edges span no face of the Minkowski difference.
      if (length > 1e-12) consider(n / length);
    }
  }
  return best.distance;
}

/// The part of a core that is furthest along a normal: a corner, an edge or a face. By default all.
struct Facing {
  Vec3 normal = Vec3::Zero();
  double least = 0;

  bool has(const Vec3& corner) const { return corner.dot(normal) >= least; }
};

Facing facing(const RoundedPolytope& body, const Vec3& n) {
  // Corners of a face are as far along its normal but for rounding, of coordinates of this size.
  // One more does no harm: no pair is closer for it.
  const Vec3& furthest = body.support(n);
  return {n, furthest.dot(n) - 1e-12 * furthest.cwiseAbs().maxCoeff()};
}

/// The closest pair among edges of these parts of both, and among their corners and the other's
/// solid core, with B moved by `shift`.
void closest_apart(const RoundedPolytope& a, const Facing& of_a, const RoundedPolytope& b,
                   const Facing& of_b, const Vec3& shift, Separation& best) {
  double min_squared = std::numeric_limits<double>::infinity();
  const auto consider = [&](const Vec3& on_a, const Vec3& on_b) {
    const double squared = (on_a - on_b).squaredNorm();
    if (squared >= min_squared) return;
    min_squared = squared;
    best.on_a = on_a;
    best.on_b = on_b - shift;
  };
  const auto segments = [](const RoundedPolytope& body, const Facing& part) {
    std::vector<std::pair<Vec3, Vec3>> result;
    for (const auto& [i, j] : body.edges()) {
      const Vec3 &from = body.vertices()[i], &to = body.vertices()[j];
      if (part.has(from) && part.has(to)) result.emplace_back(from, to - from);
    }
    if (body.edges().empty()) result.emplace_back(body.vertices()[0], Vec3::Zero());
    return result;
  };
  const auto segments_of_b = segments(b, of_b);
  for (const auto& [p, d] : segments(a, of_a)) {
    for (const auto& [q, e] : segments_of_b) {
      const auto [on_a, on_b] = closest_of_segments(p, d, q + shift, e);
      consider(on_a, on_b);
    }
  }
  if (a.is_solid()) {
    for (const Vec3& v : b.vertices()) {
      if (of_b.has(v)) consider(a.closest_to(v + shift), v + shift);
    }
  }
  if (b.is_solid()) {
    for (const Vec3& v : a.vertices()) {
      if (of_a.has(v)) consider(v, b.closest_to(v - shift) + shift);
    }
  }
}

}  // namespace

Separation separation(const RoundedPolytope& a, const RoundedPolytope& b) {
  Separation s{};
  const bool solid = a.is_solid() || b.is_solid();
  const double gap = largest_gap(a, b, s);
  if (!solid || (gap > 0 && !(a.is_solid() && b.is_solid()))) {
    const Vec3 across = s.normal;
    closest_apart(a, {}, b, {}, Vec3::Zero(), s);
    const Vec3 line = s.on_a - s.on_b;
    s.distance = line.norm();
    if (s.distance > 0) {
      s.normal = line / s.distance;
    } else {
      // Touching cores: perpendicular to both segments, or any direction perpendicular to one.
      const Vec3 axis = !a.edge_directions().empty()   ? a.edge_directions()[0]
                        : !b.edge_directions().empty() ? b.edge_directions()[0]
                                                       : Vec3(Vec3::UnitX());
      s.normal = std::isfinite(gap) ? across : axis.unitOrthogonal();
    }
  } else {
    // Moved by the gap along the normal, B touches A: where it does, the points are on both.
    closest_apart(a, facing(a, -s.normal), b, facing(b, s.normal), s.distance * s.normal, s);
  }
  s.distance -= a.radius() + b.radius();
  s.on_a -= a.radius() * s.normal;
  s.on_b += b.radius() * s.normal;
  return s;
}

Separation separation(const RoundedPolytope& a, const Vec3& normal, double displacement) {
  Separation s{};
  s.normal = normal;
  s.on_a = a.support(-normal) - a.radius() * normal;
  s.distance = s.on_a.dot(normal) - displacement;
  s.on_b = s.on_a - s.distance * normal;
  return s;
}

Eigen::Matrix3d rotation_of(const ts_pose& pose) {
  const double* q = pose.orientation;
  return Eigen::Quaterniond(q[0], q[1], q[2], q[3]).toRotationMatrix();
}

Vec3 position_of(const ts_pose& pose) {
  return Vec3(pose.position[0], pose.position[1], pose.position[2]);
}

namespace {

std::vector<RoundedPolytope> parts(const ts_shape& shape, const CylinderModel& model) {
  const double* s = shape.size;
  switch (shape.kind) {
    case TS_CYLINDER:
      return model(s[0], s[1]);
    case TS_SPHERE:
      return {RoundedPolytope::sphere(Vec3::Zero(), s[0])};
    case TS_CAPSULE:
      return {RoundedPolytope::capsule(s[0], s[1])};
    case TS_BOX:
      return {RoundedPolytope::box(Vec3(s[0], s[1], s[2]))};
    case TS_CONVEX:
      return {RoundedPolytope::hull(shape)};
    case TS_PLANE:
      return {};
  }
  return {};
}

}  // namespace

ModelPair::ModelPair(const ts_shape& a, const ts_shape& b, const CylinderModel& model)
    : a_(parts(a, model)), b_(parts(b, model)), plane_(b), is_plane_(b.kind == TS_PLANE) {}

Separation ModelPair::separation(const ts_pose& a, const ts_pose& b, std::vector<Separation>* all) {
  const Eigen::Matrix3d rotation_b = rotation_of(b);
  for (RoundedPolytope& part : a_) part.place(rotation_of(a), position_of(a));
  for (RoundedPolytope& part : b_) part.place(rotation_b, position_of(b));
  const Vec3 normal = rotation_b * Vec3(plane_.size[0], plane_.size[1], plane_.size[2]);
  const double displacement = plane_.size[3] + normal.dot(position_of(b));

  Separation nearest{};
  for (std::size_t i = 0; i < a_.size(); ++i) {
    Separation of_part{};
    if (is_plane_) {
      of_part = touchstone::separation(a_[i], normal, displacement);
    } else {
      for (std::size_t j = 0; j < b_.size(); ++j) {
        const Separation s = touchstone::separation(a_[i], b_[j]);
        if (j == 0 || s.distance < of_part.distance) of_part = s;
      }
    }
    if (all) all->push_back(of_part);
    if (i == 0 || of_part.distance < nearest.distance) nearest = of_part;
  }
  return nearest;
}

std::vector<RoundedPolytope> inscribed_capsule(double radius, double half_length) {
  const double r = std::min(radius, half_length);
  return {RoundedPolytope::capsule(r, half_length - r)};
}

std::vector<RoundedPolytope> circumscribed_capsule(double radius, double half_length) {
  return {RoundedPolytope::capsule(radius, half_length)};
}

std::vector<RoundedPolytope> inscribed_spheres(int count, double radius, double half_length) {
  const double r = std::min(radius, half_length);
  std::vector<RoundedPolytope> result;
  for (int i = 0; i < count; ++i) {
    Vec3 centre = Vec3::Zero();
    if (half_length >= radius) {
      if (count > 1) centre.z() = (half_length - r) * (2.0 * i / (count - 1) - 1);
    } else if (count > 1) {
      const double angle = 2 * std::numbers::pi * i / count;
      centre = (radius - r) * Vec3(std::cos(angle), std::sin(angle), 0);
    }
    result.push_back(RoundedPolytope::sphere(centre, r));
  }
  return result;
}

std::vector<RoundedPolytope> inscribed_prism(int sides, double radius, double half_length) {
  return {RoundedPolytope::prism(sides, radius, half_length)};
}

namespace {

double place(double reach, int i, int count) {
  return count == 1 ? 0 : reach * (2.0 * i / (count - 1) - 1);
}

BoxParts parts_in_box(const Vec3& box, int count, bool as_capsules) {
  std::array<int, 3> axis = {0, 1, 2};  // axes of the smallest, middle and largest half extent
  std::sort(axis.begin(), axis.end(), [&](int i, int j) { return box[i] < box[j]; });
  const double radius = box[axis[0]];
  const double middle = box[axis[1]] - radius, longest = box[axis[2]] - radius;
  BoxParts parts{
      {}, radius, as_capsules ? longest : 0, turn_between(Vec3::UnitZ(), Vec3::Unit(axis[2]))};
  const int in_row = as_capsules ? 1 : count;
  int rows = count;
  if (!as_capsules) {
    rows = middle > 0 && longest > 0
               ? 1 + static_cast<int>(std::ceil(middle / longest * (count - 1)))
               : 1;
  } else if (middle == 0) {
    rows = 1;
  }
  for (int row = 0; row < rows; ++row) {
    for (int i = 0; i < in_row; ++i) {
      parts.centres.emplace_back(place(middle, row, rows) * Vec3::Unit(axis[1]) +
                                 place(longest, i, in_row) * Vec3::Unit(axis[2]));
    }
  }
  return parts;
}

}  // namespace

BoxParts spheres_in_box(const Vec3& half_extents, int count) {
  return parts_in_box(half_extents, count, false);
}

BoxParts capsules_in_box(const Vec3& half_extents, int count) {
  return parts_in_box(half_extents, count, true);
}

}  // namespace touchstone
