// Shapes, poses and contacts: values that compare, print and pickle by their numbers.
#include <algorithm>
#include <cmath>
#include <pybind11/eigen.h>
#include <pybind11/stl.h>

#include "oracle/hull.hpp"
#include "properties/given_orientation.hpp"
#include "python/parameters.hpp"
#include "reference/invalid_input.hpp"

namespace touchstone::python {
namespace {

py::tuple plain(const Vec3& v) { return py::make_tuple(v.x(), v.y(), v.z()); }

py::tuple plain(const Eigen::Quaterniond& q) { return py::make_tuple(q.w(), q.x(), q.y(), q.z()); }

py::array frozen(py::array array) {
  array.attr("setflags")(py::arg("write") = false);
  return array;
}

py::tuple arguments(const PointValue& p) {
  return py::make_tuple(plain(p.position), plain(p.normal), p.depth);
}

py::tuple arguments(const ContactValue& c) {
  py::tuple points(c.points.size());
  for (std::size_t i = 0; i < c.points.size(); ++i) points[i] = py::cast(c.points[i]);
  return py::make_tuple(c.signed_distance, plain(c.normal), points);
}

/// The constructor's arguments with a rounding, if there is one.
py::tuple with_rounding(const py::tuple& sharp, double rounding) {
  return rounding > 0 ? py::tuple(sharp + py::make_tuple(rounding)) : sharp;
}

void bind_shapes(py::module_& m) {
  constexpr const char* of_rounding = "By which edges and corners are rounded, metres.";

  py::class_<Cylinder> cylinder(m, "Cylinder", R"(Cylinder(radius, half_length, rounding=0)

A solid circular cylinder about its local z axis; its caps are at z = ±half_length. Edges may be
rounded: all points within `rounding` of the cylinder whose sizes are smaller by it. Metres.

>>> touchstone.Cylinder(radius=0.5, half_length=1)
Cylinder(radius=0.5, half_length=1.0)
>>> touchstone.Cylinder(radius=-1, half_length=1)
Traceback (most recent call last):
    ...
ValueError: radius is -1: must be positive and finite
)");
  define_constructor(
      cylinder,
      +[](double radius, double half_length, double rounding) {
        return Cylinder(radius, half_length, rounding);
      },
      py::arg("radius"), py::arg("half_length"), py::arg("rounding") = 0.0);
  cylinder.def_property_readonly("radius", &Cylinder::radius, "Metres.");
  cylinder.def_property_readonly("half_length", &Cylinder::half_length, "Metres.");
  cylinder.def_property_readonly("rounding", &Cylinder::rounding, of_rounding);
  define_value<Cylinder>(cylinder, {"radius", "half_length", "rounding"}, [](const Cylinder& s) {
    return with_rounding(py::make_tuple(s.radius(), s.half_length()), s.rounding());
  });

  py::class_<Plane> plane(m, "Plane", R"(Plane(normal, displacement)

The half-space normal·x <= displacement of its own frame, which is solid. The normal needs no unit
length, but must not be zero; the displacement is in metres if it has.
)");
  define_constructor(
      plane,
      +[](const Numbers<Vec3>& normal, double displacement) { return Plane(normal, displacement); },
      py::arg("normal"), py::arg("displacement"));
  plane.def_property_readonly(
      "normal", [](const Plane& s) { return vector_to_python(s.normal()); }, "As given.");
  plane.def_property_readonly("displacement", &Plane::displacement, "As given.");
  define_value<Plane>(plane, {"normal", "displacement"}, [](const Plane& s) {
    return py::make_tuple(plain(s.normal()), s.displacement());
  });

  py::class_<Sphere> sphere(m, "Sphere", "Sphere(radius)\n\nA ball about its origin. Metres.\n");
  define_constructor(
      sphere, +[](double radius) { return Sphere(radius); }, py::arg("radius"));
  sphere.def_property_readonly("radius", &Sphere::radius, "Metres.");
  define_value<Sphere>(sphere, {"radius"},
                       [](const Sphere& s) { return py::make_tuple(s.radius()); });

  py::class_<Capsule> capsule(m, "Capsule", R"(Capsule(radius, half_length)

All points within `radius` of the segment from -half_length to +half_length on the local z axis:
its ends reach half_length + radius. Metres.
)");
  define_constructor(
      capsule, +[](double radius, double half_length) { return Capsule(radius, half_length); },
      py::arg("radius"), py::arg("half_length"));
  capsule.def_property_readonly("radius", &Capsule::radius, "Metres.");
  capsule.def_property_readonly("half_length", &Capsule::half_length, "Of the segment, metres.");
  define_value<Capsule>(capsule, {"radius", "half_length"}, [](const Capsule& s) {
    return py::make_tuple(s.radius(), s.half_length());
  });

  py::class_<Box> box(m, "Box",
                      "Box(half_extents, rounding=0)\n\nA box about its origin, whose edges may be "
                      "rounded as a Cylinder's. Metres.\n");
  define_constructor(
      box,
      +[](const Numbers<Vec3>& half_extents, double rounding) {
        return Box(half_extents, rounding);
      },
      py::arg("half_extents"), py::arg("rounding") = 0.0);
  box.def_property_readonly("rounding", &Box::rounding, of_rounding);
  box.def_property_readonly(
      "half_extents", [](const Box& s) { return vector_to_python(s.half_extents()); },
      "Along the local x, y, z axes, metres; an array of three.");
  define_value<Box>(box, {"half_extents", "rounding"}, [](const Box& s) {
    return with_rounding(py::make_tuple(plain(s.half_extents())), s.rounding());
  });

  py::class_<Convex> convex(m, "Convex", R"(Convex(vertices, rounding=0)

The convex hull of three or more points of its own frame, which need not be about its origin: a
polyhedron, or a polygon in space, as a triangle. Of up to 4,096 points those are kept that are
corners, which exact arithmetic decides. With a rounding the body is larger than the hull: all points
within it. Metres.

>>> touchstone.Convex([(0, 0, 0), (1, 0, 0), (0, 1, 0), (0.25, 0.25, 0)])
Convex(vertices=((0.0, 0.0, 0.0), (1.0, 0.0, 0.0), (0.0, 1.0, 0.0)))
)");
  define_constructor(
      convex,
      +[](const Numbers<Points>& vertices, double rounding) {
        std::vector<Vec3> points;
        for (const auto& row : vertices.vector.rowwise()) points.emplace_back(row);
        return oracle::convex_hull(points, rounding);
      },
      py::arg("vertices"), py::arg("rounding") = 0.0);
  convex.def_property_readonly("rounding", &Convex::rounding, "Around the hull, metres.");
  convex.def_property_readonly(
      "vertices", [](const Convex& s) { return frozen(vectors_to_python(s.vertices())); },
      "Metres; an array of shape (n, 3).");
  define_value<Convex>(convex, {"vertices", "rounding"}, [](const Convex& s) {
    py::tuple vertices(s.vertices().size());
    for (std::size_t i = 0; i < s.vertices().size(); ++i) vertices[i] = plain(s.vertices()[i]);
    return with_rounding(py::make_tuple(vertices), s.rounding());
  });
}

void bind_pose(py::module_& m) {
  py::class_<Pose> pose(
      m, "Pose",
      R"(Pose(position=(0, 0, 0), orientation=(1, 0, 0, 0), rotation=None, axis=None)

Where a body lies in the world: maps its frame to the world's. The position is in metres, the
orientation a quaternion w, x, y, z of any length but zero; it is kept as given. In its place there
may be a rotation, a 3 × 3 array that is one to 1e-9, or an axis, the direction of the body's z in
the world, which the shortest turn brings there.

>>> touchstone.Pose((0, 0, 1))
Pose(position=(0.0, 0.0, 1.0), orientation=(1.0, 0.0, 0.0, 0.0))
>>> touchstone.Pose(orientation=(0, 0, 0, 2)).rotation @ (1, 0, 0)
array([-1.,  0.,  0.])
>>> touchstone.Pose((0, 0, 1), axis=(0, 1, 0))
Pose(position=(0.0, 0.0, 1.0), orientation=(1.0, -1.0, 0.0, 0.0))
)");
  define_constructor(
      pose,
      +[](const Numbers<Vec3>& position, const Numbers<Eigen::Vector4d>& orientation,
          const std::optional<Numbers<Eigen::Matrix3d>>& rotation,
          const std::optional<Numbers<Vec3>>& axis) {
        const Eigen::Vector4d& q = orientation;
        if ((rotation || axis) && (q != Eigen::Vector4d(1, 0, 0, 0) || (rotation && axis))) {
          throw InvalidInput(axis ? "axis" : "rotation", "given",
                             "must stand without orientation, rotation and axis besides");
        }
        return Pose(position, rotation ? orientation_of(rotation->vector)
                              : axis   ? orientation_along(axis->vector)
                                       : Eigen::Quaterniond(q[0], q[1], q[2], q[3]));
      },
      py::arg("position") = Vec3(0, 0, 0), py::arg("orientation") = Eigen::Vector4d(1, 0, 0, 0),
      py::arg("rotation") = py::none(), py::arg("axis") = py::none());
  pose.def_property_readonly(
      "position", [](const Pose& p) { return vector_to_python(p.position()); },
      "Metres, world frame; an array of three.");
  pose.def_property_readonly(
      "orientation",
      [](const Pose& p) {
        const auto& q = p.orientation();
        return frozen(py::cast(Eigen::Vector4d(q.w(), q.x(), q.y(), q.z())));
      },
      "Quaternion w, x, y, z as given; an array of four.");
  pose.def_property_readonly(
      "rotation", [](const Pose& p) { return frozen(py::cast(p.rotation())); },
      "Body frame to world frame, a 3 × 3 array; column 2 is the axis of a cylinder.");
  define_value<Pose>(pose, {"position", "orientation"}, [](const Pose& p) {
    return py::make_tuple(plain(p.position()), plain(p.orientation()));
  });
}

void bind_contact(py::module_& m) {
  py::class_<PointValue> point(m, "Point", R"(Point(position, normal, depth)

One contact point in the world frame: a position (metres; Touchstone's are halfway between the two
surfaces), the unit normal from B to A there, and the depth (metres; negative where they are apart).
)");
  define_constructor(
      point,
      +[](const Numbers<Vec3>& position, const Numbers<Vec3>& normal, double depth) {
        return PointValue{position, normal, depth};
      },
      py::arg("position"), py::arg("normal"), py::arg("depth"));
  point.def_property_readonly(
      "position", [](const PointValue& p) { return vector_to_python(p.position); }, "Metres.");
  point.def_property_readonly(
      "normal", [](const PointValue& p) { return vector_to_python(p.normal); }, "From B to A.");
  point.def_property_readonly(
      "depth", [](const PointValue& p) { return p.depth; }, "Metres; positive inside.");
  define_value<PointValue>(point, {"position", "normal", "depth"}, arguments);

  py::class_<ContactValue> contact(m, "Contact", R"(Contact(signed_distance, normal, points=())

A routine's answer: the signed distance (metres; negative inside), the unit normal from B to A in
the world frame, along which A moves to come free, and up to 16 contact points.
)");
  define_constructor(
      contact,
      +[](double signed_distance, const Numbers<Vec3>& normal, const py::iterable& points) {
        std::vector<PointValue> all;
        for (const py::handle each : points) {
          all.push_back(element<PointValue>("points", all.size(), each, "a Point of touchstone"));
        }
        if (all.size() > TOUCHSTONE_MAX_POINTS) {
          throw InvalidInput("points", "a sequence of " + std::to_string(all.size()),
                             "must be at most " + std::to_string(TOUCHSTONE_MAX_POINTS));
        }
        return ContactValue{signed_distance, normal, std::move(all)};
      },
      py::arg("signed_distance"), py::arg("normal"), py::arg("points") = py::tuple());
  contact.def_property_readonly(
      "signed_distance", [](const ContactValue& c) { return c.signed_distance; },
      "Metres; positive apart, negative inside.");
  contact.def_property_readonly(
      "normal", [](const ContactValue& c) { return vector_to_python(c.normal); },
      "Unit, from B to A, world frame; an array of three.");
  contact.def_property_readonly(
      "points", [](const ContactValue& c) { return py::tuple(arguments(c)[2]); },
      "A tuple of Point.");
  define_value<ContactValue>(contact, {"signed_distance", "normal", "points"}, arguments);
}

}  // namespace

bool is_masked_array(py::handle value) {
  return py::isinstance<py::array>(value) &&
         py::isinstance(value, py::module_::import("numpy.ma").attr("MaskedArray"));
}

py::array vector_to_python(const Vec3& v) { return frozen(py::cast(v)); }

py::array vectors_to_python(const std::vector<Vec3>& all) {
  py::array_t<double> result({all.size(), std::size_t{3}});
  for (std::size_t i = 0; i < all.size(); ++i) {
    Eigen::Map<Vec3>(result.mutable_data(static_cast<py::ssize_t>(i))) = all[i];
  }
  return result;
}

py::object shape_to_python(const Shape& shape) {
  return std::visit([](const auto& s) { return py::cast(s); }, shape);
}

Shape shape_from_python(const char* name, py::handle value) {
  if (py::isinstance<Cylinder>(value)) return value.cast<Cylinder>();
  if (py::isinstance<Plane>(value)) return value.cast<Plane>();
  if (py::isinstance<Sphere>(value)) return value.cast<Sphere>();
  if (py::isinstance<Capsule>(value)) return value.cast<Capsule>();
  if (py::isinstance<Box>(value)) return value.cast<Box>();
  if (py::isinstance<Convex>(value)) return value.cast<Convex>();
  throw py::type_error(std::string(name) + " is " + shown(value) +
                       ": must be a Cylinder, Plane, Sphere, Capsule, Box or Convex of touchstone");
}

Answer answer_from_python(py::handle value) {
  Answer answer{};
  const auto put = [](const Vec3& v, double* to) { std::copy_n(v.data(), 3, to); };
  if (py::isinstance<ContactValue>(value)) {
    const auto& contact = value.cast<const ContactValue&>();
    answer.status = TS_CONTACT;
    answer.signed_distance = contact.signed_distance;
    put(contact.normal, answer.normal);
    answer.point_count = static_cast<int>(contact.points.size());
    for (std::size_t i = 0; i < contact.points.size(); ++i) {
      put(contact.points[i].position, answer.points[i].position);
      put(contact.points[i].normal, answer.points[i].normal);
      answer.points[i].depth = contact.points[i].depth;
    }
  } else if (value.is_none()) {
    answer.status = TS_NONE;
  } else if (value.ptr() == Py_NotImplemented) {
    answer.status = TS_UNSUPPORTED;
  } else {
    answer.status = TS_FAILED;
    answer.reason = "returned " + py::type::handle_of(value).attr("__name__").cast<std::string>() +
                    ": must be touchstone.Contact, None or NotImplemented";
  }
  return answer;
}

void check_threshold(double threshold) {
  if (std::isfinite(threshold) && threshold >= 0) return;
  throw InvalidInput("threshold", py::repr(py::float_(threshold)).cast<std::string>(),
                     "must be finite and not negative");
}

void bind_values(py::module_& m) {
  bind_shapes(m);
  bind_pose(m);
  bind_contact(m);
}

}  // namespace touchstone::python
