#pragma once

#include <string>

namespace touchstone {

/// What a library has said so far into a file in memory, in one line: its first line that says
/// Error, without that word and the library's own file and line; without one, the first line.
std::string complaint_in(int log);

}  // namespace touchstone
