#pragma once

#include <string>

namespace touchstone {

/// This program's version, each engine's as its plug-in says, and each library's that the truth
/// comes from.
std::string version_text();

}  // namespace touchstone
