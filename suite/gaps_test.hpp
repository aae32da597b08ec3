#pragma once

#include <algorithm>
#include <sstream>
#include <string>
#include <vector>

#include "oracle/judge/score.hpp"
#include "reports/test_data/test_data.hpp"
#include "suite/readers_test.hpp"
#include "suite/touchstone_suite.hpp"

// That readers know what the gap along any normal is.

namespace touchstone {

inline std::string csv_of(const std::vector<TestDatum>& data, CsvColumns columns) {
  const auto writer = test_data_writer(TestDataFormat::csv, columns);
  std::string text;
  for (const TestDatum& datum : data) text += writer->add(datum);
  return text + writer->finish();
}

/// Bound of the error of a reader's gap, relative to the largest regret allowed; README.md has it.
constexpr double gap_error = 0.01;

/// Rotations of the best normal of which every reader has to know the regret: to all sides, and
/// far enough that the reversed term of a plane's column counts. Each configuration has two of
/// them, so that the three of a pose class have all.
constexpr double rotations_of_best[] = {0, 1e-3, -1e-3, 0.5, 2, -2};

inline Vec3 rotated_best(const TestDatum& d, double angle) {
  const Vec3 best = d.truth.normals.front().n;
  const Vec3 axis = best.unitOrthogonal() + best.cross(best.unitOrthogonal()) / 2;
  return Eigen::AngleAxisd(angle, axis.normalized()) * best;
}

/// Holds the gaps that the reader in C++ says, and those in Python and JavaScript, which are given
/// the file, to the exact regrets.
inline void expect_gaps_of_all_readers(const std::vector<TestDatum>& given,
                                       const std::string& csv) {
  std::istringstream in(csv);
  const auto cases = touchstone_suite::read(in);
  ASSERT_EQ(cases.size(), given.size());
  std::vector<std::vector<double>> said(1);
  std::vector<double> expected;
  nlohmann::json normals = nlohmann::json::array();
  for (std::size_t i = 0; i < given.size(); ++i) {
    for (const std::size_t k : {i, i + 3}) {
      const double angle = rotations_of_best[k % std::size(rotations_of_best)];
      const Vec3 n = rotated_best(given[i], angle);
      said[0].push_back(touchstone_suite::gap(cases[i], {n.x(), n.y(), n.z()}));
      normals.push_back({n.x(), n.y(), n.z()});
      expected.push_back(oracle::normal_regret(given[i].configuration, given[i].truth, n));
    }
  }
  const OwnFolder folder;
  folder.with("suite.csv", csv);
  folder.with("normals.json", normals.dump());
  for (const char* const command : {TOUCHSTONE_PYTHON R"( -Bc '
import json, os, judge
folder = os.environ["FOLDER"]
normals = iter(json.load(open(folder + "/normals.json")))
print([judge.gap(case, next(normals)) for case in judge.read(folder + "/suite.csv") for _ in range(2)])')",
                                    R"(node -e '
const {read, gap} = require("./judge.js"), folder = process.env.FOLDER;
const normals = JSON.parse(require("fs").readFileSync(folder + "/normals.json"));
const cases = read(folder + "/suite.csv");
console.log(JSON.stringify(normals.map((n, i) => gap(cases[Math.floor(i / 2)], n))));')"}) {
    const std::string text =
        printed_by("cd " TOUCHSTONE_SUITE " && FOLDER=" + folder.path.string() + ' ' + command);
    said.push_back(nlohmann::json::parse(text).get<std::vector<double>>());
  }
  for (const auto& gaps : said) {
    ASSERT_EQ(gaps.size(), expected.size());
    for (std::size_t i = 0; i < gaps.size(); ++i) {
      const touchstone_suite::Case& c = cases[i / 2];
      // Beyond the limit only the verdict counts: an error relative to the regret.
      EXPECT_NEAR(std::max(0.0, c.signed_distance - gaps[i]), expected[i],
                  std::max(gap_error * c.max_regret, 1e-12 * expected[i]))
          << c.id;
    }
  }
}

}  // namespace touchstone
