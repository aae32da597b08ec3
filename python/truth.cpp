// The exact truth of one configuration.
#include "oracle/truth.hpp"

#include <pybind11/stl.h>

#include "oracle/first_touch.hpp"
#include "oracle/judge/cast_score.hpp"
#include "oracle/patch/contact_patch.hpp"
#include "properties/files/answer_json.hpp"
#include "python/parameters.hpp"

namespace touchstone::python {
namespace {

/// A truth with the configuration that it is of, for its patch.
struct KnownTruth {
  Configuration configuration;
  oracle::Truth truth;
};

py::object integer(const mpz_class& value) {
  return py::reinterpret_steal<py::object>(
      PyLong_FromString(value.get_str(16).c_str(), nullptr, 16));
}

py::object fraction(const mpq_class& value) {
  return py::module_::import("fractions")
      .attr("Fraction")(integer(value.get_num()), integer(value.get_den()));
}

/// The double that is nearest to the enclosure's middle.
py::object middle(const oracle::Enclosure& enclosure) {
  const mpq_class sum = enclosure.lo + enclosure.hi;
  return fraction(sum / 2).attr("__float__")();
}

py::object truth_of(const Cylinder& a, py::handle pose_a, py::handle b, py::handle pose_b,
                    double width) {
  const auto [is_batch, configurations] = posed_bodies(a, pose_a, b, pose_b);
  py::list all;
  for (const Configuration& c : configurations) {
    if (PyErr_CheckSignals() != 0) throw py::error_already_set();  // as by Ctrl-C
    all.append(KnownTruth{c, oracle::truth(c, width)});
  }
  return is_batch ? py::object(all) : py::object(all[0]);
}

/// The first touch of a sweep, with the truth there.
struct KnownTouch {
  oracle::FirstTouch touch;
  std::optional<KnownTruth> truth;
};

KnownTouch first_touch_of(const Cylinder& a, const Pose& pose_a, const Numbers<Vec3>& sweep,
                          py::handle b, const Pose& pose_b, const Numbers<Vec3>& spin,
                          double width) {
  const Configuration c{a, pose_a, shape_from_python("b", b), pose_b};
  const Sweep motion(sweep, spin);
  KnownTouch known{oracle::first_touch(c, motion, width), {}};
  if (known.touch.there) {
    known.truth = {swept(c, motion, known.touch.fraction.hi.get_d()), *known.touch.there};
  }
  return known;
}

py::array normals_of(const KnownTruth& t) {
  std::vector<Vec3> all;
  for (const auto& normal : t.truth.normals) all.push_back(normal.n);
  return vectors_to_python(all);
}

}  // namespace

void bind_truth(py::module_& m) {
  using oracle::ContactPatch;
  py::class_<ContactPatch> patch(m, "Patch", R"(The contact patch along one optimal normal.

Where the bodies' support features overlap, in the plane across the normal halfway between the
surfaces. World frame, metres.
)");
  patch.def_property_readonly(
      "kind", [](const ContactPatch& p) { return patch_kind_name(p.kind()); },
      "\"point\", \"segment\" or \"region\".");
  patch.def_property_readonly("area", &ContactPatch::area, "Square metres; 0 but for a region.");
  patch.def_property_readonly("perimeter", &ContactPatch::perimeter,
                              "Metres; of a segment its length.");
  patch.def_property_readonly(
      "centroid", [](const ContactPatch& p) { return vector_to_python(p.centroid()); },
      "An array of three.");
  patch.def_property_readonly(
      "outline", [](const ContactPatch& p) { return vectors_to_python(p.outline()); },
      "The boundary in order, arcs as chords: shape (m, 3).");

  py::class_<KnownTruth> truth(m, "Truth", R"(What is true of two bodies: `truth` gives it.

Metres, world frame, normals from B to A.
)");
  truth.def_property_readonly(
      "lower", [](const KnownTruth& t) { return fraction(t.truth.signed_distance.lo); },
      "A fractions.Fraction that the signed distance is proven not to lie below.");
  truth.def_property_readonly(
      "upper", [](const KnownTruth& t) { return fraction(t.truth.signed_distance.hi); },
      "A fractions.Fraction that the signed distance is proven not to lie above.");
  truth.def_property_readonly(
      "signed_distance", [](const KnownTruth& t) { return middle(t.truth.signed_distance); },
      "The float nearest to the middle of both; positive apart, negative inside.");
  truth.def_property_readonly("normals", &normals_of,
                              "Unit normals that reach it, or tie with one that does: shape (k, "
                              "3); of a family at least one.");
  truth.def_property_readonly(
      "ties", [](const KnownTruth& t) { return ties_name(t.truth.ties); },
      "How many normals reach it: \"unique\", \"finite\" or \"continuum\".");
  truth.def_property_readonly(
      "patches",
      [](const KnownTruth& t) {
        py::tuple all(t.truth.normals.size());
        for (std::size_t i = 0; i < all.size(); ++i) {
          all[i] = py::cast(oracle::contact_patch(t.configuration, t.truth.normals[i]));
        }
        return all;
      },
      "The Patch along each of the normals, a tuple.");
  truth.def("__repr__", [](const KnownTruth& t) {
    const auto [low, high] = decimals(t.truth.signed_distance);
    return "<touchstone.Truth: signed distance from " + low + " to " + high + ", " +
           ties_name(t.truth.ties) + ">";
  });

  define(m, "truth", &truth_of, R"(truth(a, pose_a, b, pose_b, width=1e-15)

Returns the exact truth of two bodies: a proven enclosure of the signed distance, and the normals.

Bodies and poses as in `overlaps`: with two Poses a Truth, else a list with one for each row. All
numbers are taken as they are, a quaternion divided by its exact length. The enclosure is no wider than `width` times the largest
half extent, and zero lies within it only if the bodies touch. Each takes about a millisecond.

>>> t = touchstone.truth(touchstone.Cylinder(0.5, 1), touchstone.Pose((0, 0, 3)),
...                      touchstone.Sphere(1), touchstone.Pose(), width=1e-30)
>>> t.lower <= 1 <= t.upper, t.signed_distance, t.ties
(True, 1.0, 'unique')
)",
         py::arg("a"), py::arg("pose_a"), py::arg("b"), py::arg("pose_b"),
         py::arg("width") = 1e-15);

  py::class_<KnownTouch> touch(m, "FirstTouch",
                               "What is true of a moving body: `first_touch` gives it.");
  touch.def_property_readonly(
      "status", [](const KnownTouch& t) { return status_name(t.touch.status); },
      "\"touch\", \"never\", \"from-start\"; \"undecided\" where no proof tells a graze from a "
      "miss.");
  touch.def_property_readonly(
      "lower", [](const KnownTouch& t) { return fraction(t.touch.fraction.lo); },
      "A fractions.Fraction of the sweep before which nothing touches.");
  touch.def_property_readonly(
      "upper", [](const KnownTouch& t) { return fraction(t.touch.fraction.hi); },
      "A fractions.Fraction at which the bodies are proven to touch or overlap.");
  touch.def_property_readonly(
      "fraction", [](const KnownTouch& t) { return middle(t.touch.fraction); },
      "The float nearest to the middle of both.");
  touch.def_property_readonly(
      "truth", [](const KnownTouch& t) { return t.truth; },
      "The Truth of the pose at `upper`; None unless the bodies touch.");
  touch.def("__repr__", [](const KnownTouch& t) {
    const auto [low, high] = decimals(t.touch.fraction);
    return std::string("<touchstone.FirstTouch: ") + status_name(t.touch.status) + ", from " + low +
           " to " + high + ">";
  });

  define(m, "first_touch", &first_touch_of,
         R"(first_touch(a, pose_a, sweep, b, pose_b, spin=(0.0, 0.0, 0.0), width=1e-20)

Returns when `a` touches `b` first while it moves by `sweep` (metres), proven.

`spin` turns it meanwhile about its centre, by as many radians as it is long, in the world frame.
Without it, the enclosure of the fraction is no wider than `width`.

>>> t = touchstone.first_touch(touchstone.Cylinder(0.5, 1), touchstone.Pose((0, 0, 5)), (0, 0, -9),
...                            touchstone.Sphere(1), touchstone.Pose())
>>> t.status, t.upper, t.truth.normals
('touch', Fraction(1, 3), array([[0., 0., 1.]]))
)",
         py::arg("a"), py::arg("pose_a"), py::arg("sweep"), py::arg("b"), py::arg("pose_b"),
         py::arg("spin") = py::make_tuple(0.0, 0.0, 0.0), py::arg("width") = 1e-20);
}

}  // namespace touchstone::python
