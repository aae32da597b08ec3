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

/// The engine of that family, if there is one.
const NpmEngine* find_npm_engine(std::string_view family);

/// Why the engine cannot be asked here, and the remedy; empty if it can.
std::string npm_obstacle(const NpmEngine& engine);

/// The command that asks it, and the folder of its script. Precondition: no obstacle.
std::string npm_command(const NpmEngine& engine);
std::filesystem::path npm_folder();

}  // namespace touchstone
