#pragma once

#include <array>
#include <string>

#include <nlohmann/json_fwd.hpp>

#include "candidates/answer.hpp"
#include "oracle/judge/score.hpp"
#include "oracle/patch/contact_patch.hpp"
#include "oracle/truth.hpp"

namespace touchstone {

/// Whether every normal is reversed, for a person whose body a is our body B.
enum class Order { as_ours, swapped };

const char* ties_name(oracle::Ties ties);
const char* patch_kind_name(oracle::ContactPatch::Kind kind);

/// Decimals of an enclosure's two ends, rounded outward, with as many digits as tell them apart.
std::array<std::string, 2> decimals(const oracle::Enclosure& enclosure);

/// {"signed_distance": [lo, hi] as decimals rounded outward, "normals": […], "ties": "unique",
/// "patch": [{"kind", "area", "perimeter", "centroid", "outline"}, …] for each of the normals}.
nlohmann::json to_json(const Configuration& configuration, const oracle::Truth& truth,
                       Order order = Order::as_ours);

/// {"status", "signed_distance", "normal", "points": [{"position", "normal", "depth"}], "score":
/// {…}}; what the answer does not define is null.
nlohmann::json to_json(const ts_answer& answer, const Score& score, Order order = Order::as_ours);
/// Adds the member "reason" where the answer has one.
nlohmann::json to_json(const Answer& answer, const Score& score, Order order = Order::as_ours);

/// Reads what to_json wrote, with Order::as_ours; of the score members may be missing, as they are
/// in files of older versions. A number may be null, "nan", "inf" or "-inf", too; a point without a
/// normal has the answer's. `path` names the answer in errors, which are InvalidInput.
ts_answer answer_from_json(const nlohmann::json& answer, const std::string& path);
Score score_from_json(const nlohmann::json& answer, const std::string& path);

}  // namespace touchstone
