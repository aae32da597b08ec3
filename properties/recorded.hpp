#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

#include "properties/nearest_arrangement.hpp"

namespace touchstone {

/// A configuration near contact that one of the shipped scenes produced with exact contacts: a line
/// of recorded.jsonl (docs/scenes.md says how they are sampled).
struct Recorded {
  std::string_view scene;
  std::uint64_t weight;  ///< number of narrow-phase questions that it stands for
  Configuration configuration;
};

/// Those of a pair, in the order of the file.
const std::vector<Recorded>& recorded(Pair pair);

/// How often an arrangement occurs among a pair's recorded questions.
struct RecordedShare {
  Pair pair;
  NearestArrangement arrangement;
  double share;  ///< of the pair's questions
};

/// By pair, then from the most frequent to the rarest arrangement and tilt.
std::vector<RecordedShare> recorded_shares();

}  // namespace touchstone
