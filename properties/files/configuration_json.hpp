#pragma once

#include <optional>
#include <string>

#include <nlohmann/json_fwd.hpp>

#include "properties/identity.hpp"
#include "reference/configuration.hpp"

namespace touchstone {

/// A configuration as a person writes it: the bodies may come in either order.
struct GivenConfiguration {
  Configuration configuration;
  /// True if the person's body a is our body B: normals are reversed before they are shown.
  bool swapped = false;
  /// Of our body A as seen from B, where it is a cast.
  std::optional<Sweep> sweep = {};
};

/// Reads {"a": shape, "pose_a": pose, "b": shape, "pose_b": pose}; other members than "id" are
/// refused. Numbers are JSON numbers or strings with a decimal or hexadecimal float. A missing pose
/// is the identity. Throws InvalidInput with the full path of the field ("b.half_extents[1]").
GivenConfiguration configuration_from_json(const nlohmann::json& json);

/// The same, which may be a cast: "sweep", body a's translation, and "spin", its turn (sweep.hpp).
GivenConfiguration cast_from_json(const nlohmann::json& json);

/// The configuration of a file: one JSON object, which is a configuration, or has one as its member
/// "configuration", as saved failures, certificates and a report's worst cases have. `source` is
/// what errors call the file. Throws InvalidInput, also for several lines.
Configuration configuration_from_text(const std::string& text, const std::string& source);

/// {"shape": "cylinder", "radius": …}. `path` names the object in errors, which are InvalidInput.
Shape shape_from_json(const nlohmann::json& value, const std::string& path);
/// {"position": …, "orientation": quaternion w, x, y, z}; either may be missing. In place of the
/// orientation there may be "rotation", a matrix by its rows, or "axis", the direction of the
/// body's z in the world: "x", "y", "z" or a vector (given_orientation.hpp).
Pose pose_from_json(const nlohmann::json& value, const std::string& path);

/// Shortest decimals that give the same doubles back.
nlohmann::json to_json(const Configuration& configuration);
/// Every number as a string with a hexadecimal float.
nlohmann::json to_hex_json(const Configuration& configuration);
/// The same with the members of a cast; without a sweep, none more.
nlohmann::json to_json(const Configuration& configuration, const std::optional<Sweep>& sweep);
nlohmann::json to_hex_json(const Configuration& configuration, const std::optional<Sweep>& sweep);

/// Every number as a string with a fraction in lowest terms, as in "-3/8".
nlohmann::json to_exact_json(const Configuration& configuration);

nlohmann::json to_json(const Shape& shape);
nlohmann::json to_json(const Vec3& v);

/// Help of the option that takes such a name.
inline constexpr const char* given_help =
    "pair/class/seed/index (of a cast also /motion), a file with a line as for solve or with a "
    "saved failure, or - for "
    "standard input";

/// What a configuration of standard input has for a name.
inline constexpr const char* standard_input_name = "standard input";

/// Reads an identity, or where there is such a file, the file; "-" is standard input. A file holds
/// one JSON object, or JSON Lines, of which `id` names one by its member "id": a configuration as
/// for `solve`, or an object with one as its member "configuration", as saved failures,
/// certificates and a report's worst cases have. Throws InvalidInput, also for several lines
/// without an `id`, which lists theirs.
Subject given_configuration(const std::string& input, const std::optional<std::string>& id = {});

/// Throws InvalidInput (field "sweep") if it is a cast, which `asked` ("stability", "--emit") does
/// not know.
void refuse_sweep(const Subject& subject, const std::string& asked);

}  // namespace touchstone
