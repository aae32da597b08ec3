#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <pybind11/eigen.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include <Eigen/Dense>

#include "python/bindings.hpp"

namespace touchstone::python {

/// The first argument, whatever it is; an ellipsis where none is given by its place.
struct AnyFirst {
  py::object value = py::ellipsis();
};

/// Points, one a row.
using Points = Eigen::Matrix<double, Eigen::Dynamic, 3, Eigen::RowMajor>;

/// A vector of Eigen. None of numpy's masked arrays is one, whose mask would be lost.
template <class Vector>
struct Numbers {
  Vector vector;
  operator const Vector&() const { return vector; }
};

}  // namespace touchstone::python

/// pybind11 asks all overloads without conversions, then all with them. This one is for the latter
/// alone, so that its overload is asked when all others have refused.
template <>
struct pybind11::detail::type_caster<touchstone::python::AnyFirst> {
  PYBIND11_TYPE_CASTER(touchstone::python::AnyFirst, const_name("object"));
  bool load(handle source, bool convert) {
    value.value = reinterpret_borrow<object>(source);
    return convert;
  }
  static handle cast(const touchstone::python::AnyFirst& first, return_value_policy, handle) {
    return first.value.inc_ref();
  }
};

template <class Vector>
struct pybind11::detail::type_caster<touchstone::python::Numbers<Vector>> {
  PYBIND11_TYPE_CASTER(touchstone::python::Numbers<Vector>, make_caster<Vector>::name);
  bool load(handle source, bool convert) {
    make_caster<Vector> numbers;
    if (touchstone::python::is_masked_array(source) || !numbers.load(source, convert)) return false;
    value.vector = cast_op<const Vector&>(numbers);
    return true;
  }
};

namespace touchstone::python {

// Functions whose arguments pybind11 refuses with a list of C++ types. Each gets a second overload,
// which takes whatever the first does not and says which argument is wrong and what would be right.

/// What an argument of that C++ type must be; nullptr where the function itself says so.
template <class T>
inline constexpr const char* must_be = nullptr;
template <>
inline constexpr const char* must_be<double> = "a number";
template <>
inline constexpr const char* must_be<Numbers<Vec3>> = "three numbers, none of them masked";
template <>
inline constexpr const char* must_be<Numbers<Eigen::Vector4d>> =
    "four numbers, none of them masked";
template <>
inline constexpr const char* must_be<std::optional<Numbers<Eigen::Matrix3d>>> =
    "three rows of three numbers, none of them masked";
template <>
inline constexpr const char* must_be<std::optional<Numbers<Vec3>>> = must_be<Numbers<Vec3>>;
template <>
inline constexpr const char* must_be<Numbers<Points>> =
    "rows of three numbers, none of them masked";
template <>
inline constexpr const char* must_be<std::uint64_t> = "a whole number that is not negative";
template <>
inline constexpr const char* must_be<unsigned> = must_be<std::uint64_t>;
template <>
inline constexpr const char* must_be<std::string> = "a str";
template <>
inline constexpr const char* must_be<std::vector<std::string>> = "a list of str";
template <>
inline constexpr const char* must_be<std::optional<std::vector<std::string>>> =
    "None or a list of str";
template <>
inline constexpr const char* must_be<std::filesystem::path> = "a str or a path";
template <>
inline constexpr const char* must_be<py::function> = "a function";
template <>
inline constexpr const char* must_be<py::iterable> = "a sequence";
template <>
inline constexpr const char* must_be<py::sequence> = "a sequence";
template <>
inline constexpr const char* must_be<Cylinder> = "a Cylinder of touchstone";
template <>
inline constexpr const char* must_be<Pose> = "a Pose of touchstone";
template <>
inline constexpr const char* must_be<NamedConfiguration> = "a Configuration of touchstone";

struct Parameter {
  std::string name;
  const char* wanted;  ///< must_be of its type
  bool is_optional;
  bool (*takes)(py::handle value);
};

/// A value as Python prints it, cut where it is long.
std::string shown(py::handle value);

/// Throws py::type_error that says why the parameters do not take these arguments.
[[noreturn]] void refuse(const std::string& function, const std::vector<Parameter>& parameters,
                         const AnyFirst& first, const py::args& others, const py::kwargs& named);

template <class Argument, class Name>
Parameter parameter_of(const Name& name) {
  using Type = std::remove_cv_t<std::remove_reference_t<Argument>>;
  const auto takes = [](py::handle value) {
    if constexpr (must_be<Type> == nullptr) {
      return true;
    } else {
      return py::detail::make_caster<Type>().load(value, true);
    }
  };
  return {name.name, must_be<Type>, std::is_same_v<Name, py::arg_v>, takes};
}

/// The overload that refuses; of a function, `first_may_lack` comes with it.
inline auto refusal(const std::string& function, std::vector<Parameter> parameters) {
  return [function, parameters = std::move(parameters)](
             const AnyFirst& first, const py::args& others, const py::kwargs& named) -> py::object {
    refuse(function, parameters, first, others, named);
  };
}
inline auto first_may_lack() { return py::arg("_") = AnyFirst(); }

/// An element of a sequence. Throws py::type_error that calls it `name`[`index`].
template <class T>
const T& element(const char* name, std::size_t index, py::handle value, const char* wanted) {
  if (py::isinstance<T>(value)) return value.cast<const T&>();
  throw py::type_error(std::string(name) + '[' + std::to_string(index) + "] is " + shown(value) +
                       ": must be " + wanted);
}

/// Defines a function of the module. `names`: a py::arg for each parameter, with its default.
template <class Result, class... Arguments, class... Names>
void define(py::module_& m, const char* name, Result (*function)(Arguments...), const char* doc,
            const Names&... names) {
  m.def(name, function, names..., doc);
  m.def(name, refusal(name, {parameter_of<Arguments>(names)...}), first_may_lack());
}

/// Defines the constructor of a class.
template <class T, class... Arguments, class... Names>
void define_constructor(py::class_<T>& type, T (*make)(Arguments...), const Names&... names) {
  type.def(py::init(make), names...);
  type.def(
      py::init([name = type.attr("__name__").template cast<std::string>(),
                parameters = std::vector{parameter_of<Arguments>(names)...}](
                   const AnyFirst& first, const py::args& others, const py::kwargs& named) -> T {
        refuse(name, parameters, first, others, named);
      }),
      first_may_lack());
}

}  // namespace touchstone::python
