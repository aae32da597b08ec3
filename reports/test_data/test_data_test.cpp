// What export writes: the limits of a right answer, and files that others read as what they mean.
#include "reports/test_data/test_data.hpp"

#include <array>
#include <cmath>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <map>
#include <sstream>

#include <nlohmann/json.hpp>

#include "oracle/patch/contact_patch.hpp"
#include "properties/files/configuration_json.hpp"
#include "properties/files/given_text.hpp"
#include "properties/files/own_folder_test.hpp"
#include "properties/files/strict_json.hpp"
#include "reference/invalid_input.hpp"

namespace touchstone {
namespace {

using nlohmann::json;

/// Every shape, ties of every kind, contacts of every kind.
Campaign few(unsigned workers = 1) {
  Campaign c;
  c.pairs.assign(std::begin(all_pairs), std::end(all_pairs));
  c.classes = {"touching", "concentric", "general-deep", "general+apart", "recorded"};
  c.count = 9;
  c.seed = 3;
  c.workers = workers;
  return c;
}

std::vector<TestDatum> data(const Campaign& campaign) {
  std::vector<TestDatum> result;
  make_test_data(campaign, [&](const TestDatum& d) { result.push_back(d); });
  return result;
}

std::string file_of(const std::vector<TestDatum>& data, TestDataFormat format,
                    CsvColumns columns = CsvColumns::all) {
  const auto writer = test_data_writer(format, columns);
  std::string text;
  for (const TestDatum& d : data) text += writer->add(d);
  return text + writer->finish();
}

TEST(TestData, ComesInOrderWhateverTheWorkers) {
  const auto one = data(few(1)), three = data(few(3));
  ASSERT_EQ(one.size(), 9u * cells(few()).size());
  EXPECT_EQ(file_of(one, TestDataFormat::json_lines), file_of(three, TestDataFormat::json_lines));
  for (std::size_t i = 0; i < one.size(); ++i) EXPECT_EQ(one[i].identity, identities(few())[i]);
}

TEST(TestData, TheErrorOfTheMidpointReachesBothEnds) {
  for (const TestDatum& d : data(few())) {
    const auto& [lo, hi] = d.truth.signed_distance;
    const mpq_class middle(d.truth.signed_distance.midpoint());
    const mpq_class error(midpoint_error(d.truth.signed_distance));
    EXPECT_TRUE(middle - error <= lo && hi <= middle + error) << to_string(d.identity);
    EXPECT_LE(error, abs(middle) * mpq_class(0x1p-52)) << to_string(d.identity);
  }
}

/// The truth itself as an answer.
ts_answer right_answer(const TestDatum& d) {
  ts_answer a{};
  a.status = TS_CONTACT;
  a.signed_distance = d.truth.signed_distance.midpoint();
  for (int i = 0; i < 3; ++i) a.normal[i] = d.truth.normals.front().n[i];
  a.point_count = 1;
  const Vec3 middle = oracle::contact_patch(d.configuration, d.truth.normals.front()).centroid();
  for (int i = 0; i < 3; ++i) a.points[0].position[i] = middle[i];
  a.points[0].depth = -a.signed_distance;
  return a;
}

/// A point within both bodies, where no depth of its own can be too little for it; between them if
/// they are apart. Projects on one and the other in turns, which converges for convex bodies.
Vec3 point_in_both(const Configuration& c, Vec3 p) {
  const double step = 1e-6 * error_size(c, Bar{});
  const auto project = [&](const Shape& shape, const Pose& pose) {
    const auto distance = [&](const Vec3& at) { return point_distance(shape, pose, at); };
    const double outside = distance(p);
    if (!(outside > 0)) return;
    Vec3 gradient;
    for (int i = 0; i < 3; ++i) {
      const Vec3 along = step * Vec3::Unit(i);
      gradient[i] = (distance(p + along) - distance(p - along)) / (2 * step);
    }
    p -= outside * gradient;
  };
  constexpr int max_turns = 100;
  for (int turn = 0; turn < max_turns; ++turn) project(c.a, c.pose_a), project(c.b, c.pose_b);
  return p;
}

TEST(TestData, LimitsAreThoseAtWhichScoresChange) {
  for (const double threshold : {0.0, 0.01}) {
    Campaign campaign = few();
    campaign.bar.threshold = threshold;
    for (const TestDatum& d : data(campaign)) {
      const AnswerLimits& l = d.limits;
      // Next to each limit by a hundredth of what is allowed.
      const double step = l.max_regret / 100;
      const auto outcome = [&](double AnswerLimits::*limit, double by) {
        ts_answer a = right_answer(d);
        if (limit == &AnswerLimits::min_point_depth) {
          const Vec3 middle(a.points[0].position), n(a.normal);
          const bool is_inside = d.truth.signed_distance.midpoint() < 0;
          const Vec3 p = is_inside ? point_in_both(d.configuration, middle) : middle;
          a.points[a.point_count++] = {{p.x(), p.y(), p.z()}, {n.x(), n.y(), n.z()}, l.*limit + by};
        } else {
          a.signed_distance = l.*limit + by;
        }
        return score(d.configuration, d.truth, a, campaign.bar).outcome;
      };
      ts_answer none{};
      none.status = TS_NONE;
      const bool may_miss = agrees(score(d.configuration, d.truth, none, campaign.bar).outcome);
      EXPECT_EQ(may_miss, l.contact != AnswerLimits::Contact::required);
      if (l.contact == AnswerLimits::Contact::forbidden) {
        EXPECT_EQ(outcome(&AnswerLimits::min_distance, step), Outcome::phantom);
        continue;
      }
      const std::string id = to_string(d.identity);
      EXPECT_EQ(outcome(&AnswerLimits::min_distance, step), Outcome::agree) << id;
      EXPECT_EQ(outcome(&AnswerLimits::min_distance, -step), Outcome::overdeep) << id;
      EXPECT_EQ(outcome(&AnswerLimits::max_distance, -step), Outcome::agree) << id;
      EXPECT_EQ(outcome(&AnswerLimits::max_distance, step), Outcome::shallow) << id;
      EXPECT_EQ(outcome(&AnswerLimits::min_point_depth, step), Outcome::agree) << id;
      EXPECT_EQ(outcome(&AnswerLimits::min_point_depth, -step), Outcome::phantom_points) << id;
    }
  }
}

TEST(JsonLinesOfTestData, AreReadBySolveToTheLastBit) {
  const auto all = data(few());
  std::istringstream in(file_of(all, TestDataFormat::json_lines));
  JsonLines lines(in);
  for (const TestDatum& d : all) {
    ASSERT_TRUE(lines.next());
    const json line = lines.parse();
    EXPECT_EQ(line["id"], to_string(d.identity));
    EXPECT_EQ(to_hex_json(configuration_from_json(line["configuration"]).configuration),
              to_hex_json(d.configuration));
    EXPECT_EQ(line["signed_distance"].get<double>(), d.truth.signed_distance.midpoint());
    EXPECT_EQ(line["limits"]["max_distance"].get<double>(), d.limits.max_distance);
    EXPECT_EQ(line["truth"]["normals"].size(), line["truth"]["patch"].size());
  }
  EXPECT_FALSE(lines.next());
}

std::vector<std::string> split(const std::string& text, char separator) {
  std::vector<std::string> parts;
  std::istringstream in(text);
  for (std::string part; std::getline(in, part, separator);) parts.push_back(part);
  return parts;
}

TEST(CsvOfTestData, GivesTheSameDoublesBack) {
  const auto all = data(few());
  const auto rows = split(file_of(all, TestDataFormat::csv), '\n');
  ASSERT_EQ(rows.size(), all.size() + 1);
  const auto header = split(rows[0], ',');
  for (std::size_t i = 0; i < all.size(); ++i) {
    const auto row = split(rows[i + 1], ',');
    ASSERT_EQ(row.size(), header.size());
    std::map<std::string, std::string> cells;
    for (std::size_t k = 0; k < row.size(); ++k) cells[header[k]] = row[k];
    const TestDatum& d = all[i];
    const auto number = [&](const char* name) { return *parse_double(cells.at(name)); };
    EXPECT_EQ(cells["id"], to_string(d.identity));
    EXPECT_EQ(number("radius_a"), d.configuration.a.radius());
    EXPECT_EQ(number("position_a_z"), d.configuration.pose_a.position().z());
    EXPECT_EQ(number("orientation_b_w"), d.configuration.pose_b.orientation().w());
    EXPECT_EQ(number("orientation_b_z"), d.configuration.pose_b.orientation().z());
    EXPECT_EQ(number("min_distance"), d.limits.min_distance);
    const std::size_t normals = d.truth.normals.size();
    for (const char* list : {"normal", "patch_kind", "patch_area", "patch_centroid"}) {
      EXPECT_EQ(split(cells.at(list), ';').size(), normals) << list;
    }
  }
}

TEST(CsvOfTestData, OfTheSuiteHasNoNumbersOfPatches) {
  const std::string text = file_of(data(few()), TestDataFormat::csv, CsvColumns::suite);
  EXPECT_THAT(text.substr(0, text.find('\n')), testing::EndsWith(",normal,patch_kind"));
}

TEST(NumPyOfTestData, IsReadByNumPy) {
  const auto all = data(few());
  const OwnFolder folder;
  const auto file = folder.with("data.npz", file_of(all, TestDataFormat::npz));
  const char* const script = R"(
import sys, numpy
d = numpy.load(sys.argv[1])
first = d["first_normal"]
for i in range(len(d["id"])):
    numbers = [d["radius_a"][i], *d["position_a"][i], *d["orientation_b"][i], *d["size_b"][i],
               d["signed_distance"][i], d["max_regret"][i],
               *d["normal"][first[i]:first[i + 1]].ravel()]
    kinds = d["patch_kind"][first[i]:first[i + 1]]
    print(d["id"][i], d["ties"][i], ";".join(kinds), *(float(x).hex() for x in numbers))
)";
  const auto lines =
      split(printed_by(TOUCHSTONE_PYTHON " " + folder.with("read.py", script).string() + " " +
                       file.string()),
            '\n');
  ASSERT_EQ(lines.size(), all.size());
  const auto csv = split(file_of(all, TestDataFormat::csv), '\n');
  for (std::size_t i = 0; i < all.size(); ++i) {
    const TestDatum& d = all[i];
    const auto words = split(lines[i], ' ');
    EXPECT_EQ(words[0], to_string(d.identity));
    std::vector<double> expected = {d.configuration.a.radius()};
    const auto add = [&](const auto& v) { expected.insert(expected.end(), v.begin(), v.end()); };
    add(d.configuration.pose_a.position());
    const auto& q = d.configuration.pose_b.orientation();
    add(std::array{q.w(), q.x(), q.y(), q.z()});
    const std::size_t sizes = expected.size();
    expected.resize(sizes + 4);
    const auto cells = split(csv[i + 1], ',');
    for (std::size_t k = 0; k < 4; ++k) expected[sizes + k] = *parse_double(cells[12 + k]);
    add(std::array{d.truth.signed_distance.midpoint(), d.limits.max_regret});
    for (const auto& normal : d.truth.normals) {
      add(Vec3(
          (normal.n.array().abs() < 1e-30).select(0, normal.n)));  // as docs/your-poses.md says
    }
    ASSERT_EQ(words.size(), 3 + expected.size());
    for (std::size_t k = 0; k < expected.size(); ++k) {
      EXPECT_EQ(std::strtod(words[3 + k].c_str(), nullptr), expected[k]) << lines[i];
    }
  }
}

TEST(TestDataFormats, AreNamed) {
  EXPECT_EQ(parse_test_data_format("npz", "--format"), TestDataFormat::npz);
  EXPECT_THROW(parse_test_data_format("txt", "--format"), InvalidInput);
}

}  // namespace
}  // namespace touchstone
