#pragma once

#include <memory>
#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <string>
#include <vector>

#include "candidates/host/respondent.hpp"
#include "properties/identity.hpp"
#include "reference/configuration.hpp"

namespace touchstone::python {

namespace py = pybind11;

// The parts of the module, one file each.

void bind_values(py::module_& module);          ///< values.cpp
void bind_routines(py::module_& module);        ///< routines.cpp
void bind_truth(py::module_& module);           ///< truth.cpp
void bind_configurations(py::module_& module);  ///< configurations.cpp
void bind_scores(py::module_& module);          ///< scores.cpp
void bind_report(py::module_& module);          ///< reporting.cpp

// What they share.

/// A configuration in Python; its name is an identity, or empty.
using NamedConfiguration = Subject;

/// One contact point as Python gives it.
struct PointValue {
  Vec3 position, normal;
  double depth;
};

/// A contact as Python gives it. Nothing of it need be right, or finite.
struct ContactValue {
  double signed_distance;
  Vec3 normal;
  std::vector<PointValue> points;
};

/// Whether it is one of numpy's masked arrays, whose numbers alone say less than it does.
bool is_masked_array(py::handle value);

/// A numpy array of three doubles that cannot be written to.
py::array vector_to_python(const Vec3& v);
/// n × 3.
py::array vectors_to_python(const std::vector<Vec3>& all);

py::object shape_to_python(const Shape& shape);
/// Throws py::type_error that calls the argument `name`.
Shape shape_from_python(const char* name, py::handle value);

/// The answer that a function's result is: a Contact; None, no contact; NotImplemented, no routine.
/// Anything else is a failure with its reason.
Answer answer_from_python(py::handle value);

/// What asks such a function, in the process that it is made in. `seconds` by the clock are allowed
/// for one question, where this is Python's main thread.
std::unique_ptr<Respondent> function_respondent(const py::function& function, double seconds);

/// The configurations that a cylinder, a shape and their poses make: one of two Poses, otherwise
/// one for each row of a batch.
struct PosedBodies {
  bool is_batch;
  std::vector<Configuration> configurations;
};
PosedBodies posed_bodies(const Cylinder& a, py::handle pose_a, py::handle b, py::handle pose_b);

/// Throws InvalidInput unless it is finite and not negative.
void check_threshold(double threshold);

/// __repr__, __eq__, __hash__ and pickling of a value that its constructor's arguments define.
/// `arguments` gives them as plain numbers and tuples, without the last ones where these are the
/// constructor's own.
template <class T>
void define_value(py::class_<T>& type, const std::vector<std::string>& names,
                  py::tuple (*arguments)(const T&)) {
  const auto name = type.attr("__name__").template cast<std::string>();
  type.def("__repr__", [name, names, arguments](const T& value) {
    const py::tuple values = arguments(value);
    std::string text = name + "(";
    for (std::size_t i = 0; i < values.size(); ++i) {
      text += (i > 0 ? ", " : "") + names[i] + "=" + py::repr(values[i]).cast<std::string>();
    }
    return text + ")";
  });
  type.def("__eq__", [arguments](const T& self, py::handle other) -> py::object {
    if (!py::isinstance<T>(other)) return py::reinterpret_borrow<py::object>(Py_NotImplemented);
    return py::bool_(arguments(self).equal(arguments(other.cast<const T&>())));
  });
  type.def("__hash__", [arguments](const T& self) { return py::hash(arguments(self)); });
  type.def("__reduce__", [arguments](const T& self) {
    return py::make_tuple(py::type::of<T>(), arguments(self));
  });
}

}  // namespace touchstone::python
