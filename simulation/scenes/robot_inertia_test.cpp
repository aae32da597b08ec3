// The inertia of links: what is read of it from URDF, SDF and MJCF, and what a scene makes of it.
#include <cmath>
#include <fmt/format.h>
#include <gmock/gmock.h>

#include "candidates/candidates.hpp"
#include "simulation/assembly.hpp"
#include "simulation/scenes/disturbed_scene.hpp"
#include "simulation/scenes/robot_files_fixture.hpp"
#include "simulation/scenes/trajectory.hpp"

namespace touchstone {
namespace {

using testing::Contains;
using testing::HasSubstr;
using testing::Not;

Eigen::Quaterniond about(const Vec3& axis, double angle) {
  return Eigen::Quaterniond(Eigen::AngleAxisd(angle, axis));
}
Eigen::Matrix3d moments(const LinkInertia& i) {
  const Eigen::Matrix3d& r = i.pose.rotation();
  return r * i.moments.value().asDiagonal() * r.transpose();
}
Eigen::Matrix3d symmetric(double xx, double xy, double xz, double yy, double yz, double zz) {
  Eigen::Matrix3d m;
  m << xx, xy, xz, xy, yy, yz, xz, yz, zz;
  return m;
}
const Eigen::Matrix3d tensor = symmetric(0.3, 0.02, -0.03, 0.4, 0.01, 0.5);

/// Is it so in a link at (1, 2, 3), turned by 0.5 about z, whose inertia is at (0.1, 0, −0.2) in
/// it, turned by 0.3 about x and then 0.4 about z?
void expect_turned(const Eigen::Matrix3d& given, const LinkInertia& i) {
  constexpr double near = 1e-12;
  const Eigen::Quaterniond link = about(Vec3::UnitZ(), 0.5);
  const Eigen::Matrix3d r =
      (link * about(Vec3::UnitZ(), 0.4) * about(Vec3::UnitX(), 0.3)).toRotationMatrix();
  EXPECT_LT((i.pose.position() - Vec3(1, 2, 3) - link * Vec3(0.1, 0, -0.2)).norm(), near);
  EXPECT_LT((moments(i) - r * given * r.transpose()).norm(), near);
}

/// A file whose link "part" is there and has a box and this inertial.
std::string urdf_text(const std::string& inertial) {
  return "<robot name='r'><link name='base'/><joint name='j' type='fixed'><parent link='base'/>"
         "<child link='part'/><origin xyz='1 2 3' rpy='0 0 0.5'/></joint><link name='part'>" +
         inertial +
         "<collision><geometry><box size='1 1 1'/></geometry></collision></link></robot>";
}
std::string sdf_model(const std::string& inertial) {
  return "<model name='m'><pose>1 2 3 0 0 0.5</pose><link name='part'>" + inertial +
         "<collision name='c'><geometry><box><size>1 1 1</size></box></geometry></collision></link>"
         "</model>";
}
std::string sdf_text(const std::string& inertial) {
  return "<sdf version='1.7'>" + sdf_model(inertial) + "</sdf>";
}
std::string sdf_world_text(const std::string& inertial) {
  return "<sdf version='1.7'><world name='w'>" + sdf_model(inertial) + "</world></sdf>";
}

/// What the file says of a mass and of moments {xx}, {xy}, ….
constexpr const char* urdf_inertial =
    "<inertial><origin xyz='0.1 0 -0.2' rpy='0.3 0 0.4'/><mass value='{}'/><inertia ixx='{}' "
    "ixy='{}' ixz='{}' iyy='{}' iyz='{}' izz='{}'/></inertial>";
constexpr const char* sdf_inertial =
    "<inertial><pose>0.1 0 -0.2 0.3 0 0.4</pose><mass>{}</mass><inertia><ixx>{}</ixx><ixy>{}</ixy>"
    "<ixz>{}</ixz><iyy>{}</iyy><iyz>{}</iyz><izz>{}</izz></inertia></inertial>";

/// A format in which a file may have any moments; MuJoCo checks those of MJCF itself.
struct InertiaFormat {
  const char* file;
  const char* link;  ///< the name that "part" is read by
  std::string (*text)(const std::string& inertial);
  const char* inertial;

  RobotFile read(const std::string& given) const { return robot_of(file, text(given)); }
  RobotFile read(double mass, const Eigen::Matrix3d& m) const {
    return read(fmt::format(fmt::runtime(inertial), mass, m(0, 0), m(0, 1), m(0, 2), m(1, 1),
                            m(1, 2), m(2, 2)));
  }
  /// The link "part" of a file.
  const Link& part(const RobotFile& robot) const { return by_name(robot.links, link); }
};
const InertiaFormat urdf = {"inertia.urdf", "part", urdf_text, urdf_inertial},
                    sdf = {"inertia.sdf", "m::part", sdf_text, sdf_inertial},
                    sdf_world = {"inertia.sdf", "m::part", sdf_world_text, sdf_inertial};

TEST(RobotInertia, IsTurnedByItsFrameAndItsLink) {
  for (const InertiaFormat& format : {urdf, sdf, sdf_world}) {
    SCOPED_TRACE(format.file);
    const RobotFile robot = format.read(7, tensor);
    EXPECT_EQ(format.part(robot).mass, 7);
    expect_turned(tensor, format.part(robot).inertia.value());
    EXPECT_TRUE(robot.ignored.empty());
  }
}

/// Moments that no body can have, and what is said of them.
const std::vector<std::pair<Eigen::Matrix3d, std::string>> bad_moments = {
    {Eigen::Matrix3d::Zero(), "not positive"},
    {symmetric(1, 0, 0, 1, 0, -1), "not positive"},
    {symmetric(1, 0, 0, 1, 2, 1), "not positive"},  // 1 ± 2
    {symmetric(0.1, 0, 0, 0.1, 0, 0.3), "larger than the sum of the others"},
    {symmetric(1, 0, 0, 1, 0, 1e-14), "next to nothing beside another"},
    {symmetric(1e-4, 0, 0, 1e-4, 0, 1e-4), "next to nothing beside its shapes'"}};

TEST(RobotInertia, ThatNoBodyCanHaveIsNamedAndLeavesMassAndCentre) {
  for (const InertiaFormat& format : {urdf, sdf, sdf_world}) {
    for (const auto& [m, fault] : bad_moments) {
      SCOPED_TRACE(format.file + (": " + fault));
      const RobotFile robot = format.read(7, m);
      EXPECT_THAT(robot.ignored,
                  testing::ElementsAre(fmt::format(
                      "link {}: its inertia, of which one principal moment is {}; that of its "
                      "shapes is taken, with its mass and centre of mass",
                      format.link, fault)));
      const Link& part = format.part(robot);
      EXPECT_EQ(part.mass, 7);
      EXPECT_EQ(part.shapes.size(), 1U);
      EXPECT_FALSE(part.inertia.value().moments);
      const Vec3 centre = Vec3(1, 2, 3) + about(Vec3::UnitZ(), 0.5) * Vec3(0.1, 0, -0.2);
      EXPECT_LT((part.inertia->pose.position() - centre).norm(), 1e-12);
    }
  }
}

TEST(RobotInertia, OfAFlatPlateInTwoDigitsIsTaken) {
  const RobotFile robot = urdf.read(1, symmetric(0.33, 0, 0, 0.084, 0, 0.415));
  EXPECT_TRUE(urdf.part(robot).inertia.value().moments);
}

TEST(RobotInertia, WithoutAMassIsNamed) {
  const RobotFile robot = urdf.read(0, tensor);
  EXPECT_THAT(robot.ignored, Contains("link part: an inertia without a mass"));
  EXPECT_FALSE(urdf.part(robot).inertia);
  EXPECT_TRUE(urdf.read(0, Eigen::Matrix3d::Zero()).ignored.empty());
  const std::string negative = fmt::format(fmt::runtime(urdf_inertial), -1, 1, 0, 0, 1, 0, 1);
  EXPECT_THAT(refusal_of(urdf.file, urdf_text(negative)), HasSubstr("link part.mass is -1"));
}

TEST(RobotInertia, ThatIsNotThereIsThatOfTheShapes) {
  for (const InertiaFormat& format : {urdf, sdf, sdf_world}) {
    EXPECT_FALSE(format.part(format.read("")).inertia) << format.file;
  }
  EXPECT_FALSE(urdf.part(urdf.read("")).mass);
  EXPECT_FALSE(by_name(urdf.read(7, tensor).links, "base").inertia);
  EXPECT_FALSE(sdf.part(sdf.read("<inertial><mass>3</mass></inertial>")).inertia);
  const RobotFile low = sdf.read("<inertial><pose>0 0 -0.4 0 0 0</pose><mass>3</mass></inertial>");
  const LinkInertia& i = sdf.part(low).inertia.value();
  EXPECT_FALSE(i.moments);
  EXPECT_LT((i.pose.position() - Vec3(1, 2, 2.6)).norm(), 1e-12);
}

TEST(SdfInertia, WithAUnitOrANegativeMassIsRefused) {
  const auto of = [](const std::string& inertial) {
    return refusal_of("inertia.sdf", sdf_world_text("<inertial>" + inertial + "</inertial>"));
  };
  EXPECT_THAT(of("<mass>3kg</mass>"),
              HasSubstr("link m::part.inertial.mass is \"3kg\": must be a number"));
  EXPECT_THAT(of("<inertia><ixx>1 m</ixx></inertia>"),
              HasSubstr("link m::part.inertial.inertia.ixx is \"1 m\": must be a number"));
  EXPECT_THAT(of("<pose>0 0 1m 0 0 0</pose>"), HasSubstr("link m::part.inertial.pose is"));
  EXPECT_THAT(of("<mass>-1</mass>"), HasSubstr("link m::part.mass is -1"));
  EXPECT_THAT(of("<mass>-1</mass><frobnicate/>"), Not(HasSubstr("accepted")));
}

RobotFile mjcf(const std::string& body) {
  return robot_of("inertia.xml",
                  "<mujoco><compiler angle='radian' eulerseq='XYZ'/><worldbody>"
                  "<body name='part' pos='1 2 3' euler='0 0 0.5'><freejoint/>" +
                      body + "</body></worldbody></mujoco>");
}

TEST(MjcfInertia, IsTurnedByItsFrameAndItsBody) {
  const Eigen::Quaterniond q = about(Vec3::UnitZ(), 0.4) * about(Vec3::UnitX(), 0.3);
  const RobotFile world = mjcf(fmt::format(
      "<inertial pos='0.1 0 -0.2' quat='{} {} {} {}' mass='7' diaginertia='0.3 0.4 0.5'/>"
      "<geom type='box' size='1 1 1'/>",
      q.w(), q.x(), q.y(), q.z()));
  EXPECT_EQ(by_name(world.links, "part").mass, 7);
  expect_turned(symmetric(0.3, 0, 0, 0.4, 0, 0.5), by_name(world.links, "part").inertia.value());
}

TEST(MjcfInertia, IsThatOfAllGeomsWhereTheFileHasNone) {
  // A ball of 1 kg that collides, and one of 3 kg, at 0.4 m, that does not.
  const RobotFile world = mjcf(
      "<geom type='sphere' size='0.1' mass='1'/>"
      "<geom type='sphere' size='0.1' mass='3' pos='0 0 -0.4' contype='0' conaffinity='0'/>");
  const Link& part = by_name(world.links, "part");
  EXPECT_EQ(part.shapes.size(), 1U);
  EXPECT_NEAR(*part.mass, 4, 1e-12);
  EXPECT_LT((part.inertia->pose.position() - Vec3(1, 2, 3 - 0.3)).norm(), 1e-12);
  const double along = 0.4 * 4 * 0.01, across = along + 0.3 * 0.3 + 3 * 0.1 * 0.1;
  EXPECT_LT((moments(*part.inertia) - symmetric(across, 0, 0, across, 0, along)).norm(), 1e-12);
}

/// A link of two boxes, one on the other, of 6 kg in all.
RobotFile tower() {
  RobotFile robot;
  robot.name = "tower";
  Link part{"tower"};
  part.shapes = {
      {"foot", Box(Vec3(0.1, 0.1, 0.2)), Pose(Vec3(0, 0, 0.2))},
      {"head", Box(Vec3(0.1, 0.1, 0.4)), Pose(Vec3(0, 0, 0.8), about(Vec3::UnitZ(), 0.7))}};
  part.mass = 6;
  robot.links = {part};
  return robot;
}

TEST(RobotInertia, IsThatOfAllTheShapesOfALinkTogether) {
  RobotFile robot = tower();
  const Pose frame(Vec3(0.02, 0.01, 0.1), about(Vec3::UnitY(), 0.3));
  robot.links[0].inertia = {frame, Vec3(0.2, 0.3, 0.4)};
  const Assembly all = assemblies(robot_scene(robot, {}).scene).at(0);
  EXPECT_NEAR(all.inertia.mass, 6, 1e-12);
  EXPECT_LT((all.X_WF.position() - frame.position()).norm(), 1e-12);
  const Eigen::Matrix3d &axes = all.X_WF.rotation(), &r = frame.rotation();
  EXPECT_LT((axes * all.inertia.principal.asDiagonal() * axes.transpose() -
             r * Vec3(0.2, 0.3, 0.4).asDiagonal() * r.transpose())
                .norm(),
            1e-12);
}

TEST(RobotInertia, WithoutMomentsIsThatOfTheShapesAboutTheGivenCentre) {
  RobotFile robot = tower();
  const Assembly spread = assemblies(robot_scene(robot, {}).scene).at(0);
  const Vec3 centre(0.03, -0.01, 0.1);
  robot.links[0].inertia = {Pose(centre)};
  const Assembly moved = assemblies(robot_scene(robot, {}).scene).at(0);
  EXPECT_NEAR(spread.X_WF.position().z(), 0.6, 1e-12);
  EXPECT_LT((moved.X_WF.position() - centre).norm(), 1e-12);
  EXPECT_NEAR(moved.inertia.mass, 6, 1e-12);
  EXPECT_LT((moved.inertia.principal - spread.inertia.principal).norm(), 1e-12);
}

TEST(RobotInertia, OfALinkWithoutShapesIsItsOwnToo) {
  RobotFile robot = tower();
  Link battery{"battery", Pose(Vec3(0, 0, 0.1))};
  battery.mass = 3;
  battery.inertia = {Pose(Vec3(0.2, 0, 0.1)), Vec3(0.1, 0.2, 0.2)};
  robot.links.push_back(battery);
  LinkJoint mount;
  mount.name = "mount", mount.child = 1, mount.parent = 0;
  robot.joints = {mount};
  const Assembly all = assemblies(robot_scene(robot, {}).scene).at(0);
  EXPECT_NEAR(all.inertia.mass, 9, 1e-12);
  EXPECT_LT((all.X_WF.position() - (6 * Vec3(0, 0, 0.6) + 3 * Vec3(0.2, 0, 0.1)) / 9).norm(),
            1e-12);
}

TEST(RobotInertia, StaysInItsBodyUnderADisturbance) {
  RobotFile robot = tower();
  robot.links[0].inertia = {Pose(Vec3(0.03, 0, 0.1)), Vec3(0.2, 0.3, 0.4)};
  const Scene scene = robot_scene(robot, {}).scene;
  const DisturbedScene disturbed(scene, 42, 3);
  for (const Assembly& a : assemblies(disturbed.scene)) {
    if (!a.is_free()) continue;
    const Vec3 back = disturbed.turn.conjugate() * a.X_WF.position();
    EXPECT_LT((back - Vec3(0.03, 0, 0.1)).norm(), 2e-3);
    EXPECT_LT((a.inertia.principal - Vec3(0.2, 0.3, 0.4)).norm(), 1e-12);
  }
}

/// How far a tower leans after two seconds on a slope, rad.
double lean_on_slope(RobotFile robot, double slope) {
  robot.gravity = 9.81 * Vec3(std::sin(slope), 0, -std::cos(slope));
  for (LinkShape& s : robot.links[0].shapes) s.friction = 2;
  SceneFile file = robot_scene(robot, {});
  file.scene.bodies.back().material.friction = 2;  // the ground
  CandidateProcess process(find_candidate("reference"), simulation_threshold);
  CandidateModel exact(process);
  const Trajectory run = run_scene(file.scene, exact);
  return std::acos(std::min(1.0, run.frames.back()[0].pose.axis().z()));
}

// The tower is 0.2 m wide and its mass 0.6 m high: it tips at atan(0.1 / 0.6) = 9.5°, and with a
// low battery at atan(0.1 / 0.15) = 34°.
TEST(RobotInertia, ALowBatteryKeepsATowerFromTipping) {
  constexpr double slope = 0.35, stands = 0.02, tips = 0.5;
  EXPECT_GT(lean_on_slope(tower(), slope), tips);
  RobotFile low = tower();
  low.links[0].inertia = {Pose(Vec3(0, 0, 0.15)), Vec3(0.4, 0.4, 0.05)};
  EXPECT_LT(lean_on_slope(low, slope), stands);
  low.links[0].inertia->moments.reset();
  EXPECT_LT(lean_on_slope(low, slope), stands);
}

}  // namespace
}  // namespace touchstone
