#include "reports/second_oracle.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sstream>

#include <nlohmann/json.hpp>

#include "candidates/candidates.hpp"
#include "reports/solve.hpp"

namespace touchstone {
namespace {

using testing::HasSubstr;

// 3-4-5 from the rim point (1, 0, 1) to the sphere's centre, less its radius: apart by 3.
const Configuration apart{Cylinder(1, 1), Pose(), Sphere(2),
                          Pose({4, 0, 5}, Eigen::Quaterniond::Identity())};
// Centre a quarter below the cap: −3/4.
const Configuration inside{Cylinder(2, 1), Pose(), Sphere(0.5),
                           Pose({0.5, 0, 0.75}, Eigen::Quaterniond::Identity())};

oracle::Enclosure shifted(const oracle::Enclosure& truth, double by) {
  return {truth.lo + mpq_class(by), truth.hi + mpq_class(by)};
}

TEST(Agreement, OfTheTwoOracles) {
  for (const auto& c : {apart, inside}) {
    EXPECT_NO_THROW(check_agreement(c, oracle::truth(c).signed_distance, audit::enclose(c)));
  }
}

TEST(Agreement, AShiftedTruthIsAContradictionEitherWay) {
  for (const auto& c : {apart, inside}) {
    const oracle::Enclosure truth = oracle::truth(c).signed_distance;
    const audit::Enclosure e = audit::enclose(c);
    for (const double by : {1e-8, -1e-8}) {
      EXPECT_THROW(check_agreement(c, shifted(truth, by), e), Contradiction) << by;
    }
  }
}

TEST(Agreement, APairCloserThanTheTruthIsAContradiction) {
  audit::Enclosure e = audit::enclose(apart);
  e.pair_distance = 2.5;
  EXPECT_THROW(check_agreement(apart, oracle::truth(apart).signed_distance, e), Contradiction);
}

TEST(Agreement, AContradictionShowsTheConfigurationToTheLastBit) {
  const Configuration c{Cylinder(0.1, 1), Pose(), Sphere(0.25), Pose()};
  try {
    check_agreement(c, shifted(oracle::truth(c).signed_distance, 1), audit::enclose(c));
    FAIL();
  } catch (const Contradiction& e) {
    EXPECT_THAT(e.what(), HasSubstr("\"radius\":\"0x1.999999999999ap-4\""));
  }
}

TEST(Agreement, SolveAddsTheSecondOraclesEnclosure) {
  const auto solved = [](const std::string& position) {
    std::istringstream in(
        R"({"a":{"shape":"cylinder","radius":1,"half_length":1},"b":{"shape":"sphere","radius":1},)"
        R"("pose_b":{"position":)" +
        position + "}}");
    std::ostringstream out;
    EXPECT_TRUE(solve(in, out, {.candidates = {}, .bar = {}, .audit = true}));
    return nlohmann::json::parse(out.str())["audit"];
  };
  const auto above = solved("[0,0,3]"), within = solved("[0.5,0,0.75]");
  EXPECT_NEAR(std::stod(above["signed_distance"][0].get<std::string>()), 1, 1e-9);
  EXPECT_NEAR(std::stod(above["signed_distance"][1].get<std::string>()), 1, 1e-9);
  EXPECT_GE(above["primal_dual_gap"].get<double>(), 0);
  EXPECT_LE(above["primal_dual_gap"].get<double>(), 1e-9);
  EXPECT_NEAR(std::stod(within["signed_distance"][1].get<std::string>()), -1.25, 1e-8);
  EXPECT_TRUE(within["primal_dual_gap"].is_null());
}

}  // namespace
}  // namespace touchstone
