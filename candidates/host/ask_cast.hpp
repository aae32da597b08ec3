#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "candidates/candidates.hpp"
#include "reference/cast.hpp"

namespace touchstone {

/// A configuration, and the translation by which A moves, metres in the world's frame.
struct CastQuestion {
  Configuration configuration;
  Vec3 sweep;
};

/// What a candidate answers to a cast, or why it gave none.
struct CastAnswer {
  std::optional<Cast> cast;
  std::string failure = {};  ///< "Segmentation fault"; empty for an answer
};

/// Asks a candidate when A touches B first: our own routine here, an engine's plug-in (cast.h) in a
/// process of its own, which all of them share unless it ends before it has answered. None for what
/// the candidate has no cast of.
std::vector<std::optional<CastAnswer>> ask_casts(const Candidate& candidate,
                                                 std::span<const CastQuestion> questions);

}  // namespace touchstone
