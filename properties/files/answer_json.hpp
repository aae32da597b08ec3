#pragma once

#include <nlohmann/json.hpp>

#include "candidates/candidate.h"
#include "oracle/judge/score.hpp"
#include "oracle/truth.hpp"

namespace touchstone {

/// Turns every normal round: for a person whose body a is our body B.
enum class Order { as_ours, swapped };

/// {"signed_distance": [lo, hi] as decimals rounded outward, "normals": […], "ties": "unique",
/// "patch": [{"kind", "area", "perimeter", "centroid", "outline"}, …] for each of the normals}.
nlohmann::json to_json(const Configuration& configuration, const oracle::Truth& truth,
                       Order order = Order::as_ours);

/// {"status", "signed_distance", "normal", "points": [{"position", "normal", "depth"}], "score":
/// {…}}; what the answer does not define is null.
nlohmann::json to_json(const ts_answer& answer, const Score& score, Order order = Order::as_ours);

}  // namespace touchstone
