#include "shape.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>
#include <string>

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

Cylinder::Cylinder(double radius, double half_length)
    : radius_(checked_size("radius", radius)),
      half_length_(checked_size("half_length", half_length)) {}

Box::Box(const Vec3& half_extents) : half_extents_(half_extents) {
  constexpr const char* fields[] = {"half_extents[0]", "half_extents[1]", "half_extents[2]"};
  for (int i = 0; i < 3; ++i) checked_size(fields[i], half_extents[i]);
}

const char* shape_name(const Shape& shape) {
  constexpr const char* names[] = {"cylinder", "plane", "sphere", "capsule", "box"};
  return names[shape.index()];
}

double smallest_half_extent(const Shape& shape) {
  return std::visit(
      Overloaded{[](const Cylinder& s) { return std::min(s.radius(), s.half_length()); },
                 [](const Plane&) { return std::numeric_limits<double>::infinity(); },
                 [](const Sphere& s) { return s.radius(); },
                 [](const Capsule& s) { return s.radius(); },
                 [](const Box& s) { return s.half_extents().minCoeff(); }},
      shape);
}

double largest_half_extent(const Shape& shape) {
  return std::visit(Overloaded{[](const Plane&) { return 0.0; },
                               [](const auto& s) { return largest_half_extent(s); }},
                    shape);
}

}  // namespace touchstone
