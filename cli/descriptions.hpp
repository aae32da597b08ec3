#pragma once

#include <string>

namespace CLI {
class App;
}

namespace touchstone {

// The program's own description of its commands, in other forms than --help.

/// The manual page, in troff with the man macros.
std::string manual(const CLI::App& program);

/// Completion scripts: subcommands, options, files.
std::string bash_completion(const CLI::App& program);
std::string zsh_completion(const CLI::App& program);

}  // namespace touchstone
