#pragma once

#include <nlohmann/json.hpp>

namespace touchstone {

/// {"cpu", "cores", "compiler", "os"} of the machine that this runs on.
nlohmann::json describe_machine();

}  // namespace touchstone
