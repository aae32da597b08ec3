// The Python module: what it consists of, and how errors reach Python.
#include <map>

#include "python/bindings.hpp"
#include "reference/invalid_input.hpp"

namespace touchstone::python {
namespace {

/// The parameter of a function of the module that an option of the program is.
std::string parameter_of(const std::string& field) {
  static const std::map<std::string, std::string> parameters = {{"--class", "classes"},
                                                                {"--pair", "pair"},
                                                                {"--group", "groups"},
                                                                {"--candidates", "candidates"},
                                                                {"--out", "folder"}};
  const auto found = parameters.find(field);
  return found == parameters.end() ? field : found->second;
}

void translate(std::exception_ptr thrown) {
  try {
    std::rethrow_exception(std::move(thrown));
  } catch (const InvalidInput& e) {
    const InvalidInput renamed(parameter_of(e.field()), e.value(), e.remedy());
    PyErr_SetString(PyExc_ValueError, renamed.what());
  }
}

}  // namespace
}  // namespace touchstone::python

PYBIND11_MODULE(_touchstone, module) {
  using namespace touchstone::python;
  py::options options;
  options.disable_function_signatures();  // the docstrings and the stubs have them
  py::register_local_exception_translator(translate);
  module.attr("__version__") = TOUCHSTONE_VERSION;
  bind_values(module);
  bind_routines(module);
  bind_truth(module);
  bind_configurations(module);
  bind_scores(module);
  bind_report(module);
}
