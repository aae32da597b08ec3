#pragma once

#include <string>

#include "properties/laws/check.hpp"
#include "reports/terminal.hpp"

namespace touchstone {

/// What broke which law, in decimals and hexadecimal floats, with the truth, the answer and the
/// command that shows it again. Commands and configurations stand in lines of their own, however
/// long.
std::string failure_text(const Failure& failure, const Terminal& terminal);

}  // namespace touchstone
