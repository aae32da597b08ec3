#include "reports/figures/figures.hpp"

#include <algorithm>
#include <cstdlib>
#include <string>
#include <vector>

#include "properties/files/write_file.hpp"
#include "reference/invalid_input.hpp"
#include "reports/figures/gnuplot.hpp"

namespace touchstone {

using nlohmann::json;
using std::filesystem::path;

void check_figures(const path& folder) {
  if (std::system("command -v gnuplot >/dev/null 2>&1") != 0) {
    throw InvalidInput("--figures", '"' + folder.string() + '"',
                       "needs gnuplot, which is not installed (Debian: gnuplot-nox)");
  }
  check_writable(folder, "--figures");
}

void write_figures(const json& report, const path& folder) {
  check_figures(folder);
  std::vector<std::string> pairs;
  for (const json& row : report["summary"]) {
    const std::string pair = row["pair"];
    if (std::find(pairs.begin(), pairs.end(), pair) == pairs.end()) pairs.push_back(pair);
  }
  std::string script = speed_figures(report, pairs, folder);
  for (const auto& pair : pairs) {
    script += error_figure(report, pair, folder) + class_figure(report, pair, folder);
  }
  run_gnuplot(script, folder);
}

}  // namespace touchstone
