#include "reports/reproducer/programs.hpp"

#include <array>
#include <fmt/format.h>

namespace touchstone {

// Made by the build from the files NAME.in of candidates/reproducers, and npm's package.json.
extern const std::string_view cpp_template, javascript_template, python_template;
extern const std::string_view bullet_template, ode_template, fcl_template, libccd_template,
    mujoco_template;
extern const std::string_view jolt_mjs_template, jolt_doctest_template, rapier_mjs_template,
    physx_mjs_template, havok_mjs_template, mujoco3_mjs_template, mujoco3_py_template;
extern const std::string_view package_json;

const Language cpp = {"c++", "//", cpp_template, NumberStyle::hexadecimal};
const Language javascript = {"javascript", "//", javascript_template, NumberStyle::decimal};
const Language python = {"python", "#", python_template, NumberStyle::decimal};

std::span<const Program> programs() {
  static const std::array all = {
      Program{"bullet", "bullet", "Bullet", cpp, bullet_template, "double,rounded"},
      Program{"bullet-margin-0", "bullet-margin-0", "Bullet", cpp, bullet_template, "double,sharp"},
      Program{"bullet-float", "bullet-float", "Bullet", cpp, bullet_template, "float,rounded"},
      Program{"bullet-float-margin-0", "bullet-float-margin-0", "Bullet", cpp, bullet_template,
              "float,sharp"},
      Program{"ode", "ode", "ODE", cpp, ode_template, ""},
      Program{"fcl", "fcl", "FCL", cpp, fcl_template, "collide"},
      Program{"fcl-indep", "fcl-indep", "FCL", cpp, fcl_template, "indep"},
      Program{"fcl-distance", "fcl-distance", "FCL", cpp, fcl_template, "distance", false},
      Program{"libccd", "libccd-gjk", "libccd", cpp, libccd_template, "gjk", false},
      Program{"libccd-mpr", "libccd-mpr", "libccd", cpp, libccd_template, "mpr", false},
      Program{"mujoco", "mujoco", "MuJoCo", cpp, mujoco_template, ""},
      Program{"jolt", "jolt", "Jolt", javascript, jolt_mjs_template, "query"},
      Program{"jolt", "jolt", "Jolt", cpp, jolt_doctest_template, "doctest"},
      Program{"jolt-margin-0", "jolt-margin-0", "Jolt", javascript, jolt_mjs_template, "query"},
      Program{"jolt-margin-0", "jolt-margin-0", "Jolt", cpp, jolt_doctest_template, "doctest"},
      Program{"jolt-margin", "jolt-margin", "Jolt", javascript, jolt_mjs_template, "query"},
      Program{"jolt-margin", "jolt-margin", "Jolt", cpp, jolt_doctest_template, "doctest"},
      Program{"jolt-world", "jolt-world", "Jolt", javascript, jolt_mjs_template, "world"},
      Program{"rapier", "rapier", "Rapier", javascript, rapier_mjs_template, "query"},
      Program{"rapier-world", "rapier-world", "Rapier", javascript, rapier_mjs_template, "world"},
      Program{"physx", "physx", "PhysX", javascript, physx_mjs_template, "query"},
      Program{"physx-world", "physx-world", "PhysX", javascript, physx_mjs_template, "world"},
      Program{"havok", "havok", "Havok", javascript, havok_mjs_template, "", false},
      Program{"mujoco3", "mujoco3", "MuJoCo", javascript, mujoco3_mjs_template, ""},
      Program{"mujoco3", "mujoco3", "MuJoCo", python, mujoco3_py_template, ""},
      Program{"mujoco3-single", "mujoco3-single", "MuJoCo", javascript, mujoco3_mjs_template,
              "single"},
      Program{"mujoco3-single", "mujoco3-single", "MuJoCo", python, mujoco3_py_template, "single"}};
  return all;
}

std::string_view family_of(std::string_view name) { return name.substr(0, name.find(':')); }

bool knows(const Program& program, Pair pair) {
  if (pair == Pair::plane) return program.plane;
  return pair != Pair::convex || program.source.find("convex]") != program.source.npos;
}

std::string package_version(std::string_view package) {
  const std::string member = fmt::format("\"{}\": \"", package);
  const std::string_view rest = package_json.substr(package_json.find(member) + member.size());
  return std::string(rest.substr(0, rest.find('"')));
}

}  // namespace touchstone
