// The questions of our own routines: for one pair of poses, and for batches over numpy arrays.
#include <limits>
#include <optional>
#include <pybind11/eigen.h>
#include <pybind11/stl.h>

#include "oracle/judge/cast_score.hpp"
#include "python/parameters.hpp"
#include "reference/invalid_input.hpp"
#include "reference/touchstone.hpp"

namespace touchstone::python {
namespace {

/// The poses of one body in a batch: rows of an array, which is read where it lies, or one pose for
/// all.
class Poses {
 public:
  Poses(const char* name, py::handle value) : name_(name) {
    if (py::isinstance<Pose>(value)) {
      one_ = value.cast<Pose>();
      return;
    }
    if (!py::isinstance<py::array>(value)) {
      refuse("a " + py::type::handle_of(value).attr("__name__").cast<std::string>());
    }
    if (is_masked_array(value)) refuse("a masked array, whose mask would be lost");
    array_ = py::reinterpret_borrow<py::array>(value);
    if (!array_.dtype().equal(py::dtype::of<double>())) {
      refuse("an array of " + py::str(array_.dtype()).cast<std::string>());
    }
    if (array_.ndim() != 2 || array_.shape(1) != row_length) {
      refuse("an array of shape " + py::str(array_.attr("shape")).cast<std::string>());
    }
    constexpr int contiguous = py::detail::npy_api::NPY_ARRAY_C_CONTIGUOUS_,
                  aligned = py::detail::npy_api::NPY_ARRAY_ALIGNED_;
    if ((array_.flags() & contiguous) == 0 || (array_.flags() & aligned) == 0) {
      refuse(
          "an array whose rows do not follow one another in memory, for which use "
          "numpy.ascontiguousarray");
    }
    rows_ = static_cast<const double*>(array_.data());
  }

  bool is_one() const { return one_.has_value(); }
  std::size_t count() const { return static_cast<std::size_t>(array_.shape(0)); }

  /// Throws InvalidInput that names the row.
  Pose operator[](std::size_t row) const {
    if (one_) return *one_;
    const double* const x = rows_ + row * row_length;
    try {
      return Pose({x[0], x[1], x[2]}, {x[3], x[4], x[5], x[6]});
    } catch (const InvalidInput& e) {
      throw e.within(name_ + "[" + std::to_string(row) + "]");
    }
  }

 private:
  static constexpr py::ssize_t row_length = 7;

  [[noreturn]] void refuse(const std::string& what) const {
    throw py::type_error(name_ + " is " + what +
                         ": must be a Pose, or a C-contiguous float64 array of shape (n, 7), each "
                         "row a position and an orientation w, x, y, z");
  }

  std::string name_;
  std::optional<Pose> one_;
  py::array array_;
  const double* rows_ = nullptr;
};

/// Both bodies of a question, as Python gives them.
struct Bodies {
  Bodies(const Cylinder& cylinder, py::handle of_a, py::handle other, py::handle of_b)
      : a(cylinder),
        b(shape_from_python("b", other)),
        pose_a("pose_a", of_a),
        pose_b("pose_b", of_b) {
    if (is_batch() && !pose_a.is_one() && !pose_b.is_one() && pose_a.count() != pose_b.count()) {
      throw InvalidInput("pose_b", "an array of " + std::to_string(pose_b.count()) + " rows",
                         "must have as many as pose_a, " + std::to_string(pose_a.count()));
    }
  }

  bool is_batch() const { return !pose_a.is_one() || !pose_b.is_one(); }
  std::size_t count() const { return pose_a.is_one() ? pose_b.count() : pose_a.count(); }

  /// question(a, pose_a, b, pose_b) for one pair of poses.
  template <class Question>
  auto ask(Question question) const {
    return std::visit([&](const auto& other) { return question(a, pose_a[0], other, pose_b[0]); },
                      b);
  }
  /// take(i, question(a, pose_a, b, pose_b)) for each row, without Python's lock.
  template <class Question, class Take>
  void ask_all(Question question, Take take) const {
    const py::gil_scoped_release release;
    const std::size_t rows = count();
    std::visit(
        [&](const auto& other) {
          for (std::size_t i = 0; i < rows; ++i) take(i, question(a, pose_a[i], other, pose_b[i]));
        },
        b);
  }

  const Cylinder& a;
  Shape b;
  Poses pose_a, pose_b;
};

/// Shapes without a cast to and from numpy's signed sizes.
template <class... Sizes>
std::vector<py::ssize_t> shape(Sizes... sizes) {
  return {static_cast<py::ssize_t>(sizes)...};
}

py::object overlaps_of(const Cylinder& a, py::handle pose_a, py::handle b, py::handle pose_b) {
  const Bodies bodies(a, pose_a, b, pose_b);
  const auto question = [](const auto&... body) { return overlaps(body...); };
  if (!bodies.is_batch()) return py::bool_(bodies.ask(question));
  py::array_t<bool> result(shape(bodies.count()));
  bool* const to = result.mutable_data();
  bodies.ask_all(question, [to](std::size_t i, bool overlap) { to[i] = overlap; });
  return result;
}

py::object signed_distance_of(const Cylinder& a, py::handle pose_a, py::handle b,
                              py::handle pose_b) {
  const Bodies bodies(a, pose_a, b, pose_b);
  const auto question = [](const auto&... body) { return signed_distance(body...); };
  if (!bodies.is_batch()) {
    const SignedDistance found = bodies.ask(question);
    return py::make_tuple(found.value, vector_to_python(found.normal));
  }
  py::array_t<double> values(shape(bodies.count())), normals(shape(bodies.count(), 3));
  double *const value = values.mutable_data(), *const normal = normals.mutable_data();
  bodies.ask_all(question, [=](std::size_t i, const SignedDistance& found) {
    value[i] = found.value;
    Eigen::Map<Vec3>(normal + 3 * i) = found.normal;
  });
  return py::make_tuple(values, normals);
}

/// One sweep, or one a row.
struct Sweeps {
  explicit Sweeps(py::handle value) {
    py::detail::make_caster<Numbers<Vec3>> one;
    py::detail::make_caster<Numbers<Points>> many;
    if (one.load(value, true)) {
      rows = py::detail::cast_op<const Numbers<Vec3>&>(one).vector.transpose();
    } else if (many.load(value, true)) {
      rows = py::detail::cast_op<const Numbers<Points>&>(many).vector;
      is_batch = true;
    } else {
      throw py::type_error("sweep is " + shown(value) +
                           ": must be three numbers, or rows of three, none of them masked");
    }
  }
  Vec3 operator[](std::size_t i) const {
    return rows.row(is_batch ? static_cast<Eigen::Index>(i) : 0).transpose();
  }

  Points rows;
  bool is_batch = false;
};

py::object cast_of(const Cylinder& a, py::handle pose_a, py::handle sweep, py::handle b,
                   py::handle pose_b) {
  const Sweeps sweeps(sweep);
  const PosedBodies bodies = posed_bodies(a, pose_a, b, pose_b);
  const auto of_row = [&](std::size_t i) {
    return cast(bodies.configurations[bodies.is_batch ? i : 0], sweeps[i]);
  };
  if (!bodies.is_batch && !sweeps.is_batch) {
    const Cast found = of_row(0);
    return py::make_tuple(status_name(found.status), found.fraction,
                          vector_to_python(found.normal));
  }
  const auto rows = static_cast<std::size_t>(sweeps.rows.rows());
  const std::size_t count = bodies.is_batch ? bodies.configurations.size() : rows;
  if (sweeps.is_batch && rows != count) {
    throw InvalidInput("sweep", "an array of " + std::to_string(rows) + " rows",
                       "must have as many as the poses, " + std::to_string(count));
  }
  py::list statuses;
  py::array_t<double> fractions(shape(count)), normals(shape(count, 3));
  for (std::size_t i = 0; i < count; ++i) {
    const Cast found = of_row(i);
    statuses.append(status_name(found.status));
    fractions.mutable_data()[i] = found.fraction;
    Eigen::Map<Vec3>(normals.mutable_data() + 3 * i) = found.normal;
  }
  return py::make_tuple(statuses, fractions, normals);
}

/// The contacts of a batch, as arrays.
struct Contacts {
  explicit Contacts(std::size_t n)
      : signed_distances(shape(n)),
        normals(shape(n, 3)),
        counts(shape(n)),
        positions(shape(n, Contact::max_points, 3)),
        depths(shape(n, Contact::max_points)) {}

  py::array_t<double> signed_distances, normals;
  py::array_t<std::int32_t> counts;
  py::array_t<double> positions, depths;
};

/// None beyond the threshold.
py::object contact_to_python(const Contact& contact) {
  if (contact.points().empty()) return py::none();
  ContactValue value{contact.signed_distance, contact.normal, {}};
  for (const ContactPoint& p : contact.points()) {
    value.points.push_back({p.position, contact.normal, p.depth});
  }
  return py::cast(value);
}

py::object contact_of(const Cylinder& a, py::handle pose_a, py::handle b, py::handle pose_b,
                      double threshold) {
  check_threshold(threshold);
  const Bodies bodies(a, pose_a, b, pose_b);
  const auto question = [threshold](const auto&... body) { return contact(body..., threshold); };
  if (!bodies.is_batch()) return contact_to_python(bodies.ask(question));
  Contacts contacts(bodies.count());
  double *const distance = contacts.signed_distances.mutable_data(),
                *const normal = contacts.normals.mutable_data(),
                *const position = contacts.positions.mutable_data(),
                *const depth = contacts.depths.mutable_data();
  std::int32_t* const count = contacts.counts.mutable_data();
  bodies.ask_all(question, [=](std::size_t i, const Contact& found) {
    constexpr double none = std::numeric_limits<double>::quiet_NaN();
    distance[i] = found.signed_distance;
    Eigen::Map<Vec3>(normal + 3 * i) = found.normal;
    count[i] = static_cast<std::int32_t>(found.points().size());
    for (std::size_t k = 0; k < Contact::max_points; ++k) {
      const std::size_t at = i * Contact::max_points + k;
      const bool is_there = k < found.points().size();
      Eigen::Map<Vec3>(position + 3 * at) =
          is_there ? found.points()[k].position : Vec3::Constant(none);
      depth[at] = is_there ? found.points()[k].depth : none;
    }
  });
  return py::cast(std::move(contacts));
}

}  // namespace

PosedBodies posed_bodies(const Cylinder& a, py::handle pose_a, py::handle b, py::handle pose_b) {
  const Bodies bodies(a, pose_a, b, pose_b);
  PosedBodies result{bodies.is_batch(), {}};
  const std::size_t rows = result.is_batch ? bodies.count() : 1;
  for (std::size_t i = 0; i < rows; ++i) {
    result.configurations.push_back({a, bodies.pose_a[i], bodies.b, bodies.pose_b[i]});
  }
  return result;
}

void bind_routines(py::module_& m) {
  py::class_<Contacts> contacts(m, "Contacts",
                                R"(The contacts of a batch of n pairs of poses, as arrays.

What lies beyond a row's count of points is NaN. Metres, world frame, normals from B to A.
)");
  contacts.def_readonly("signed_distances", &Contacts::signed_distances, "float64, shape (n,).");
  contacts.def_readonly("normals", &Contacts::normals, "float64, shape (n, 3).");
  contacts.def_readonly("counts", &Contacts::counts, "How many points: int32, shape (n,).");
  contacts.def_readonly("positions", &Contacts::positions, "float64, shape (n, 8, 3).");
  contacts.def_readonly("depths", &Contacts::depths, "float64, shape (n, 8); positive inside.");
  contacts.def("__len__", [](const Contacts& c) { return c.counts.size(); });

  define(m, "overlaps", &overlaps_of, R"(overlaps(a, pose_a, b, pose_b)

Returns whether the bodies share a point; those that touch do, as far as rounding can tell.

`a` is a Cylinder, `b` any shape. A pose is a Pose, or an array of float64, C-contiguous, of the
shape (n, 7): n positions (metres) and orientations w, x, y, z. It is read where it lies. With two
Poses the result is a bool, else an array of n. Python's lock is released during the loop.

>>> can, ball = touchstone.Cylinder(0.5, 1), touchstone.Sphere(1)
>>> poses = numpy.array([[0, 0, 1.9, 1, 0, 0, 0], [0, 0, 2.1, 1, 0, 0, 0]])
>>> touchstone.overlaps(can, poses, ball, touchstone.Pose())
array([ True, False])
)",
         py::arg("a"), py::arg("pose_a"), py::arg("b"), py::arg("pose_b"));
  define(m, "signed_distance", &signed_distance_of, R"(signed_distance(a, pose_a, b, pose_b)

Returns signed distance (metres; negative inside) and unit normal (from B to A, world frame).

Bodies and poses as in `overlaps`. With two Poses, a float and an array of three; else arrays of the
shapes (n,) and (n, 3). Within 1e-13 of the larger size of the truth.

>>> touchstone.signed_distance(touchstone.Cylinder(0.5, 1), touchstone.Pose((0, 0, 3)),
...                            touchstone.Sphere(1), touchstone.Pose())
(1.0, array([0., 0., 1.]))
)",
         py::arg("a"), py::arg("pose_a"), py::arg("b"), py::arg("pose_b"));
  define(m, "cast", &cast_of, R"(cast(a, pose_a, sweep, b, pose_b)

Returns when `a` touches `b` first while it moves by `sweep` (metres, world frame).

Bodies and poses as in `overlaps`; a sweep is three numbers, or rows of three. For one, a status
("touch", "never" or "from-start"), the fraction of the sweep up to which `a` moves freely, and the
normal there; else a list and arrays of the shapes (n,) and (n, 3).

>>> touchstone.cast(touchstone.Cylinder(0.5, 1), touchstone.Pose((0, 0, 5)), (0, 0, -4),
...                 touchstone.Sphere(1), touchstone.Pose())
('touch', 0.75, array([0., 0., 1.]))
)",
         py::arg("a"), py::arg("pose_a"), py::arg("sweep"), py::arg("b"), py::arg("pose_b"));
  define(m, "contact", &contact_of, R"(contact(a, pose_a, b, pose_b, threshold=0.0)

Returns signed distance, normal and contact points where the distance is at most `threshold` metres.

Bodies and poses as in `overlaps`. With two Poses a Contact, or None beyond the threshold; else
Contacts, whose members are arrays: beyond the threshold a row has no points, and its signed distance
is the clearance along its normal, which may be less than the distance.

>>> touchstone.contact(touchstone.Cylinder(0.5, 1), touchstone.Pose((0, 0, 1.75)),
...                    touchstone.Sphere(1), touchstone.Pose()).points
(Point(position=(0.0, 0.0, 0.875), normal=(0.0, 0.0, 1.0), depth=0.25),)
)",
         py::arg("a"), py::arg("pose_a"), py::arg("b"), py::arg("pose_b"),
         py::arg("threshold") = 0.0);
}

}  // namespace touchstone::python
