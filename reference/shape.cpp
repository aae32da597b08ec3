#include "shape.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <sstream>
#include <string>
#include <utility>

#include <Eigen/Geometry>

#include "convex_tables.hpp"
#include "invalid_input.hpp"

namespace touchstone {
namespace {

std::string text_of(double value) {
  std::ostringstream out;
  out << value;
  return out.str();
}

double checked_size(const char* field, double value) {
  if (!(std::isfinite(value) && value > 0)) {
    throw InvalidInput(field, text_of(value), "must be positive and finite");
  }
  return value;
}

/// A hull grows by it, by any length.
constexpr double max_rounding = std::numeric_limits<double>::max();

/// Not minus zero, whose sign JSON would show.
double checked_rounding(double value, double most) {
  if (!(value >= 0 && value <= most)) {
    throw InvalidInput("rounding", text_of(value),
                       most < max_rounding
                           ? "must be 0 to the smallest half extent, " + text_of(most)
                           : "must not be negative, and finite");
  }
  return std::abs(value);
}

double checked_finite(const std::string& field, double value) {
  if (!std::isfinite(value)) throw InvalidInput(field, text_of(value), "must be finite");
  return value;
}

template <class... Functions>
struct Overloaded : Functions... {
  using Functions::operator()...;
};
template <class... Functions>
Overloaded(Functions...) -> Overloaded<Functions...>;

}  // namespace

Plane::Plane(const Vec3& normal, double displacement)
    : normal_(normal), displacement_(checked_finite("displacement", displacement)) {
  for (int i = 0; i < 3; ++i) checked_finite("normal[" + std::to_string(i) + "]", normal[i]);
  if (normal.isZero(0)) throw InvalidInput("normal", "[0, 0, 0]", "must not be zero");
  // Times a power of two, so that no square overflows or vanishes.
  int exponent;
  std::frexp(normal.cwiseAbs().maxCoeff(), &exponent);
  const Vec3 direction =
      normal.unaryExpr([exponent](double x) { return std::ldexp(x, -exponent); });
  constexpr double most = std::numeric_limits<double>::max();
  unit_normal_ = direction.normalized();
  unit_displacement_ =
      std::clamp(std::ldexp(displacement, -exponent) / direction.norm(), -most, most);
}

Sphere::Sphere(double radius) : radius_(checked_size("radius", radius)) {}

Capsule::Capsule(double radius, double half_length)
    : radius_(checked_size("radius", radius)),
      half_length_(checked_size("half_length", half_length)) {}

namespace {

double positive_core_length(double length, double rounding, double lengths) {
  constexpr double vanishing = 1e-15;
  return rounding == 0 ? length : std::max(length - rounding, vanishing * lengths);
}

}  // namespace

Cylinder::Cylinder(double radius, double half_length, double rounding)
    : radius_(checked_size("radius", radius)),
      half_length_(checked_size("half_length", half_length)),
      rounding_(checked_rounding(rounding, std::min(radius, half_length))),
      positive_core_radius_(positive_core_length(radius, rounding, radius + half_length)),
      positive_core_half_length_(
          positive_core_length(half_length, rounding, radius + half_length)) {}

Box::Box(const Vec3& half_extents, double rounding)
    : half_extents_(half_extents), rounding_(rounding) {
  constexpr const char* fields[] = {"half_extents[0]", "half_extents[1]", "half_extents[2]"};
  for (int i = 0; i < 3; ++i) checked_size(fields[i], half_extents[i]);
  rounding_ = checked_rounding(rounding, half_extents.minCoeff());
  for (int i = 0; i < 3; ++i) {
    positive_core_half_extents_[i] =
        positive_core_length(half_extents[i], rounding, half_extents.sum());
  }
}

namespace {

/// Half of their sum, which may overflow.
double middle_of(double low, double high) { return low / 2 + high / 2; }

[[noreturn]] void refuse_faces(const std::string& field, const std::string& value,
                               const char* remedy) {
  throw InvalidInput(field, value, remedy);
}

/// Every pair of neighbours in a face, to the faces on its two sides.
std::vector<Convex::Edge> edges_of(const std::vector<Convex::Face>& faces) {
  std::map<std::array<int, 2>, int> left;  // from, to: the face that runs that way
  for (std::size_t f = 0; f < faces.size(); ++f) {
    const auto& v = faces[f].vertices;
    for (std::size_t i = 0; i < v.size(); ++i) {
      const std::array<int, 2> way{v[i], v[(i + 1) % v.size()]};
      if (!left.emplace(way, static_cast<int>(f)).second) {
        refuse_faces("faces[" + std::to_string(f) + "]",
                     std::to_string(way[0]) + " to " + std::to_string(way[1]),
                     "must run along an edge once, counterclockwise seen from outside");
      }
    }
  }
  std::vector<Convex::Edge> edges;
  for (const auto& [way, face] : left) {
    const auto back = left.find({way[1], way[0]});
    if (back == left.end()) {
      refuse_faces("faces[" + std::to_string(face) + "]",
                   std::to_string(way[0]) + " to " + std::to_string(way[1]),
                   "must meet another face along every edge");
    }
    if (way[0] < way[1]) edges.push_back({way, {face, back->second}});
  }
  return edges;
}

}  // namespace

Convex::Convex(std::vector<Vec3> vertices, std::vector<std::vector<int>> faces, double rounding)
    : rounding_(checked_rounding(rounding, max_rounding)) {
  const auto at = [](const char* name, std::size_t i) {
    return std::string(name) + '[' + std::to_string(i) + ']';
  };
  const std::size_t count = vertices.size();
  if (count < 3 || count > max_vertices) {
    throw InvalidInput("vertices", std::to_string(count), "must be 3 to 4096 points");
  }
  for (std::size_t i = 0; i < count; ++i) {
    for (int k = 0; k < 3; ++k) checked_finite(at("vertices", i) + at("", k), vertices[i][k]);
  }
  auto data = std::make_shared<Data>();
  Vec3 low = vertices.front(), high = low;
  for (const Vec3& v : vertices) low = low.cwiseMin(v), high = high.cwiseMax(v);
  data->half_extents = high / 2 - low / 2;
  for (int k = 0; k < 3; ++k) data->middle[k] = middle_of(low[k], high[k]);
  const double largest = data->half_extents.maxCoeff();

  // Numbers of about one about the middle, so that no product overflows or vanishes.
  const int exponent = largest > 0 ? -std::ilogb(largest) : 0;
  std::vector<Vec3> unit(count);
  for (std::size_t i = 0; i < count; ++i) {
    unit[i] = (vertices[i] - data->middle).unaryExpr([exponent](double x) {
      return std::ldexp(x, exponent);
    });
  }
  std::vector<bool> used(count);
  std::vector<Vec3> areas;  // of the faces, twice
  for (std::size_t f = 0; f < faces.size(); ++f) {
    Face face{std::move(faces[f]), Vec3::Zero()};
    if (face.vertices.size() < 3) {
      refuse_faces(at("faces", f), std::to_string(face.vertices.size()),
                   "must have three vertices or more");
    }
    for (const int v : face.vertices) {
      if (v < 0 || static_cast<std::size_t>(v) >= count) {
        refuse_faces(at("faces", f), std::to_string(v), "must be indices of vertices");
      }
      used[v] = true;
    }
    Vec3 area = Vec3::Zero();
    const Vec3& first = unit[face.vertices.front()];
    for (std::size_t i = 2; i < face.vertices.size(); ++i) {
      area += (unit[face.vertices[i - 1]] - first).cross(unit[face.vertices[i]] - first);
    }
    face.normal = area.stableNormalized();
    areas.push_back(area);
    data->face_list.push_back(static_cast<int>(face.vertices.size()));
    data->face_list.insert(data->face_list.end(), face.vertices.begin(), face.vertices.end());
    data->faces.push_back(std::move(face));
  }
  data->edges = edges_of(data->faces);
  const auto unused = std::find(used.begin(), used.end(), false);
  if (unused != used.end()) {
    throw InvalidInput(at("vertices", static_cast<std::size_t>(unused - used.begin())),
                       "in no face", "must be a corner");
  }
  if (count + data->faces.size() != data->edges.size() + 2) {
    refuse_faces("faces", std::to_string(data->faces.size()), "must be one closed surface");
  }
  // A volume, of which rounding is some ulp of the size's cube, however thin a face is; places are
  // rounded as parts of how far they are from the origin.
  constexpr double part = 1e-13;
  const double tolerance = part * (1 + data->middle.cwiseAbs().maxCoeff() / largest);
  for (std::size_t f = 0; f < areas.size(); ++f) {
    const Vec3& on_face = unit[data->faces[f].vertices.front()];
    for (std::size_t i = 0; i < count; ++i) {
      if ((unit[i] - on_face).dot(areas[f]) > tolerance) {
        refuse_faces(at("faces", f), at("vertices", i) + " is outside",
                     "must have all vertices on its inner side");
      }
    }
  }
  data->smallest_half_extent = data->faces.size() == 2
                                   ? std::ldexp(std::sqrt(areas.front().norm() / 2) / 2, -exponent)
                                   : data->half_extents.minCoeff();
  data->tables = std::make_shared<ConvexTables>(vertices, data->faces, data->edges);
  data->vertices = std::move(vertices);
  data_ = std::move(data);
}

Convex Convex::rounded(double rounding) const {
  return {data_, checked_rounding(rounding, max_rounding)};
}

Convex Convex::scaled(int exponent) const {
  const auto scale = [exponent](double x) { return std::ldexp(x, exponent); };
  auto data = std::make_shared<Data>(*data_);
  for (Vec3& v : data->vertices) v = v.unaryExpr(scale).eval();
  data->half_extents = data->half_extents.unaryExpr(scale).eval();
  data->middle = data->middle.unaryExpr(scale).eval();
  data->smallest_half_extent = scale(data->smallest_half_extent);
  data->tables = std::make_shared<ConvexTables>(data->tables->scaled(exponent));
  return {std::move(data), scale(rounding_)};
}

const char* shape_name(const Shape& shape) {
  constexpr const char* names[] = {"cylinder", "plane", "sphere", "capsule", "box", "convex"};
  return names[shape.index()];
}

double rounding_of(const Shape& shape) {
  return std::visit(
      [](const auto& s) {
        if constexpr (requires { s.rounding(); }) return s.rounding();
        return 0.0;
      },
      shape);
}

Shape with_rounding(const Shape& shape, double rounding) {
  return std::visit(
      Overloaded{[=](const Cylinder& s) -> Shape {
                   return Cylinder(s.radius(), s.half_length(), rounding);
                 },
                 [=](const Box& s) -> Shape { return Box(s.half_extents(), rounding); },
                 [=](const Convex& s) -> Shape { return s.rounded(rounding); },
                 [](const auto& s) -> Shape { return s; }},
      shape);
}

double smallest_half_extent(const Shape& shape) {
  return std::visit(
      Overloaded{[](const Cylinder& s) { return std::min(s.radius(), s.half_length()); },
                 [](const Plane&) { return std::numeric_limits<double>::infinity(); },
                 [](const Sphere& s) { return s.radius(); },
                 [](const Capsule& s) { return s.radius(); },
                 [](const Box& s) { return s.half_extents().minCoeff(); },
                 [](const Convex& s) { return s.smallest_half_extent() + s.rounding(); }},
      shape);
}

double largest_half_extent(const Shape& shape) {
  return std::visit(Overloaded{[](const Plane&) { return 0.0; },
                               [](const auto& s) { return largest_half_extent(s); }},
                    shape);
}

}  // namespace touchstone
