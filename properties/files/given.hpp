#pragma once

#include <string>

#include "properties/identity.hpp"

namespace touchstone {

/// Help of the option that takes such a name.
inline constexpr const char* given_help =
    "pair/class/seed/index, a file with a line as for solve or with a saved failure, or - for "
    "standard input";

/// Reads an identity, or where there is such a file, the file; "-" is standard input. A file holds
/// one JSON object, or JSON Lines, of which the first that is not blank counts: a configuration as
/// for `solve`, or an object with one as its member "configuration", as saved failures,
/// certificates and a report's worst cases have. Throws InvalidInput.
Subject given_configuration(const std::string& input);

}  // namespace touchstone
