#pragma once

#include <span>
#include <string>
#include <string_view>

#include "candidates/host/ask_cast.hpp"
#include "properties/identity.hpp"

namespace touchstone {

class Draw;

/// How A moves towards, along or past the pose of a class: a cast is that pose with such a motion
/// put upon it. So a head-on motion upon rim-edge is a rim into an edge, and so on.
struct CastMotion {
  const char* name;
  const char* description;  ///< one sentence
  /// `normal`: the first optimal one of the pose, whose signed distance is `distance`.
  CastQuestion (*put_upon)(Draw& draw, const Configuration& pose, const Vec3& normal,
                           double distance);
};

/// All of them, in the order of reports.
std::span<const CastMotion> cast_motions();
/// Throws InvalidInput (field "identity.motion") that lists them.
const CastMotion& find_cast_motion(std::string_view name);

/// The name of one cast: "cylinder-box/rim-face/42/137/grazing".
struct CastIdentity {
  Identity pose;
  const CastMotion* motion;
};
std::string to_string(const CastIdentity& identity);
/// Whether the text has five parts, of which the first is a pair.
bool is_cast_identity(std::string_view text);
/// Throws InvalidInput like parse_identity, and of the motion.
CastIdentity parse_cast_identity(std::string_view text);

/// The cast of that identity: the same bits on every call.
CastQuestion make_cast(const CastIdentity& identity);
Subject subject(const CastIdentity& identity);

}  // namespace touchstone
