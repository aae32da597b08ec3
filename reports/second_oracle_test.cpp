// The second oracle beside the first, and its certificates: of every pair, judged by
// oracle/check_certificate.py, which shares nothing with us; and with one thing wrong.
//
// TOUCHSTONE_COUNT sets how many configurations of each class are certified; by default, for CI,
// one of every fourth class.
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <map>
#include <sstream>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "candidates/candidates.hpp"
#include "oracle/truth.hpp"
#include "properties/files/configuration_json.hpp"
#include "properties/identity.hpp"
#include "reports/solve.hpp"

namespace touchstone {
namespace {

using nlohmann::json;
using testing::HasSubstr;
namespace fs = std::filesystem;

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

class Folder {
 public:
  Folder() {
    std::string name = (fs::temp_directory_path() / "certificates-XXXXXX").string();
    if (mkdtemp(name.data()) == nullptr) throw std::runtime_error("no temporary folder");
    path_ = name;
  }
  ~Folder() { fs::remove_all(path_); }
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;

  void write(const std::string& name, const std::string& certificate) const {
    std::ofstream(path_ / (name + ".json")) << certificate;
  }

  /// What the checker says about each file, by name.
  std::map<std::string, std::string> verdicts() const {
    const std::string command =
        std::string(TOUCHSTONE_PYTHON " " TOUCHSTONE_CHECKER " ") + path_.string() + "/*.json 2>&1";
    FILE* pipe = popen(command.c_str(), "r");
    std::map<std::string, std::string> result;
    char buffer[1024];
    while (fgets(buffer, sizeof buffer, pipe) != nullptr) {
      const std::string line = buffer;
      const auto end = line.find(".json: ");
      if (end == std::string::npos) {
        ADD_FAILURE() << line;
        continue;
      }
      result[fs::path(line.substr(0, end)).filename()] = line.substr(end + 7);
    }
    exit_code_ = WEXITSTATUS(pclose(pipe));
    return result;
  }
  int exit_code() const { return exit_code_; }

 private:
  fs::path path_;
  mutable int exit_code_ = -1;
};

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

/// Another last digit of the numerator.
std::string with_another_digit(std::string fraction) {
  const auto slash = fraction.find('/');
  char& digit = fraction[(slash == std::string::npos ? fraction.size() : slash) - 1];
  digit = digit == '9' ? '8' : static_cast<char>(digit + 1);
  return fraction;
}

json with_changed_pose_digit(json certificate, std::size_t which) {
  json& pose = certificate["exact"][which % 2 ? "pose_a" : "pose_b"];
  json& number = which % 4 < 2 ? pose["position"][which % 3] : pose["orientation"][which % 4];
  number = with_another_digit(number);
  return certificate;
}

/// One end moved inwards by a thousandth of the width.
json with_narrowed_end(json certificate, int end) {
  json& ends = certificate["signed_distance"];
  const mpq_class lo(ends[0].get<std::string>()), hi(ends[1].get<std::string>());
  mpq_class moved = end == 0 ? lo : hi;
  moved += (end == 0 ? 1 : -1) * (hi - lo) / 1000;
  ends[static_cast<std::size_t>(end)] = moved.get_str();
  return certificate;
}

json with_a_cell_less(json certificate, std::size_t which) {
  if (!certificate.contains("cells")) {
    certificate.erase("pair");
    return certificate;
  }
  json& cells = certificate["cells"];
  cells.erase(which % cells.size());
  return certificate;
}

/// A cell's point of A three times as far from A's centre: outside.
json with_a_point_outside(json certificate, std::size_t which) {
  const bool has_cells = certificate.contains("cells");
  json& entry =
      has_cells ? certificate["cells"][which % certificate["cells"].size()] : certificate["pair"];
  for (json& x : entry["a"]) x = mpq_class(mpq_class(x.get<std::string>()) * 1000).get_str();
  return certificate;
}

class Certificates : public testing::TestWithParam<Pair> {};

TEST_P(Certificates, AreAcceptedAndEveryChangeIsRejected) {
  const Folder good, bad;
  std::size_t number = 0;
  for (const Identity& id : identities(GetParam())) {
    SCOPED_TRACE(to_string(id));
    const Configuration c = make_configuration(id);
    const audit::Certificate proof = audit::certify(c, budget);
    const oracle::Enclosure truth = oracle::truth(c).signed_distance;
    EXPECT_LE(proof.lo, truth.hi);
    EXPECT_GE(proof.hi, truth.lo);
    const std::string pose_class = id.pose_class.name();
    if (pose_class == "general+shallow" || pose_class == "general+apart" ||
        pose_class == "general+deep") {
      EXPECT_LE(proof.hi - proof.lo, mpq_class(width) * mpq_class(larger_size(c)));
    }
    const json certificate = json::parse(certificate_json(proof, c));
    const std::string name = pose_class + "-" + std::to_string(id.index);
    good.write(name, certificate.dump());
    bad.write(name + " pose", with_changed_pose_digit(certificate, number).dump());
    bad.write(name + " lower", with_narrowed_end(certificate, 0).dump());
    bad.write(name + " upper", with_narrowed_end(certificate, 1).dump());
    bad.write(name + " cell", with_a_cell_less(certificate, 7 * number).dump());
    bad.write(name + " point", with_a_point_outside(certificate, 7 * number).dump());
    ++number;
  }
  const auto accepted = good.verdicts();
  EXPECT_EQ(good.exit_code(), 0);
  EXPECT_EQ(accepted.size(), number);
  for (const auto& [name, verdict] : accepted) {
    EXPECT_THAT(verdict, testing::StartsWith("accepted: ")) << name;
  }
  const auto rejected = bad.verdicts();
  EXPECT_EQ(bad.exit_code(), 1);
  EXPECT_EQ(rejected.size(), 5 * number);
  const std::map<std::string, std::string> reasons = {
      {"pose", "two forms of the input"},
      {"lower", "gap along the normal is below lo|no multiple"},
      {"upper", "hi does not bound cell|farther apart than hi|no multiple"},
      {"cell", "do not cover all directions|certificate.cells is missing"},
      {"point", "point outside body a"}};
  for (const auto& [name, verdict] : rejected) {
    EXPECT_THAT(verdict, testing::StartsWith("rejected: ")) << name;
    EXPECT_THAT(verdict, testing::ContainsRegex(reasons.at(name.substr(name.rfind(' ') + 1))))
        << name;
  }
}

TEST_P(Certificates, DoNotHoldForAPoseOneUlpAway) {
  // Both forms of the input changed alike: only the proof can tell.
  const Folder folder;
  const std::size_t count = 10;
  for (std::uint64_t i = 0; i < count; ++i) {
    const Configuration c = make_configuration({GetParam(), "general-deep", 20261121, i});
    const audit::Certificate proof = audit::certify(c, budget);
    Vec3 position = c.pose_a.position();
    for (double& x : position) x = std::nextafter(x, HUGE_VAL);
    const Configuration moved{c.a, Pose(position, c.pose_a.orientation()), c.b, c.pose_b};
    folder.write(std::to_string(i), certificate_json(proof, moved));
  }
  const auto verdicts = folder.verdicts();
  EXPECT_EQ(verdicts.size(), count);
  for (const auto& [name, verdict] : verdicts) {
    EXPECT_THAT(verdict, testing::StartsWith("rejected: ")) << name;
  }
}

/// The configuration with every length times 2^exponent.
Configuration scaled(const Configuration& c, int exponent) {
  const json unscaled = to_json(c);
  json result = unscaled;
  const auto scale = [&](const std::string& pointer) {
    json& number = result.at(json::json_pointer(pointer));
    number = std::ldexp(number.get<double>(), exponent);
  };
  for (const std::string body : {"a", "b"}) {
    for (const auto& [name, value] : unscaled[body].items()) {
      if (name == "shape" || name == "normal") continue;
      for (std::size_t i = 0; i < value.size() && value.is_array(); ++i) {
        scale("/" + body + "/" + name + "/" + std::to_string(i));
      }
      if (value.is_number()) scale("/" + body + "/" + name);
    }
    for (const char* i : {"0", "1", "2"}) scale("/pose_" + body + "/position/" + i);
  }
  return configuration_from_json(result).configuration;
}

TEST_P(Certificates, OfTheSmallestAndLargestLengthsAreAccepted) {
  const Folder folder;
  std::size_t count = 0;
  for (const char* pose_class : {"general-deep", "general-shallow", "general-separated"}) {
    // Lengths between 2^-8 and 2^4 become denormal, or reach the largest doubles.
    for (const int exponent : {-1066, -1020, 1000, 1019}) {
      const Configuration c =
          scaled(make_configuration({GetParam(), pose_class, 20261122, 0}), exponent);
      folder.write(pose_class + std::to_string(exponent),
                   certificate_json(audit::certify(c, budget), c));
      ++count;
    }
  }
  const auto verdicts = folder.verdicts();
  EXPECT_EQ(folder.exit_code(), 0);
  EXPECT_EQ(verdicts.size(), count);
  for (const auto& [name, verdict] : verdicts) {
    EXPECT_THAT(verdict, testing::StartsWith("accepted: ")) << name;
  }
}

TEST_P(Certificates, OfMixedExtremesAreAccepted) {
  // 1e308 beside 5e-324 in every place, one after the other, and apart by more than all doubles.
  const Folder folder;
  std::size_t count = 0;
  const json base = to_json(make_configuration({GetParam(), "general-deep", 20261122, 0}));
  const json flat = base.flatten();
  for (const auto& [pointer, value] : flat.items()) {
    if (!value.is_number()) continue;
    for (const double extreme : {5e-324, 1e308, 1.7e308}) {
      json changed = flat;
      changed[pointer] = extreme;
      if (pointer == "/pose_a/position/0") changed["/pose_b/position/0"] = -extreme;
      if (pointer == "/b/radius" && changed.contains("/b/half_length")) {
        changed["/b/half_length"] = extreme;
      }
      const Configuration c = configuration_from_json(changed.unflatten()).configuration;
      folder.write(std::to_string(count++), certificate_json(audit::certify(c, {1e-6, 400}), c));
    }
  }
  const auto verdicts = folder.verdicts();
  EXPECT_EQ(folder.exit_code(), 0);
  EXPECT_EQ(verdicts.size(), count);
  for (const auto& [name, verdict] : verdicts) {
    EXPECT_THAT(verdict, testing::StartsWith("accepted: ")) << name;
  }
}

INSTANTIATE_TEST_SUITE_P(, Certificates, testing::ValuesIn(all_pairs), [](const auto& pair) {
  return std::string(pair_name(pair.param)).substr(std::string("cylinder-").size());
});

}  // namespace
}  // namespace touchstone
