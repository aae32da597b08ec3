// MuJoCo's mj_collision with the drop-in.
#include "reference/engines/mujoco.hpp"

#include <cstring>
#include <fmt/format.h>
#include <memory>
#include <stdexcept>

#include "reference/engines/drop_in_test.hpp"

namespace touchstone {
namespace {

std::string size_text(const Cylinder& s) {
  return fmt::format("{} {}", s.radius(), s.half_length());
}
std::string size_text(const Capsule& s) {
  return fmt::format("{} {}", s.radius(), s.half_length());
}
std::string size_text(const Sphere& s) { return fmt::format("{}", s.radius()); }
std::string size_text(const Plane&) { return "1 1 1"; }  // of its picture
std::string size_text(const Convex&) { throw std::logic_error("no hulls here"); }
std::string size_text(const Box& s) {
  const Vec3& h = s.half_extents();
  return fmt::format("{} {} {}", h.x(), h.y(), h.z());
}

/// A plane of MuJoCo is the xy-plane of its frame.
Pose pose_in_mujoco(const Shape& shape, const Pose& pose) {
  const auto* plane = std::get_if<Plane>(&shape);
  if (!plane) return pose;
  const Vec3 normal = pose.rotation() * plane->unit_normal();
  return Pose(pose.position() + plane->unit_displacement() * normal,
              turn_between(Vec3::UnitZ(), normal));
}

/// Attributes of a geom.
std::string geom_xml(const Shape& shape, const Pose& pose) {
  const Pose at = pose_in_mujoco(shape, pose);
  const Vec3& x = at.position();
  const Eigen::Quaterniond q = at.unit_orientation();
  return fmt::format("type='{}' size='{}' pos='{} {} {}' quat='{} {} {} {}'", shape_name(shape),
                     std::visit([](const auto& s) { return size_text(s); }, shape), x.x(), x.y(),
                     x.z(), q.w(), q.x(), q.y(), q.z());
}

/// A model of A, a free body, and B, part of the world, after mj_collision.
class Scene {
 public:
  Scene(const Configuration& c, bool cylinder_is_first, double margin, double gap = 0) {
    const auto geom = [&](const char* name, const Shape& shape, const Pose& pose) {
      return fmt::format("<geom name='{}' {} margin='{}' gap='{}'/>", name, geom_xml(shape, pose),
                         margin, gap);
    };
    const std::string b = geom("b", c.b, c.pose_b);
    const std::string a = "<body><freejoint/>" + geom("a", c.a, c.pose_a) + "</body>";
    // A geom of the world comes first, wherever it stands in the text.
    const bool both_move = cylinder_is_first && !std::holds_alternative<Plane>(c.b);
    const std::string xml = "<mujoco><worldbody>" + a +
                            (both_move ? "<body><freejoint/>" + b + "</body>" : b) +
                            "</worldbody></mujoco>";
    const auto files = std::make_unique<mjVFS>();
    mj_defaultVFS(files.get());
    mj_makeEmptyFileVFS(files.get(), "scene.xml", static_cast<int>(xml.size()));
    std::memcpy(files->filedata[0], xml.data(), xml.size());
    char error[500] = "";
    model = mj_loadXML("scene.xml", files.get(), error, sizeof error);
    mj_deleteVFS(files.get());
    if (!model) throw std::runtime_error(error);
    data = mj_makeData(model);
    mj_kinematics(model, data);
    mj_comPos(model, data);
    mj_collision(model, data);
  }
  ~Scene() {
    mj_deleteData(data);
    mj_deleteModel(model);
  }
  Scene(const Scene&) = delete;
  Scene& operator=(const Scene&) = delete;

  std::vector<EnginePoint> points() const {
    const int a = mj_name2id(model, mjOBJ_GEOM, "a");
    std::vector<EnginePoint> points;
    for (int i = 0; i < data->ncon; ++i) {
      const mjContact& c = data->contact[i];
      points.push_back({Vec3(c.pos), (c.geom1 == a ? -1 : 1) * Vec3(c.frame), -c.dist});
    }
    return points;
  }
  mjModel* model;
  mjData* data;
};

class MujocoDropIn : public testing::Test {
 protected:
  void SetUp() override { mujoco::install(); }
  void TearDown() override { mujoco::uninstall(); }
};

constexpr double rounded_by_xml = 1e-12;

TEST_F(MujocoDropIn, AnswersEveryPairWhicheverGeomComesFirst) {
  for (const Pair pair : pairs_of_sizes) {
    for (const Identity& id : everyday_poses(pair, 2)) {
      const Configuration c = make_configuration(id);
      SCOPED_TRACE(to_string(id));
      const double margin = 0.01 * smaller_size(c);
      for (const bool cylinder_is_first : {true, false}) {
        expect_as_ours(c, margin, 8, Scene(c, cylinder_is_first, margin).points(), rounded_by_xml);
      }
    }
  }
}

const Configuration standing{Cylinder(0.5, 1), Pose(Vec3(0, 0, 2.005)), Box({2, 2, 1}), Pose()};

TEST_F(MujocoDropIn, FindsSeparateBodiesWithinTheMarginAndExcludesThoseInTheGap) {
  EXPECT_TRUE(Scene(standing, true, 0.004).points().empty());
  for (const double gap : {0.0, 0.008}) {
    const Scene scene(standing, true, 0.01, gap);
    ASSERT_EQ(scene.data->ncon, 3);
    for (int i = 0; i < 3; ++i) {
      const mjContact& c = scene.data->contact[i];
      EXPECT_NEAR(c.dist, 0.005, 1e-12);
      EXPECT_NEAR(c.includemargin, 0.01 - gap, 1e-12);
      EXPECT_EQ(c.exclude, gap > 0 ? 1 : 0);
    }
  }
}

TEST_F(MujocoDropIn, GivesCompleteRightHandedFrames) {
  const Scene scene(standing, true, 0.01);
  ASSERT_EQ(scene.data->ncon, 3);
  const Eigen::Map<const Eigen::Matrix3d> frame(scene.data->contact[0].frame);
  EXPECT_TRUE((frame.transpose() * frame).isIdentity(1e-12));
  EXPECT_NEAR(frame.determinant(), 1, 1e-12);
}

TEST_F(MujocoDropIn, HasNoContactWithAPoseThatIsNotFinite) {
  const Scene scene(standing, true, 0.01);
  scene.data->geom_xpos[0] = NAN;
  mjContact contacts[mjMAXCONPAIR];
  const auto collide = mjCOLLISIONFUNC[mjGEOM_CYLINDER][mjGEOM_BOX];
  EXPECT_EQ(collide(scene.model, scene.data, contacts, 0, 1, 1), 0);
}

TEST_F(MujocoDropIn, SizesOfZeroStayMujocosOwn) {
  const Scene scene({Cylinder(0.5, 1), Pose(Vec3(0, 0, 1.24)), Capsule(0.25, 1), Pose()}, true, 0);
  const int a = mj_name2id(scene.model, mjOBJ_GEOM, "a");
  const int b = mj_name2id(scene.model, mjOBJ_GEOM, "b");
  scene.model->geom_size[3 * b + 1] = 0;  // a program may write a model's sizes
  mjContact ours[mjMAXCONPAIR] = {}, own[mjMAXCONPAIR] = {};
  const auto collide = [&](mjContact* contacts) {
    return mjCOLLISIONFUNC[mjGEOM_CAPSULE][mjGEOM_CYLINDER](scene.model, scene.data, contacts, b, a,
                                                            0);
  };
  ASSERT_EQ(collide(ours), 1);
  mujoco::uninstall();
  ASSERT_EQ(collide(own), 1);
  EXPECT_EQ(ours[0].dist, own[0].dist);
  EXPECT_NEAR(ours[0].dist, -0.01, 1e-4);
}

TEST_F(MujocoDropIn, LetsThreadsCollideAtOnce) {
  expect_threads_answer_alike([](int) {
    std::vector<double> numbers;
    for (const Identity& id : everyday_poses(Pair::box, 1)) {
      append(numbers, Scene(make_configuration(id), true, 0).points());
    }
    return numbers;
  });
}

TEST_F(MujocoDropIn, UninstallGivesBackMujocosOwnAnswers) {
  const auto answers = [] {
    std::vector<double> numbers;
    for (const Pair pair : pairs_of_sizes) {
      for (const Identity& id : everyday_poses(pair, 1)) {
        append(numbers, Scene(make_configuration(id), true, 0).points());
      }
    }
    return numbers;
  };
  expect_uninstall_gives_back(answers, mujoco::install, mujoco::uninstall);
}

}  // namespace
}  // namespace touchstone
