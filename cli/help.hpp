#pragma once

#include <memory>
#include <string>

#include <CLI/CLI.hpp>

namespace touchstone {

/// How --help prints options and subcommands: within 80 columns, long descriptions on several
/// lines.
std::shared_ptr<CLI::FormatterBase> help_format();

/// A line of a list in a footer, or several within 80 columns: a name in a column of this width and
/// what it is.
std::string list_entry(const std::string& name, std::size_t width, const std::string& text);

}  // namespace touchstone
