#include "candidates/npm_engines.hpp"

#include <algorithm>
#include <cstdlib>
#include <sstream>
#include <unistd.h>

#include "candidates/candidates.hpp"

namespace touchstone {
namespace {

/// The folder in which the packages are installed, as candidates/npm/packages.mjs finds it.
std::filesystem::path packages() {
  const char* const given = std::getenv("TOUCHSTONE_NPM");
  return given ? std::filesystem::path(given) : npm_folder() / "../../build/npm";
}

bool is_on_path(const char* program) {
  const char* const path = std::getenv("PATH");
  std::istringstream folders(path ? path : "");
  for (std::string folder; std::getline(folders, folder, ':');) {
    if (access((folder + '/' + program).c_str(), X_OK) == 0) return true;
  }
  return false;
}

}  // namespace

const std::vector<NpmEngine>& npm_engines() {
  static const std::vector<NpmEngine> engines = {
      {"jolt", "jolt-physics", "jolt.mjs"},
      {"jolt-margin-0", "jolt-physics", "jolt.mjs margin-0"},
      {"jolt-margin", "jolt-physics", "jolt.mjs margin"},
      {"jolt-world", "jolt-physics", "jolt.mjs world"},
      {"jolt-floor", "jolt-physics", "jolt.mjs floor"},
      {"rapier", "@dimforge/rapier3d-compat", "rapier.mjs"},
      {"rapier-world", "@dimforge/rapier3d-compat", "rapier.mjs world"},
      {"rapier-floor", "@dimforge/rapier3d-compat", "rapier.mjs floor"},
      {"rapier-floor-edges", "@dimforge/rapier3d-compat", "rapier.mjs floor-edges"},
      {"physx", "physx-js-webidl", "physx.mjs"},
      {"physx-world", "physx-js-webidl", "physx.mjs world"},
      {"physx-floor", "physx-js-webidl", "physx.mjs floor"},
      {"havok", "@babylonjs/havok", "havok.mjs"},
      {"havok-floor", "@babylonjs/havok", "havok.mjs floor"},
      {"mujoco3", "@mujoco/mujoco", "mujoco3.mjs"},
      {"mujoco3-single", "@mujoco/mujoco", "mujoco3.mjs single"}};
  return engines;
}

const NpmEngine* find_npm_engine(std::string_view name) {
  const auto& all = npm_engines();
  const auto found =
      std::ranges::find(all, name.substr(0, name.find_first_of(":@")), &NpmEngine::family);
  return found == all.end() ? nullptr : &*found;
}

std::string_view npm_release(std::string_view name) {
  const auto at = name.find('@');
  return at == name.npos || !find_npm_engine(name) ? "" : name.substr(at + 1);
}

std::filesystem::path npm_folder() {
  auto program = std::filesystem::read_symlink("/proc/self/exe").parent_path();
  // The program of a build tree, a test in it, the installed program.
  for (const char* folder : {"../../candidates/npm", "../../../candidates/npm",
                             "../../../../candidates/npm", "../share/touchstone/candidates/npm"}) {
    auto path = (program / folder).lexically_normal();
    if (std::filesystem::exists(path / "package.json")) return path;
  }
  return program;
}

std::string npm_obstacle(const NpmEngine& engine, std::string_view release) {
  if (!is_on_path("node")) {
    return std::string("node is not installed; ") +
           (is_in_clone() ? "./touchstone installs it when it can"
                          : "install Debian's packages nodejs and npm");
  }
  const std::string package(engine.package), wanted = package + '@' + std::string(release);
  const auto folder = release.empty() ? packages() : packages() / "versions" / wanted;
  if (std::filesystem::exists(folder / "node_modules" / package / "package.json")) return "";
  const std::string missing =
      "npm's package " + (release.empty() ? package : wanted) + " is not in ";
  if (is_in_clone()) {
    return missing + folder.lexically_normal().string() +
           "; ./touchstone installs it there, or name a folder in TOUCHSTONE_NPM that has it";
  }
  const char* const given = std::getenv("TOUCHSTONE_NPM");
  if (given && !release.empty()) {
    return missing + folder.string() + "; run npm install --ignore-scripts --prefix " +
           folder.string() + ' ' + wanted;
  }
  return missing + (given ? given : "a folder that TOUCHSTONE_NPM names") +
         "; copy package.json and package-lock.json from " + npm_folder().string() +
         " into a folder, run npm ci --ignore-scripts there, and set TOUCHSTONE_NPM to it";
}

std::string npm_command(const NpmEngine& engine, std::string_view release) {
  const std::string script = "node " + std::string(engine.script);
  return release.empty() ? script : "TOUCHSTONE_RELEASE=" + std::string(release) + ' ' + script;
}

}  // namespace touchstone
