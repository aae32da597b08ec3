// What the fuzzer's target does without libFuzzer: any bytes make a configuration, answers that are
// wrong are seen, and the corpus holds; and so does the hostile class.
//
// TOUCHSTONE_COUNT sets how many hostile configurations of each pair are tried; by default 2000.
#include "verification/fuzz/fuzz.hpp"

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>
#include <iterator>
#include <optional>
#include <random>
#include <set>
#include <vector>

#include "properties/identity.hpp"
#include "reference/random_bodies_test.hpp"

namespace touchstone {
namespace {

using Bytes = std::vector<std::uint8_t>;

Bytes random_bytes(std::mt19937& random) {
  Bytes bytes(random() % 180);
  for (std::uint8_t& byte : bytes) byte = static_cast<std::uint8_t>(random());
  return bytes;
}

TEST(FuzzBytes, AnyMakeAConfigurationOfEveryKind) {
  std::mt19937 random(1);
  std::set<Pair> pairs;
  int parallel = 0, equal = 0;
  for (int i = 0; i < 2000; ++i) {
    const Configuration c = configuration_from_bytes(random_bytes(random));
    pairs.insert(pair_of(c));
    parallel += std::abs(c.pose_a.axis().dot(c.pose_b.axis())) > 1 - 1e-15;
    equal += c.a.radius() == c.a.half_length();
  }
  EXPECT_EQ(pairs.size(), std::size(all_pairs));
  EXPECT_GT(parallel, 100);
  EXPECT_GT(equal, 100);
  EXPECT_EQ(pair_of(configuration_from_bytes({})), Pair::cylinder);
}

TEST(FuzzBytes, MostMakeBodiesThatMeetOrNearlyDo) {
  std::mt19937 random(2);
  int near = 0;
  constexpr int count = 2000;
  for (int i = 0; i < count; ++i) {
    const Configuration c = configuration_from_bytes(random_bytes(random));
    near += signed_distance(c).value < larger_size(c);
  }
  EXPECT_GT(near, count / 2);
}

/// A can 0.1 m deep in a box's top.
Configuration standing_can() {
  return {Cylinder(1, 1), Pose({0.3, 0.2, 1.9}, {1, 0, 0, 0}), Box({2, 2, 1}), Pose()};
}

TEST(FuzzDisagreement, SeesEveryWrongAnswer) {
  const Configuration c = standing_can();
  const oracle::Truth truth = oracle::truth(c);
  const OwnAnswers right = own_answers(c);
  EXPECT_FALSE(disagreement(c, right, &truth));
  const auto is_seen = [&](auto change) {
    OwnAnswers wrong = right;
    change(wrong);
    return disagreement(c, wrong, &truth).has_value();
  };
  EXPECT_TRUE(is_seen([](OwnAnswers& a) { a.distance.value += 1e-12; }));
  EXPECT_TRUE(is_seen([](OwnAnswers& a) { a.distance.value = NAN; }));
  EXPECT_TRUE(is_seen([](OwnAnswers& a) { a.overlaps = false; }));
  EXPECT_TRUE(is_seen([](OwnAnswers& a) { a.contact.clear_points(); }));
  EXPECT_TRUE(is_seen([](OwnAnswers& a) { a.contact.signed_distance = -0.2; }));
  EXPECT_TRUE(is_seen([](OwnAnswers& a) { a.contact.add_point({0, 0, 1}, 0.1 + 1e-11); }));
  EXPECT_TRUE(is_seen([](OwnAnswers& a) {
    a.contact.clear_points();
    a.contact.add_point({0, 0, 1}, 0.09);
  }));
  // Both distances alike, and wrong.
  EXPECT_TRUE(is_seen([](OwnAnswers& a) {
    a.distance.value = a.certified.value = a.contact.signed_distance += 1e-12;
  }));
  EXPECT_TRUE(is_seen([](OwnAnswers& a) { a.distance.normal = {1, 0, 0}; }));
  EXPECT_TRUE(is_seen([](OwnAnswers& a) { a.certified.error_bound = -1; }));
}

// The distance of two bodies of 1e-200, a thousand of their sizes apart, has a square that
// vanishes.
TEST(FuzzDisagreement, MeasuresTinyBodiesThatAreApartByTheirDistance) {
  const double size = 1e-200;
  const Configuration c{Cylinder(size, size), Pose({1e3 * size, 0, 0}, {1, 0, 0, 0}),
                        Cylinder(size, size), Pose()};
  OwnAnswers answers = own_answers(c);
  EXPECT_FALSE(disagreement(c, answers, nullptr));
  answers.distance.value += 5e-14 * 1e3 * size;
  EXPECT_FALSE(disagreement(c, answers, nullptr));
}

TEST(FuzzCorpus, HoldsNoDisagreement) {
  int count = 0;
  for (const auto& file : std::filesystem::directory_iterator(TOUCHSTONE_FUZZ_CORPUS)) {
    std::ifstream in(file.path(), std::ios::binary);
    const Bytes bytes(std::istreambuf_iterator<char>(in), {});
    const Configuration c = configuration_from_bytes(bytes);
    const oracle::Truth truth = oracle::truth(c);
    EXPECT_EQ(disagreement(c, own_answers(c), &truth), std::nullopt) << file.path();
    ++count;
  }
  EXPECT_GT(count, 10);
}

class HostileAnswers : public testing::TestWithParam<Pair> {};

// Against `certified_distance`; one in 500 against the truth, which takes a hundred times as long.
TEST_P(HostileAnswers, HoldNoDisagreement) {
  const char* const text = std::getenv("TOUCHSTONE_COUNT");
  const std::uint64_t count = text ? std::strtoull(text, nullptr, 10) : 2000;
  for (std::uint64_t i = 0; i < count; ++i) {
    const Identity id{GetParam(), "hostile", 23, i};
    const Configuration c = make_configuration(id);
    std::optional<oracle::Truth> truth;
    if (i % 500 == 0) truth = oracle::truth(c);
    EXPECT_EQ(disagreement(c, own_answers(c), truth ? &*truth : nullptr), std::nullopt)
        << to_string(id);
  }
}

INSTANTIATE_TEST_SUITE_P(, HostileAnswers, testing::ValuesIn(all_pairs), name_of_other);

}  // namespace
}  // namespace touchstone
