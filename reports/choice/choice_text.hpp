#pragma once

#include <string>

#include <nlohmann/json.hpp>

namespace touchstone {

/// choose.json for a terminal of 80 columns: the answer, what fails first with cheaper models, and
/// each candidate's run.
std::string choice_text(const nlohmann::json& choice);

}  // namespace touchstone
