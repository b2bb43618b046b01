// SPDX-License-Identifier: BSD-3-Clause
#include "arguments.h"

#include <pybind11/numpy.h>

#include <algorithm>
#include <cmath>

namespace edgevo::python {
namespace {

std::string trimmed(const std::string& text) {
  const size_t begin = text.find_first_not_of(' '), end = text.find_last_not_of(' ');
  return begin == std::string::npos ? std::string() : text.substr(begin, end - begin + 1);
}

// The parts of "a, b=(1, 2), c": commas within brackets do not separate.
std::vector<std::string> split(const std::string& list) {
  std::vector<std::string> parts(1);
  int depth = 0;
  for (const char c : list) {
    depth += (c == '(' || c == '{') - (c == ')' || c == '}');
    if (c == ',' && depth == 0)
      parts.emplace_back();
    else
      parts.back() += c;
  }
  return parts;
}

// One line of at most some fifty characters.
std::string shortened(std::string text) {
  constexpr size_t kMaxCharacters = 50;
  std::replace_if(
      text.begin(), text.end(), [](char c) { return c == '\n' || c == '\r'; }, ' ');
  return text.size() <= kMaxCharacters ? text : text.substr(0, kMaxCharacters) + "...";
}

std::string type_of(py::handle object) {
  const std::string module = py::str(py::type::handle_of(object).attr("__module__"));
  const std::string name = py::str(py::type::handle_of(object).attr("__qualname__"));
  return module == "builtins" || module == "edgevo" ? name : module + "." + name;
}

std::string describe_array(const py::array& array) {
  std::string sizes;
  for (py::ssize_t i = 0; i < array.ndim(); ++i) sizes += (i ? " x " : "") + std::to_string(array.shape(i));
  return "an array of " + std::string(py::str(array.dtype())) + ", " + (sizes.empty() ? "a scalar" : sizes);
}

// What repr() says, or nothing of an object whose repr() fails.
std::string value_of(py::handle object) {
  try {
    return shortened(py::repr(object));
  } catch (py::error_already_set&) {
    return "";
  }
}

void check_no_null(const std::string& text, const std::string& where) {
  if (text.find('\0') != std::string::npos)
    throw bad_value(where, "holds a null character", "give a text without");
}

}  // namespace

Signature::Signature(const std::string& text) {
  const size_t open = text.find('('), close = text.rfind(')');
  name_ = text.substr(0, open);
  text_ = text.substr(open, close - open + 1);
  bool is_positional = true;
  for (const std::string& part : split(text.substr(open + 1, close - open - 1))) {
    const std::string argument = trimmed(part.substr(0, part.find('=')));
    if (argument == "*")
      is_positional = false;
    else if (!argument.empty())
      arguments_.push_back({argument, part.find('=') != std::string::npos}), positional_ += is_positional;
  }
}

std::string Signature::documentation(const std::string& doc, bool is_method) const {
  std::string text = text_;
  if (is_method) text.insert(1, arguments_.empty() ? "$self" : "$self, ");
  return name_.substr(name_.rfind('.') + 1) + text + "\n--\n\n" + doc;
}

int Signature::find(const std::string& argument) const {
  for (size_t i = 0; i < arguments_.size(); ++i)
    if (arguments_[i].name == argument) return int(i);
  return -1;
}

std::string Signature::names() const { return name_ + text_; }

std::string describe(py::handle object) {
  if (!object || object.is_none()) return "None";
  if (py::isinstance<py::array>(object)) return describe_array(py::reinterpret_borrow<py::array>(object));
  const std::string type = type_of(object);
  const bool has_short_value = py::isinstance<py::str>(object) || py::isinstance<py::int_>(object) ||
                               py::isinstance<py::float_>(object) || py::isinstance<py::bool_>(object);
  return has_short_value ? type + " " + value_of(object) : type;
}

InputError bad_value(const std::string& where, const std::string& what, const std::string& remedy) {
  const size_t end = where.find("(): ");
  if (end == std::string::npos) return {where, what, remedy};
  return {where.substr(0, end + 2), where.substr(end + 4) + " " + what, remedy};
}

std::optional<py::int_> whole_number(py::handle object) {
  // numpy's bool has an index, too, which is deprecated.
  if (PyBool_Check(object.ptr()) || !PyIndex_Check(object.ptr()) || py::isinstance<py::array>(object) ||
      type_of(object) == "numpy.bool_")
    return std::nullopt;
  PyObject* const number = PyNumber_Index(object.ptr());
  if (!number) throw py::error_already_set();
  return py::reinterpret_steal<py::int_>(number);
}

Arguments::Arguments(const Signature& signature, const py::args& given, const py::kwargs& named)
    : signature_(signature), values_(signature.arguments_.size()) {
  const std::string where = signature.name() + "(): ";
  if (given.size() > signature.positional_)
    throw py::type_error(where + std::to_string(given.size()) + " arguments came without a name; wanted " +
                         signature.names());
  for (size_t i = 0; i < given.size(); ++i) values_[i] = given[i];
  for (const auto& [key, value] : named) {
    const std::string name = py::str(key);
    const int i = signature.find(name);
    if (i < 0)
      throw py::type_error(where + "there is no argument '" + shortened(name) + "'; wanted " +
                           signature.names());
    if (values_[size_t(i)]) throw py::type_error(where + "'" + name + "' came twice");
    values_[size_t(i)] = py::reinterpret_borrow<py::object>(value);
  }
  for (size_t i = 0; i < values_.size(); ++i)
    if (!values_[i] && !signature.arguments_[i].is_optional)
      throw py::type_error(where + "'" + signature.arguments_[i].name + "' is missing; wanted " +
                           signature.names());
}

py::handle Arguments::at(const char* argument) const {
  const py::object& value = values_.at(size_t(signature_.find(argument)));
  return value ? py::handle(value) : py::handle(Py_None);
}

bool Arguments::has(const char* argument) const { return !at(argument).is_none(); }

std::string Arguments::where(const char* argument) const { return signature_.name() + "(): " + argument; }

void Arguments::refuse(const char* argument, const std::string& wanted) const {
  throw py::type_error(where(argument) + " is " + describe(at(argument)) + "; " + wanted + " is wanted");
}

std::string Arguments::text(const char* argument) const {
  if (!py::isinstance<py::str>(at(argument))) refuse(argument, "a str");
  std::string text;
  try {
    text = py::cast<std::string>(at(argument));
  } catch (py::error_already_set&) {
    throw bad_value(where(argument), "is no valid Unicode", "give another text");
  }
  check_no_null(text, where(argument));
  return text;
}

std::string Arguments::path(const char* argument) const {
  const py::handle object = at(argument);
  if (!py::isinstance<py::str>(object) && !py::isinstance<py::bytes>(object) &&
      !py::hasattr(object, "__fspath__"))
    refuse(argument, "a path (str or os.PathLike)");
  const std::string path = py::cast<std::string>(py::module_::import("os").attr("fsencode")(object));
  check_no_null(path, where(argument));
  if (path.empty()) throw bad_value(where(argument), "is an empty path", "name a file or folder");
  return path;
}

double Arguments::number(const char* argument) const {
  const py::handle object = at(argument);
  // Arrays and texts may convert to a number, but are none.
  const bool is_scalar_of_numpy = py::hasattr(object, "dtype") && !py::isinstance<py::array>(object);
  if (!PyFloat_Check(object.ptr()) && !is_scalar_of_numpy && !whole_number(object))
    refuse(argument, "a number");
  const double value = PyFloat_AsDouble(object.ptr());
  if (PyErr_Occurred()) {
    PyErr_Clear();
    refuse(argument, "a number");
  }
  if (!std::isfinite(value))
    throw bad_value(where(argument), "is " + std::string(py::str(object)), "give a finite number");
  return value;
}

double Arguments::number(const char* argument, double otherwise) const {
  return has(argument) ? number(argument) : otherwise;
}

int Arguments::integer(const char* argument, int min, int max) const {
  const std::optional<py::int_> number = whole_number(at(argument));
  if (!number) refuse(argument, "an int");
  int overflow = 0;
  const long long value = PyLong_AsLongLongAndOverflow(number->ptr(), &overflow);
  if (overflow != 0 || value < min || value > max)
    throw bad_value(where(argument), "is " + value_of(*number),
                    "give a number from " + std::to_string(min) + " to " + std::to_string(max));
  return int(value);
}

uint64_t Arguments::seed(const char* argument, uint64_t otherwise) const {
  if (!has(argument)) return otherwise;
  const std::optional<py::int_> number = whole_number(at(argument));
  if (!number) refuse(argument, "an int");
  const unsigned long long value = PyLong_AsUnsignedLongLong(number->ptr());
  if (PyErr_Occurred()) {
    PyErr_Clear();
    throw bad_value(where(argument), "is " + value_of(*number), "give a number from 0 to 2**64 - 1");
  }
  return value;
}

bool Arguments::flag(const char* argument, bool otherwise) const {
  if (at(argument).is_none()) return otherwise;
  if (!PyBool_Check(at(argument).ptr())) refuse(argument, "True or False");
  return at(argument).ptr() == Py_True;
}

py::object Arguments::function(const char* argument) const {
  if (!has(argument)) return py::object();
  if (!PyCallable_Check(at(argument).ptr())) refuse(argument, "a function");
  return py::reinterpret_borrow<py::object>(at(argument));
}

std::pair<int, std::optional<int>> Arguments::range(const char* argument) const {
  const py::handle object = at(argument);
  const char* const wanted = "(first, end) with end after first, or None for the last frame,";
  if (!py::isinstance<py::tuple>(object) && !py::isinstance<py::list>(object)) refuse(argument, wanted);
  const auto pair = py::reinterpret_borrow<py::sequence>(object);
  if (pair.size() != 2) refuse(argument, wanted);
  const auto number = [&](size_t i) {
    const std::optional<py::int_> value = whole_number(py::object(pair[i]));
    if (!value) refuse(argument, wanted);
    int overflow = 0;
    const long long n = PyLong_AsLongLongAndOverflow(value->ptr(), &overflow);
    if (overflow != 0 || n < 0 || n > 1'000'000'000)
      throw bad_value(where(argument), "holds " + value_of(*value), "count frames from 0");
    return int(n);
  };
  const int first = number(0);
  if (py::object(pair[1]).is_none()) return {first, std::nullopt};
  const int end = number(1);
  if (end <= first)
    throw bad_value(where(argument), "ends at " + std::to_string(end) + " before it begins",
                    "give (first, end) with end after first");
  return {first, end};
}

Timestamp Arguments::time(const char* argument) const { return time_of(at(argument), where(argument)); }

Timestamp time_of(py::handle object, const std::string& where) {
  constexpr double kMaxSeconds = 9e10;  // some three thousand years
  if (const std::optional<py::int_> number = whole_number(object)) {
    int overflow = 0;
    const long long ns = PyLong_AsLongLongAndOverflow(number->ptr(), &overflow);
    if (overflow != 0)
      throw bad_value(where, "is " + value_of(*number), "give nanoseconds that fit into 64 bits");
    return Timestamp::from_nanoseconds(ns);
  }
  if (!PyFloat_Check(object.ptr()))
    throw py::type_error(where + " is " + describe(object) +
                         "; seconds (float) or nanoseconds (int) are wanted");
  const double seconds = PyFloat_AS_DOUBLE(object.ptr());
  if (!std::isfinite(seconds) || std::abs(seconds) > kMaxSeconds)
    throw bad_value(where, "is " + value_of(object) + " seconds", "give the time of the image");
  return Timestamp::from_seconds(seconds);
}

}  // namespace edgevo::python
