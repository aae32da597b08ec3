// MuJoCo 2.2.2's own world.
//
// World     A model made from XML, mj_step. All options are MuJoCo's defaults but for the time
// step:
//           Newton solver, pyramidal friction cones, condim 3, semi-implicit Euler. Its contacts
//           are soft (solref 0.02 1, solimp 0.9 0.95 0.001): a body at rest sinks in by some tenths
//           of a millimetre, and one that friction holds creeps; docs/inside-the-engines.md has the
//           sums. At its best: as hard as the step allows (solref two steps, solimp 0.99 0.999),
//           elliptic cones, impratio 10.
// Shapes    cylinder, box, capsule, sphere with half lengths; a plane is infinite. A hull is a mesh
//           asset, spheres are several geoms of one body.
// Masses    Inertia of the exact bodies. MuJoCo takes the larger friction of two bodies.
// Drives    A free body so heavy that no contact stops it, whose pose and velocity are set before
//           each step: contacts with a mocap body know nothing of its velocity.
#include <algorithm>
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

/// The same attributes of a part that stands for a cylinder; a hull's mesh has this name.
std::string part_xml(const RoundedPolytope& part, const std::string& mesh) {
  const auto& corners = part.vertices();
  if (corners.size() == 1) {
    const Vec3& p = corners[0];
    return GeomXml{}(Sphere(part.radius())) + fmt::format(" pos='{} {} {}'", p.x(), p.y(), p.z());
  }
  if (corners.size() == 2) {
    return GeomXml{}(Capsule(part.radius(), (corners[1] - corners[0]).norm() / 2));
  }
  return fmt::format("type='mesh' mesh='{}'", mesh);
}

std::string mesh_xml(const RoundedPolytope& hull, const std::string& name) {
  std::string xml = fmt::format("<mesh name='{}' vertex='", name);
  for (const Vec3& v : hull.vertices()) xml += fmt::format("{} {} {} ", v.x(), v.y(), v.z());
  return xml + "'/>";
}

/// Options and defaults of a world whose contacts are as hard as the step allows: by MuJoCo's
/// documentation the time constant of a contact has to be two steps at least.
std::string best_xml(double step) {
  return fmt::format(
      "<option cone='elliptic' impratio='10'/><default><geom solref='{} 1' "
      "solimp='0.99 0.999 0.001'/></default>",
      2 * step);
}

/// Mass of a driven body as a multiple of all free ones': the share of an impulse that moves it.
constexpr double driven_mass_ratio = 1e6;

/// Pairs that MuJoCo would let touch though neither body yields to the other.
std::string exclusions_xml(const Scene& scene) {
  std::string xml;
  for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
    if (!scene.bodies[i].drive) continue;
    for (std::size_t j = 0; j < scene.bodies.size(); ++j) {
      const Body& other = scene.bodies[j];
      if (other.fixed || (other.drive && i < j)) {
        xml += fmt::format("<exclude body1='b{}' body2='b{}'/>", i, j);
      }
    }
  }
  return xml.empty() ? "" : "<contact>" + xml + "</contact>";
}

mjModel* load_xml(const std::string& xml) {
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
  MujocoWorld(const Scene& scene, const EngineSetup& setup)
      : EngineWorld(scene, setup), model_(load_xml(scene_xml())), data_(mj_makeData(model_)) {
    for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
      const Body& body = scene.bodies[i];
      place_of_.push_back(places_);
      if (body.fixed) continue;
      ++places_;
      set_velocity(i, {body.pose, body.velocity, body.angular_velocity});
    }
  }
  ~MujocoWorld() override {
    mj_deleteData(data_);
    mj_deleteModel(model_);
  }
  MujocoWorld(const MujocoWorld&) = delete;
  MujocoWorld& operator=(const MujocoWorld&) = delete;

  Contacts contacts() const override { return {data_->ncon}; }

 protected:
  void advance() override {
    mj_step(model_, data_);
    std::fill_n(data_->xfrc_applied, 6 * model_->nbody, 0.0);
    const bool was_reset = data_->warning[mjWARN_BADQPOS].number > 0 ||
                           data_->warning[mjWARN_BADQVEL].number > 0 ||
                           data_->warning[mjWARN_BADQACC].number > 0;
    for (std::size_t i = 0; i < scene_.bodies.size(); ++i) {
      if (!scene_.bodies[i].is_free()) continue;
      const double *q = data_->qpos + 7 * place_of_[i], *v = data_->qvel + 6 * place_of_[i];
      const Vec3 position = was_reset ? Vec3::Constant(2 * max_in_world) : Vec3(q[0], q[1], q[2]);
      const Eigen::Quaterniond turn(q[3], q[4], q[5], q[6]);
      set_state(i, position, {q[3], q[4], q[5], q[6]}, Vec3(v[0], v[1], v[2]),
                turn.normalized() * Vec3(v[3], v[4], v[5]));
    }
  }
  void drive(std::size_t body, const BodyState& state, const Pose&) override {
    double* const q = data_->qpos + 7 * place_of_[body];
    const Eigen::Quaterniond turn = state.pose.unit_orientation();
    mju_copy3(q, state.pose.position().data());
    q[3] = turn.w(), q[4] = turn.x(), q[5] = turn.y(), q[6] = turn.z();
    set_velocity(body, state);
    const Vec3 weight = model_->body_mass[body + 1] * scene_.gravity;
    mju_addToScl3(force_on(body), weight.data(), -1);
  }
  void push(std::size_t body, const Push& push) override {
    mju_addTo3(force_on(body), push.force.data());
    mju_addTo3(force_on(body) + 3, push.torque.data());
  }

 private:
  /// Force and torque on a body; MuJoCo's first body is the world.
  double* force_on(std::size_t body) { return data_->xfrc_applied + 6 * (body + 1); }

  /// The linear part in the world's frame, the angular one in the body's.
  void set_velocity(std::size_t body, const BodyState& state) {
    double* const velocity = data_->qvel + 6 * place_of_[body];
    const Vec3 spin = state.pose.rotation().transpose() * state.angular_velocity;
    mju_copy3(velocity, state.velocity.data());
    mju_copy3(velocity + 3, spin.data());
  }

  std::string body_xml(std::size_t index, double driven_mass) const {
    const Body& body = scene_.bodies[index];
    const Vec3& p = body.pose.position();
    const Eigen::Quaterniond q = body.pose.unit_orientation();
    std::string xml = fmt::format("<body name='b{}' pos='{} {} {}' quat='{} {} {} {}'>", index,
                                  p.x(), p.y(), p.z(), q.w(), q.x(), q.y(), q.z());
    if (!body.fixed) {
      Inertia i = inertia(body.shape, body.density);
      if (body.drive) i.principal *= driven_mass / i.mass, i.mass = driven_mass;
      xml += fmt::format("<freejoint/><inertial pos='0 0 0' mass='{}' diaginertia='{} {} {}'/>",
                         i.mass, i.principal.x(), i.principal.y(), i.principal.z());
    }
    const auto parts = this->parts(index);
    std::vector<std::string> geoms;
    if (parts.empty()) geoms.push_back(std::visit(GeomXml{}, shape(index)));
    for (const RoundedPolytope& part : parts) {
      geoms.push_back(part_xml(part, fmt::format("m{}", index)));
    }
    for (const std::string& geom : geoms) {
      xml += fmt::format("<geom {} friction='{} 0.005 0.0001'/>", geom, body.material.friction);
    }
    return xml + "</body>";
  }

  std::string scene_xml() const {
    std::string meshes, bodies;
    double mass = 0;
    std::size_t geoms = 1;
    for (const Body& body : scene_.bodies) {
      if (body.is_free()) mass += inertia(body.shape, body.density).mass;
    }
    for (std::size_t i = 0; i < scene_.bodies.size(); ++i) {
      const auto parts = this->parts(i);
      geoms += std::max<std::size_t>(1, parts.size());
      if (parts.size() == 1 && parts[0].vertices().size() > 2) {
        meshes += mesh_xml(parts[0], fmt::format("m{}", i));
      }
      bodies += body_xml(i, driven_mass_ratio * std::max(mass, 1.0));
    }
    // Room for contacts; MuJoCo's memory grows with the square of the rows, four to a contact.
    const std::size_t contacts = 16 * geoms;
    const Vec3& g = scene_.gravity;
    return fmt::format(
        "<mujoco><option timestep='{}' gravity='{} {} {}'>{}</option>"
        "<size nconmax='{}' njmax='{}'/>{}{}<worldbody>{}</worldbody>{}</mujoco>",
        scene_.step, g.x(), g.y(), g.z(), is_multipoint() ? "<flag multiccd='enable'/>" : "",
        contacts, 4 * contacts, setup_.best_solver ? best_xml(scene_.step) : "",
        meshes.empty() ? "" : "<asset>" + meshes + "</asset>", bodies, exclusions_xml(scene_));
  }

  std::vector<std::size_t> place_of_;  ///< by body: how many before it are not fixed
  std::size_t places_ = 0;
  mjModel* model_;
  mjData* data_;
};

std::unique_ptr<Simulation> begin(const Scene& scene, const EngineSetup& setup) {
  if (setup.cured || setup.has(EngineShape::Kind::exact)) mujoco::install();
  mju_user_warning = [](const char*) {};  // it would write a file where the program runs
  mju_user_error = [](const char*) { std::abort(); };  // it would wait for a key
  return std::make_unique<MujocoWorld>(scene, setup);
}

}  // namespace
}  // namespace touchstone

const touchstone::EngineModule* touchstone_engine() {
  static const touchstone::EngineModule module = {
      mj_versionString(),
      "double precision; mj_step with default options: Newton solver, pyramidal cones, soft "
      "contacts (solref 0.02 1)",
      "contacts as hard as the step allows (solref of two steps, solimp 0.99 0.999), elliptic "
      "cones, impratio 10",
      touchstone::begin};
  return &module;
}
