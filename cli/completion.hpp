#pragma once

#include <string>

#include <CLI/CLI.hpp>

namespace touchstone {

/// What a shell completes `touchstone` with, made of the program's own subcommands and options;
/// values and other arguments are completed as file names.
std::string bash_completion(const CLI::App& program);
std::string zsh_completion(const CLI::App& program);

}  // namespace touchstone
