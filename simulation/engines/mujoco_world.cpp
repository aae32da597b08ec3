// MuJoCo 2.2.2's own world.
//
// World     A model made from XML, mj_step. All options are MuJoCo's defaults but for the time
// step:
//           Newton solver, pyramidal friction cones, condim 3, semi-implicit Euler. Its contacts
//           are soft (solref 0.02 1, solimp 0.9 0.95 0.001): a body at rest sinks in by some tenths
//           of a millimetre, and one that friction holds creeps; docs/inside-the-engines.md has the
//           sums. At its best: as hard as the step allows (solref two steps, solimp 0.99 0.999),
//           elliptic cones, impratio 10.
// Shapes    cylinder, box, capsule, sphere with half lengths; a plane is infinite.
// Masses    Inertia of the exact bodies. MuJoCo takes the larger friction of two bodies.
#include <cstdlib>
#include <cstring>
#include <fmt/format.h>
#include <mujoco/mujoco.h>
#include <stdexcept>
#include <string>

#include "reference/engines/mujoco.hpp"
#include "simulation/engines/engine_world.hpp"

namespace touchstone {
namespace {

/// The attributes `type`, `size` and, of a plane, its frame: MuJoCo's is solid below its xy-plane.
struct GeomXml {
  std::string operator()(const Cylinder& s) const {
    return fmt::format("type='cylinder' size='{} {}'", s.radius(), s.half_length());
  }
  std::string operator()(const Plane& s) const {
    const Vec3 &n = s.unit_normal(), p = s.unit_displacement() * n;
    return fmt::format("type='plane' size='0 0 1' pos='{} {} {}' zaxis='{} {} {}'", p.x(), p.y(),
                       p.z(), n.x(), n.y(), n.z());
  }
  std::string operator()(const Sphere& s) const {
    return fmt::format("type='sphere' size='{}'", s.radius());
  }
  std::string operator()(const Capsule& s) const {
    return fmt::format("type='capsule' size='{} {}'", s.radius(), s.half_length());
  }
  std::string operator()(const Box& s) const {
    const Vec3& h = s.half_extents();
    return fmt::format("type='box' size='{} {} {}'", h.x(), h.y(), h.z());
  }
};

std::string body_xml(const Body& body) {
  const Vec3& p = body.pose.position();
  const Eigen::Quaterniond q = body.pose.unit_orientation();
  std::string xml = fmt::format("<body pos='{} {} {}' quat='{} {} {} {}'>", p.x(), p.y(), p.z(),
                                q.w(), q.x(), q.y(), q.z());
  if (!body.fixed) {
    const Inertia i = inertia(body.shape, body.density);
    xml += fmt::format("<freejoint/><inertial pos='0 0 0' mass='{}' diaginertia='{} {} {}'/>",
                       i.mass, i.principal.x(), i.principal.y(), i.principal.z());
  }
  return xml + fmt::format("<geom {} friction='{} 0.005 0.0001'/></body>",
                           std::visit(GeomXml{}, body.shape), body.material.friction);
}

/// Options and defaults of a world whose contacts are as hard as the step allows: by MuJoCo's
/// documentation the time constant of a contact has to be two steps at least.
std::string best_xml(double step) {
  return fmt::format(
      "<option cone='elliptic' impratio='10'/><default><geom solref='{} 1' "
      "solimp='0.99 0.999 0.001'/></default>",
      2 * step);
}

std::string scene_xml(const Scene& scene, bool best_solver) {
  // Room for contacts; MuJoCo's memory grows with the square of the rows, four to a contact.
  const std::size_t contacts = 16 * (scene.bodies.size() + 1);
  const Vec3& g = scene.gravity;
  std::string xml = fmt::format(
      "<mujoco><option timestep='{}' gravity='{} {} {}'/><size nconmax='{}' njmax='{}'/>"
      "{}<worldbody>",
      scene.step, g.x(), g.y(), g.z(), contacts, 4 * contacts,
      best_solver ? best_xml(scene.step) : "");
  for (const Body& body : scene.bodies) xml += body_xml(body);
  return xml + "</worldbody></mujoco>";
}

mjModel* make_model(const Scene& scene, bool best_solver) {
  const std::string xml = scene_xml(scene, best_solver);
  const auto files = std::make_unique<mjVFS>();
  mj_defaultVFS(files.get());
  mj_makeEmptyFileVFS(files.get(), "scene.xml", static_cast<int>(xml.size()));
  std::memcpy(files->filedata[0], xml.data(), xml.size());
  char error[512] = "";
  mjModel* const model = mj_loadXML("scene.xml", files.get(), error, sizeof error);
  mj_deleteVFS(files.get());
  if (!model) throw std::runtime_error(error);
  return model;
}

class MujocoWorld : public EngineWorld {
 public:
  MujocoWorld(const Scene& scene, bool best_solver)
      : EngineWorld(scene), model_(make_model(scene, best_solver)), data_(mj_makeData(model_)) {
    double* velocity = data_->qvel;
    for (const Body& body : scene.bodies) {
      if (body.fixed) continue;
      // The linear part in the world's frame, the angular one in the body's.
      const Vec3 spin = body.pose.rotation().transpose() * body.angular_velocity;
      mju_copy3(velocity, body.velocity.data());
      mju_copy3(velocity + 3, spin.data());
      velocity += 6;
    }
  }
  ~MujocoWorld() override {
    mj_deleteData(data_);
    mj_deleteModel(model_);
  }
  MujocoWorld(const MujocoWorld&) = delete;
  MujocoWorld& operator=(const MujocoWorld&) = delete;

  void step() override {
    mj_step(model_, data_);
    const bool was_reset = data_->warning[mjWARN_BADQPOS].number > 0 ||
                           data_->warning[mjWARN_BADQVEL].number > 0 ||
                           data_->warning[mjWARN_BADQACC].number > 0;
    const double *q = data_->qpos, *v = data_->qvel;
    for (std::size_t i = 0; i < scene_.bodies.size(); ++i) {
      if (scene_.bodies[i].fixed) continue;
      const Vec3 position = was_reset ? Vec3::Constant(2 * max_in_world) : Vec3(q[0], q[1], q[2]);
      const Eigen::Quaterniond turn(q[3], q[4], q[5], q[6]);
      set_state(i, position, {q[3], q[4], q[5], q[6]}, Vec3(v[0], v[1], v[2]),
                turn.normalized() * Vec3(v[3], v[4], v[5]));
      q += 7;
      v += 6;
    }
  }

  Contacts contacts() const override { return {data_->ncon}; }

 private:
  mjModel* model_;
  mjData* data_;
};

std::unique_ptr<Simulation> begin(const Scene& scene, const EngineSetup& setup) {
  if (setup.cured) mujoco::install();
  mju_user_warning = [](const char*) {};  // it would write a file where the program runs
  mju_user_error = [](const char*) { std::abort(); };  // it would wait for a key
  return std::make_unique<MujocoWorld>(scene, setup.best_solver);
}

}  // namespace
}  // namespace touchstone

const touchstone::EngineModule* touchstone_engine() {
  static const touchstone::EngineModule module = {
      mj_versionString(),
      "double precision; mj_step with default options: Newton solver, pyramidal cones, soft "
      "contacts (solref 0.02 1)",
      "contacts as hard as the step allows (solref of two steps, solimp 0.99 0.999), elliptic "
      "cones, "
      "impratio 10",
      touchstone::begin};
  return &module;
}
