#include "reports/stability/stability.hpp"

#include <fstream>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <numeric>
#include <set>
#include <sstream>

#include <nlohmann/json.hpp>

#include "candidates/candidates.hpp"
#include "oracle/patch/convex_set.hpp"
#include "properties/files/configuration_json.hpp"
#include "properties/motions/motion.hpp"
#include "reference/invalid_input.hpp"
#include "reports/stability/measure.hpp"
#include "reports/stability/step_change.hpp"

namespace touchstone {
namespace {

using nlohmann::json;

Study study(const std::vector<std::string>& names, unsigned workers = 2) {
  Study s;
  s.candidates = find_candidates(names);
  s.workers = workers;
  return s;
}

/// A few of everything.
StabilityOptions small(const Study& of) {
  StabilityOptions options = brief(of, {Pair::plane, Pair::capsule}, 3);
  options.ladder.cells = {{Pair::plane, "standing"}, {Pair::capsule, "coaxial"}};
  options.ladder.count = 2;
  options.grid.stride = 8;
  options.steps = 10;
  return options;
}

TEST(Stability, DoesNotDependOnTheNumberOfWorkers) {
  EXPECT_EQ(json_text(measure(small(study({"reference", "bullet", "ode"}, 1)))),
            json_text(measure(small(study({"reference", "bullet", "ode"}, 3)))));
}

TEST(Stability, SmallStepsStartInEveryClassThatTouchesOrIsAlignedExactly) {
  std::set<std::string> names;
  for (const Cell& cell : degenerate_cells({Pair::box})) names.insert(cell.pose_class);
  for (const char* name : {"parallel-side", "touching", "touching-tilted"}) {
    EXPECT_EQ(names.count(name), 1u) << name;
  }
}

/// "Done when": the depth of our routines changes by no more than a step allows, on every rung of
/// every degenerate class.
TEST(Stability, OurDepthIsAmplifiedByNoMoreThanTheStepAllows) {
  Ladder ladder{degenerate_cells({std::begin(all_pairs), std::end(all_pairs)}), 5, 3};
  const Amplification result = amplification(ladder, study({"reference"}));
  EXPECT_EQ(result.results.size(), ladder.cells.size());
  for (const Amplification::Row& row : result.results) {
    EXPECT_THAT(row.unanswered, testing::Each(0));
    EXPECT_THAT(row.missed, testing::Each(0));
  }
  EXPECT_FALSE(result.worst.empty());
  for (const Amplification::WorstStep& step : result.worst) {
    if (step.measure != "amplification") continue;
    EXPECT_LE(step.value, 1 + 1e-9) << step.from << " to " << step.to;
  }
}

/// "Done when": no missed contact in any map; and no other failure either.
TEST(Stability, OurMapsAreOfOneColour) {
  std::vector<const CriticalPose*> poses;
  for (const CriticalPose& pose : critical_poses()) poses.push_back(&pose);
  MapGrid grid{{}, 4};
  for (const int exponent : {-15, -12, -8, -4, -2}) grid.zooms.emplace_back(exponent);
  const FailureMaps result = maps(poses, grid, study({"reference"}));
  EXPECT_EQ(result.poses.size(), poses.size());
  for (const FailureMaps::Pose& pose : result.poses) {
    ASSERT_EQ(pose.pictures.size(), 1u);
    for (const std::string& letters : pose.pictures[0].letters) {
      EXPECT_EQ(letters, std::string(81, '.')) << pose.name;
    }
  }
}

TEST(Stability, OurMotionsAreAsSmoothAsTheTruth) {
  std::vector<const Motion*> all;
  for (const Motion& motion : motions()) all.push_back(&motion);
  const Sequences result = sequences(all, 40, study({"reference"}));
  EXPECT_EQ(result.motions.size(), all.size());
  for (const Sequences::Course& course : result.motions) {
    const Sequences::Row& ours = course.results.at(0);
    EXPECT_EQ(ours.missed, 0) << course.motion;
    EXPECT_EQ(ours.wrong, 0) << course.motion;
    ASSERT_TRUE(ours.jump && ours.amplification);
    EXPECT_LT(ours.jump->value, 1e-14) << course.motion;
    EXPECT_LE(*ours.amplification, 1 + 1e-9) << course.motion;
  }
}

template <class Row>
const Row& row_of(const std::vector<Row>& rows, const std::string& candidate) {
  for (const Row& row : rows) {
    if (row.candidate == candidate) return row;
  }
  throw std::out_of_range(candidate);
}

/// A candidate that is wrong in a known way at known places.
TEST(Stability, ColoursALineHeldByOnePoint) {
  // ODE has two points under a lying cylinder, one between parallel sides.
  const FailureMaps result =
      maps({&find_critical_pose("lying"), &find_critical_pose("parallel-sides")},
           {{Decade(-12)}, 8}, study({"ode"}));
  const auto middle = [&](std::size_t pose) {
    return result.poses.at(pose).pictures.at(0).letters.at(0).at(12);
  };
  EXPECT_EQ(middle(0), '.');
  EXPECT_EQ(middle(1), 'f');
}

TEST(Stability, WritesMapsInRunLengths) {
  const FailureMaps maps{1, {Decade(-8)}, {{"lying", "", "", "", "", {{"x", {"mmm..f......"}}}}}};
  const json written = to_json(Stability{{"x"}, 0, 0, {}, maps, {}})["maps"];
  EXPECT_EQ(written["poses"][0]["results"][0]["maps"], json({"3m2.f6."}));
  EXPECT_EQ(written["zooms"], json({"1e-8"}));
  EXPECT_EQ(written["letters"]["m"], "missed");
}

TEST(Stability, MeasuresAJumpThatTheStepDoesNotExplain) {
  // libccd's EPA, which MuJoCo calls, ends at another depth at every tiny step.
  const Amplification result =
      amplification(subject(parse_identity("cylinder-sphere/concentric-aligned/1/0")), 1, 3,
                    study({"reference", "mujoco"}));
  EXPECT_LT(row_of(result.results, "reference").jump, 1e-14);
  EXPECT_GT(row_of(result.results, "mujoco").jump, 0.01);
  EXPECT_EQ(result.worst.at(0).candidate, "mujoco");
  EXPECT_GT(result.worst.at(0).value, 1e6);
}

TEST(Stability, ReplaysItsWorstSteps) {
  const Amplification result = measure(small(study({"bullet"}))).amplification.value();
  ASSERT_FALSE(result.worst.empty());
  auto bullet = start(find_candidates({"bullet"}), Bar{}.threshold);
  for (const Amplification::WorstStep& step : result.worst) {
    const auto poses = examine_poses(
        {given_configuration(step.from).configuration, given_configuration(step.to).configuration},
        bullet, Bar{});
    const StepChange change = step_change(poses[0], poses[1], 0, Bar{}).value();
    const double value =
        step.measure == "amplification" ? change.amplification : change.hull_excess.value();
    EXPECT_EQ(value, step.value) << step.measure << " from " << step.from << " to " << step.to;
  }
}

TEST(Stability, CountsACandidateThatDies) {
  add_file(std::filesystem::path(TOUCHSTONE_TEST_PLUGINS) / "touchstone-sabotage.so");
  StabilityOptions options = small(study({"sabotage", "reference"}));
  options.parts = {StabilityPart::amplification};
  options.ladder.cells = {{Pair::capsule, "coaxial"}};
  options.ladder.count = 6;
  const Stability result = measure(options);
  const auto& unanswered = row_of(result.amplification->results, "sabotage").unanswered;
  const int sum = std::accumulate(unanswered.begin(), unanswered.end(), 0);
  EXPECT_GT(sum, 0);
  EXPECT_LT(sum, 6 * 16);
  // Who else is asked makes no difference.
  StabilityOptions alone = options;
  alone.study = study({"reference"});
  EXPECT_EQ(to_json(measure(alone))["amplification"]["results"][0],
            to_json(result)["amplification"]["results"][1]);
}

TEST(StabilityTable, IsNoWiderThanATerminal) {
  std::istringstream lines(
      stability_table(measure(small(study({"reference", "bullet-float-margin-0"})))));
  for (std::string line; std::getline(lines, line);) {
    if (line.find(" replay ") != std::string::npos) continue;  // never broken: to be copied
    EXPECT_LE(line.size(), 80u) << line;
  }
}

TEST(StabilityFiles, HoldTheResultAsData) {
  const auto folder = std::filesystem::path(testing::TempDir()) / "stability";
  write_stability({{"ode"}, 1e-4, 0, {}, {}, Sequences{}}, "</script>x", folder);
  std::ifstream file(folder / "stability.json"), page(folder / "stability.html");
  const json written = json::parse(file);
  EXPECT_EQ(written["schema"], "touchstone-stability-1");
  EXPECT_EQ(written["command"], "</script>x");
  EXPECT_EQ(written["candidates"], json({"ode"}));
  EXPECT_EQ(written["sequences"]["steps"], 0);
  EXPECT_FALSE(written.contains("maps"));
  const std::string text{std::istreambuf_iterator<char>(page), {}};
  EXPECT_THAT(text, testing::HasSubstr("\\u003c/script>x"));
}

using oracle::ContactPatch;
using oracle::ConvexSet;

constexpr double rounding = 1e-15;

ContactPatch level(double height, const ConvexSet& set) {
  return {{{0, 0, height}, {1, 0, 0}, {0, 1, 0}}, set};
}
ConvexSet square(double side, double x) {
  return ConvexSet::polygon({{x, 0}, {x + side, 0}, {x + side, side}, {x, side}});
}

TEST(Movement, OfAShiftIsItsLength) {
  EXPECT_NEAR(movement(level(0, square(1, 0)), level(0, square(1, 0.25))), 0.25, rounding);
  EXPECT_NEAR(movement(level(0, square(1, 0)), level(0.5, square(1, 0))), 0.5, rounding);
}

TEST(Movement, OfAnUnchangedSetIsZero) {
  const ConvexSet disc = ConvexSet::region({oracle::Side::arc({1, 2}, 0.5, 0, 2 * M_PI)});
  EXPECT_NEAR(movement(level(1, disc), level(1, disc)), 0, rounding);
}

TEST(Movement, CountsWhicheverSetReachesFarther) {
  const ContactPatch point = level(0, ConvexSet::point({0, 0}));
  const ContactPatch segment = level(0, ConvexSet::segment({-1, 0}, {3, 0}));
  EXPECT_NEAR(movement(point, segment), 3, rounding);
  EXPECT_NEAR(movement(segment, point), 3, rounding);
}

TEST(Movement, IsMeasuredInSpaceBetweenDifferentPlanes) {
  const ContactPatch upright{{{0, 0, 0}, {0, 1, 0}, {0, 0, 1}}, ConvexSet::segment({0, 0}, {0, 2})};
  EXPECT_NEAR(movement(level(0, ConvexSet::point({0, 0})), upright), 2, rounding);
}

ts_answer answered(std::initializer_list<Vec3> points) {
  ts_answer a{};
  a.status = TS_CONTACT;
  a.normal[2] = 1;
  for (const Vec3& p : points) {
    for (int i = 0; i < 3; ++i) a.points[a.point_count].position[i] = p[i];
    ++a.point_count;
  }
  return a;
}

TEST(HullOfPoints, IsWhatThePointsSpan) {
  const ContactPatch hull = hull_of_points(
      answered({{1, 1, 5}, {3, 1, 5}, {2, 1.5, 5}, {3, 3, 5}, {1, 3, 5}, {1, 1, 5}}));
  EXPECT_NEAR(hull.area(), 4, 1e-14);
  EXPECT_LT((hull.centroid() - Vec3(2, 2, 5)).norm(), 1e-14);
  EXPECT_EQ(hull_of_points(answered({{1, 2, 3}})).kind(), ContactPatch::Kind::point);
  EXPECT_EQ(hull_of_points(answered({{1, 2, 3}, {2, 2, 3}})).kind(), ContactPatch::Kind::segment);
}

// An alternating contact: the point goes from one end of a line to the other.
TEST(HullOfPoints, MovesAsFarAsAPointJumps) {
  EXPECT_NEAR(movement(hull_of_points(answered({{-0.045, 0, 0}})),
                       hull_of_points(answered({{0.045, 0, 0}}))),
              0.09, rounding);
}

}  // namespace
}  // namespace touchstone
