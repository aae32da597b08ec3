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
#include "suite/touchstone_suite.hpp"

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

inline nlohmann::json numbers_json(const touchstone_suite::Vector& v) {
  auto numbers = nlohmann::json::array();
  for (const double x : v) numbers.push_back(number_json(x));
  return numbers;
}

/// A line of a file of answers.
inline std::string line_of(const std::string& id, const touchstone_suite::Answer& a) {
  nlohmann::json line = {{"id", id}, {"status", a.status}};
  if (a.status == "contact") {
    line["signed_distance"] = number_json(a.signed_distance);
    line["normal"] = numbers_json(a.normal);
    line["points"] = nlohmann::json::array();
    for (const auto& p : a.points) {
      line["points"].push_back(
          {{"position", numbers_json({p[0], p[1], p[2]})}, {"depth", number_json(p[3])}});
    }
  }
  return line.dump() + '\n';
}
inline std::string line_of(const std::string& id, const touchstone_suite::CastAnswer& a) {
  const nlohmann::json line = {{"id", id},
                               {"status", a.status},
                               {"fraction", number_json(a.fraction)},
                               {"normal", numbers_json(a.normal)}};
  return line.dump() + '\n';
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

/// Both judges say the one of all answers in double precision, and "agree" in single.
inline void expect_right_in_float_alone(const std::string& suite, const std::string& answers,
                                        const std::string& in_double) {
  using testing::Each;
  EXPECT_THAT(verdicts_of_judges(suite_file(suite), answers), Each(Each(in_double)));
  EXPECT_THAT(verdicts_of_judges("--float " + suite_file(suite), answers),
              Each(Each(std::string("agree"))));
}

}  // namespace touchstone
