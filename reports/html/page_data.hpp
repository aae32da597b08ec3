#pragma once

#include <nlohmann/json.hpp>

namespace touchstone {

/// A report as its page carries it, at a fifth of the size: `results`, `summary` and `trends` as
/// {schema, rows} with their numbers to four digits, the `strings` that rows name by number, and
/// the candidates' `marks`. A schema is "string", null (as it is) or an object, whose values a row
/// gives in its order.
nlohmann::json page_data(const nlohmann::json& report);

}  // namespace touchstone
