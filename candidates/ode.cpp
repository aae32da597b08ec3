// ODE 0.16.2, double precision.
//
// Calls        dCollide on two geoms without spaces, asked for TOUCHSTONE_MAX_POINTS contacts.
// Routes       As Debian builds it: sphere and plane are ODE's own closed forms, the box its
//              separating-axis code with clipping, the capsule libccd's MPR, the cylinder special
//              code for nearly parallel axes and otherwise libccd's MPR, the convex body libccd's
//              MPR.
// Shapes       Full lengths; a capsule's length is without its caps; a plane is a·x = d. A convex
//              body is dCreateConvex of its faces about the mean of its vertices, for MPR searches
//              from a geom's origin.
// Conventions  The normal points into the first geom, hence from B to A for a call with A first;
//              depth is positive inside. Positions are where ODE puts them (on the cylinder for a
//              plane, inside both bodies for MPR).
// Meshes       ode-mesh:N is the cylinder A as the triangle mesh of the prism with N sides, against
//              B's own geom. A mesh is a surface: a body wholly inside it is not in contact.
// Threshold    ODE has none: it answers only if it finds the bodies touching.
// Cured        With TOUCHSTONE_CURED, Touchstone's contacts are installed in ODE
//              (reference/engines/ode.hpp), and the candidate is ode+touchstone.
// Planes       A plane geom has no pose, so that a posed plane is transformed to world coordinates
//              at every query.
#include <array>
#include <limits>
#include <memory>
#include <ode/ode.h>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "candidates/adapter.hpp"
#include "candidates/model.hpp"
#include "candidates/ode_library.hpp"
#include "candidates/ode_mesh.hpp"
#ifdef TOUCHSTONE_CURED
#include "reference/engines/ode.hpp"
#endif

namespace {

dGeomID make_geom(const ts_shape& shape) {
  const double* s = shape.size;
  switch (shape.kind) {
    case TS_CYLINDER:
      return dCreateCylinder(nullptr, s[0], 2 * s[1]);
    case TS_PLANE:
      return dCreatePlane(nullptr, s[0], s[1], s[2], s[3]);
    case TS_SPHERE:
      return dCreateSphere(nullptr, s[0]);
    case TS_CAPSULE:
      return dCreateCapsule(nullptr, s[0], 2 * s[1]);
    case TS_BOX:
      return dCreateBox(nullptr, 2 * s[0], 2 * s[1], 2 * s[2]);
    case TS_CONVEX:
      break;  // a Hull
  }
  return nullptr;
}

/// A convex body about the mean of its vertices; ODE keeps pointers to all of it.
class Hull {
 public:
  explicit Hull(const ts_shape& shape) : middle_(touchstone::adapter::middle_of(shape)) {
    const auto coordinates = touchstone::coordinates_of(shape);
    for (std::size_t i = 0; i < coordinates.size(); ++i) {
      corners_.push_back(coordinates[i] - middle_[i % 3]);
    }
    for (const std::vector<int>& face : touchstone::faces_of(shape)) {
      polygons_.push_back(static_cast<unsigned>(face.size()));
      polygons_.insert(polygons_.end(), face.begin(), face.end());
      add_plane(face);
    }
  }
  Hull(const Hull&) = delete;
  Hull& operator=(const Hull&) = delete;

  dGeomID make_geom() const {
    return dCreateConvex(nullptr, planes_.data(), static_cast<unsigned>(planes_.size() / 4),
                         corners_.data(), static_cast<unsigned>(corners_.size() / 3),
                         polygons_.data());
  }
  /// Where the geom's origin is for a body at this pose.
  ts_pose at(const ts_pose& pose) const {
    dMatrix3 turn;
    dRfromQ(turn, pose.orientation);
    const dVector3 middle = {middle_[0], middle_[1], middle_[2]};
    dVector3 offset;
    dMultiply0_331(offset, turn, middle);
    ts_pose result = pose;
    for (int i = 0; i < 3; ++i) result.position[i] += offset[i];
    return result;
  }

 private:
  touchstone::Vec3 corner(int i) const {
    return Eigen::Map<const touchstone::Vec3>(corners_.data() + std::ptrdiff_t{3} * i);
  }
  void add_plane(const std::vector<int>& face) {
    touchstone::Vec3 area = touchstone::Vec3::Zero();
    for (std::size_t i = 2; i < face.size(); ++i) {
      area += (corner(face[i - 1]) - corner(face[0])).cross(corner(face[i]) - corner(face[0]));
    }
    const touchstone::Vec3 n = area.stableNormalized();
    planes_.insert(planes_.end(), {n.x(), n.y(), n.z(), n.dot(corner(face[0]))});
  }

  std::array<double, 3> middle_;
  std::vector<double> corners_, planes_;
  std::vector<unsigned> polygons_;
};

/// The surface of a prism, which may meet a convex body.
std::unique_ptr<touchstone::OdeMesh> make_prism(int sides, double radius, double half_length,
                                                bool meets_hull) {
  std::vector<dTriIndex> indices;
  const auto n = static_cast<dTriIndex>(sides);
  const auto add = [&](dTriIndex i, dTriIndex j, dTriIndex k) {
    indices.insert(indices.end(), {i, j, k});
  };
  for (dTriIndex i = 0; i < n; ++i) {
    const dTriIndex next = (i + 1) % n;
    add(i, next, next + n);
    add(i, next + n, i + n);
    if (i > 0 && next > 0) {
      add(0, next, i);
      add(n, i + n, next + n);
    }
  }
  auto mesh = std::make_unique<touchstone::OdeMesh>(
      touchstone::RoundedPolytope::prism(sides, radius, half_length).vertices(),
      std::move(indices));
  if (meets_hull) mesh->find_angles();
  return mesh;
}

}  // namespace

struct ts_prepared {
 public:
  ts_prepared(const ts_shape& a, const ts_shape& b)
      : shape_b_(b), hull_(hull_of(b)), a_(make_geom(a)), b_(geom_of_b()) {}
  /// A as a mesh.
  ts_prepared(const ts_shape& a, const ts_shape& b, int sides)
      : shape_b_(b),
        hull_(hull_of(b)),
        mesh_(make_prism(sides, a.size[0], a.size[1], b.kind == TS_CONVEX)),
        model_(std::in_place, a, b,
               [sides](double radius, double half_length) {
                 return touchstone::inscribed_prism(sides, radius, half_length);
               }),
        a_(mesh_->make_geom(nullptr)),
        b_(geom_of_b()) {}
  ~ts_prepared() {
    dGeomDestroy(a_);
    dGeomDestroy(b_);
  }
  ts_prepared(const ts_prepared&) = delete;
  ts_prepared& operator=(const ts_prepared&) = delete;

  void query(const ts_pose& a, const ts_pose& b, ts_answer& answer) {
    place(a_, a);
    if (shape_b_.kind == TS_PLANE) {
      place_plane(b);
    } else {
      place(b_, hull_ ? hull_->at(b) : b);
    }
    // A mesh gives points on every triangle, and the deepest may come last.
    constexpr int max_contacts = 64;
    dContactGeom contacts[max_contacts];
    const int count = dCollide(a_, b_, mesh_ ? max_contacts : TOUCHSTONE_MAX_POINTS, contacts,
                               sizeof(dContactGeom));
    touchstone::adapter::begin(answer);
    for (const dContactGeom& c : std::span(contacts, static_cast<std::size_t>(count))) {
      touchstone::adapter::add_point(c.pos, c.normal, -c.depth, answer);
    }
  }

  /// Distance of the mesh's prism; NaN if B is a cylinder, which is not replaced.
  double model_distance(const ts_pose& a, const ts_pose& b) {
    if (shape_b_.kind == TS_CYLINDER) return std::numeric_limits<double>::quiet_NaN();
    return model_->separation(a, b).distance;
  }

 private:
  static std::unique_ptr<Hull> hull_of(const ts_shape& b) {
    return b.kind == TS_CONVEX ? std::make_unique<Hull>(b) : nullptr;
  }
  dGeomID geom_of_b() const { return hull_ ? hull_->make_geom() : make_geom(shape_b_); }

  static void place(dGeomID geom, const ts_pose& pose) {
    dGeomSetPosition(geom, pose.position[0], pose.position[1], pose.position[2]);
    dGeomSetQuaternion(geom, pose.orientation);
  }

  void place_plane(const ts_pose& pose) {
    dMatrix3 r;
    dRfromQ(r, pose.orientation);
    dVector3 n;
    dMultiply0_331(n, r, shape_b_.size);
    const double* p = pose.position;
    dGeomPlaneSetParams(b_, n[0], n[1], n[2],
                        shape_b_.size[3] + n[0] * p[0] + n[1] * p[1] + n[2] * p[2]);
  }

  ts_shape shape_b_;
  std::unique_ptr<Hull> hull_;  ///< B as a convex body; else null
  std::unique_ptr<touchstone::OdeMesh> mesh_;
  std::optional<touchstone::ModelPair> model_;
  dGeomID a_, b_;
};

namespace {

using touchstone::adapter::release, touchstone::adapter::supports_all,
    touchstone::adapter::supports_primitives;

ts_prepared* prepare(void*, const ts_shape* a, const ts_shape* b, double, double) {
  touchstone::initialise_ode();
#ifdef TOUCHSTONE_CURED
  touchstone::ode::install();
#endif
  return new ts_prepared(*a, *b);
}

void query(ts_prepared* prepared, const ts_pose* a, const ts_pose* b, const double*,
           ts_answer* answer) {
  prepared->query(*a, *b, *answer);
}

#ifdef TOUCHSTONE_CURED

const ts_candidate candidates[] = {
    {"ode+touchstone", TOUCHSTONE_ODE_VERSION,
     "double precision; dCollide with Touchstone's contacts of cylinders installed, asked for 16; "
     "positions halfway between the surfaces",
     nullptr, nullptr, supports_primitives, prepare, query, release, nullptr, nullptr}};

#else

ts_prepared* prepare_mesh(void*, const ts_shape* a, const ts_shape* b, double, double sides) {
  touchstone::initialise_ode();
  return new ts_prepared(*a, *b, static_cast<int>(sides));
}

double model_distance(ts_prepared* prepared, const ts_pose* a, const ts_pose* b) {
  return prepared->model_distance(*a, *b);
}

const ts_parameter sides = {"number of sides", 3, 128, 16, 1, 0};

const ts_candidate candidates[] = {
    {"ode", TOUCHSTONE_ODE_VERSION,
     "double precision; dCollide asked for 16 contacts; cylinder, capsule and convex body through "
     "libccd's MPR, box by separating axes and clipping, plane and sphere analytic; positions as "
     "ODE gives them",
     nullptr, nullptr, supports_all, prepare, query, release, nullptr, nullptr},
    {"ode-mesh", TOUCHSTONE_ODE_VERSION,
     "double precision; dCollide of a triangle mesh and a primitive, asked for 64 contacts of "
     "which "
     "the 16 deepest are kept",
     "the cylinder A as the triangle mesh of the regular prism with its corners on the rims",
     &sides, supports_all, prepare_mesh, query, release, model_distance, nullptr}};

#endif

const ts_plugin plugin = touchstone::adapter::plugin_of(candidates);

}  // namespace

const ts_plugin* touchstone_plugin() { return &plugin; }
