#include <algorithm>
#include <fmt/format.h>
#include <vector>

#include "properties/files/write_file.hpp"
#include "reports/figures/gnuplot.hpp"

namespace touchstone {

using nlohmann::json;

std::string class_figure(const json& report, const std::string& pair,
                         const std::filesystem::path& folder) {
  std::vector<std::string> classes, candidates;
  std::string data = "class,candidate,share_that_disagrees\n", cells;
  const auto place = [](std::vector<std::string>& names, const std::string& name) {
    const auto at = std::find(names.begin(), names.end(), name);
    const auto index = at - names.begin();
    if (at == names.end()) names.push_back(name);
    return index;
  };
  for (const json& row : report["results"]) {
    if (row["pair"] != pair || row["outcomes"].value("unsupported", 0) == row["count"]) continue;
    const double share = 1 - agreement(row);
    data += fmt::format("{},{},{:.6g}\n", row["class"].get<std::string>(),
                        csv_cell(row["candidate"].get<std::string>()), share);
    const auto y = place(classes, row["class"]), x = place(candidates, row["candidate"]);
    cells += fmt::format("{} {} {:.6g}\n", x, y, share);
  }
  if (cells.empty()) return "";
  write_file(folder / ("classes-" + pair + ".csv"), data, "--figures");
  const auto tics = [](const std::vector<std::string>& names) {
    std::string text;
    for (std::size_t i = 0; i < names.size(); ++i) {
      text += fmt::format("{}{} {}", i ? ", " : "", quoted(names[i]), i);
    }
    return text;
  };
  const int width = 320 + 26 * static_cast<int>(candidates.size());
  const int height = 200 + 15 * static_cast<int>(classes.size());
  return in_both_forms("classes-" + pair, width, height,
                       fmt::format("set title {}\nset palette defined (0 '#ffffff', 1 '#b3321f')\n"
                                   "set cbrange [0:1]\nset cblabel 'share that disagrees'\n"
                                   "set xrange [-0.5:{}]\nset yrange [{}:-0.5]\nset tics scale 0\n"
                                   "set xtics rotate by 90 right ({})\nset ytics ({})\n"
                                   "plot '-' using 1:2:3 with image pixels notitle\n{}e\n",
                                   quoted(pair), static_cast<double>(candidates.size()) - 0.5,
                                   static_cast<double>(classes.size()) - 0.5, tics(candidates),
                                   tics(classes), cells));
}

}  // namespace touchstone
