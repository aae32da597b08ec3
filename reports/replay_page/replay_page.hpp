#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include <nlohmann/json.hpp>

namespace touchstone {

/// One self-contained page of a configuration: both bodies in three dimensions and in a slice
/// through the contact, with the contact points and normals of truth and candidates, and all
/// numbers. `examined` is what examine() of reports/worst.hpp gives, as JSON; `hexadecimal` and
/// `exact` are its configuration written by to_hex_json and to_exact_json. Nothing is loaded from
/// elsewhere.
std::string replay_page(nlohmann::json examined, const nlohmann::json& hexadecimal,
                        const nlohmann::json& exact, std::string_view description);

}  // namespace touchstone
