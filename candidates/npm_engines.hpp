#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace touchstone {

/// An engine from npm that candidates/npm has an adapter for.
struct NpmEngine {
  std::string_view family;   ///< its candidate's name without parameter
  std::string_view package;  ///< npm's
  std::string_view script;   ///< with its arguments
};

const std::vector<NpmEngine>& npm_engines();

/// The engine of a candidate, "jolt-margin:0.01@0.30", or of its family, if it is one of npm.
const NpmEngine* find_npm_engine(std::string_view name);

/// What follows the "@" of an engine of npm: "0.14"; empty: the release of package-lock.json, or no
/// such engine. ./touchstone installs a release in the folder versions/PACKAGE@RELEASE beside that.
std::string_view npm_release(std::string_view name);

/// Why the engine, or its release, cannot be asked here, and the remedy; empty if it can.
std::string npm_obstacle(const NpmEngine& engine, std::string_view release = {});

/// The command that asks it, and the folder of its script. Precondition: no obstacle.
std::string npm_command(const NpmEngine& engine, std::string_view release = {});
std::filesystem::path npm_folder();

}  // namespace touchstone
