#include "properties/arbitrary.hpp"

#include <fmt/core.h>
#include <ostream>

#include "properties/pose_class.hpp"
#include "properties/simplify.hpp"

namespace touchstone {
namespace {

std::string shown(const Vec3& v) { return fmt::format("({:a}, {:a}, {:a})", v.x(), v.y(), v.z()); }

std::string shown(const Pose& pose) {
  const auto& q = pose.orientation();
  return fmt::format("position {} orientation ({:a}, {:a}, {:a}, {:a})", shown(pose.position()),
                     q.w(), q.x(), q.y(), q.z());
}

struct ShownShape {
  std::string operator()(const Cylinder& s) const {
    return fmt::format("cylinder radius {:a} half_length {:a}", s.radius(), s.half_length());
  }
  std::string operator()(const Plane& s) const {
    return fmt::format("plane normal {} displacement {:a}", shown(s.normal()), s.displacement());
  }
  std::string operator()(const Sphere& s) const {
    return fmt::format("sphere radius {:a}", s.radius());
  }
  std::string operator()(const Capsule& s) const {
    return fmt::format("capsule radius {:a} half_length {:a}", s.radius(), s.half_length());
  }
  std::string operator()(const Box& s) const {
    return fmt::format("box half_extents {}", shown(s.half_extents()));
  }
  std::string operator()(const Convex& s) const {
    std::string text = "convex vertices";
    for (const Vec3& v : s.vertices()) text += ' ' + shown(v);
    return text;
  }
};

}  // namespace

rc::Gen<Configuration> configurations(Pair pair, std::string_view pose_class) {
  const PoseClass c(pair, pose_class);
  return rc::Gen<Configuration>([c](const rc::Random& random, int) {
    Draw draw(random);
    return rc::shrinkable::shrinkRecur(c.generate(draw), [](const Configuration& configuration) {
      return rc::seq::fromContainer(simpler(configuration));
    });
  });
}

void showValue(const Configuration& c, std::ostream& out) {
  out << "a: " << ShownShape{}(c.a) << ' ' << shown(c.pose_a)
      << "; b: " << std::visit(ShownShape{}, c.b) << ' ' << shown(c.pose_b);
}

}  // namespace touchstone
