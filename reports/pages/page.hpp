#pragma once

#include <string>

#include <nlohmann/json_fwd.hpp>

namespace touchstone {

enum class Page { report, comparison, replay, stability, choice };

/// One self-contained HTML file: the shell that all pages share (page.html), filled with a page's
/// own part, its scripts and its data. It loads nothing from elsewhere, and no string of the data
/// can break out of it.
std::string render_page(Page page, const nlohmann::json& data);

}  // namespace touchstone
