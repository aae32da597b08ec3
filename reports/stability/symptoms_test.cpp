// What users report of contacts that change when nothing does, as numbers of the engines as they
// are here; docs/engines.md tells the same with sources. A new version that changes it should be
// noticed. All lengths are metres.
#include <cmath>
#include <functional>
#include <gtest/gtest.h>
#include <set>

#include "candidates/testing/plain_contacts.hpp"
#include "reports/stability/step_change.hpp"

namespace touchstone {
namespace {

/// Sixty poses, one small step apart, and what one candidate makes of them.
struct Walk {
  double largest_jump = 0;     ///< of the hull of the contact points, between neighbours
  int jumps = 0;               ///< steps at which it moves by more than a centimetre
  int changes = 0;             ///< steps that change the number of points
  int missed = 0;              ///< poses without a contact
  std::set<int> point_counts;  ///< of the contacts
};
constexpr int poses = 60;
constexpr double centimetre = 0.01;

Walk walk(const char* candidate, const std::function<Configuration(int)>& pose) {
  std::vector<Configuration> asked;
  for (int i = 0; i < poses; ++i) asked.push_back(pose(i));
  const std::vector<Answer> answers = process(find_candidate(candidate)).answers(asked);
  Walk result;
  for (int i = 0; i < poses; ++i) {
    const Answer& a = answers[static_cast<std::size_t>(i)];
    if (a.status != TS_CONTACT) {
      ++result.missed;
      continue;
    }
    result.point_counts.insert(a.point_count);
    if (i == 0 || answers[static_cast<std::size_t>(i - 1)].status != TS_CONTACT) continue;
    const Answer& before = answers[static_cast<std::size_t>(i - 1)];
    const double jump = movement(hull_of_points(before), hull_of_points(a));
    result.largest_jump = std::max(result.largest_jump, jump);
    result.jumps += jump > centimetre;
    result.changes += a.point_count != before.point_count;
  }
  return result;
}

/// A rotation by an angle in radians.
Quaternion turn(const Vec3& about, double angle) {
  return Quaternion(Eigen::AngleAxisd(angle, about));
}
/// Local z along x, with both numbers alike: exactly so but for rounding.
const Quaternion lying(std::sqrt(0.5), 0, std::sqrt(0.5), 0);
const Vec3 x = Vec3::UnitX(), y = Vec3::UnitY(), z = Vec3::UnitZ();

const Cylinder rod(0.03, 0.1), can(0.033, 0.06), battery(0.007, 0.025);
const Box table({0.5, 0.5, 0.05});
const Pose below({0, 0, -0.05}, upright);  // of a table with its top at z = 0

/// A rod lies on a table, half a millimetre deep, and slides along itself by 50 µm a step.
Configuration sliding_rod(int i) {
  return {rod, Pose({0.05 + 50e-6 * i, 0.02, 0.0295}, lying), table, below};
}
/// It rolls by a hundredth of a radian, a third of a millimetre, a step.
Configuration rolling_rod(int i) {
  const double angle = 0.01 * i;
  return {rod, Pose({0.05, 0.02 + 0.03 * angle, 0.0295}, turn(x, -angle) * lying), table, below};
}
/// It turns on the table by a tenth of a radian a step: its ends move by a centimetre.
Configuration turning_rod(int i) {
  return {rod, Pose({0.05, 0.02, 0.0295}, turn(z, 0.1 * i) * lying), table, below};
}
/// A can stands on a table, a millimetre deep, and leans by two microradians, another way each
/// time: no point of it moves by more than 0.3 µm.
Configuration leaning_can(int i) {
  const Quaternion lean(1, 1e-6 * std::cos(i), 1e-6 * std::sin(i), 0);
  return {can, Pose({0.1, 0.05, 0.059}, lean), table, below};
}
/// A can goes over from standing by a hundredth of a radian a step, on its rim, half a millimetre
/// deep.
Configuration tipping_can(int i) {
  const double angle = 0.01 * i;
  const double height = 0.06 * std::cos(angle) + 0.033 * std::sin(angle) - 0.0005;
  return {can, Pose({0.1, 0.05, height}, turn(y, angle)), table, below};
}
/// Two cans lie one upon the other, the upper tilted out of parallel by 0.2 mrad a step.
Configuration seesaw(int i) {
  return {can, Pose({0.01, 0, 0.0655}, turn(y, 2e-4 * (i - poses / 2)) * lying), can,
          Pose({0, 0, 0}, lying)};
}
/// A battery lies on a table, 0.2 mm deep, and turns by ten microradians a step.
Configuration turning_battery(int i) {
  return {battery, Pose({0.1, 0.05, 0.0068}, turn(z, 1e-5 * i) * lying), table, below};
}

// Ours, for comparison: nothing moves but as the bodies do.
TEST(Symptoms, AreNotOurs) {
  for (const auto& pose : {sliding_rod, rolling_rod, leaning_can, turning_battery}) {
    const Walk ours = walk("reference", pose);
    EXPECT_EQ(ours.missed, 0);
    EXPECT_EQ(ours.changes, 0);
    EXPECT_EQ(ours.point_counts.size(), 1u);
  }
  EXPECT_LT(walk("reference", sliding_rod).largest_jump, 51e-6);
  EXPECT_LT(walk("reference", rolling_rod).largest_jump, 0.00031);
  EXPECT_LT(walk("reference", turning_rod).largest_jump, 0.0101);
  EXPECT_EQ(walk("reference", tipping_can).missed, 0);
}

TEST(Symptoms, AContactJumpsNineCentimetresForAStepOf50Micrometres) {  // dart #3428
  const Walk bullet = walk("bullet-margin-0", sliding_rod);
  EXPECT_GT(bullet.largest_jump, 0.09);
  EXPECT_GT(bullet.jumps, 20);
  EXPECT_EQ(bullet.point_counts, std::set{1});
  EXPECT_GT(walk("fcl-distance", sliding_rod).largest_jump, 0.08);
}

TEST(Symptoms, OneContactAlternatesUnderALyingCylinder) {  // mujoco_warp #1555
  const Walk mujoco = walk("mujoco", rolling_rod);
  EXPECT_EQ(mujoco.point_counts, std::set{1});
  EXPECT_GT(mujoco.largest_jump, 0.15);  // of a rod of 0.2 m, from end to end
  EXPECT_GT(mujoco.jumps, 40);           // of 59 steps
}

TEST(Symptoms, ContactsChangeWithYaw) {  // genesis-world #3127
  for (const char* candidate : {"mujoco", "fcl", "libccd-mpr", "bullet"}) {
    const Walk w = walk(candidate, turning_rod);
    EXPECT_GT(w.largest_jump, 0.15) << candidate;
    EXPECT_GT(w.jumps, 10) << candidate;
  }
}

TEST(Symptoms, AContactJumpsCentimetresWhileTheBodyMovesAFractionOfAMicrometre) {
  // genesis-world #3245: 15 to 23 mm for 0.2 µm.
  const Walk bullet = walk("bullet", leaning_can);
  EXPECT_GT(bullet.largest_jump, 0.02);
  EXPECT_EQ(bullet.jumps, poses - 1);
  EXPECT_GT(walk("fcl-distance", leaning_can).largest_jump, 0.02);
}

TEST(Symptoms, ContactsOfARimAreMissed) {  // of a rounded edge, as in godot-jolt #516
  const Walk bullet = walk("bullet", tipping_can);
  EXPECT_GT(bullet.missed, 40);
  EXPECT_LT(bullet.missed, poses);  // not while it stands
  EXPECT_EQ(walk("bullet-margin-0", tipping_can).missed, 0);
}

TEST(Symptoms, BulletInSinglePrecisionMissesALyingBattery) {  // found here
  EXPECT_EQ(walk("bullet-float", turning_battery).missed, poses);
  EXPECT_EQ(walk("bullet", turning_battery).missed, 0);
}

TEST(Symptoms, TheNumberOfPointsFlickers) {
  // gz-physics and mujoco #13 tell of noisy contacts between cylinder and box.
  EXPECT_GE(walk("ode", tipping_can).point_counts.size(), 4u);  // 2 to 8 as it tips
  EXPECT_GT(walk("bullet-persistent", turning_battery).changes, 0);
}

TEST(Symptoms, OdesOneContactBetweenNearlyParallelSidesRunsFromEndToEnd) {
  const Walk ode = walk("ode", seesaw);
  EXPECT_EQ(ode.point_counts, std::set{1});
  EXPECT_GT(ode.largest_jump, 0.05);
  EXPECT_EQ(ode.missed, 0);
}

}  // namespace
}  // namespace touchstone
