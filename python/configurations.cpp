// Configurations: drawn from pose classes, or of the caller's own.
#include <algorithm>
#include <pybind11/stl.h>

#include "properties/identity.hpp"
#include "python/parameters.hpp"
#include "reference/invalid_input.hpp"

namespace touchstone::python {
namespace {

NamedConfiguration own(const Cylinder& a, const Pose& pose_a, py::handle b, const Pose& pose_b) {
  return {"", "", {a, pose_a, shape_from_python("b", b), pose_b}};
}

/// What makes two configurations equal.
py::tuple bodies(const NamedConfiguration& named) {
  const Configuration& c = named.configuration;
  return py::make_tuple(c.a, c.pose_a, shape_to_python(c.b), c.pose_b);
}

py::dict classes_of(const std::string& name) {
  const Pair pair = parse_pair(name, "pair");
  py::dict result;
  for (const PoseClass& each : selected(pair, {})) {
    result[py::str(each.name())] = each.description();
  }
  return result;
}

/// As many as the command line's reports have answers.
constexpr std::uint64_t max_configurations = 100000000;

py::list configurations_of(const std::string& name,
                           const std::optional<std::vector<std::string>>& classes,
                           std::uint64_t seed, std::uint64_t count) {
  const Pair pair = parse_pair(name, "pair");
  const std::vector<std::string> wanted = classes.value_or(pose_classes(pair));
  check_pose_classes({pair}, wanted);
  if (count < 1 || count > max_configurations / std::max<std::size_t>(1, wanted.size())) {
    throw InvalidInput("count", std::to_string(count),
                       "must be from 1 to as many as make " + std::to_string(max_configurations) +
                           " configurations in all");
  }
  py::list result;
  for (const std::string& each : wanted) {
    for (std::uint64_t i = 0; i < count; ++i) {
      if (PyErr_CheckSignals() != 0) throw py::error_already_set();  // as by Ctrl-C
      result.append(subject({pair, each, seed, i}));
    }
  }
  return result;
}

}  // namespace

void bind_configurations(py::module_& m) {
  py::class_<NamedConfiguration> configuration(m, "Configuration",
                                               R"(Configuration(a, pose_a, b, pose_b)

Two shapes with their poses in the world. Body A is a cylinder, body B any shape.

>>> touchstone.Configuration.of("cylinder-plane/lying/1/0").b
Plane(normal=(0.0, 0.0, 1.0), displacement=0.0)
)");
  define_constructor(configuration, &own, py::arg("a"), py::arg("pose_a"), py::arg("b"),
                     py::arg("pose_b"));
  configuration.def_static(
      "of", [](const std::string& identity) { return subject(parse_identity(identity)); },
      py::arg("identity"), R"(Configuration.of(identity)

The configuration of an identity, "pair/class/seed/index", as reports name it: always the same bits.
)");
  configuration.def_static(
      "of", refusal("Configuration.of", {parameter_of<std::string>(py::arg("identity"))}),
      first_may_lack());
  configuration.def_readonly("identity", &NamedConfiguration::name,
                             "\"pair/class/seed/index\"; empty for one of your own.");
  configuration.def_readonly("description", &NamedConfiguration::description,
                             "What its pose class is; empty for one of your own.");
  configuration.def_property_readonly(
      "pair", [](const NamedConfiguration& c) { return pair_name(pair_of(c.configuration)); },
      "\"cylinder-plane\", \"cylinder-sphere\", …");
  configuration.def_property_readonly(
      "a", [](const NamedConfiguration& c) { return c.configuration.a; }, "The cylinder.");
  configuration.def_property_readonly(
      "pose_a", [](const NamedConfiguration& c) { return c.configuration.pose_a; }, "Its pose.");
  configuration.def_property_readonly(
      "b", [](const NamedConfiguration& c) { return shape_to_python(c.configuration.b); },
      "The other shape.");
  configuration.def_property_readonly(
      "pose_b", [](const NamedConfiguration& c) { return c.configuration.pose_b; }, "Its pose.");
  configuration.def("__eq__", [](const NamedConfiguration& c, py::handle other) {
    return py::isinstance<NamedConfiguration>(other) &&
           bodies(c).equal(bodies(other.cast<const NamedConfiguration&>()));
  });
  configuration.def("__hash__", [](const NamedConfiguration& c) { return py::hash(bodies(c)); });
  configuration.def("__repr__", [](const NamedConfiguration& c) {
    if (!c.name.empty()) return "Configuration.of('" + c.name + "')";
    return "Configuration" + py::repr(bodies(c)).cast<std::string>();
  });
  configuration.def("__reduce__", [](const py::object& self) {
    const auto& c = self.cast<const NamedConfiguration&>();
    const py::object type = py::type::of(self);
    if (c.name.empty()) return py::make_tuple(type, bodies(c));
    const auto make = py::module_::import("operator").attr("methodcaller")("of", c.name);
    return py::make_tuple(make, py::make_tuple(type));
  });

  m.attr("PAIRS") = [] {
    py::list names;
    for (const Pair pair : all_pairs) names.append(pair_name(pair));
    return py::tuple(names);
  }();
  define(m, "classes", &classes_of, R"(classes(pair)

Returns the pose classes of a pair that a report scores: a dict of names and descriptions.

>>> touchstone.classes("cylinder-plane")["lying"]
'A generator lies exactly on the plane: a line of equally deep points.'
)",
         py::arg("pair"));
  define(m, "configurations", &configurations_of,
         R"(configurations(pair, classes=None, seed=1, count=10)

Returns a list with `count` configurations of each pose class; None: of all that `classes` lists.

An arrangement and modifiers make further classes, as in "lying+turned+deep". The same arguments
give the same bits on every machine.

>>> [c.identity for c in touchstone.configurations("cylinder-box", ["rim-face"], count=2)]
['cylinder-box/rim-face/1/0', 'cylinder-box/rim-face/1/1']
)",
         py::arg("pair"), py::arg("classes") = py::none(), py::arg("seed") = 1,
         py::arg("count") = 10);
}

}  // namespace touchstone::python
