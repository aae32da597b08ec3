#pragma once

#include <algorithm>
#include <cmath>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sstream>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "properties/files/own_folder_test.hpp"
#include "properties/named.hpp"

// What the tests of the suites do with files and with the readers that are programs.

namespace touchstone {

inline const std::string judges[] = {TOUCHSTONE_PYTHON " " TOUCHSTONE_SUITE "/judge.py ",
                                     "node " TOUCHSTONE_SUITE "/judge.js "};

inline std::string suite_file(const std::string& name) {
  return TOUCHSTONE_SUITE "/touchstone-suite-" + name + ".csv.gz";
}
/// The text of suite_file(name).
inline std::string unpacked(const std::string& name) {
  return printed_by("gzip -dc " + suite_file(name));
}

/// The cells of one column, which has to be there.
inline std::vector<std::string> column(const std::string& csv, const std::string& name) {
  std::vector<std::string> cells;
  std::istringstream in(csv);
  std::size_t place = std::string::npos;
  for (std::string line; std::getline(in, line);) {
    if (line.starts_with('#')) continue;
    const auto row = split(line, ',');
    if (place == std::string::npos) {
      place = static_cast<std::size_t>(std::ranges::find(row, name) - row.begin());
    } else {
      cells.emplace_back(row.at(place));
    }
  }
  return cells;
}

/// JSON has no number for what is not finite.
inline nlohmann::json number_json(double x) {
  if (std::isnan(x)) return nullptr;
  return std::isfinite(x) ? nlohmann::json(x) : nlohmann::json(x > 0 ? "inf" : "-inf");
}

/// Of each judge the verdicts on answers: second words of lines such as "cylinder-box/rim-face/1/0
/// agree".
inline std::vector<std::vector<std::string>> verdicts_of_judges(const std::string& suite,
                                                                const std::string& answers) {
  const OwnFolder folder;
  const std::string files = suite + ' ' + folder.with("answers", answers).string();
  std::vector<std::vector<std::string>> result;
  for (const std::string& judge : judges) {
    auto& verdicts = result.emplace_back();
    std::istringstream in(printed_by(judge + files, 1));
    for (std::string line; std::getline(in, line);) {
      std::istringstream words(line);
      std::string id, verdict, right;
      words >> id >> verdict >> right;
      EXPECT_EQ(right.empty(), verdict == "agree") << line;
      verdicts.push_back(verdict);
    }
  }
  return result;
}

}  // namespace touchstone
