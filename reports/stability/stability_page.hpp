#pragma once

#include <string>

#include <nlohmann/json.hpp>

namespace touchstone {

/// stability.html: self-contained, drawn from stability.json by the same script as the report's
/// section (reports/html/stability.js).
std::string stability_page(const nlohmann::json& stability);

}  // namespace touchstone
