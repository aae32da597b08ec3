// The second oracle beside the first, and its certificates: of every pair, judged by
// oracle/check_certificate.py, which shares nothing with us.
//
// TOUCHSTONE_COUNT sets how many configurations of each class are certified; by default, for CI,
// one of every fourth class.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sstream>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "candidates/candidates.hpp"
#include "oracle/first_touch.hpp"
#include "oracle/rounded.hpp"
#include "oracle/truth.hpp"
#include "properties/casts.hpp"
#include "properties/files/configuration_json.hpp"
#include "properties/files/own_folder_test.hpp"
#include "properties/identity.hpp"
#include "properties/numbers.hpp"
#include "reference/random_bodies_test.hpp"
#include "reports/solve.hpp"

namespace touchstone {
namespace {

using nlohmann::json;
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

constexpr double width = 1e-30;
constexpr audit::Budget budget{width, 4000};

std::vector<Identity> identities(Pair pair) {
  const char* text = std::getenv("TOUCHSTONE_COUNT");
  const std::uint64_t count = text ? std::strtoull(text, nullptr, 10) : 1;
  const std::size_t step = text ? 1 : 16;
  std::vector<Identity> result;
  for (std::size_t k = 0; k < pose_classes(pair).size(); k += step) {
    for (std::uint64_t i = 0; i < count; ++i) {
      result.push_back({pair, pose_classes(pair)[k], 20261121, i});
    }
  }
  return result;
}

/// Writes certificates of a pair into a folder, all of which the checker accepts in the end.
class Certificates : public testing::TestWithParam<Pair> {
 protected:
  void TearDown() override {
    std::istringstream lines(printed_by(TOUCHSTONE_PYTHON " " TOUCHSTONE_CHECKER " " +
                                        folder_.path.string() + "/*.json 2>&1"));
    std::size_t count = 0;
    for (std::string line; std::getline(lines, line); ++count) {
      EXPECT_THAT(line, HasSubstr(".json: accepted: "));
    }
    EXPECT_EQ(count, count_);
  }

  void write(const std::string& certificate) {
    folder_.with(std::to_string(count_++) + ".json", certificate);
  }
  audit::Certificate certify(const Configuration& c, const audit::Budget& spent = budget) {
    audit::Certificate proof = audit::certify(c, spent);
    write(certificate_json(proof, c));
    return proof;
  }
  /// The certificate encloses the truth; returns how widely.
  mpq_class certify_truth(const Configuration& c) {
    const audit::Certificate proof = certify(c);
    const oracle::Enclosure truth = oracle::truth(c).signed_distance;
    EXPECT_LE(proof.lo, truth.hi);
    EXPECT_GE(proof.hi, truth.lo);
    return proof.hi - proof.lo;
  }
  std::size_t count() const { return count_; }

 private:
  const OwnFolder folder_;
  std::size_t count_ = 0;
};
/// Of bodies whose sizes are set to such lengths.
class CertificatesOfExtremes : public Certificates {};

// oracle/check_certificate_test.py and oracle/forge_certificates.py hold what must be rejected.
TEST_P(Certificates, AreAcceptedAndEncloseTheTruth) {
  for (const Identity& id : identities(GetParam())) {
    SCOPED_TRACE(to_string(id));
    const Configuration c = make_configuration(id);
    const mpq_class found = certify_truth(c);
    const std::string pose_class = id.pose_class.name();
    if (pose_class == "general+shallow" || pose_class == "general+apart" ||
        pose_class == "general+deep") {
      EXPECT_LE(found, mpq_class(width) * mpq_class(larger_size(c)));
    }
  }
}

TEST_P(Certificates, OfRoundedBodiesAreAcceptedAndEncloseTheTruth) {
  constexpr double parts[] = {0.25, 1};
  for (const Identity& id : identities(GetParam())) {
    SCOPED_TRACE(to_string(id));
    certify_truth(rounded_by(make_configuration(id), parts[count() % 2], parts[count() / 2 % 2]));
  }
}

TEST_P(Certificates, OfCastsAreAcceptedAndEndAtTheTouch) {
  const Vec3 spins[] = {Vec3::Zero(), {0.3, -0.5, 0.7}};
  for (const CastMotion& motion : cast_motions()) {
    for (std::uint64_t i = 0; i < 2; ++i) {
      const CastIdentity id{{GetParam(), "general+apart", 20261121, i}, &motion};
      SCOPED_TRACE(to_string(id));
      const auto [c, translation] = make_cast(id);
      const Sweep sweep(translation, spins[i]);
      const oracle::FirstTouch truth = oracle::first_touch(c, sweep);
      if (truth.status == oracle::FirstTouch::Status::from_start) continue;
      const audit::CastCertificate proof = audit::certify_cast(c, sweep);
      // One that grazes may be as near as that without a touch.
      EXPECT_TRUE(proof.pair || truth.status == oracle::FirstTouch::Status::never);
      EXPECT_LE(proof.apart.back().until, truth.fraction.hi);
      const double next_to = sweep.turns() ? 1e-12 : 1e-14;
      EXPECT_LE(proof.distance.get_d(),
                next_to * (larger_size(c) + c.pose_a.position().norm() +
                           c.pose_b.position().norm() + translation.norm()));
      write(certificate_json(proof, c, sweep));
    }
  }
  EXPECT_GE(count(), 5u);
}

TEST_P(CertificatesOfExtremes, OfTheSmallestAndLargestLengthsAreAccepted) {
  for (const char* pose_class : {"general-deep", "general-shallow", "general-separated"}) {
    // Lengths between 2^-8 and 2^4 become denormal, or reach the largest doubles.
    for (const int exponent : {-1066, -1020, 1000, 1019}) {
      Numbers numbers = numbers_of(make_configuration({GetParam(), pose_class, 20261122, 0}));
      scale_both(numbers, exponent);
      certify(configuration_of(numbers));
    }
  }
}

TEST_P(CertificatesOfExtremes, OfMixedExtremesAreAccepted) {
  // 1e308 beside 5e-324 in every place, one after the other, and apart by more than all doubles.
  const json flat =
      to_json(make_configuration({GetParam(), "general-deep", 20261122, 0})).flatten();
  for (const auto& [pointer, value] : flat.items()) {
    if (!value.is_number()) continue;
    for (const double extreme : {5e-324, 1e308, 1.7e308}) {
      json changed = flat;
      changed[pointer] = extreme;
      if (pointer == "/pose_a/position/0") changed["/pose_b/position/0"] = -extreme;
      if (pointer == "/b/radius" && changed.contains("/b/half_length")) {
        changed["/b/half_length"] = extreme;
      }
      certify(configuration_from_json(changed.unflatten()).configuration, {1e-6, 400});
    }
  }
}

INSTANTIATE_TEST_SUITE_P(, Certificates, testing::ValuesIn(all_pairs), name_of_other);
INSTANTIATE_TEST_SUITE_P(, CertificatesOfExtremes, testing::ValuesIn(all_pairs), name_of_other);

}  // namespace
}  // namespace touchstone
