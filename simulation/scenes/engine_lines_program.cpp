// Writes a program of C++ that contains the lines which `choose --engine` prints, of every shape
// for several cylinders, and compares what they make with what the engine's world was simulated
// with (engine_world.hpp): engine_lines_program bullet|ode|mujoco. For engine_lines_test.sh.
#include <algorithm>
#include <fmt/format.h>
#include <iostream>
#include <sstream>

#include "simulation/engines/engine_world.hpp"
#include "simulation/scenes/engine_choice.hpp"

using namespace touchstone;
using Kind = EngineShape::Kind;

namespace {

/// Long, as long as wide, flat, and with sizes that six digits do not hold.
const std::vector<Cylinder> cylinders = {Cylinder(0.05, 0.1), Cylinder(0.5, 0.5),
                                         Cylinder(0.25, 0.03), Cylinder(1.0 / 3, 12.345678901)};

const std::vector<EngineShape> shapes = {
    {Kind::cylinder},   {Kind::no_margin},  {Kind::multipoint}, {Kind::capsule},  {Kind::box},
    {Kind::spheres, 1}, {Kind::spheres, 2}, {Kind::spheres, 8}, {Kind::hull, 12}, {Kind::exact}};

bool offers(const std::string& engine, const EngineShape& shape) {
  if (shape.kind == Kind::no_margin) return engine == "bullet";
  if (shape.kind == Kind::multipoint || shape.kind == Kind::hull) return engine != "ode";
  return true;
}

struct Corners {
  Vec3 low, high;
};

/// The smallest box around a piece, in the body's frame.
Corners around(const Piece& piece) {
  if (!piece.corners.empty()) {
    Corners box{piece.corners[0], piece.corners[0]};
    for (const Vec3& corner : piece.corners) {
      box.low = box.low.cwiseMin(corner);
      box.high = box.high.cwiseMax(corner);
    }
    return box;
  }
  Vec3 half;
  if (const auto* c = std::get_if<Cylinder>(&piece.shape)) {
    half = {c->radius(), c->radius(), c->half_length()};
  } else if (const auto* capsule = std::get_if<Capsule>(&piece.shape)) {
    half = {capsule->radius(), capsule->radius(), capsule->half_length() + capsule->radius()};
  } else if (const auto* box = std::get_if<Box>(&piece.shape)) {
    half = box->half_extents();
  } else {
    half.setConstant(std::get<Sphere>(piece.shape).radius());
  }
  return {piece.centre - half, piece.centre + half};
}

std::string expected(const EngineShape& shape, const Cylinder& cylinder) {
  std::string list;
  for (const Piece& piece : pieces({.name = "", .shape = cylinder}, shape)) {
    const auto [low, high] = around(piece);
    list += fmt::format("{{{}, {}, {}, {}, {}, {}}}, ", low.x(), low.y(), low.z(), high.x(),
                        high.y(), high.z());
  }
  return "{" + list + "}";
}

/// Lines that begin with one of these beginnings, and the others.
std::pair<std::string, std::string> apart(const std::string& lines,
                                          const std::vector<std::string>& beginnings) {
  std::pair<std::string, std::string> result;
  std::istringstream stream(lines);
  for (std::string line; std::getline(stream, line);) {
    const bool is_first = std::ranges::any_of(
        beginnings, [&](const std::string& beginning) { return line.starts_with(beginning); });
    (is_first ? result.first : result.second) += line + '\n';
  }
  return result;
}

// What the boxes around the shapes are compared by. MuJoCo keeps meshes in single precision.
const char* const comparison = R"(
#include <cmath>
#include <cstdio>
#include <vector>
struct Corners { double at[6]; };
int failures = 0;
void compare(const char* name, const std::vector<Corners>& made, const std::vector<Corners>& expected,
             double tolerance = 1e-12) {
  bool is_same = made.size() == expected.size();
  for (unsigned i = 0; is_same && i < made.size(); ++i) {
    for (int k = 0; k < 6; ++k) {
      if (std::abs(made[i].at[k] - expected[i].at[k]) <= tolerance) continue;
      std::printf("%s, part %u: %.17g instead of %.17g\n", name, i, made[i].at[k], expected[i].at[k]);
      is_same = false;
    }
  }
  if (!is_same) ++failures, std::printf("FAILED: %s, %zu parts\n", name, made.size());
}
)";

const char* const in_bullet = R"(
#include <btBulletCollisionCommon.h>
Corners around(const btCollisionShape& shape, const btTransform& at) {
  btVector3 low, high;
  shape.getAabb(at, low, high);
  return {{low.x(), low.y(), low.z(), high.x(), high.y(), high.z()}};
}
std::vector<Corners> parts(const btCollisionShape& shape) {
  if (!shape.isCompound()) return {around(shape, btTransform::getIdentity())};
  const auto& compound = static_cast<const btCompoundShape&>(shape);
  std::vector<Corners> result;
  for (int i = 0; i < compound.getNumChildShapes(); ++i) {
    result.push_back(around(*compound.getChildShape(i), compound.getChildTransform(i)));
  }
  return result;
}
)";

const char* const in_ode = R"(
#include <ode/ode.h>
std::vector<Corners> parts(dBodyID body) {
  std::vector<Corners> result;
  for (dGeomID geom = dBodyGetFirstGeom(body); geom; geom = dBodyGetNextGeom(geom)) {
    dReal b[6];
    dGeomGetAABB(geom, b);
    result.insert(result.begin(), {{b[0], b[2], b[4], b[1], b[3], b[5]}});  // the last comes first
  }
  return result;
}
)";

const char* const in_mujoco = R"(
#include <algorithm>
#include <fstream>
#include <mujoco/mujoco.h>
Corners around(const mjModel& m, const mjData& d, int geom) {
  const mjtNum *p = d.geom_xpos + 3 * geom, *size = m.geom_size + 3 * geom;
  if (m.geom_type[geom] == mjGEOM_MESH) {
    Corners box = {{1e9, 1e9, 1e9, -1e9, -1e9, -1e9}};
    const int mesh = m.geom_dataid[geom];
    for (int v = 0; v < m.mesh_vertnum[mesh]; ++v) {
      const float* vertex = m.mesh_vert + 3 * (m.mesh_vertadr[mesh] + v);
      const mjtNum local[3] = {vertex[0], vertex[1], vertex[2]};
      mjtNum turned[3];
      mju_rotVecMat(turned, local, d.geom_xmat + 9 * geom);
      for (int k = 0; k < 3; ++k) {
        box.at[k] = std::min(box.at[k], turned[k] + p[k]);
        box.at[k + 3] = std::max(box.at[k + 3], turned[k] + p[k]);
      }
    }
    return box;
  }
  const int type = m.geom_type[geom];
  mjtNum half[3] = {size[0], size[0], size[0]};
  if (type == mjGEOM_BOX) half[1] = size[1], half[2] = size[2];
  if (type == mjGEOM_CYLINDER) half[2] = size[1];
  if (type == mjGEOM_CAPSULE) half[2] = size[0] + size[1];
  return {{p[0] - half[0], p[1] - half[1], p[2] - half[2], p[0] + half[0], p[1] + half[1], p[2] + half[2]}};
}
void compare_model(const char* name, const char* xml, const std::vector<std::vector<Corners>>& expected,
                   double tolerance) {
  std::ofstream("model.xml") << xml;
  char error[1000] = "";
  mjModel* m = mj_loadXML("model.xml", nullptr, error, sizeof error);
  if (!m) { ++failures, std::printf("FAILED: %s: %s\n", name, error); return; }
  mjData* d = mj_makeData(m);
  mj_kinematics(m, d);
  for (unsigned body = 0; body < expected.size(); ++body) {
    std::vector<Corners> made;
    for (int g = 0; g < m->ngeom; ++g) {
      if (m->geom_bodyid[g] == int(body) + 1) made.push_back(around(*m, *d, g));
    }
    compare(name, made, expected[body], tolerance);
  }
  mj_deleteData(d);
  mj_deleteModel(m);
}
)";

std::string cpp_program(const std::string& engine) {
  std::string includes, calls;
  for (const EngineShape& shape : shapes) {
    for (const Cylinder& cylinder : cylinders) {
      if (!offers(engine, shape)) continue;
      const auto [included, lines] = apart(engine_lines(engine, shape, cylinder), {"#include"});
      if (includes.find(included) == std::string::npos) includes += included;
      const std::string name =
          fmt::format("{} of {}", engine_shape_name(shape), shape_text(cylinder));
      const bool is_bullet = engine == "bullet";
      calls += "  {\n" +
               std::string(is_bullet ? "btDefaultCollisionConfiguration configuration;\n"
                                       "btCollisionDispatcher dispatcher(&configuration);\n"
                                     : "dBodyID body = dBodyCreate(world);\n") +
               lines +
               fmt::format("compare(\"{}\", parts({}), {});\n", name, is_bullet ? "*shape" : "body",
                           expected(shape, cylinder));
      if (shape.kind == Kind::no_margin) {  // which no box shows
        calls += "if (shape->getMargin() != 0) ++failures, std::puts(\"FAILED: a margin\");\n";
      }
      calls += "  }\n";
    }
  }
  return std::string(comparison) + (engine == "bullet" ? in_bullet : in_ode) + includes +
         "int main() {\n" +
         (engine == "ode" ? "dInitODE2(0);\ndWorldID world = dWorldCreate();\n"
                            "dSpaceID space = dSimpleSpaceCreate(nullptr);\n"
                          : "") +
         calls + "return failures != 0;\n}\n";
}

/// Each shape for all cylinders in one model, as where a scene has several sizes.
std::string mujoco_program() {
  std::string calls;
  for (const EngineShape& shape : shapes) {
    if (!offers("mujoco", shape)) continue;
    std::string top, bodies, all;
    for (const Cylinder& cylinder : cylinders) {
      const auto [outside, inside] =
          apart(engine_lines("mujoco", shape, cylinder), {"<option>", "<asset>"});
      top += outside;
      bodies += "<body>" + inside + "</body>\n";
      all += expected(shape, cylinder) + ", ";
    }
    constexpr double of_meshes = 1e-5, of_numbers = 1e-12;  // metres, at lengths of 12 m
    calls += fmt::format(
        "compare_model(\"{}\", R\"(<mujoco>{}<worldbody>{}</worldbody></mujoco>)\", {{{}}}, {});\n",
        engine_shape_name(shape), top, bodies, all,
        shape.kind == Kind::hull ? of_meshes : of_numbers);
  }
  return std::string(comparison) + in_mujoco + "int main() {\n" + calls +
         "return failures != 0;\n}\n";
}

}  // namespace

int main(int argc, char** argv) {
  const std::string engine = argc > 1 ? argv[1] : "";
  std::cout << (engine == "mujoco" ? mujoco_program() : cpp_program(engine));
}
