#pragma once

#include <string>

#include <CLI/CLI.hpp>

namespace touchstone {

/// The manual page in troff (man(7)), made of the program's own subcommands and options, so that it
/// says what they say.
std::string manual(const CLI::App& program);

}  // namespace touchstone
