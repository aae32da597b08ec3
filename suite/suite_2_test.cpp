// touchstone-suite-2, its contacts: that the committed files are those that `touchstone export
// --suite-2` writes, exact in single precision, and that readers allow floats what they cost.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <map>
#include <sstream>

#include "properties/files/given_text.hpp"
#include "properties/named.hpp"
#include "suite/gaps_test.hpp"

namespace touchstone {
namespace {

using nlohmann::json;

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
  const auto expect_float = [](const std::string& cell) {
    const double x = parse_double(cell).value();
    EXPECT_EQ(static_cast<double>(static_cast<float>(x)), x) << cell;
  };
  for (const SuiteFile& file : suite_2_files()) {
    const std::string csv = unpacked(name_of(file));
    for (const std::string_view name : split(touchstone_suite::columns_of_bodies, ',')) {
      if (name == "id" || name == "group" || name == "shape_b" || name.empty()) continue;
      for (const std::string& cell : column(csv, std::string(name))) expect_float(cell);
    }
    for (const std::string& cell : column(csv, "vertices_b")) {
      if (cell == "none") continue;
      for (const std::string_view vertex : split(cell, ';')) {
        for (const std::string_view x : split(vertex, ' ')) expect_float(std::string(x));
      }
    }
    for (const std::string& cell : column(csv, "contact")) ++contacts[cell];
    for (const std::string& cell : column(csv, "ties")) ++ties[cell];
    for (const std::string& cell : column(csv, "shape_b")) ++shapes[cell];
  }
  EXPECT_EQ(contacts.size(), 3u);
  EXPECT_EQ(ties.size(), 3u);
  for (const auto& [shape, count] : shapes) EXPECT_EQ(count, 100) << shape;
}

/// An answer that is wrong in double precision by what single precision is allowed.
TEST(Readers, AllowRoutinesInFloatWhatFloatsCost) {
  const SuiteFile& file = suite_2_files().front();
  std::ostringstream lines;
  std::vector<touchstone_suite::Answer> given;
  std::vector<touchstone_suite::Case> required;
  std::istringstream in(unpacked(name_of(file)));
  for (const auto& c : touchstone_suite::read(in)) {
    if (c.contact != "required" || touchstone_suite::in_float(c).contact != "required") continue;
    const double distance = c.signed_distance - (c.max_regret + c.float_tolerance) / 2;
    given.push_back({"contact", distance, c.normal, {{0, 0, 0, -distance}}});
    required.push_back(c);
    lines << json{{"id", c.id},
                  {"status", "contact"},
                  {"signed_distance", distance},
                  {"normal", {c.normal[0], c.normal[1], c.normal[2]}},
                  {"points", {{{"position", {0, 0, 0}}, {"depth", -distance}}}}}
          << '\n';
  }
  ASSERT_GT(given.size(), 10u);
  for (const bool single : {false, true}) {
    const std::string right = single ? "agree" : "overdeep";
    for (std::size_t i = 0; i < given.size(); ++i) {
      const auto& c = required[i];
      EXPECT_EQ(verdict(single ? in_float(c) : c, given[i]), right) << c.id;
    }
    const std::string suite = (single ? "--float " : "") + suite_file(name_of(file));
    const std::vector<std::string> expected(given.size(), right);
    EXPECT_THAT(verdicts_of_judges(suite, lines.str()), testing::Each(expected));
  }
}

}  // namespace
}  // namespace touchstone
