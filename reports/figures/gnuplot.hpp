#pragma once

#include <filesystem>
#include <string>

#include <nlohmann/json.hpp>

namespace touchstone {

/// "pointtype 7 linecolor '#0072b2'": a candidate's mark, coloured as on the report's page.
std::string style_of(const std::string& candidate);

/// Text within double quotes, for gnuplot.
std::string quoted(const std::string& text);
/// A cell of CSV.
std::string csv_cell(const std::string& text);

/// A figure's commands, once for NAME.svg and once for NAME.png of twice as many pixels.
std::string in_both_forms(const std::string& name, int width, int height,
                          const std::string& commands);

/// Runs a script within `folder`. Throws std::runtime_error with gnuplot's words if it fails; the
/// script is then left there.
void run_gnuplot(const std::string& script, const std::filesystem::path& folder);

/// Of a row of `summary` or `results`.
double agreement(const nlohmann::json& row);

// The figures of one report. Each writes its data as CSV and returns its commands, none where there
// is nothing to show.
std::string speed_figures(const nlohmann::json& report, const std::vector<std::string>& pairs,
                          const std::filesystem::path& folder);
std::string error_figure(const nlohmann::json& report, const std::string& pair,
                         const std::filesystem::path& folder);
std::string class_figure(const nlohmann::json& report, const std::string& pair,
                         const std::filesystem::path& folder);

}  // namespace touchstone
