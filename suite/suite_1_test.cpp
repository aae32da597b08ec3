// touchstone-suite-1: that the committed file is the one that `touchstone export --suite` writes,
// and covers what it says.
#include <filesystem>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <set>

#include "properties/files/disk.hpp"
#include "properties/named.hpp"
#include "suite/gaps_test.hpp"

namespace touchstone {
namespace {

std::vector<TestDatum> data_of(Campaign campaign) {
  campaign.workers = 2;
  std::vector<TestDatum> result;
  make_test_data(campaign, [&](const TestDatum& datum) { result.push_back(datum); });
  return result;
}

TEST(Suite1, IsWhatExportWritesToTheByteAndReadersKnowTheRegretOfAnyNormal) {
  const std::string committed = unpacked("1");
  const auto made = data_of(suite_1());
  EXPECT_TRUE(csv_of(made, CsvColumns::suite) == committed);
  EXPECT_LT(std::filesystem::file_size(suite_file("1")), 1500000u) << "too large for a repository";
  expect_gaps_of_all_readers(made, committed);
}

TEST(Suite1, HasEveryPoseClassAndEveryKindOfAnswer) {
  const std::string csv = unpacked("1");
  std::set<std::string> classes;
  for (const std::string& id : column(csv, "id")) {
    const auto parts = split(id, '/');
    classes.insert(std::string(parts[0]) + '/' + std::string(parts[1]));
  }
  std::size_t count = 0;
  for (const Pair pair : all_pairs) count += pose_classes(pair, Coverage::suite_1).size();
  EXPECT_EQ(classes.size(), count);
  const auto kinds = [&](const std::string& name) {
    const auto cells = column(csv, name);
    return std::set<std::string>(cells.begin(), cells.end()).size();
  };
  EXPECT_EQ(kinds("group"), std::size(all_groups));
  EXPECT_EQ(kinds("contact"), 3u);
  EXPECT_EQ(kinds("ties"), 3u);
}

/// The suite's planes all have unit normals, so that these are not in it.
TEST(Readers, KnowPlanesWhoseNormalsHaveAnyLength) {
  Campaign planes = suite_1();
  planes.pairs = {Pair::plane};
  std::vector<TestDatum> made;
  for (const TestDatum& d : data_of(planes)) {
    const Plane& plane = std::get<Plane>(d.configuration.b);
    if (plane.unit_displacement() == 0) continue;
    TestDatum& longer = made.emplace_back(d);
    longer.configuration.b = Plane(4 * plane.normal(), 4 * plane.displacement());
  }
  ASSERT_GT(made.size(), 100u);
  // With the suite's columns alone it would have to be the whole suite.
  expect_gaps_of_all_readers(made, csv_of(made, CsvColumns::all));
}

TEST(Suites, HaveTheChecksumsThatAreWrittenDown) {
  const std::string sums = read_file(TOUCHSTONE_SUITE "/SHA256SUMS", "file");
  EXPECT_EQ(sums,
            printed_by("cd " TOUCHSTONE_SUITE " && for f in 1 2-smoke 2-everyday 2-hard 2-casts; do"
                       " f=touchstone-suite-$f; sha256sum $f.csv.gz;"
                       " gzip -dc $f.csv.gz | sha256sum | sed \"s/-$/$f.csv/\"; done"));
  EXPECT_THAT(read_file(TOUCHSTONE_SUITE "/README.md", "file"),
              testing::HasSubstr(sums.substr(0, 64)));
}

}  // namespace
}  // namespace touchstone
