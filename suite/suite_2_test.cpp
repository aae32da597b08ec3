// touchstone-suite-2, its contacts: that the committed files are those that `touchstone export
// --suite-2` writes, exact in single precision, and that readers allow floats what they cost.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <map>
#include <sstream>

#include "suite/gaps_test.hpp"

namespace touchstone {
namespace {

std::string name_of(const SuiteFile& file) { return "2-" + std::string(file.name); }

TEST(Suite2, IsWhatExportWritesToTheByteAndReadersKnowTheRegretOfAnyNormal) {
  std::size_t count = 0;
  for (const SuiteFile& file : suite_2_files()) {
    std::vector<TestDatum> made;
    make_suite_2(file, [&](const TestDatum& datum) { made.push_back(datum); });
    const std::string text = csv_of(made, CsvColumns::suite_2);
    EXPECT_TRUE(text == unpacked(name_of(file))) << file.name;
    expect_gaps_of_all_readers(made, text);
    count += made.size();
  }
  EXPECT_EQ(count, 600u);
}

TEST(Suite2, IsExactInSinglePrecisionAndHasAllPairsAndKindsOfAnswers) {
  std::map<std::string, int> contacts, ties, shapes;
  for (const SuiteFile& file : suite_2_files()) {
    const std::string csv = unpacked(name_of(file));
    std::istringstream in(csv);
    for (const auto& c : touchstone_suite::read(in)) {
      auto numbers = c.vertices_b;
      numbers.insert(numbers.end(), {c.size_a, c.position_a, c.orientation_a, c.size_b,
                                     c.position_b, c.orientation_b});
      for (const auto& v : numbers) {
        for (const double x : v) EXPECT_EQ(static_cast<double>(static_cast<float>(x)), x) << c.id;
      }
      ++contacts[c.contact], ++shapes[c.shape_b];
    }
    for (const std::string& cell : column(csv, "ties")) ++ties[cell];
  }
  EXPECT_EQ(contacts.size(), 3u);
  EXPECT_EQ(ties.size(), 3u);
  for (const auto& [shape, count] : shapes) EXPECT_EQ(count, 100) << shape;
}

/// An answer that is too deep in double precision by what single precision is allowed.
TEST(Suite2, AllowsRoutinesInFloatWhatFloatsCost) {
  std::istringstream in(unpacked("2-smoke"));
  std::string lines;
  for (const auto& c : touchstone_suite::read(in)) {
    if (in_float(c).contact != "required") continue;
    const double distance = c.signed_distance - (c.max_regret + c.float_tolerance) / 2;
    const touchstone_suite::Answer deep{"contact", distance, c.normal, {{0, 0, 0, -distance}}};
    EXPECT_EQ(verdict(c, deep), "overdeep") << c.id;
    EXPECT_EQ(verdict(in_float(c), deep), "agree") << c.id;
    lines += line_of(c.id, deep);
  }
  EXPECT_GT(std::ranges::count(lines, '\n'), 10);
  expect_right_in_float_alone("2-smoke", lines, "overdeep");
}

}  // namespace
}  // namespace touchstone
