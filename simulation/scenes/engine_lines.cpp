// The shapes that stand for cylinders, in the words of each engine. Numbers have all digits that
// they need to be the same again.
#include <algorithm>
#include <fmt/format.h>

#include "candidates/model.hpp"
#include "simulation/scenes/engine_choice.hpp"

namespace touchstone {
namespace {

using Kind = EngineShape::Kind;

/// A capsule inside a cylinder that is no longer than wide is a sphere, which no engine has as a
/// capsule of length 0.
EngineShape without_flat_capsules(const EngineShape& shape, const Cylinder& c) {
  const bool is_flat = c.half_length() <= c.radius();
  return shape.kind == Kind::capsule && is_flat ? EngineShape{Kind::spheres, 1} : shape;
}

/// The centre of sphere `i` of several, in a row or on a ring, as C++.
struct Centres {
  std::string angle;  ///< line that computes the angle `a` on a ring; empty in a row
  std::string xyz;    ///< the arguments x, y, z
};

Centres centres(int count, const Cylinder& c, const char* full_turn) {
  const double r = c.radius(), h = c.half_length(), inner = std::min(r, h);
  if (h >= r) return {"", fmt::format("0, 0, {} * (2.0 * i / {} - 1)", h - inner, count - 1)};
  return {fmt::format("  const double a = {} * i / {};\n", full_turn, count),
          fmt::format("{0} * cos(a), {0} * sin(a), 0", r - inner)};
}

std::string bullet_lines(const EngineShape& shape, const Cylinder& c) {
  const double r = c.radius(), h = c.half_length(), inner = std::min(r, h);
  std::string cylinder =
      fmt::format("auto* shape = new btCylinderShapeZ(btVector3({0}, {0}, {1}));", r, h);
  switch (shape.kind) {
    case Kind::cylinder:
      return cylinder;
    case Kind::no_margin:
      return cylinder + "\nshape->setMargin(0);  // its size stays; its edges are sharp";
    case Kind::multipoint:
      return "configuration.setConvexConvexMultipointIterations(3, 3);  // "
             "btDefaultCollision…\n"
             "configuration.setPlaneConvexMultipointIterations(3, 3);\n" +
             cylinder;
    case Kind::capsule:
      return fmt::format("auto* shape = new btCapsuleShapeZ({}, {});", inner, 2 * (h - inner));
    case Kind::box:
      return fmt::format("auto* shape = new btBoxShape(btVector3({0}, {0}, {1}));", r, h);
    case Kind::spheres: {
      if (shape.count == 1) return fmt::format("auto* shape = new btSphereShape({});", inner);
      const Centres at = centres(shape.count, c, "SIMD_2_PI");
      return fmt::format(
          "auto* shape = new btCompoundShape;\n"
          "for (int i = 0; i < {}; ++i) {{\n{}"
          "  const btVector3 centre({});\n"
          "  shape->addChildShape(btTransform(btQuaternion::getIdentity(), centre),\n"
          "                       new btSphereShape({}));\n"
          "}}",
          shape.count, at.angle, at.xyz, inner);
    }
    case Kind::hull:
      return fmt::format(
          "auto* shape = new btConvexHullShape;\n"
          "for (int i = 0; i < {0}; ++i) {{\n"
          "  const double a = SIMD_2_PI * i / {0}, x = {1} * cos(a), y = {1} * sin(a);\n"
          "  shape->addPoint(btVector3(x, y, -{2}), false);\n"
          "  shape->addPoint(btVector3(x, y, {2}), false);\n"
          "}}\n"
          "shape->setMargin(0);  // 0.04 would be added outside the hull\n"
          "shape->recalcLocalAabb();",
          shape.count, r, h);
    case Kind::exact:
      return "#include <touchstone/engines/bullet.hpp>\n"
             "touchstone::bullet::install(dispatcher);  // before the world's bodies meet\n" +
             cylinder;
  }
  return "";
}

std::string ode_lines(const EngineShape& shape, const Cylinder& c) {
  const double r = c.radius(), h = c.half_length(), inner = std::min(r, h);
  const std::string on_body = "\ndGeomSetBody(geom, body);";
  std::string cylinder =
      fmt::format("dGeomID geom = dCreateCylinder(space, {}, {});", r, 2 * h) + on_body;
  switch (shape.kind) {
    case Kind::capsule:
      return fmt::format("dGeomID geom = dCreateCapsule(space, {}, {});", inner, 2 * (h - inner)) +
             on_body;
    case Kind::box:
      return fmt::format("dGeomID geom = dCreateBox(space, {0}, {0}, {1});", 2 * r, 2 * h) +
             on_body;
    case Kind::spheres: {
      if (shape.count == 1) {
        return fmt::format("dGeomID geom = dCreateSphere(space, {});", inner) + on_body;
      }
      const Centres at = centres(shape.count, c, "2 * M_PI");
      return fmt::format(
          "for (int i = 0; i < {}; ++i) {{\n"
          "  dGeomID geom = dCreateSphere(space, {});\n"
          "  dGeomSetBody(geom, body);\n{}"
          "  dGeomSetOffsetPosition(geom, {});\n"
          "}}",
          shape.count, inner, at.angle, at.xyz);
    }
    case Kind::exact:
      return "#include <touchstone/engines/ode.hpp>\n"
             "touchstone::ode::install();  // once, after dInitODE2\n" +
             cylinder;
    default:
      return cylinder;
  }
}

/// Spheres and hulls from the parts of which the simplified models consist.
std::string mujoco_lines(const EngineShape& shape, const Cylinder& c) {
  const double r = c.radius(), h = c.half_length(), inner = std::min(r, h);
  std::string cylinder = fmt::format("<geom type=\"cylinder\" size=\"{} {}\"/>", r, h);
  const auto placed = [](std::vector<RoundedPolytope> parts) {
    for (RoundedPolytope& part : parts) part.place(Eigen::Matrix3d::Identity(), Vec3::Zero());
    return parts;
  };
  switch (shape.kind) {
    case Kind::multipoint:
      return "<option><flag multiccd=\"enable\"/></option>\n" + cylinder;
    case Kind::capsule:
      return fmt::format("<geom type=\"capsule\" size=\"{} {}\"/>", inner, h - inner);
    case Kind::box:
      return fmt::format("<geom type=\"box\" size=\"{0} {0} {1}\"/>", r, h);
    case Kind::spheres: {
      std::string lines;
      for (const RoundedPolytope& part : placed(inscribed_spheres(shape.count, r, h))) {
        const Vec3& p = part.vertices().front();
        lines += fmt::format("{}<geom type=\"sphere\" size=\"{}\" pos=\"{} {} {}\"/>",
                             lines.empty() ? "" : "\n", part.radius(), p.x(), p.y(), p.z());
      }
      return lines;
    }
    case Kind::hull: {
      const RoundedPolytope prism = placed(inscribed_prism(shape.count, r, h)).front();
      std::string vertices;
      for (const Vec3& v : prism.vertices()) {
        vertices += fmt::format("{}{} {} {}", vertices.empty() ? "" : "  ", v.x(), v.y(), v.z());
      }
      // Another name for each size, for a model may have several.
      const std::string name = fmt::format("prism-{}-{}-{}", shape.count, r, h);
      return fmt::format(
          "<asset><mesh name=\"{0}\" vertex=\"{1}\"/></asset>\n"
          "<geom type=\"mesh\" mesh=\"{0}\"/>",
          name, vertices);
    }
    case Kind::exact:
      return "<!-- in C++: #include <touchstone/engines/mujoco.hpp>\n"
             "     touchstone::mujoco::install();  // once, before the first step -->\n" +
             cylinder;
    default:
      return cylinder;
  }
}

}  // namespace

std::string engine_lines(const std::string& engine, const EngineShape& wanted,
                         const Cylinder& cylinder) {
  const EngineShape shape = without_flat_capsules(wanted, cylinder);
  if (engine.starts_with("bullet")) return bullet_lines(shape, cylinder);
  return engine == "ode" ? ode_lines(shape, cylinder) : mujoco_lines(shape, cylinder);
}

}  // namespace touchstone
