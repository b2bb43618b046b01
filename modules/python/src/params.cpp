// SPDX-License-Identifier: BSD-3-Clause
#include <pybind11/numpy.h>

#include "classes.h"
#include "edgevo/core/error.h"
#include "run_parameters.h"

namespace edgevo::python {
namespace {

std::string text_of(py::handle value, const std::string& where) {
  if (PyBool_Check(value.ptr())) return value.ptr() == Py_True ? "true" : "false";
  if (py::isinstance<py::str>(value)) return py::cast<std::string>(value);
  if (PyFloat_Check(value.ptr())) return py::repr(py::float_(PyFloat_AS_DOUBLE(value.ptr())));
  // A scalar of numpy as the plain one that it holds.
  if (py::hasattr(value, "dtype") && !py::isinstance<py::array>(value) && py::hasattr(value, "item"))
    return text_of(value.attr("item")(), where);
  if (const auto number = whole_number(value)) return std::string(py::str(py::object(*number)));
  throw py::type_error(where + " is " + describe(value) + "; bool, int, float or str is wanted");
}

// Errors name the parameter as Python has it, not as the command line has it.
void set(const std::string& key, const std::string& value, const std::string& where, RunParams* params) {
  const std::string assignment = key + "=" + value;
  try {
    set_param(assignment, [&](ParamVisitor& v) { params->visit(v); });
  } catch (const InputError& e) {
    const std::string text = e.what();
    const size_t end = text.find(": ");
    throw InputError(where, end == std::string::npos ? text : text.substr(end + 2), "");
  }
}

void read(py::handle object, const std::string& prefix, const std::string& where, RunParams* params) {
  for (const auto& [key, value] : py::reinterpret_borrow<py::dict>(object)) {
    if (!py::isinstance<py::str>(key))
      throw py::type_error(where + " has the key " + describe(key) + "; names of parameters are str");
    const std::string name = prefix + std::string(py::str(key));
    if (name.find('=') != std::string::npos || name.find('\0') != std::string::npos)
      throw bad_value(where, "has the key '" + name.substr(0, name.find('\0')) + "'",
                      "give the name of a parameter; edgevo.params() lists them");
    if (py::isinstance<py::dict>(value))
      read(value, name + ".", where, params);
    else
      set(name, text_of(value, where + "[" + name + "]"), where, params);
  }
}

// A text as YAML has it: in single quotes, doubled within, where it would be something else.
std::string unquoted(const std::string& text) {
  if (text.size() < 2 || text.front() != '\'' || text.back() != '\'') return text;
  std::string plain;
  for (size_t i = 1; i + 1 < text.size(); ++i) {
    plain += text[i];
    if (text[i] == '\'') ++i;
  }
  return plain;
}

// The value as the Python type that it stands for.
py::object parsed(const ParamDescription& param) {
  if (param.value == "true" || param.value == "false") return py::bool_(param.value == "true");
  for (PyObject* const type : {(PyObject*)&PyLong_Type, (PyObject*)&PyFloat_Type}) {
    try {
      return py::reinterpret_borrow<py::object>(type)(param.value);
    } catch (py::error_already_set& e) {
      if (!e.matches(PyExc_ValueError)) throw;
    }
  }
  return py::str(unquoted(param.value));
}

py::dict all_params() {
  RunParams defaults;
  py::dict all;
  for (const ParamDescription& param : describe_params([&](ParamVisitor& v) { defaults.visit(v); }))
    all[py::str(param.key)] = param;
  return all;
}

}  // namespace

RunParams run_params(const Arguments& arguments, const char* argument) {
  RunParams params;
  if (!arguments.has(argument)) return params;
  if (!py::isinstance<py::dict>(arguments.at(argument)))
    arguments.refuse(argument, "a dict of names and values");
  read(arguments.at(argument), "", arguments.where(argument), &params);
  params.map.check();
  return params;
}

void add_params(py::module_& module) {
  py::class_<ParamDescription> param(module, "Param", "A parameter of a run.");
  param.def_property_readonly("value", parsed, "Default: bool, int, float or str.");
  param.def_readonly("range", &ParamDescription::range,
                     "\"[min, max]\" of a number, the choices of a text; empty: any text.");
  param.def_readonly("meaning", &ParamDescription::help, "What it does, with its unit.");
  param.def_property_readonly(
      "basic", [](const ParamDescription& p) { return p.level == ParamLevel::kBasic; },
      "Whether it is for every user.");
  param.def("__repr__", [](const ParamDescription& p) {
    return "Param(" + p.value + (p.range.empty() ? "" : ", " + p.range) + "): " + p.help;
  });
  define_function(
      module, "params()", [](const Arguments&) { return all_params(); },
      "All parameters of a run by their names, which run() and Odometry() take in `params`.");
}

}  // namespace edgevo::python
