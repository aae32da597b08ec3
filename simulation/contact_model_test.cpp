#include "simulation/contact_model.hpp"

#include <cmath>
#include <gmock/gmock.h>
#include <limits>

#include "candidates/candidates.hpp"
#include "simulation/world.hpp"

namespace touchstone {
namespace {

Pose at(double x, double y, double z) { return {Vec3(x, y, z), Eigen::Quaterniond::Identity()}; }

Scene two_cans_on_the_ground() {
  Scene scene;
  scene.bodies = {{"ground", Plane(Vec3::UnitZ(), 0), 1000, {}, {}, {}, {}, true},
                  {"left", Cylinder(0.2, 0.3), 1000, {}, at(-1, 0, 0.29995)},
                  {"right", Cylinder(0.2, 0.3), 1000, {}, at(1, 0, 0.29995)}};
  return scene;
}

TEST(RecordingModel, KeepsWhatWasAskedWithTheNormalOfTheStepBefore) {
  CandidateProcess process(find_candidate("reference"), simulation_threshold);
  CandidateModel model(process);
  RecordingModel recording(model);
  World world(two_cans_on_the_ground(), recording);
  for (int i = 0; i < 3; ++i) world.step();
  ASSERT_EQ(recording.asked().size(), 6U);
  EXPECT_FALSE(recording.asked()[0].question.previous_normal.has_value());
  for (std::size_t i = 2; i < 6; ++i) {
    const PairQuestion& q = recording.asked()[i].question;
    ASSERT_TRUE(q.previous_normal.has_value());
    EXPECT_LT((*q.previous_normal - Vec3::UnitZ()).norm(), 1e-12);
    EXPECT_EQ(recording.asked()[i].answer.status, TS_CONTACT);
  }
}

TEST(PairwiseModel, AsksTheCandidateOfEachPair) {
  CandidateProcess reference(find_candidate("reference"), simulation_threshold);
  CandidateProcess capsule(find_candidate("capsule"), simulation_threshold);
  PairwiseModel model(
      [&](int a, int) -> CandidateProcess& { return a == 1 ? reference : capsule; });
  World world(two_cans_on_the_ground(), model);
  world.step();
  ASSERT_EQ(world.contacts().size(), 2U);
  EXPECT_EQ(world.contacts()[0].answer.point_count, 3);  // a cap
  EXPECT_EQ(world.contacts()[1].answer.point_count, 1);  // a round end
}

/// One point for every question, as a test wants it.
class MadeUpModel : public ContactModel {
 public:
  explicit MadeUpModel(const ts_point& point) : point_(point) {}
  void begin() override {}
  std::vector<Answer> answers(std::span<const PairQuestion> questions) override {
    Answer answer{};
    answer.status = TS_CONTACT;
    answer.point_count = 1;
    answer.points[0] = point_;
    return std::vector<Answer>(questions.size(), answer);
  }

 private:
  ts_point point_;
};

TEST(World, LeavesOutPointsThatAreNoNumbersAndCountsThem) {
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  for (const ts_point& point : {ts_point{{nan, 0, 0}, {0, 0, 1}, 0}, ts_point{{}, {0, 0, nan}, 0},
                                ts_point{{}, {0, 0, 0}, 0}, ts_point{{}, {0, 0, 1}, nan}}) {
    MadeUpModel model(point);
    World world(two_cans_on_the_ground(), model);
    world.step();
    EXPECT_EQ(world.unusable_points(), 2U);
    EXPECT_NEAR(world.states()[1].velocity.z(), -9.81 / 240, 1e-12);  // falls freely
  }
}

TEST(World, DoesNotStopWhatIsStillApart) {
  MadeUpModel model({{-1, 0, 0}, {0, 0, 1}, -1e-9});
  World world(two_cans_on_the_ground(), model);
  world.step();
  EXPECT_NEAR(world.states()[1].velocity.z(), -9.81 / 240, 1e-12);
}

TEST(World, EndsAnAbsurdMotion) {
  MadeUpModel model({{-1, 0, 0}, {0, 0, 1}, 1e9});
  World world(two_cans_on_the_ground(), model);
  world.step();
  world.step();
  EXPECT_FALSE(world.sound());
  EXPECT_TRUE(world.states()[1].pose.position().allFinite());
  world.step();
  EXPECT_NEAR(world.time(), 3.0 / 240, 1e-12);
}

}  // namespace
}  // namespace touchstone
