#include "python/parameters.hpp"

#include <algorithm>
#include <fmt/format.h>

namespace touchstone::python {

std::string shown(py::handle value) {
  constexpr std::size_t max_length = 200;
  const auto text = py::repr(value).cast<std::string>();
  return text.size() <= max_length ? text : text.substr(0, max_length) + "…";
}

void refuse(const std::string& function, const std::vector<Parameter>& parameters,
            const AnyFirst& first, const py::args& others, const py::kwargs& named) {
  std::vector<py::object> given;
  if (!first.value.is(py::ellipsis())) given.push_back(first.value);
  for (const py::handle other : others) given.push_back(py::reinterpret_borrow<py::object>(other));
  std::string names;
  for (const Parameter& p : parameters) names += (names.empty() ? "" : ", ") + p.name;
  if (given.size() > parameters.size()) {
    throw py::type_error(fmt::format("{} is given {} arguments: must be at most {}: {}", function,
                                     given.size(), parameters.size(), names));
  }
  for (const auto& [key, value] : named) {
    const auto name = key.cast<std::string>();
    const auto is_it = [&](const Parameter& p) { return p.name == name; };
    if (std::any_of(parameters.begin(), parameters.end(), is_it)) continue;
    throw py::type_error(
        fmt::format("{} is no argument of {}: must be one of {}", name, function, names));
  }
  for (std::size_t i = 0; i < parameters.size(); ++i) {
    const Parameter& p = parameters[i];
    const bool is_named = named.contains(p.name.c_str());
    if (i < given.size() && is_named) {
      throw py::type_error(fmt::format("{} is given twice: must be given once", p.name));
    }
    if (i >= given.size() && !is_named) {
      if (p.is_optional) continue;
      throw py::type_error(fmt::format("{} is missing: {} takes {}", p.name, function, names));
    }
    const py::object value = i < given.size() ? given[i] : py::object(named[p.name.c_str()]);
    if (p.takes(value)) continue;
    throw py::type_error(fmt::format("{} is {}: must be {}", p.name, shown(value), p.wanted));
  }
  throw py::type_error(
      fmt::format("{} does not take these arguments: must be {}", function, names));
}

}  // namespace touchstone::python
