#pragma once

#include <string>

#include "simulation/engines/run_engines.hpp"

namespace touchstone {

/// One self-contained page: what our contacts change in the engines, and some of the experiments in
/// motion, without and with them; runs these again. `command` is the command line that a person
/// would repeat.
std::string engines_page(const EngineResults& results, const std::string& command);

}  // namespace touchstone
