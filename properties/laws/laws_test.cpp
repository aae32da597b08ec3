// The laws themselves: what they accept, and that each finds its fault. Causes of failures: which
// features meet, what is known, with what to start.
#include <cmath>
#include <gtest/gtest.h>
#include <rapidcheck.h>
#include <set>

#include "candidates/candidates.hpp"
#include "properties/arbitrary.hpp"
#include "properties/files/own_folder_test.hpp"
#include "properties/identity.hpp"
#include "properties/laws/check.hpp"
#include "properties/laws/failure_file.hpp"
#include "properties/moves.hpp"
#include "properties/simplify.hpp"
#include "reference/contact_of.hpp"
#include "reference/invalid_input.hpp"
#include "reference/random_bodies_test.hpp"

namespace touchstone {
namespace {

/// A standing cylinder 0.1 deep in a box's top, and its right answer.
Configuration standing() {
  return {Cylinder(1, 1), Pose({0, 0, 1.9}, {1, 0, 0, 0}), Box({2, 2, 1}), Pose()};
}

Answer contact(double distance, const Vec3& n = Vec3(0, 0, 1),
               const std::vector<Vec3>& points = {{0, 0, 0.95}}) {
  Answer a{};
  a.status = TS_CONTACT;
  a.signed_distance = distance;
  Eigen::Map<Vec3>(a.normal) = n;
  for (const Vec3& p : points) {
    ts_point& point = a.points[a.point_count++];
    Eigen::Map<Vec3>(point.position) = p;
    Eigen::Map<Vec3>(point.normal) = n;
    point.depth = -distance;
  }
  return a;
}

Answer none() {
  Answer a{};
  a.status = TS_NONE;
  return a;
}

std::string failure(const char* law, const std::vector<Answer>& answers) {
  const auto v = find_law(law).judge(standing(), answers, {});
  return v ? v->failure : "";
}

/// The right contact with points of other depths, halfway between surfaces that overlap by as much.
Answer with_depths(Answer a, const std::vector<double>& depths) {
  for (std::size_t i = 0; i < depths.size(); ++i) {
    a.points[i].depth = depths[i];
    a.points[i].position[2] = 1 - depths[i] / 2;
  }
  return a;
}

const std::vector<Vec3> triangle = {{1, 0, 0.95}, {-0.5, 0.8, 0.95}, {-0.5, -0.8, 0.95}};

TEST(Laws, SeeWhatTheyAreThereFor) {
  const Answer good = contact(-0.1, {0, 0, 1}, triangle);
  EXPECT_EQ(failure("answers", {good}), "");
  EXPECT_EQ(failure("answers", {contact(NAN)}), "not-finite");
  EXPECT_EQ(failure("answers", {contact(-0.1, {0, 0, 2})}), "wrong-normal");

  EXPECT_EQ(failure("agreement", {good}), "");
  EXPECT_EQ(failure("agreement", {none()}), "missed");
  EXPECT_EQ(failure("agreement", {contact(-0.09)}), "shallow");
  EXPECT_EQ(failure("agreement", {contact(-0.11)}), "overdeep");
  EXPECT_EQ(failure("agreement", {contact(-0.1, {1, 0, 0})}), "wrong-normal");

  EXPECT_EQ(failure("flip", {good, contact(-0.1)}), "");
  EXPECT_EQ(failure("flip", {good, contact(-0.101)}), "not-invariant");
  EXPECT_EQ(failure("flip", {good, contact(-0.1, {0, 0.6, 0.8})}), "not-invariant");
  EXPECT_EQ(failure("flip", {good, none()}), "not-invariant");
  EXPECT_EQ(failure("scale", {good, contact(-0.0125), contact(-0.8)}), "");
  EXPECT_EQ(failure("scale", {good, contact(-0.1), contact(-0.1)}), "not-invariant");

  std::vector<Answer> steps(7, good);
  EXPECT_EQ(failure("small-steps", steps), "");
  steps[4] = contact(-0.12);
  EXPECT_EQ(failure("small-steps", steps), "jump");

  EXPECT_EQ(failure("growth", {good, good, contact(-0.11)}), "");
  EXPECT_EQ(failure("growth", {good, contact(-0.09), good}), "shallow");
  EXPECT_EQ(failure("growth", {good, contact(-0.2), good}), "overdeep");

  EXPECT_EQ(failure("way-out", {good}), "");
  EXPECT_EQ(failure("way-out", {contact(-0.05)}), "shallow");
  EXPECT_EQ(failure("way-out", {contact(-0.2)}), "overdeep");

  EXPECT_EQ(failure("apart", {good, none()}), "");
  EXPECT_EQ(failure("apart", {good, contact(-0.01)}), "phantom");

  EXPECT_EQ(failure("points", {good}), "");
  EXPECT_EQ(failure("points", {contact(-0.1, {0, 0, 1}, {{3, 0, 0.95}})}), "off-body");
  EXPECT_EQ(failure("points", {contact(-0.1, {0, 0, 1}, {})}), "no-points");
  EXPECT_EQ(failure("points", {with_depths(good, {0, 0.05, 0})}), "shallow-points");
  EXPECT_EQ(failure("points", {with_depths(good, {0.1, 0.05, 0.11})}), "overdeep-points");
  EXPECT_EQ(failure("points", {with_depths(good, {0.1, -0.05, 0.1})}), "phantom-points");
  EXPECT_EQ(failure("points", {contact(-0.09)}), "");
  EXPECT_EQ(failure("agreement", {contact(-0.1, {0, 0, 1}, {})}), "");

  EXPECT_EQ(failure("manifold", {good}), "");
  EXPECT_EQ(failure("manifold", {contact(-0.1, {0, 0, 1}, {{0, 0, 0.95}})}), "few-points");

  std::vector<Answer> unseen(7, good);
  EXPECT_EQ(failure("hull", unseen), "");
  unseen[5] = contact(-0.1, {0, 0, 1}, {{-1, 0, 0.95}, {0.5, 0.8, 0.95}, {0.5, -0.8, 0.95}});
  EXPECT_EQ(failure("hull", unseen), "jump");
  unseen[5] = contact(-0.1, {0, 0.6, 0.8}, {{-1, 0, 0.95}});  // another of several normals
  EXPECT_EQ(failure("hull", unseen), "");

  EXPECT_EQ(failure("memory", {good, good, good, good, good}), "");
  EXPECT_EQ(failure("memory", {good, good, good, good, contact(std::nextafter(-0.1, 0))}),
            "not-invariant");
}

// A face that leans by a hair over a cap overlaps it in part: no point may lie on the rest, however
// little that rises. Those along the edge that is deepest hold all that there is.
TEST(Laws, ManifoldAsksForNoPointsWhereTheBodiesAreApart) {
  const Configuration c{Cylinder(1, 0x1.eb76e8p-2),
                        Pose({0, 0, 0x1.da30be68p-1}, {0x1p+24, 1, 0, 0}),
                        Box({1, 0x1p-2, 0x1.c8ea956p-2}), Pose()};
  const Vec3 normal = c.pose_a.rotation().col(2);
  const double depth = 3.818e-8, edge = -0.25, along = 0.96;
  const auto failure_with = [&](const std::vector<Vec3>& points) {
    const Answer a = contact(-depth, normal, points);
    const auto v = find_law("manifold").judge(c, {&a, 1}, {});
    return v ? v->failure : "";
  };
  const double z = 0x1.c8ea956p-2;
  EXPECT_EQ(
      failure_with({{-along, edge, z}, {along, edge, z}, {along, 0.07, z}, {-along, 0.07, z}}), "");
  EXPECT_EQ(failure_with({{-along, edge, z}}), "few-points");
}

// Scores are remembered, each for its own answer and bar.
TEST(Laws, TellAnswersAndBarsApart) {
  const Answer deep = contact(-0.1, {0, 0, 1}, triangle), shallow = contact(-0.09);
  const auto outcome = [](const Answer& answer, double tolerance) {
    return score_of(standing(), answer, {.tolerance = tolerance, .threshold = 0}).outcome;
  };
  for (int i = 0; i < 2; ++i) {
    EXPECT_EQ(outcome(deep, 1e-4), Outcome::agree);
    EXPECT_EQ(outcome(shallow, 1e-4), Outcome::shallow);
    EXPECT_EQ(outcome(shallow, 0.1), Outcome::agree);
    EXPECT_EQ(outcome(shallow, 1e-4), Outcome::shallow);
  }
  Answer other_depth = deep;  // but for the depth of a point
  other_depth.points[2].depth = 0.2;
  EXPECT_EQ(outcome(deep, 1e-4), Outcome::agree);
  EXPECT_EQ(outcome(other_depth, 1e-4), Outcome::overdeep_points);
}

// The same with and without the truth of where the way leads.
TEST(Laws, WayOutIsJudgedAtTheTolerance) {
  const double tolerance = Bar{}.tolerance;
  for (const double error : {0.0, 0.999, 0.9999999, 1.0000001, 1.001}) {
    for (const int sign : {-1, 1}) {
      const std::string found = failure("way-out", {contact(-0.1 + sign * error * tolerance)});
      EXPECT_EQ(found, error < 1 ? "" : sign > 0 ? "shallow" : "overdeep") << sign * error;
    }
  }
  // A wrong normal may lead out all the same.
  const double angle = 0.01;
  EXPECT_EQ(failure("way-out", {contact(-0.1, {std::sin(angle), 0, std::cos(angle)})}), "");
}

TEST(Laws, HintSeesAFlickerAndAHintThatMisleads) {
  const Law& law = find_law("hint");
  // Every face of the cube is as near as the cylinder's caps.
  const Configuration tied{Cylinder(1, 1), Pose(), Box({1, 1, 1}), Pose()};
  const auto judged = [&](const Configuration& c, const std::vector<Answer>& answers) {
    Bar bar;
    bar.threshold = law.threshold(c, bar);
    const auto v = law.judge(c, answers, bar);
    return v ? v->failure : "";
  };
  const Vec3 x = Vec3::UnitX(), z = Vec3::UnitZ();
  const Answer up = contact(-2, z), down = contact(-2, -z), side = contact(-2, x);
  EXPECT_EQ(judged(tied, {up, up, up, up}), "");
  EXPECT_EQ(judged(tied, {up, side, up, down}), "");
  EXPECT_EQ(judged(tied, {up, up, side, up}), "jump");
  EXPECT_EQ(judged(tied, {up, up, none(), up}), "missed");
  EXPECT_EQ(judged(tied, {up, up, up, contact(-2.1, -z)}), "overdeep");
  // An answer that is wrong without a hint breaks other laws.
  EXPECT_EQ(judged(tied, {up, none(), none(), none()}), "");
  EXPECT_EQ(judged(tied, {none()}), "");

  // One normal is the best: the hint decides nothing.
  const Answer good = contact(-0.1, z), wrong = contact(-0.1, x);
  EXPECT_EQ(judged(standing(), {good, good, good, good}), "");
  EXPECT_EQ(judged(standing(), {good, good, good, wrong}), "wrong-normal");
  EXPECT_EQ(judged(standing(), {good, good, wrong, good}), "wrong-normal");
  EXPECT_EQ(judged(standing(), {good, good, contact(-0.1, z, {{3, 0, 0.95}}), good}), "off-body");
  EXPECT_EQ(judged(standing(), {wrong, good, good, good}), "");
}

TEST(Laws, HintIsAskedOfTheNextFrameWithTheNormalAndItsOpposite) {
  const Law& law = find_law("hint");
  Bar bar;
  bar.threshold = law.threshold(standing(), bar);
  EXPECT_DOUBLE_EQ(bar.threshold, 0.5e-4);
  const auto frames = law.hinted_questions(standing(), contact(-0.1, {0, 0, 1}), bar);
  ASSERT_EQ(frames.size(), 3u);
  for (const HintedQuestion& f : frames) {
    EXPECT_DOUBLE_EQ(f.configuration.pose_a.position().z(), 1.9 - 1e-5);
  }
  EXPECT_FALSE(frames[0].previous_normal);
  EXPECT_EQ(*frames[1].previous_normal, Vec3(0, 0, 1));
  EXPECT_EQ(*frames[2].previous_normal, Vec3(0, 0, -1));
  EXPECT_TRUE(law.hinted_questions(standing(), none(), bar).empty());
}

TEST(Laws, HaveNamesThatAreFound) {
  for (const Law& law : all_laws()) EXPECT_EQ(&find_law(law.name), &law);
  EXPECT_THROW(find_law("gravity"), InvalidInput);
}

// As a rapidcheck property: RC_PARAMS sets the number of tries and the seed, failures shrink.
class ReferenceKeeps : public testing::TestWithParam<Pair> {};

TEST_P(ReferenceKeeps, EveryLaw) {
  CandidateProcess reference(find_candidate("reference"), 0);
  const auto& classes = pose_classes(GetParam());
  EXPECT_TRUE(rc::check([&](unsigned number) {
    const Configuration c = *configurations(GetParam(), classes[number % classes.size()]);
    for (const Law& law : all_laws()) {
      const auto violation = broken(law, c, reference, {});
      if (violation) RC_FAIL(law.name + ", " + violation->failure + ": " + violation->detail);
    }
  }));
}

INSTANTIATE_TEST_SUITE_P(, ReferenceKeeps, testing::ValuesIn(all_pairs), name_of_other);

std::vector<const Law*> every_law() {
  std::vector<const Law*> result;
  for (const Law& law : all_laws()) result.push_back(&law);
  return result;
}

TEST(Check, SimplifiesAFailureToOneThatFailsAlike) {
  CandidateProcess bullet(find_candidate("bullet"), 0);
  CheckOptions options;
  options.laws = {&find_law("agreement")};
  options.pairs = {Pair::box};
  options.classes = {"edge-cap"};
  options.count = 3;
  const auto results = check(bullet, options, [](auto, auto) {});
  ASSERT_EQ(results.size(), 1u);
  ASSERT_FALSE(results[0].failures.empty());
  for (const Failure& f : results[0].failures) {
    const Configuration met = make_configuration(parse_identity(f.identity));
    EXPECT_LT(complexity(f.configuration), complexity(met) / 4);
    const auto v = broken(find_law(f.law), f.configuration, bullet, options.bar);
    ASSERT_TRUE(v);
    EXPECT_EQ(v->failure, f.violation.failure);
  }
}

// What a user meets every day comes first, however small the numbers of an extreme pose are.
TEST(Check, TellsFailuresInEverydayPosesFirst) {
  CandidateProcess capsule(find_candidate("capsule"), 0);
  CheckOptions options;
  options.laws = {&find_law("agreement")};
  options.pairs = {Pair::plane, Pair::box};
  options.classes = {"general+coin", "general+deep", "edge-cap", "general+shallow"};
  options.count = 3;
  options.by_features = true;
  const auto results = check(capsule, options, [](auto, auto) {});
  std::set<Group> groups;
  const auto expect_ordered = [&](const std::vector<Failure>& failures) {
    for (std::size_t i = 0; i < failures.size(); ++i) {
      groups.insert(group_met(failures[i]).value());
      if (i == 0 || failures[i].law != failures[i - 1].law) continue;
      EXPECT_LE(order_of(group_met(failures[i - 1])), order_of(group_met(failures[i])))
          << failures[i].identity;
    }
  };
  for (const LawResult& result : results) expect_ordered(result.failures);
  expect_ordered(in_order(results));
  EXPECT_TRUE(groups.contains(Group::everyday) && groups.contains(Group::extreme));
}

/// All that a run of `check` tells, as text.
std::string told(const std::vector<LawResult>& results) {
  std::string text;
  for (const LawResult& r : results) {
    text += r.law + ' ' + pair_name(r.pair) + ' ' + std::to_string(r.tried) + ' ' +
            std::to_string(r.broken) + '\n';
    for (const auto& [failure, count] : r.counts) text += failure + std::to_string(count) + '\n';
    for (const Failure& f : r.failures) {
      text += f.identity + ' ' + std::to_string(f.met) + ' ' + f.features + ' ' +
              f.violation.detail + '\n';
    }
  }
  return text;
}

TEST(Check, WorkersDoNotChangeTheResult) {
  CheckOptions options;
  options.laws = every_law();
  options.pairs = {Pair::sphere, Pair::box};
  options.classes = {"general+shallow", "edge-cap"};
  options.count = 20;  // more than one chunk
  options.by_features = true;
  const auto result_with = [&](unsigned workers) {
    options.workers = workers;
    CandidateProcess bullet(find_candidate("bullet"), 0);
    std::uint64_t most = 0, all = 0;
    const auto results = check(bullet, options, [&](std::uint64_t done, std::uint64_t of) {
      most = std::max(most, done);
      all = of;
    });
    EXPECT_EQ(all, 60u);
    EXPECT_EQ(most, all);
    return told(results);
  };
  const std::string alone = result_with(1);
  EXPECT_NE(alone.find("off-body"), std::string::npos) << alone;
  EXPECT_EQ(result_with(2), alone);
  EXPECT_EQ(result_with(5), alone);
}

// What a law finds does not depend on the laws beside it.
TEST(Check, LawsFindTogetherWhatEachFindsAlone) {
  const auto laws = every_law();
  int found = 0;
  for (const char* name : {"bullet", "ode", "reference"}) {
    CandidateProcess candidate(find_candidate(name), 0);
    for (const Pair pair : all_pairs) {
      for (std::uint64_t i = 0; i < 4; ++i) {
        const Configuration c = make_configuration({pair, "general+shallow", 3, i});
        const auto together = broken_in_session(laws, c, candidate, {});
        for (std::size_t law = 0; law < laws.size(); ++law) {
          const auto alone = broken(*laws[law], c, candidate, {});
          EXPECT_EQ(together[law] ? together[law]->failure : "", alone ? alone->failure : "")
              << name << ' ' << pair_name(pair) << ' ' << i << ' ' << laws[law]->name;
          found += alone.has_value();
        }
      }
    }
  }
  EXPECT_GT(found, 3);
}

// If bodies are so large, small or far away that rounding would decide, the laws that move them do
// not apply; the others do, and no number overflows.
TEST(Check, HoldsHostileConfigurationsToTheLawsThatApply) {
  CandidateProcess reference(find_candidate("reference"), 0);
  CheckOptions options;
  options.laws = every_law();
  options.pairs = {Pair::sphere};  // the quickest
  options.classes = {"hostile"};
  options.count = 400;
  std::uint64_t all = 0, moved = 0;
  for (const LawResult& result : check(reference, options, [](auto, auto) {})) {
    if (result.law == "answers") all = result.tried;
    if (result.law == "rotation") moved = result.tried;
    for (const Failure& f : result.failures) {
      ADD_FAILURE() << f.law << ", " << f.identity << ": " << f.violation.detail;
    }
  }
  EXPECT_EQ(all, options.count);
  EXPECT_GT(moved, options.count / 2);
  EXPECT_LT(moved, options.count);
}

/// Adds the plug-in once.
void add_sabotage() {
  [[maybe_unused]] static const bool added =
      (add_file(TOUCHSTONE_TEST_PLUGINS "/touchstone-sabotage.so"), true);
}

TEST(Corpus, APairThatIsNotSupportedAnyMoreIsNotFixed) {
  add_sabotage();  // supports no boxes
  const Failure f{"agreement",
                  "misdeed:5",
                  "1",
                  "cylinder-box/edge-cap/1/0",
                  make_configuration({Pair::box, "edge-cap", 1, 0}),
                  {"missed", 0.5, "far off"},
                  {1e-4, 0},
                  {},
                  {}};
  const auto replayed = replay({f}, {});
  EXPECT_EQ(replayed.at(0).result, ReplayedFailure::Result::changed);
  EXPECT_EQ(replayed.at(0).now, "unsupported");
}

// Where a configuration is not answered, nothing else is asked about it.
TEST(Check, ACrashIsAFailureOfTheLawAnswersAlone) {
  add_sabotage();
  CandidateProcess crashing(find_candidate("misdeed:2"), 0, {10, 256});
  const Configuration c = make_configuration({Pair::sphere, "general-shallow", 1, 0});
  const auto laws = every_law();
  const auto in_session = broken_in_session(laws, c, crashing, {});
  for (std::size_t i = 0; i < laws.size(); ++i) {
    for (const auto& v : {broken(*laws[i], c, crashing, {}), in_session[i]}) {
      EXPECT_EQ(v ? v->failure : "", laws[i]->name == "answers" ? "crashed" : "") << laws[i]->name;
    }
  }
}

// A session that has been asked forty questions breaks every law; a new one does not.
TEST(Check, AFailureThatNeedsEarlierQuestionsIsNone) {
  add_sabotage();
  CandidateProcess tiring(find_candidate("tiring"), 0);
  CheckOptions options;
  options.laws = {&find_law("agreement"), &find_law("translation")};
  options.pairs = {Pair::plane};
  options.classes = {"general+shallow"};
  options.count = 40;
  int seen = 0;
  for (std::uint64_t i = 0; i < options.count; ++i) {
    const Configuration c = make_configuration({Pair::plane, "general+shallow", 1, i});
    for (const auto& v : broken_in_session(options.laws, c, tiring, options.bar))
      seen += v.has_value();
  }
  EXPECT_GT(seen, 5);
  for (const LawResult& result : check(tiring, options, [](auto, auto) {})) {
    EXPECT_EQ(result.tried, options.count);
    EXPECT_EQ(result.broken, 0u) << result.law;
    EXPECT_TRUE(result.failures.empty()) << result.law;
  }
}

// After five failures in a row a command is asked no more, but what a law asks about one
// configuration must not hide another one's violation.
TEST(Check, ACommandIsAskedAboutEveryConfigurationThatALawIsTriedOn) {
  const std::string script = R"(
import os, sys
sys.path.insert(0, ')" TOUCHSTONE_CLIENTS R"(')
from touchstone_candidate import Candidate, run
class Far(Candidate):
    name, version, settings = "dies-far-away", "1", "answers none, and ends beyond x = 150"
    pairs = ("cylinder-sphere",)
    def prepare(self, a, b, threshold, parameter):
        return True
    def query(self, prepared, pose_a, pose_b, hint):
        if pose_a.position[0] > 150:
            os._exit(1)
        return None
run(Far)
)";
  const OwnFolder own;
  add_command("/usr/bin/python3 -B " + own.with("dies_far_away.py", script).string());
  CandidateProcess candidate(find_candidate("dies-far-away"), 0);
  Law moved{"moved", "", [](const Configuration&) { return true; }, {}, {}};
  moved.questions = [](const Configuration& c, const Bar&) {
    const Pose far(c.pose_a.position() + Vec3(100, 0, 0));
    return std::vector<Configuration>{{c.a, far, c.b, c.pose_b}};
  };
  moved.judge = [](const Configuration&, std::span<const Answer>, const Bar&) {
    return std::optional(Violation{"not-invariant", 1, ""});
  };
  const Law* law = &moved;
  constexpr std::size_t dying = 6, count = 10;
  std::vector<Configuration> configurations;
  for (std::size_t i = 0; i < count; ++i) {
    const double x = i < dying ? 100 : 10;
    configurations.push_back({Cylinder(1, 1), Pose(Vec3(x, 0, 0)), Sphere(1), Pose()});
  }
  const auto found = broken_in_session({&law, 1}, configurations, candidate, {});
  for (std::size_t i = 0; i < count; ++i) EXPECT_EQ(found[i][0].has_value(), i >= dying) << i;
}

TEST(Moves, LeaveTheGeometryAsTheySay) {
  for (const Pair pair : all_pairs) {
    const Configuration c = make_configuration({pair, "general-shallow", 4, 1});
    const double distance = oracle::truth(c).signed_distance.midpoint();
    const auto near = [&](const Configuration& other, double expected) {
      EXPECT_NEAR(oracle::truth(other).signed_distance.midpoint(), expected,
                  1e-13 * larger_size(c));
    };
    near(rotated(c, Eigen::Quaterniond(1, 2, 3, 4).normalized()), distance);
    near(translated(c, {1, -2, 3}), distance);
    near(spun(c, 1.3), distance);
    near(flipped(c), distance);
    near(scaled(c, 4), 4 * distance);
    if (pair == Pair::cylinder) near(exchanged(c), distance);
  }
}

std::string features(Pair pair, const char* pose_class) {
  return meeting_features(make_configuration({pair, pose_class, 1, 0}));
}

TEST(MeetingFeatures, AreThoseThatTheArrangementMakes) {
  EXPECT_EQ(features(Pair::plane, "standing"), "cap-plane");
  EXPECT_EQ(features(Pair::plane, "lying"), "side-plane");
  EXPECT_EQ(features(Pair::box, "side-on-face"), "side-face");
  EXPECT_EQ(features(Pair::box, "cap-on-face-centred"), "cap-face");
  EXPECT_EQ(features(Pair::box, "rim-face"), "rim-face");
  EXPECT_EQ(features(Pair::cylinder, "rim-rim"), "rim-rim");
  EXPECT_EQ(features(Pair::capsule, "cap-end"), "cap-end");
  EXPECT_EQ(features(Pair::sphere, "side"), "side-sphere");
}

TEST(MeetingFeatures, AreThoseOfAnExactPoseTurnedByRounding) {
  EXPECT_EQ(features(Pair::box, "side-on-face+turned"), "side-face");
  EXPECT_EQ(features(Pair::box, "side-on-face+tilted-1e-9"), "side-face");
}

TEST(MeetingFeatures, OfTiedNormalsAreTied) {
  const Configuration ball_in_can{Cylinder(1, 2), Pose(), Sphere(0.1), Pose()};
  EXPECT_EQ(meeting_features(ball_in_can), "tied");
}

CheckOptions options(const std::vector<const char*>& laws) {
  CheckOptions o;
  for (const char* law : laws) o.laws.push_back(&find_law(law));
  o.pairs = {Pair::box};
  o.classes = {"rim-face", "edge-cap", "edge-side"};
  o.count = 3;
  o.by_features = true;
  return o;
}

std::vector<LawResult> failures_of_bullet(const std::vector<const char*>& laws) {
  CandidateProcess bullet(find_candidate("bullet"), 0);
  return check(bullet, options(laws), [](auto, auto) {});
}

TEST(Causes, EachHasOneFailureWithItsOwnFeaturesAndAllAreCounted) {
  const auto results = failures_of_bullet({"agreement"});
  ASSERT_EQ(results.size(), 1u);
  std::set<Cause> causes;
  std::uint64_t met = 0;
  for (const Failure& f : results[0].failures) {
    EXPECT_TRUE(causes.insert(cause_of(f)).second) << to_string(cause_of(f));
    EXPECT_EQ(cause_of(f).features, f.features) << "simplified into something else";
    met += f.met;
  }
  EXPECT_GE(causes.size(), 2u);
  EXPECT_EQ(met, results[0].broken);
}

TEST(Causes, KnownOnesAreNotNew) {
  const auto results = failures_of_bullet({"agreement"});
  std::vector<Failure> known = in_order(results);
  EXPECT_EQ(new_ones(results, known).at(0).broken, 0u);
  EXPECT_TRUE(new_ones(results, known).at(0).failures.empty());
  EXPECT_EQ(new_ones(results, known).at(0).known, results[0].counts);
  const Failure missing = known.back();
  known.pop_back();
  const LawResult left = new_ones(results, known).at(0);
  ASSERT_EQ(left.failures.size(), 1u);
  EXPECT_EQ(cause_of(left.failures[0]), cause_of(missing));
  EXPECT_EQ(left.broken, missing.met);
  EXPECT_EQ(left.counts.at(missing.violation.failure), missing.met);
  std::uint64_t of_known = 0;
  for (const auto& [failure, count] : left.known) of_known += count;
  EXPECT_EQ(of_known, results[0].broken - missing.met);
  // Of another law it is another cause.
  for (Failure& f : known) f.law = "points";
  EXPECT_EQ(new_ones(results, known).at(0).broken, results[0].broken);
}

TEST(Causes, StartWithTheFirstLawAndItsMostFrequentOne) {
  const auto all = in_order(failures_of_bullet({"points", "agreement"}));
  ASSERT_GE(all.size(), 2u);
  EXPECT_EQ(all.front().law, "agreement");
  for (std::size_t i = 1; i < all.size(); ++i) {
    if (all[i].law == all[i - 1].law) {
      EXPECT_LE(all[i].met, all[i - 1].met);
    }
  }
}

}  // namespace
}  // namespace touchstone
