// Meshes of robots and worlds as their convex hulls, and which meshes are refused.
#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <random>

#include "properties/files/given_text.hpp"
#include "properties/files/own_folder_test.hpp"
#include "reference/error_of_test.hpp"
#include "simulation/scenes/robot_files_fixture.hpp"

namespace touchstone {
namespace {

using testing::HasSubstr;
using testing::IsEmpty;

using Triangles = std::vector<std::array<int, 3>>;

/// The surface of something, as a test writes it to files.
struct Surface {
  std::vector<Vec3> points;
  Triangles triangles;
};

/// A corner of a cube with legs of two, along y of four.
Surface wedge() {
  return {{{0, 0, 0}, {2, 0, 0}, {0, 4, 0}, {0, 0, 2}},
          {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}}};
}
/// A tower on a plate, of boxes that share no side: it is not convex.
Surface two_boxes() {
  Surface result;
  for (const double side : {0.0, 3.0}) {
    const int first = static_cast<int>(result.points.size());
    for (int i = 0; i < 8; ++i) result.points.emplace_back(side + (i & 1), i >> 1 & 1, i >> 2);
    for (const auto& [a, b, c, d] : std::array<std::array<int, 4>, 6>{{{0, 2, 3, 1},
                                                                       {4, 5, 7, 6},
                                                                       {0, 1, 5, 4},
                                                                       {2, 6, 7, 3},
                                                                       {0, 4, 6, 2},
                                                                       {1, 3, 7, 5}}}) {
      result.triangles.push_back({first + a, first + b, first + c});
      result.triangles.push_back({first + a, first + c, first + d});
    }
  }
  return result;
}

std::string ascii_stl(const Surface& s) {
  std::string text = "solid s\n";
  for (const auto& triangle : s.triangles) {
    text += "facet normal 0 0 0\nouter loop\n";
    for (const int i : triangle) {
      const Vec3& p = s.points[i];
      text += fmt::format("vertex {} {} {}\n", p.x(), p.y(), p.z());
    }
    text += "endloop\nendfacet\n";
  }
  return text + "endsolid s\n";
}

void append(std::string& bytes, const auto& value) {
  bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
}
std::string binary_stl(const Surface& s) {
  std::string bytes(80, ' ');
  append(bytes, static_cast<std::uint32_t>(s.triangles.size()));
  for (const auto& triangle : s.triangles) {
    bytes.append(3 * sizeof(float), '\0');  // a normal that nobody needs
    for (const int i : triangle) {
      for (const double x : s.points[i]) append(bytes, static_cast<float>(x));
    }
    append(bytes, std::uint16_t{0});
  }
  return bytes;
}

std::string obj(const Surface& s) {
  std::string text;
  for (const Vec3& p : s.points) text += fmt::format("v {} {} {}\n", p.x(), p.y(), p.z());
  for (const auto& [i, j, k] : s.triangles)
    text += fmt::format("f {} {} {}\n", i + 1, j + 1, k + 1);
  return text;
}

std::string dae(const Surface& s, const std::string& asset = "<unit meter='1'/>") {
  std::string numbers, corners;
  for (const Vec3& p : s.points) numbers += fmt::format("{} {} {} ", p.x(), p.y(), p.z());
  for (const auto& [i, j, k] : s.triangles) corners += fmt::format("{} {} {} ", i, j, k);
  return fmt::format(
      R"(<?xml version="1.0"?><COLLADA xmlns="http://www.collada.org/2005/11/COLLADASchema"
      version="1.4.1"><asset>{}</asset><library_geometries><geometry id="g"><mesh><source id="p">
      <float_array id="f" count="{}">{}</float_array><technique_common><accessor source="#f"
      count="{}" stride="3"><param name="X" type="float"/><param name="Y" type="float"/>
      <param name="Z" type="float"/></accessor></technique_common></source><vertices id="v">
      <input semantic="POSITION" source="#p"/></vertices><triangles count="{}">
      <input semantic="VERTEX" source="#v" offset="0"/><p>{}</p></triangles></mesh></geometry>
      </library_geometries><library_visual_scenes><visual_scene id="s"><node id="n">
      <instance_geometry url="#g"/></node></visual_scene></library_visual_scenes><scene>
      <instance_visual_scene url="#s"/></scene></COLLADA>)",
      asset, 3 * s.points.size(), numbers, s.points.size(), s.triangles.size(), corners);
}

/// A robot of one link with this mesh, which stands beside its file.
RobotFile robot_of_mesh(const std::string& name, const std::string& content,
                        const std::string& attributes = "") {
  const Written mesh(name, content);
  return robot_of("mesh.urdf",
                  fmt::format("<robot name='r'><link name='l'><collision name='c'><geometry>"
                              "<mesh filename='{}' {}/></geometry></collision></link></robot>",
                              mesh.path.filename().string(), attributes));
}

/// The corners of the robot's hull in its link's frame, sorted.
std::vector<Vec3> corners(const RobotFile& robot) {
  const LinkShape& shape = robot.links.at(0).shapes.at(0);
  std::vector<Vec3> result;
  for (const Vec3& v : std::get<Convex>(shape.shape).vertices()) {
    result.emplace_back(shape.pose.position() + shape.pose.rotation() * v);
  }
  std::ranges::sort(result, [](const Vec3& p, const Vec3& q) {
    return std::lexicographical_compare(p.begin(), p.end(), q.begin(), q.end());
  });
  return result;
}

TEST(Mesh, OfEveryFormatGivesTheSameHullAboutItsMiddle) {
  const std::vector<Vec3> expected = {{0, 0, 0}, {0, 0, 2}, {0, 4, 0}, {2, 0, 0}};
  for (const auto& [name, text] : {std::pair{"wedge.stl", ascii_stl(wedge())},
                                   {"binary.STL", binary_stl(wedge())},
                                   {"wedge.obj", obj(wedge())},
                                   {"wedge.dae", dae(wedge())}}) {
    const RobotFile robot = robot_of_mesh(name, text);
    EXPECT_EQ(corners(robot), expected) << name;
    EXPECT_EQ(robot.links[0].shapes[0].pose.position(), Vec3(1, 2, 1)) << name;
    EXPECT_THAT(robot.ignored, IsEmpty()) << name;
  }
}

TEST(Mesh, IsScaledAlsoByLessThanZero) {
  const std::vector<Vec3> expected = {{-0.5, 0, 0}, {0, 0, 0}, {0, 0, 2}, {0, 2, 0}};
  EXPECT_EQ(corners(robot_of_mesh("wedge.stl", ascii_stl(wedge()), "scale='-0.25 0.5 1'")),
            expected);
}

TEST(Mesh, OfColladaHasItsUnitAndNotItsUpwardAxis) {
  const std::string asset = "<unit meter='0.5' name='half'/><up_axis>Z_UP</up_axis>";
  const std::vector<Vec3> expected = {{0, 0, 0}, {0, 0, 1}, {0, 2, 0}, {1, 0, 0}};
  EXPECT_EQ(corners(robot_of_mesh("wedge.dae", dae(wedge(), asset))), expected);
}

TEST(Mesh, SaysHowMuchLargerItsHullIs) {
  // Two cubes with two more between them.
  EXPECT_THAT(
      robot_of_mesh("two.stl", binary_stl(two_boxes())).ignored,
      testing::ElementsAre(testing::EndsWith("two.stl: its hull is 100% larger than the mesh")));
}

TEST(Mesh, ThatIsNotClosedSaysThatNobodyKnows) {
  Surface open = wedge();
  open.triangles.pop_back();
  EXPECT_THAT(robot_of_mesh("open.obj", obj(open)).ignored,
              testing::ElementsAre(HasSubstr("open.obj: taken as its hull, and nobody can say")));
}

TEST(Mesh, MayHaveAnyNumberOfPointsInsideItsHull) {
  Surface many = wedge();
  std::mt19937 random(1);
  std::uniform_real_distribution<double> inside(0.1, 0.4);
  for (int i = 0; i < 3000; ++i) {
    const int first = static_cast<int>(many.points.size());
    for (int k = 0; k < 3; ++k) {
      many.points.emplace_back(inside(random), inside(random), inside(random));
    }
    many.triangles.push_back({first, first + 1, first + 2});
  }
  EXPECT_EQ(corners(robot_of_mesh("many.stl", binary_stl(many))).size(), 4U);
}

/// Why a robot with this mesh is refused, or that it is not.
std::string mesh_refusal(const std::string& name, const std::string& content,
                         const std::string& attributes = "") {
  return error_text_of([&] { robot_of_mesh(name, content, attributes); });
}

TEST(Mesh, WithMoreCornersThanABodyMayHaveIsRefused) {
  Surface ball;
  std::mt19937 random(2);
  std::normal_distribution<double> normal;
  for (int i = 0; i < 5001; ++i) {
    ball.points.push_back(Vec3(normal(random), normal(random), normal(random)).normalized());
    if (i % 3 == 2) ball.triangles.push_back({i - 2, i - 1, i});
  }
  EXPECT_THAT(
      mesh_refusal("ball.stl", binary_stl(ball)),
      testing::ContainsRegex("collision l/c.mesh is \".*ball.stl\" \\([45][0-9]* corners\\): "
                             "must be at most 4096: simplify the mesh"));
}

TEST(Mesh, ThatHasNoHullIsRefused) {
  const Surface line = {{{0, 0, 0}, {1, 1, 1}, {2, 2, 2}}, {{0, 1, 2}}};
  EXPECT_THAT(mesh_refusal("line.obj", obj(line)),
              HasSubstr("points on one line): must have three"));
  EXPECT_THAT(mesh_refusal("points.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\np 1\np 2\np 3\n"),
              HasSubstr("must have triangles"));
  EXPECT_THAT(mesh_refusal("wedge.stl", ascii_stl(wedge()), "scale='1 0 1'"),
              HasSubstr("collision l/c.mesh.scale is \"1 0 1\": must be three finite numbers"));
  EXPECT_THAT(mesh_refusal("wedge.stl", ascii_stl(wedge()), "scales='1 1 1'"),
              HasSubstr("collision l/c.mesh.scales is unknown: must be one of filename, scale"));
}

TEST(Mesh, OfAnotherFormatOrOutOfNowhereIsRefused) {
  EXPECT_THAT(mesh_refusal("wedge.ply", "ply\n"), HasSubstr("must be STL, OBJ or COLLADA"));
  const auto of = [](const std::string& filename) {
    return refusal_of("mesh.urdf",
                      "<robot name='r'><link name='l'><collision name='c'><geometry>"
                      "<mesh filename='" +
                          filename + "'/></geometry></collision></link></robot>");
  };
  for (const char* nowhere : {"nowhere.stl", "/nowhere/at/all.stl", "file:///nowhere.stl",
                              "package://no_package/meshes/a.dae", "../../../nowhere.obj"}) {
    EXPECT_THAT(of(nowhere),
                HasSubstr(fmt::format("collision l/c.mesh is \"{}\": must name a file", nowhere)));
  }
  EXPECT_THAT(of("https://example.org/a.stl"), HasSubstr("must be on this machine"));
  EXPECT_THAT(of("."), HasSubstr("must be STL, OBJ or COLLADA"));
}

/// A file with a number in four bytes put in its place.
std::string with_bytes(std::string bytes, std::size_t at, std::uint32_t value) {
  std::memcpy(&bytes.at(at), &value, sizeof value);
  return bytes;
}
std::string with_text(std::string text, const std::string& from, const std::string& to) {
  return text.replace(text.find(from), from.size(), to);
}

TEST(Mesh, ThatIsDamagedIsRefusedByName) {
  const std::string binary = binary_stl(two_boxes()), ascii = ascii_stl(two_boxes()),
                    objects = obj(two_boxes()), collada = dae(two_boxes());
  std::vector<std::pair<std::string, std::string>> damaged;
  for (const std::size_t size : {0, 1, 79, 80, 83, 84, 100, 133, 134, 500, 1200}) {
    damaged.emplace_back(fmt::format("cut{}.stl", size), binary.substr(0, size));
  }
  for (const std::uint32_t count : {0U, 25U, 1000U, 1U << 31, ~0U}) {
    damaged.emplace_back(fmt::format("count{}.stl", count), with_bytes(binary, 80, count));
  }
  constexpr std::uint32_t nan = 0x7fc00000, infinity = 0x7f800000, minus_infinity = 0xff800000;
  for (const std::uint32_t value : {nan, infinity, minus_infinity}) {
    damaged.emplace_back(fmt::format("value{}.stl", value), with_bytes(binary, 96, value));
  }
  for (const char* word : {"nan", "inf", "-inf", "1e999", "x", ""}) {
    const std::string vertex = fmt::format("vertex {} 0 0", word);
    damaged.emplace_back(fmt::format("word{}.stl", word), with_text(ascii, "vertex 0 0 0", vertex));
  }
  damaged.emplace_back("empty.stl", "solid s\nendsolid s\n");
  damaged.emplace_back("two.stl", with_text(ascii, "vertex 0 0 0\n", ""));
  damaged.emplace_back("text.stl",
                       "This is no mesh at all, but a sentence of some length, which "
                       "goes on and on until it is as long as a header.");
  damaged.emplace_back("html.stl", "<html><body>404 Not Found</body></html>");
  damaged.emplace_back("lfs.stl", "version https://git-lfs.github.com/spec/v1\noid sha256:0\n");
  for (const char* face : {"f 1 2 99", "f 0 1 2", "f -99 1 2", "f a b c", "f 1 2"}) {
    damaged.emplace_back(fmt::format("{}.obj", face[2] == '-' ? 'm' : face[6]),
                         "v 0 0 0\nv 1 0 0\nv 0 1 0\n" + std::string(face) + '\n');
  }
  for (const char* word : {"nan", "inf", "x"}) {
    damaged.emplace_back(fmt::format("word{}.obj", word),
                         with_text(objects, "v 0 0 0", fmt::format("v {} 0 0", word)));
  }
  damaged.emplace_back("empty.obj", "");
  damaged.emplace_back("comment.obj", "# nothing is here but a comment, of some length\n");
  for (const std::size_t size : {0, 20, 200, 600, 1000}) {
    damaged.emplace_back(fmt::format("cut{}.dae", size), collada.substr(0, size));
  }
  damaged.emplace_back("count.dae", with_text(collada, "count=\"48\"", "count=\"4000000000\""));
  damaged.emplace_back("stride.dae", with_text(collada, "stride=\"3\"", "stride=\"4000000000\""));
  damaged.emplace_back("index.dae", with_text(collada, "<p>0 2 3", "<p>0 2 99"));
  damaged.emplace_back("nan.dae", with_text(collada, ">0 0 0 ", ">nan 0 0 "));
  damaged.emplace_back("source.dae", with_text(collada, "source=\"#p\"", "source=\"#q\""));
  damaged.emplace_back("geometry.dae", with_text(collada, "url=\"#g\"", "url=\"#h\""));
  damaged.emplace_back("html.dae", "<html><body>404 Not Found</body></html>");
  EXPECT_GE(damaged.size(), 50U);
  for (const auto& [name, content] : damaged) {
    EXPECT_THAT(mesh_refusal(name, content), HasSubstr(name)) << printable(content, 80);
  }
}

TEST(Mesh, IsFoundInAPackageOfAFolderAboveOrOfTheModelPath) {
  const OwnFolder root;
  root.with("arm/meshes/wedge.stl", ascii_stl(wedge()));
  const std::string text =
      "<robot name='r'><link name='l'><collision><geometry>"
      "<mesh filename='package://arm/meshes/wedge.stl'/></geometry></collision></link></robot>";
  EXPECT_EQ(corners(read_robot(root.with("arm/urdf/arm.urdf", text))).size(), 4U);
  const Written elsewhere("elsewhere.urdf", text);
  EXPECT_THROW(read_robot(elsewhere.path), InvalidInput);
  EXPECT_EQ(corners(read_robot(elsewhere.path, {root.path})).size(), 4U);
}

TEST(Mesh, OfAWorldIsReadAsOneOfARobot) {
  const Written mesh("wedge.stl", ascii_stl(wedge()));
  const auto world = [&](const std::string& more) {
    return "<sdf version='1.7'><model name='m'><link name='l'><collision name='c'><geometry><mesh>"
           "<uri>" +
           mesh.path.filename().string() + "</uri>" + more +
           "</mesh></geometry></collision></link></model></sdf>";
  };
  const std::vector<Vec3> expected = {{0, 0, 0}, {0, 0, 4}, {0, 4, 0}, {1, 0, 0}};
  EXPECT_EQ(corners(robot_of("mesh.sdf", world("<scale>0.5 1 2</scale>"))), expected);
  EXPECT_THAT(refusal_of("mesh.sdf", world("<submesh><name>part</name></submesh>")),
              HasSubstr("collision m::l/c.mesh.submesh is \"part\": must be left out"));
  EXPECT_THAT(refusal_of("mesh.sdf", world("<scale>1 1</scale>")),
              HasSubstr("mesh.scale is \"1 1\": must be 3 numbers"));
}

/// MuJoCo moves a mesh to its centre of mass and turns it to its axes of inertia, in single
/// precision.
TEST(Mesh, OfMjcfIsWhereItsFileHasIt) {
  const Written mesh("wedge.stl", binary_stl(wedge()));
  const RobotFile robot = robot_of(
      "mesh.xml", fmt::format("<mujoco><compiler meshdir='{}'/><asset><mesh name='w' file='{}' "
                              "scale='0.5 0.5 0.5'/></asset><worldbody><body name='b'><geom "
                              "type='mesh' mesh='w' pos='0 0 3'/></body></worldbody></mujoco>",
                              mesh.path.parent_path().string(), mesh.path.filename().string()));
  const std::vector<Vec3> expected = {{0, 0, 3}, {0, 0, 4}, {0, 2, 3}, {1, 0, 3}};
  const LinkShape& shape = by_name(robot.links, "b").shapes.at(0);
  for (const Vec3& v : std::get<Convex>(shape.shape).vertices()) {
    const Vec3 found = shape.pose.position() + shape.pose.rotation() * v;
    const auto is_it = [&](const Vec3& p) { return (p - found).norm() < 1e-6; };
    EXPECT_TRUE(std::ranges::any_of(expected, is_it)) << found.transpose();
  }
  EXPECT_EQ(std::get<Convex>(shape.shape).vertices().size(), 4U);
}

}  // namespace
}  // namespace touchstone
