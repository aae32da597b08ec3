#pragma once

#include <optional>
#include <string>

#include "candidates/candidates.hpp"
#include "reference/cast.hpp"

namespace touchstone {

/// What a candidate answers to a cast, or why it gave none.
struct CastAnswer {
  std::optional<Cast> cast;
  std::string failure = {};  ///< "Segmentation fault"; empty for an answer
};

/// Asks a candidate when A touches B first while it moves by `sweep`: our own routine here, an
/// engine's plug-in (cast.h) in a process of its own. None if the candidate has no casts.
std::optional<CastAnswer> ask_cast(const Candidate& candidate, const Configuration& configuration,
                                   const Vec3& sweep);

}  // namespace touchstone
