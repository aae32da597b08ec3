#pragma once

#include <cstddef>
#include <string>
#include <string_view>

#include "reference/invalid_input.hpp"

namespace touchstone {

/// The text for one line of a terminal or log: control characters as \x1b, and at most `max_length`
/// bytes, of which the last are "..." where some were cut. UTF-8 stays whole.
std::string printable(std::string_view text, std::size_t max_length);

/// "radius is -1: must be positive and finite", printable, whatever a file or command line held.
std::string error_text(const InvalidInput& error);

}  // namespace touchstone
