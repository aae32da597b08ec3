#include "reports/reproducer/programs.hpp"

#include <algorithm>
#include <array>
#include <fmt/format.h>
#include <functional>

#include "candidates/npm_engines.hpp"
#include "properties/files/given_text.hpp"
#include "reference/invalid_input.hpp"

namespace touchstone {

// Made by the build from the files NAME.in of candidates/reproducers, and npm's package.json.
extern const std::string_view cpp_template, javascript_template, python_template;
extern const std::string_view bullet_template, ode_template, fcl_template, coal_template,
    libccd_template, mujoco_template;
extern const std::string_view jolt_mjs_template, jolt_doctest_template, rapier_mjs_template,
    physx_mjs_template, havok_mjs_template, mujoco3_mjs_template, mujoco3_py_template;
extern const std::string_view package_json;

const Language cpp = {"c++", "//", cpp_template, NumberStyle::hexadecimal};
const Language javascript = {"javascript", "//", javascript_template, NumberStyle::decimal};
const Language python = {"python", "#", python_template, NumberStyle::decimal};

std::span<const Program> programs() {
  static const std::array all = {
      Program{"bullet", "bullet", "Bullet", cpp, bullet_template, "double,rounded,casts"},
      Program{"bullet-margin-0", "bullet-margin-0", "Bullet", cpp, bullet_template,
              "double,sharp,casts"},
      Program{"bullet-float", "bullet-float", "Bullet", cpp, bullet_template,
              "float,rounded,casts"},
      Program{"bullet-float-margin-0", "bullet-float-margin-0", "Bullet", cpp, bullet_template,
              "float,sharp,casts"},
      Program{"bullet-floor", "bullet-floor", "Bullet", cpp, bullet_template,
              "double,rounded,floor"},
      Program{"ode", "ode", "ODE", cpp, ode_template, ""},
      Program{"ode-floor", "ode-floor", "ODE", cpp, ode_template, "floor"},
      Program{"fcl", "fcl", "FCL", cpp, fcl_template, "collide,sampled,casts"},
      Program{"fcl-indep", "fcl-indep", "FCL", cpp, fcl_template, "indep"},
      Program{"fcl-distance", "fcl-distance", "FCL", cpp, fcl_template,
              "distance,advancement,casts", false},
      Program{"coal", "coal", "Coal", cpp, coal_template, ""},
      Program{"libccd", "libccd-gjk", "libccd", cpp, libccd_template, "gjk", false},
      Program{"libccd-mpr", "libccd-mpr", "libccd", cpp, libccd_template, "mpr", false},
      Program{"mujoco", "mujoco", "MuJoCo", cpp, mujoco_template, ""},
      Program{"jolt", "jolt", "Jolt", javascript, jolt_mjs_template, "query,y,float,margin,casts"},
      Program{"jolt", "jolt", "Jolt", cpp, jolt_doctest_template, "doctest,y,float"},
      Program{"jolt-margin-0", "jolt-margin-0", "Jolt", javascript, jolt_mjs_template,
              "query,y,float,margin,casts"},
      Program{"jolt-margin-0", "jolt-margin-0", "Jolt", cpp, jolt_doctest_template,
              "doctest,y,float"},
      Program{"jolt-margin", "jolt-margin", "Jolt", javascript, jolt_mjs_template,
              "query,y,float,margin,casts"},
      Program{"jolt-margin", "jolt-margin", "Jolt", cpp, jolt_doctest_template, "doctest,y,float"},
      Program{"jolt-world", "jolt-world", "Jolt", javascript, jolt_mjs_template,
              "world,y,float,margin"},
      Program{"rapier", "rapier", "Rapier", javascript, rapier_mjs_template, "query,y,float,casts"},
      Program{"rapier-world", "rapier-world", "Rapier", javascript, rapier_mjs_template,
              "world,y,float"},
      Program{"physx", "physx", "PhysX", javascript, physx_mjs_template, "query,x,float,casts"},
      Program{"physx-world", "physx-world", "PhysX", javascript, physx_mjs_template,
              "world,x,float"},
      Program{"havok", "havok", "Havok", javascript, havok_mjs_template, "float,casts", false},
      Program{"mujoco3", "mujoco3", "MuJoCo", javascript, mujoco3_mjs_template, ""},
      Program{"mujoco3", "mujoco3", "MuJoCo", python, mujoco3_py_template, ""},
      Program{"mujoco3-single", "mujoco3-single", "MuJoCo", javascript, mujoco3_mjs_template,
              "single"},
      Program{"mujoco3-single", "mujoco3-single", "MuJoCo", python, mujoco3_py_template, "single"}};
  return all;
}

std::string_view family_of(std::string_view name) {
  return name.substr(0, find_npm_engine(name) ? name.find_first_of(":@") : name.find(':'));
}

bool has_floor(const Program& program) { return program.tags.ends_with("floor"); }

bool knows(const Program& program, Pair pair) {
  if (has_floor(program)) return pair == Pair::plane || pair == Pair::box;
  if (pair == Pair::plane) return program.plane;
  return pair != Pair::convex || program.source.find("convex]") != program.source.npos;
}

namespace {

/// The version of one of npm's packages that candidates/npm is made for.
std::string package_version(std::string_view package) {
  const std::string member = fmt::format("\"{}\": \"", package);
  const std::string_view rest = package_json.substr(package_json.find(member) + member.size());
  return std::string(rest.substr(0, rest.find('"')));
}

}  // namespace

std::string_view tags_for(const Program& program, Pair pair) {
  // PhysX's query knows no plane, which its candidate asks a scene about.
  return program.engine == "physx" && pair == Pair::plane ? "world,x,float" : program.tags;
}

Tags tags_for(const Program& program, Pair pair, bool of_cast) {
  Tags tags = names_in(tags_for(program, pair));
  if (of_cast) {
    const Tags of_contacts = {"query", "collide", "distance"};
    std::erase_if(tags, [&](std::string_view tag) { return std::ranges::count(of_contacts, tag); });
  }
  tags.emplace_back(of_cast ? "cast" : "contact");
  return tags;
}

bool knows_casts(const Program& program, Pair pair) {
  return knows(program, pair) && tags_for(program, pair).ends_with("casts");
}

std::string_view tag_of_release(std::string_view name) {
  return npm_release(name).empty() ? "newest" : "release";
}

std::string string_literal(std::string_view text) {
  std::string result = "\"";
  for (const char c : text) {
    const auto code = static_cast<unsigned char>(c);
    if (code < 0x20 || code == 0x7f) {
      result += fmt::format("\\{:03o}", code);  // some controls end a line of source
    } else {
      if (c == '"' || c == '\\') result += '\\';
      result += c;
    }
  }
  return result + '"';
}

Texts npm_texts(const Program& program, std::string_view name, const Candidate* candidate,
                const Configuration& c) {
  const NpmEngine* const engine = find_npm_engine(program.candidate);
  if (!engine) return {};
  const std::string_view release = npm_release(name);
  const std::string version =
      release.empty() ? package_version(engine->package) : std::string(release);
  Texts texts{{"npm", std::string(engine->package)},
              {"version", version},
              {"package", fmt::format("{}@{}", engine->package, version)},
              {"multiccd", program.tags == "single" ? "off" : "on, as by default"}};
  std::function<double(double)> rule = [](double smallest) { return std::min(0.05, smallest / 2); };
  texts["convex_rule"] = "0.05 m, at most half of the smallest half extent";
  if (program.engine == "jolt-margin-0") {
    texts["convex_rule"] = "0";
    rule = [](double) { return 0.0; };
  } else if (program.engine == "jolt-margin") {
    const auto given = parse_double(name.substr(0, name.find('@')).substr(name.find(':') + 1));
    // As candidates/npm/jolt.mjs has it.
    if (!candidate && !(given && *given >= 0 && *given <= 1)) {
      throw InvalidInput("--emit", string_literal(name),
                         "must be jolt-margin: and the radius, from 0 to 1 metre");
    }
    const double radius = candidate ? candidate->value : *given;
    texts["convex_rule"] = fmt::format("{} m, at most the smallest half extent", radius);
    rule = [radius](double smallest) { return std::min(radius, smallest); };
  }
  texts.merge(convex_radius_texts(c, rule));
  return texts;
}

}  // namespace touchstone
