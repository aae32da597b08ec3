// MJCF through MuJoCo itself, which is loaded when a file asks for it: it is one of many engines
// here, and no other command needs it.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <dlfcn.h>
#include <fmt/format.h>
#include <numbers>

#include "properties/files/given_text.hpp"
#include "reference/invalid_input.hpp"
#include "simulation/scenes/mesh.hpp"

#ifdef TOUCHSTONE_MUJOCO
#include <mujoco/mujoco.h>

namespace touchstone {
namespace {

/// The functions of MuJoCo that the reader calls.
struct Library {
  Library() : handle(dlopen(TOUCHSTONE_MUJOCO, RTLD_NOW | RTLD_LOCAL)) {
    if (!handle) throw std::runtime_error(dlerror());
    find(load, "mj_loadXML");
    find(make_data, "mj_makeData");
    find(kinematics, "mj_kinematics");
    find(name_of, "mj_id2name");
    // By default MuJoCo writes a file into the folder of the program, and waits for a key.
    void (**warning)(const char*) = nullptr;
    void (**error)(const char*) = nullptr;
    find(warning, "mju_user_warning");
    find(error, "mju_user_error");
    *warning = [](const char*) {};
    *error = [](const char* text) {
      std::fprintf(stderr, "Error: %s\n", text);
      std::fflush(stderr);
      std::abort();
    };
  }

  template <class Function>
  void find(Function*& function, const char* name) {
    function = reinterpret_cast<Function*>(dlsym(handle, name));
    if (!function) throw std::runtime_error(fmt::format("MuJoCo has no {}", name));
  }

  void* handle;
  decltype(mj_loadXML)* load = nullptr;
  decltype(mj_makeData)* make_data = nullptr;
  decltype(mj_kinematics)* kinematics = nullptr;
  decltype(mj_id2name)* name_of = nullptr;
};

std::string in_one_line(std::string text) {
  std::ranges::replace(text, '\n', ' ');
  return text;
}

/// A model with its bodies in their default poses. Its memory goes with the process.
struct Model {
  Library library;
  const mjModel* model = nullptr;
  const mjData* data = nullptr;

  explicit Model(const std::filesystem::path& file) {
    char error[1000] = "";
    mjModel* const loaded = library.load(file.c_str(), nullptr, error, sizeof error);
    if (!loaded) {
      constexpr std::size_t max_reason = 300;
      throw InvalidInput("scene", '"' + file.string() + '"',
                         "must be MJCF: " + printable(in_one_line(error), max_reason));
    }
    mjData* const made = library.make_data(loaded);
    library.kinematics(loaded, made);
    model = loaded;
    data = made;
  }

  /// The element's name; one without a name gets that of its kind and number.
  std::string name(int object, const char* kind, int id) const {
    const char* const given = library.name_of(model, object, id);
    return given && *given ? given : fmt::format("{} {}", kind, id);
  }
};

Vec3 to_vector(const double* v) { return {v[0], v[1], v[2]}; }

/// Pose in the world of what has a position and a quaternion in a body's frame.
Pose within(const Pose& X_WB, const double* p, const double* q) {
  const Eigen::Quaterniond turn = X_WB.unit_orientation();
  return {X_WB.position() + turn * to_vector(p), turn * Eigen::Quaterniond(q[0], q[1], q[2], q[3])};
}

/// Half lengths; nothing for a height field or an ellipsoid.
std::optional<Shape> shape_of(const mjModel& m, int geom) {
  const double* const size = m.geom_size + 3 * static_cast<std::ptrdiff_t>(geom);
  switch (m.geom_type[geom]) {
    case mjGEOM_PLANE:
      return Plane(Vec3::UnitZ(), 0);
    case mjGEOM_SPHERE:
      return Sphere(size[0]);
    case mjGEOM_CAPSULE:
      return Capsule(size[0], size[1]);
    case mjGEOM_CYLINDER:
      return Cylinder(size[0], size[1]);
    case mjGEOM_BOX:
      return Box(to_vector(size));
    default:
      return std::nullopt;
  }
}

Mesh mesh_of(const mjModel& m, int mesh) {
  Mesh result;
  for (int v = m.mesh_vertadr[mesh]; v < m.mesh_vertadr[mesh] + m.mesh_vertnum[mesh]; ++v) {
    const float* const p = m.mesh_vert + 3 * static_cast<std::ptrdiff_t>(v);
    result.points.emplace_back(p[0], p[1], p[2]);
  }
  for (int f = m.mesh_faceadr[mesh]; f < m.mesh_faceadr[mesh] + m.mesh_facenum[mesh]; ++f) {
    const int* const corners = m.mesh_face + 3 * static_cast<std::ptrdiff_t>(f);
    result.triangles.push_back({corners[0], corners[1], corners[2]});
  }
  return result;
}

void leave_out(const Model& model, int geom, const std::string& name, RobotFile& result) {
  const mjModel& m = *model.model;
  LeftOut& left = result.left_out;
  ++left.shapes;
  const double* const size = m.geom_size + 3 * static_cast<std::ptrdiff_t>(geom);
  const char* what = "a height field";
  if (m.geom_type[geom] == mjGEOM_ELLIPSOID) {
    what = "an ellipsoid";
    left.volume += 4 * std::numbers::pi / 3 * to_vector(size).prod();
  } else {
    ++left.unknown;
  }
  result.ignored.push_back(fmt::format("geom {}: {}", name, what));
}

bool collides(const mjModel& m, int geom) {
  return m.geom_contype[geom] != 0 || m.geom_conaffinity[geom] != 0;
}

/// Does MuJoCo keep two bodies apart because one is welded to the parent of what the other one is
/// welded to? Not from what the world holds.
bool is_parent_and_child(const mjModel& m, int body, int other) {
  const int a = m.body_weldid[body], b = m.body_weldid[other];
  const auto parent = [&](int weld) { return m.body_weldid[m.body_parentid[weld]]; };
  return a != 0 && b != 0 && (parent(a) == b || parent(b) == a);
}

class Reading {
 public:
  Reading(const std::filesystem::path& file) : model_(file), m_(*model_.model), d_(*model_.data) {}

  RobotFile robot() {
    // The text in front of all names is that of the model.
    const std::string name = m_.names;
    result_.name = name.empty() ? "model" : name;
    result_.is_world = true;
    result_.gravity = to_vector(m_.opt.gravity);
    if (is_disabled(mjDSBL_GRAVITY)) result_.gravity.setZero();
    result_.step = m_.opt.timestep;
    for (int b = 0; b < m_.nbody; ++b) add_body(b);
    for (int b = 1; b < m_.nbody; ++b) add_joints(b);
    add_actuators();
    keep_apart();
    note_others();
    return result_;
  }

 private:
  bool is_disabled(int flag) const { return (m_.opt.disableflags & flag) != 0; }

  std::string body_name(int b) const { return model_.name(mjOBJ_BODY, "body", b); }

  Pose pose_of(int b) const {
    const double* const q = d_.xquat + 4 * static_cast<std::ptrdiff_t>(b);
    return {to_vector(d_.xpos + 3 * static_cast<std::ptrdiff_t>(b)),
            Eigen::Quaterniond(q[0], q[1], q[2], q[3])};
  }

  void add_body(int b) {
    Link link{body_name(b), pose_of(b)};
    link.fixed = m_.body_weldid[b] == 0;
    for (int g = m_.body_geomadr[b]; g < m_.body_geomadr[b] + m_.body_geomnum[b]; ++g) {
      const std::string name = link.name + '/' + model_.name(mjOBJ_GEOM, "geom", g);
      if (!collides(m_, g)) continue;
      const Pose X_WG = within(link.pose, m_.geom_pos + 3 * static_cast<std::ptrdiff_t>(g),
                               m_.geom_quat + 4 * static_cast<std::ptrdiff_t>(g));
      if (m_.geom_type[g] == mjGEOM_MESH) {
        link.shapes.push_back(hull(m_.geom_dataid[g], name, X_WG));
      } else if (const auto shape = shape_of(m_, g)) {
        link.shapes.push_back({name, *shape, X_WG});
      } else {
        leave_out(model_, g, name, result_);
        continue;
      }
      frictionless_ += m_.geom_condim[g] == 1 ? 1 : 0;
      link.shapes.back().friction = m_.geom_friction[3 * static_cast<std::ptrdiff_t>(g)];
      link.shapes.back().mask = {m_.geom_contype[g], m_.geom_conaffinity[g]};
    }
    if (m_.body_mass[b] > 0) {
      const auto of_body = [&](const mjtNum* all, int count) {
        return all + count * static_cast<std::ptrdiff_t>(b);
      };
      const Eigen::Matrix3d moments = to_vector(of_body(m_.body_inertia, 3)).asDiagonal();
      link.mass = m_.body_mass[b];
      set_inertia(link, within(link.pose, of_body(m_.body_ipos, 3), of_body(m_.body_iquat, 4)),
                  moments, result_);
    }
    result_.links.push_back(std::move(link));
  }

  LinkShape hull(int mesh, const std::string& name, const Pose& X_WG) {
    try {
      return hull_of(mesh_of(m_, mesh), model_.name(mjOBJ_MESH, "mesh", mesh), name, X_WG, result_);
    } catch (const InvalidInput& e) {
      throw e.within("geom " + name);
    }
  }

  /// Position of the joint's limit relative to its default position; MuJoCo counts from `ref`.
  void limit(int j, LinkJoint& joint) const {
    const double at = m_.qpos0[m_.jnt_qposadr[j]];
    const bool is_limited = m_.jnt_limited[j] != 0 && !is_disabled(mjDSBL_LIMIT);
    joint.lower = is_limited ? m_.jnt_range[2 * static_cast<std::ptrdiff_t>(j)] - at : -infinity;
    joint.upper = is_limited ? m_.jnt_range[2 * static_cast<std::ptrdiff_t>(j) + 1] - at : infinity;
  }

  /// Joins a body to its parent by its joints. Of several, each but the last gets a link of its own
  /// in between, without shapes.
  void add_joints(int b) {
    const int parent = m_.body_parentid[b];
    std::vector<LinkJoint> joints;
    for (int j = m_.body_jntadr[b]; j < m_.body_jntadr[b] + m_.body_jntnum[b]; ++j) {
      LinkJoint joint;
      joint.name = model_.name(mjOBJ_JOINT, "joint", j);
      joint.axis = to_vector(d_.xaxis + 3 * static_cast<std::ptrdiff_t>(j));
      joint.anchor = to_vector(d_.xanchor + 3 * static_cast<std::ptrdiff_t>(j));
      joint.holds = false;
      if (m_.jnt_type[j] == mjJNT_FREE) return;
      if (m_.jnt_type[j] == mjJNT_BALL) {
        result_.ignored.push_back(fmt::format("joint {}: a ball; taken as fixed", joint.name));
        continue;
      }
      joint.kind = m_.jnt_type[j] == mjJNT_HINGE ? JointKind::hinge : JointKind::slider;
      limit(j, joint);
      joint_of_[j] = result_.joints.size() + joints.size();
      joints.push_back(joint);
    }
    if (joints.empty()) {
      if (result_.links[b].fixed) return;
      LinkJoint joint;
      joint.name = "weld of " + body_name(b);
      joints.push_back(joint);
    }
    // What the world holds stands for it: MuJoCo lets a body touch that, though a joint of ours of
    // the two would not.
    int from = m_.body_weldid[parent] == 0 ? world_body : parent;
    for (std::size_t i = 0; i < joints.size(); ++i) {
      LinkJoint& joint = joints[i];
      joint.parent = from;
      joint.child = b;
      if (i + 1 < joints.size()) {
        joint.child = static_cast<int>(result_.links.size());
        result_.links.push_back({fmt::format("{} after {}", body_name(b), joint.name), pose_of(b)});
      }
      from = joint.child;
      result_.joints.push_back(joint);
    }
  }

  /// Force that an actuator exerts in its joint at most.
  std::optional<double> strength(int a) const {
    const auto range = [&](const double* ranges) {
      const double* const r = ranges + 2 * static_cast<std::ptrdiff_t>(a);
      return std::max(std::abs(r[0]), std::abs(r[1]));
    };
    const double gear = std::abs(m_.actuator_gear[6 * static_cast<std::ptrdiff_t>(a)]);
    const bool is_motor = m_.actuator_biastype[a] == mjBIAS_NONE;
    double force = 0;
    if (m_.actuator_forcelimited[a]) {
      force = range(m_.actuator_forcerange) * gear;
    } else if (is_motor && m_.actuator_ctrllimited[a]) {
      force = range(m_.actuator_ctrlrange) * gear *
              std::abs(m_.actuator_gainprm[mjNGAIN * static_cast<std::ptrdiff_t>(a)]);
    }
    return force > 0 ? std::optional(force) : std::nullopt;
  }

  void add_actuators() {
    for (int a = 0; a < m_.nu; ++a) {
      const int joint = m_.actuator_trnid[2 * static_cast<std::ptrdiff_t>(a)];
      const bool is_of_joint =
          m_.actuator_trntype[a] == mjTRN_JOINT || m_.actuator_trntype[a] == mjTRN_JOINTINPARENT;
      if (!is_of_joint || !joint_of_.contains(joint)) {
        result_.ignored.push_back(
            fmt::format("actuator {}: not read", model_.name(mjOBJ_ACTUATOR, "actuator", a)));
        continue;
      }
      LinkJoint& held = result_.joints[joint_of_[joint]];
      // What several actuators exert adds up; one without a bound has none with others.
      const auto own = strength(a);
      const bool adds = held.holds && held.effort && own;
      held.effort = adds ? *held.effort + *own : held.holds ? std::nullopt : own;
      held.holds = true;
    }
  }

  /// MuJoCo's `exclude`, and parents and children, also with links in between.
  void keep_apart() {
    for (int i = 0; i < m_.nexclude; ++i) {
      const int signature = m_.exclude_signature[i];
      constexpr int bits = 16;
      result_.apart.emplace_back((signature >> bits) - 1, (signature & ((1 << bits) - 1)) - 1);
    }
    if (m_.nbody > static_cast<int>(max_links)) return;  // such a file is refused
    for (int b = 0; b < m_.nbody; ++b) {
      for (int other = b + 1; other < m_.nbody; ++other) {
        if (is_parent_and_child(m_, b, other)) result_.apart.emplace_back(b, other);
      }
    }
  }

  void note_unread_of_joints() {
    UnreadOfJoints unread;
    for (int j = 0; j < m_.njnt; ++j) {
      const std::string name = model_.name(mjOBJ_JOINT, "joint", j);
      const int dof = m_.jnt_dofadr[j];
      unread.add("damping", m_.dof_damping[dof], name);
      unread.add("friction", m_.dof_frictionloss[dof], name);
      unread.add("armature", m_.dof_armature[dof], name);
      unread.add("the spring", m_.jnt_stiffness[j], name);
    }
    unread.note(result_);
  }

  void note_others() {
    const auto note = [&](int count, const char* what) {
      if (count > 0) result_.ignored.push_back(fmt::format("{} {}: not read", count, what));
    };
    note_unread_of_joints();
    note(m_.ntendon, m_.ntendon == 1 ? "tendon" : "tendons");
    note(m_.neq, m_.neq == 1 ? "equality constraint" : "equality constraints");
    note(m_.npair, m_.npair == 1 ? "contact pair" : "contact pairs");
    note(m_.nsite, m_.nsite == 1 ? "site" : "sites");
    note(m_.nsensor, m_.nsensor == 1 ? "sensor" : "sensors");
    note(m_.nkey, m_.nkey == 1 ? "keyframe" : "keyframes");
    for (const auto& [flag, text] :
         {std::pair{mjDSBL_FILTERPARENT,
                    "filterparent: not read; a body does not touch its parent"},
          {mjDSBL_CONTACT, "contact: not read; bodies touch each other"},
          {mjDSBL_CONSTRAINT, "constraint: not read; bodies touch, and joints hold"},
          {mjDSBL_ACTUATION, "actuation: not read; actuators hold their joints"}}) {
      if (is_disabled(flag)) result_.ignored.push_back(fmt::format("flag {} here", text));
    }
    if (frictionless_ > 0) {
      result_.ignored.push_back(
          fmt::format("condim 1 of {}: not read; contacts have friction here",
                      frictionless_ == 1 ? "a geom" : fmt::format("{} geoms", frictionless_)));
    }
  }

  Model model_;
  const mjModel& m_;
  const mjData& d_;
  RobotFile result_;
  int frictionless_ = 0;                 ///< geoms
  std::map<int, std::size_t> joint_of_;  ///< by MuJoCo's joint: index among the result's
};

}  // namespace

RobotFile read_mjcf(const std::filesystem::path& file) {
  return Reading(std::filesystem::absolute(file)).robot();
}

}  // namespace touchstone

#else

namespace touchstone {

RobotFile read_mjcf(const std::filesystem::path& file) {
  throw InvalidInput(
      "scene", '"' + file.string() + '"',
      "must be URDF or SDF: this program was built without MuJoCo, which reads MJCF");
}

}  // namespace touchstone

#endif
