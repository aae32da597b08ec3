// SDF: what is read and where, the models that it includes, and which files are refused.
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fmt/format.h>
#include <gmock/gmock.h>

#include "properties/files/own_folder_test.hpp"
#include "simulation/scenes/robot_files_fixture.hpp"

namespace touchstone {
namespace {

using testing::Contains;
using testing::HasSubstr;

const std::string ball_geometry = "<geometry><sphere><radius>1</radius></sphere></geometry>";
std::string ball_link(const std::string& name, const std::string& surface = "") {
  return "<link name='" + name + "'><collision name='c'>" + ball_geometry + surface +
         "</collision></link>";
}
/// A world of this, or a model.
std::string world_of(const std::string& content) {
  return "<sdf version='1.9'><world name='w'>" + content + "</world></sdf>";
}
std::string model_of(const std::string& content) {
  return "<model name='m'>" + content + "</model>";
}
std::string joint_of_balls(const std::string& type, const std::string& content) {
  return ball_link("a") + ball_link("b") + "<joint name='j' type='" + type +
         "'><parent>a</parent><child>b</child>" + content + "</joint>";
}
RobotFile sdf_of(const std::string& content) {
  return robot_of("part.sdf", "<sdf version='1.9'>" + content + "</sdf>");
}

TEST(Sdf, GivesShapesWhereTheyAreInTheWorld) {
  const RobotFile file = read_robot(scenes / "warehouse.sdf");
  EXPECT_EQ(file.name, "warehouse");
  EXPECT_EQ(shape_count(file), 10U);
  const LinkShape& roller = named(file, "roller_conveyor::frame/roller_2");
  EXPECT_TRUE(by_name(file.links, "roller_conveyor::frame").fixed);
  EXPECT_NEAR((roller.pose.position() - Vec3(-0.6, 0, 0.42)).norm(), 0, 1e-12);
  EXPECT_NEAR((roller.pose.axis() - Vec3(0, -1, 0)).norm(), 0, 1e-5);
  const auto& hull = std::get<Convex>(named(file, "cart::tray/hull").shape);
  EXPECT_EQ(hull.vertices().size(), 8U);
  const auto& bumper = std::get<Capsule>(named(file, "cart::tray/bumper").shape);
  EXPECT_EQ(bumper.half_length(), 0.2);
  EXPECT_TRUE(std::holds_alternative<Plane>(named(file, "ground_plane::link/collision").shape));
  const LinkJoint& axle = by_name(file.joints, "cart::wheel_axle");
  EXPECT_EQ(file.links[axle.parent].name, "cart::tray");
  EXPECT_EQ(file.links[axle.child].name, "cart::wheel");
  EXPECT_NEAR((axle.axis - Vec3(0, -1, 0)).norm(), 0, 1e-5);
  EXPECT_NEAR((axle.anchor - Vec3(0.3, 1.8, 0.12)).norm(), 0, 1e-12);
}

TEST(Sdf, SaysWhatItIgnores) {
  const auto ignored = read_robot(scenes / "warehouse.sdf").ignored;
  EXPECT_THAT(ignored, Contains("plugin ignition::gazebo::systems::Physics: not read"));
  EXPECT_THAT(ignored, Contains("sensor touch: not read"));
}

std::string sdf_refusal(const std::string& geometry, const std::string& version = "1.7") {
  return refusal_of("part.sdf", "<sdf version='" + version + R"('><world name='w'><model name='m'>
    <link name='mid'><collision name='broken'>)" +
                                    geometry + "</collision></link></model></world></sdf>");
}

TEST(Sdf, RefusesAShapeThatItsReaderWouldReplaceByADefault) {
  const auto of = [](const std::string& shape) {
    return sdf_refusal("<geometry>" + shape + "</geometry>");
  };
  const std::string length = "<length>1</length>";
  EXPECT_EQ(of("<cylinder><radius> 0.2 </radius>" + length + "</cylinder>"),
            "accepted with 1 shapes");
  EXPECT_EQ(of("<plane><normal>0 0 1</normal></plane>"), "accepted with 1 shapes");
  EXPECT_THAT(
      of("<cylinder><radiu>0.2</radiu>" + length + "</cylinder>"),
      HasSubstr("collision m::mid/broken.cylinder.radiu is unknown: must be one of radius"));
  EXPECT_THAT(of("<cylinder>" + length + "</cylinder>"),
              HasSubstr("collision m::mid/broken.cylinder.radius is missing"));
  EXPECT_THAT(of("<cylinder><radius>0.2m</radius>" + length + "</cylinder>"),
              HasSubstr("cylinder.radius is \"0.2m\": must be a number"));
  EXPECT_THAT(of("<sphere><radius>1</radius><radius>2</radius></sphere>"),
              HasSubstr("sphere.radius is there more than once"));
  EXPECT_THAT(of("<box><size>1 2 3 4</size></box>"), HasSubstr("box.size is \"1 2 3 4\""));
  EXPECT_THAT(of("<cilinder/>"), HasSubstr("m::mid/broken.geometry is \"cilinder\""));
  EXPECT_THAT(of(""), HasSubstr("m::mid/broken.geometry is empty"));
}

TEST(Sdf, RefusesAPoseOfWhichItsReaderWouldIgnoreAUnit) {
  EXPECT_EQ(sdf_refusal("<pose>0 0 1 0 0 0</pose>" + ball_geometry), "accepted with 1 shapes");
  EXPECT_THAT(sdf_refusal("<pose>0 0 1m 0 0 0</pose>" + ball_geometry),
              HasSubstr("collision m::mid/broken.pose is \"0 0 1m 0 0 0\": must be numbers"));
}

TEST(Sdf, RefusesAVersionThatItsReaderDoesNotKnow) {
  EXPECT_EQ(sdf_refusal(ball_geometry, "1.6"), "accepted with 1 shapes");
  for (const char* version : {"9.9", "1.99", "1.x", "1", ""}) {
    EXPECT_THAT(sdf_refusal(ball_geometry, version), testing::Not(HasSubstr("accepted")))
        << version;
  }
  EXPECT_THAT(sdf_refusal(ball_geometry, "9.9"),
              HasSubstr("sdf.version is \"9.9\": must be 1.0 to 1."));
}

struct ModelFolder : OwnFolder {
  /// Writes a model with this content; its first link is "l".
  void model(const std::string& name, const std::string& content) const {
    with(name + "/model.config",
         "<model><name>" + name + "</name><sdf version='1.7'>model.sdf</sdf></model>");
    with(name + "/model.sdf",
         "<sdf version='1.7'><model name='" + name + "'>" + content + "</model></sdf>");
  }
};

struct IncludedModels : testing::Test {
  const std::string ball = ball_link("l");
  ModelFolder models;

  /// What becomes of a world that includes this URI.
  static std::string with(const std::string& uri,
                          const std::vector<std::filesystem::path>& folders = {}) {
    const Written world("world.sdf", world_of("<include><uri>" + uri + "</uri></include>"));
    try {
      return fmt::format("{} shapes", shape_count(read_robot(world.path, folders)));
    } catch (const InvalidInput& e) {
      return e.what();
    }
  }
};

TEST_F(IncludedModels, AreCheckedToo) {
  models.model("can",
               "<link name='l'><collision name='c'><geometry><sphere><radiu>0.2</radiu>"
               "</sphere></geometry></collision></link>");
  EXPECT_THAT(with((models.path / "can").string()),
              HasSubstr((models.path / "can" / "model.sdf").string() +
                        ": collision can::l/c.sphere.radiu is unknown: must be one of radius"));
}

TEST_F(IncludedModels, AreFoundByOptionAndByTheEnvironment) {
  models.model("ball", ball);
  EXPECT_THAT(with("model://ball"), HasSubstr("include.uri is \"model://ball\": must name a model "
                                              "in a folder of --model-path, SDF_PATH"));
  EXPECT_EQ(with("model://ball", {models.path}), "1 shapes");
  EXPECT_EQ(with("package://ball", {models.path}), "1 shapes");
  EXPECT_EQ(with(" model://ball/model.sdf\n", {models.path}), "1 shapes");
  for (const char* variable : {"SDF_PATH", "GZ_SIM_RESOURCE_PATH", "GAZEBO_MODEL_PATH"}) {
    setenv(variable, ("/nowhere:" + models.path.string()).c_str(), 1);
    EXPECT_EQ(with("model://ball"), "1 shapes") << variable;
    unsetenv(variable);
  }
}

TEST_F(IncludedModels, ThatIncludeThemselvesOrAreNotHereAreRefused) {
  models.model("a", ball + "<include><uri>model://b</uri></include>");
  models.model("b", ball + "<include><uri>model://a</uri></include>");
  EXPECT_THAT(with("model://a", {models.path}), HasSubstr("must not include itself"));
  EXPECT_THAT(with("https://fuel.gazebosim.org/1.0/model"), HasSubstr("must be on this machine"));
  std::filesystem::create_directory(models.path / "empty");
  EXPECT_THAT(with("model://empty", {models.path}), HasSubstr("model.config"));
  EXPECT_THAT(with(""), HasSubstr("include.uri is \"\""));
}

TEST_F(IncludedModels, AreThoseThatWereCheckedWhateverIsInTheWorkingFolder) {
  const ModelFolder working;
  working.model("ball", ball + ball);  // two links of one name: libsdformat would refuse it
  models.model("ball", ball);
  const std::filesystem::path before = std::filesystem::current_path();
  std::filesystem::current_path(working.path);
  EXPECT_EQ(with("ball", {models.path}), "1 shapes");
  std::filesystem::current_path(before);
}

TEST(Sdf, RefusesUnitsWhereItsReaderWouldPassOverThem) {
  const auto refusal = [](const std::string& place, const std::string& value) {
    std::string text = world_of(
        "<gravity>0 0 GRAVITY</gravity>" +
        model_of("<frame name='f'><pose>0 0 FRAME 0 0 0</pose></frame>" +
                 ball_link("c", "<surface><friction><ode><mu>MU</mu></ode></friction></surface>") +
                 joint_of_balls("prismatic",
                                "<pose>0 JOINT 0 0 0 0</pose><axis><xyz>0 0 1</xyz><limit>"
                                "<lower>LOWER</lower><upper>UPPER</upper><effort>EFFORT</effort>"
                                "</limit></axis>")));
    for (const auto& [name, usual] : {std::pair{"GRAVITY", "-9.8"},
                                      {"MU", "0.5"},
                                      {"FRAME", "0"},
                                      {"JOINT", "0"},
                                      {"LOWER", "-inf"},
                                      {"UPPER", "1e16"},
                                      {"EFFORT", "-1"}}) {
      for (std::size_t at = text.find(name); at != text.npos; at = text.find(name)) {
        text.replace(at, std::string(name).size(), place == name ? value : usual);
      }
    }
    return refusal_of("units.sdf", text);
  };
  EXPECT_EQ(refusal("NONE", ""), "accepted with 3 shapes");
  EXPECT_THAT(refusal("GRAVITY", "-9.8m/s2"), HasSubstr("world w.gravity is \"0 0 -9.8m/s2\""));
  EXPECT_THAT(refusal("MU", "50%"), HasSubstr("collision m::c/c.surface.friction.ode.mu is"));
  EXPECT_THAT(refusal("FRAME", "2m"), HasSubstr("frame m::f.pose is"));
  EXPECT_THAT(refusal("JOINT", "0,5"), HasSubstr("joint m::j.pose is"));
  EXPECT_THAT(refusal("LOWER", "-100mm"), HasSubstr("joint m::j.axis.limit.lower is \"-100mm\""));
  EXPECT_THAT(refusal("UPPER", "5.7 deg"), HasSubstr("joint m::j.axis.limit.upper is"));
  EXPECT_THAT(refusal("EFFORT", "3N"), HasSubstr("joint m::j.axis.limit.effort is"));
}

TEST(Sdf, AContinuousJointHasNoLimits) {
  const std::string limited =
      "<axis><xyz>0 0 1</xyz><limit><lower>-0.1</lower><upper>0.1</upper></limit></axis>";
  const RobotFile robot = sdf_of(model_of(joint_of_balls("continuous", limited)));
  const LinkJoint& joint = by_name(robot.joints, "m::j");
  EXPECT_TRUE(std::isinf(joint.lower));
  EXPECT_TRUE(std::isinf(joint.upper));
}

TEST(Sdf, ReadsTheFirstOfSeveralWorlds) {
  const auto world = [](const std::string& name) {
    return "<world name='" + name + "'>" + model_of(ball_link("l")) + "</world>";
  };
  const RobotFile robot = sdf_of(world("earth") + world("moon"));
  EXPECT_EQ(robot.name, "earth");
  EXPECT_EQ(shape_count(robot), 1U);
  EXPECT_THAT(robot.ignored, testing::ElementsAre("world moon: not read, only the first is"));
}

TEST(Sdf, ShapesTouchByTheirBitmasks) {
  const auto link = [](const std::string& name, const std::string& bits) {
    return ball_link(name, "<surface><contact><collide_bitmask>" + bits +
                               "</collide_bitmask></contact></surface>");
  };
  const RobotFile robot =
      sdf_of(model_of(link("low", "0x01") + link("high", "2") + ball_link("any")));
  const auto mask = [&](const std::string& name) { return named(robot, "m::" + name + "/c").mask; };
  EXPECT_FALSE(mask("low").touches(mask("high")));
  EXPECT_TRUE(mask("low").touches(mask("any")));
  EXPECT_TRUE(mask("any").touches(mask("high")));
}

TEST(Sdf, SaysWhatOfLinksAndSurfacesItIgnores) {
  const auto ignored = [](const std::string& model, const std::string& link,
                          const std::string& surface) {
    return sdf_of(model_of(model + "<link name='l'>" + link + "<collision name='c'>" +
                           ball_geometry + "<surface>" + surface + "</surface></collision></link>"))
        .ignored;
  };
  EXPECT_THAT(ignored("<self_collide>false</self_collide>",
                      "<gravity>false</gravity><kinematic>true</kinematic>",
                      "<contact><collide_without_contact>1</collide_without_contact></contact>"
                      "<bounce><restitution_coefficient>0.5</restitution_coefficient></bounce>"),
              testing::UnorderedElementsAre(
                  "model m: self_collide is not read; its links touch each other",
                  "link m::l: gravity is not read; it falls",
                  "link m::l: kinematic is not read; forces move it",
                  "collision m::l/c: collide_without_contact is not read; it touches others",
                  "collision m::l/c: bounce is not read"));
  EXPECT_THAT(ignored("<self_collide>true</self_collide>",
                      "<gravity>true</gravity><kinematic>false</kinematic>",
                      "<contact><collide_without_contact>0</collide_without_contact></contact>"
                      "<bounce><restitution_coefficient>0</restitution_coefficient></bounce>"),
              testing::IsEmpty());
}

TEST(Sdf, GivesMassFrictionAndGravity) {
  const RobotFile world = read_robot(scenes / "loading-bay.sdf");
  EXPECT_TRUE(world.is_world);
  EXPECT_EQ(world.gravity.z(), -9.8);
  EXPECT_EQ(by_name(world.links, "cart_1::tray").mass, 6);
  EXPECT_EQ(named(world, "cart_1::front_left_wheel/tyre").friction, 0.9);
  EXPECT_FALSE(named(world, "barrel::link/body").friction);
  EXPECT_TRUE(by_name(world.links, "post::link").fixed);
  EXPECT_THAT(world.ignored, Contains("light sun: not read"));
}

TEST(Sdf, SaysWhatItDoesInsteadOfOtherJoints) {
  const RobotFile robot = sdf_of(model_of(joint_of_balls("ball", "")));
  EXPECT_THAT(robot.ignored, Contains("joint m::j: ball; taken as fixed"));
  EXPECT_EQ(by_name(robot.joints, "m::j").kind, JointKind::fixed);
}

TEST(Sdf, SaysWhatOfAWorldAndItsJointsItIgnores) {
  const auto ignored = [](const std::string& of_world, const std::string& of_axis) {
    const std::string axis = "<axis><xyz>0 0 1</xyz>" + of_axis + "</axis>";
    return robot_of("axis.sdf", world_of(of_world + model_of(joint_of_balls("revolute", axis))))
        .ignored;
  };
  EXPECT_THAT(
      ignored("<physics name='fast' type='ode'><max_step_size>0.002</max_step_size></physics>"
              "<state world_name='w'/>",
              "<limit><velocity>3</velocity></limit><dynamics><damping>1</damping>"
              "<friction>2</friction><spring_stiffness>4</spring_stiffness></dynamics>"),
      testing::UnorderedElementsAre(
          "physics fast: not read", "state w: not read", "damping of joint m::j: not read",
          "friction of joint m::j: not read", "the spring of joint m::j: not read",
          "the largest speed of joint m::j: not read"));
  EXPECT_THAT(ignored("", "<limit><velocity>-1</velocity></limit>"), testing::IsEmpty());
}

}  // namespace
}  // namespace touchstone
