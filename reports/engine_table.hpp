#pragma once

#include <filesystem>
#include <string>

#include "reports/report.hpp"

namespace touchstone {

/// By the ending of the file's name. Throws InvalidInput (field "--table") unless it is .md or
/// .html.
bool is_html_table(const std::filesystem::path& file);

/// A table of candidates by pairs, for a page of somebody's own: how many everyday poses are
/// answered right, how many points a contact at rest has, the largest error, the median time, and
/// what each fails first; with the command that gives it.
std::string engine_table(const Report& report, bool is_html);

}  // namespace touchstone
