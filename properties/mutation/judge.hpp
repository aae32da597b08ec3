#pragma once

#include <bitset>
#include <functional>
#include <string>

#include "properties/mutation/cases.hpp"

namespace touchstone::mutation {

/// What an answer can be wrong in.
enum class Check {
  finite,      ///< finite numbers and unit normals
  distance,    ///< within 1e-13 of the larger size
  regret,      ///< of the normal, likewise
  certified,   ///< the true distance lies within the bound, and that is rounding
  overlaps,    ///< says what the signed distance says
  threshold,   ///< points exactly where the signed distance is within the threshold
  clearance,   ///< beyond it, a clearance along the normal that is above it and not too large
  points,      ///< one is as deep as the bodies, none deeper, none beyond the threshold
  surfaces,    ///< a point lies halfway between both surfaces
  coverage,    ///< their hull spans the contact patch
  steadiness,  ///< a motion that nobody sees moves no point
  hint,        ///< the previous normal decides between normals that tie, and nothing else
  exchange,    ///< cylinders exchanged have the mirrored answer, to the last bit
  vocabulary,  ///< sizes, rotations, supports, gaps, names
  bounds,      ///< axis-aligned boxes
  agreement,   ///< among the routines themselves, the proven one being right
  refusal      ///< what is no shape or pose is refused, and its field named
};
constexpr int check_count = 17;
const char* check_name(int check);

/// Each check is made at most this many times of one case, at different thresholds or hints.
constexpr int max_variants = 8;
using Findings = std::bitset<std::size_t{check_count} * max_variants>;

Findings judge(const Case& c, const Routines& routines);

/// What the search of rims proves of its arcs, held against rims in long double: calls
/// expect(whether it holds, which of the checks). `index` decides on the ends.
enum class ArcCheck { passage, derivatives, minima, directions };
void judge_arcs(const void* made, const Routines& routines, std::size_t index,
                const std::function<void(bool, ArcCheck)>& expect);

/// Without a truth: do the routines agree with each other, and is the proven one sure? Finds only
/// `agreement` and `certified`.
Findings judge_agreement(const Case& c, const Routines& routines);

/// Of shapes and poses that cannot be; independent of the cases.
Findings judge_refusals(const Routines& routines);

}  // namespace touchstone::mutation
