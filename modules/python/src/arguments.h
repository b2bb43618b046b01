// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The arguments of a call from Python, read by hand: whatever is wrong with them is one line that names the
// function, what came and what is wanted. (pybind11's own message has a line for each overload.)
#include <pybind11/pybind11.h>

#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "edgevo/core/error.h"
#include "edgevo/core/timestamp.h"

namespace edgevo::python {

namespace py = pybind11;

/// The signature of a function as its documentation has it: "Camera(model, width, *, d=())". Arguments
/// with `=` are optional, those behind `*` are given by their names.
class Signature {
 public:
  /// Parses `text`, as above.
  explicit Signature(const std::string& text);

  /// Name of the function.
  const std::string& name() const { return name_; }
  /// The signature of a method or function as inspect.signature() reads it, then `doc`.
  std::string documentation(const std::string& doc, bool is_method) const;

 private:
  friend class Arguments;
  struct Argument {
    std::string name;
    bool is_optional = false;
  };
  int find(const std::string& argument) const;
  std::string names() const;

  std::string name_, text_;
  std::vector<Argument> arguments_;
  size_t positional_ = 0;
};

/// The error of a value: `where` is the function with the argument, "Camera(): width", and `what` goes on
/// from there, "is 0".
InputError bad_value(const std::string& where, const std::string& what, const std::string& remedy);

/// What an object is, for messages: "None", "str 'a'", "an array of float64, 480 x 640".
std::string describe(py::handle object);

/// A whole number, also one of numpy; nothing for anything else, which includes bool.
std::optional<py::int_> whole_number(py::handle object);

/// The arguments of one call. Every function throws TypeError for an object of the wrong type, and InputError
/// for a value that cannot be, in one line. Call with the GIL.
class Arguments {
 public:
  /// Throws TypeError for an argument that is missing, unknown, given twice or one too many.
  Arguments(const Signature& signature, const py::args& given, const py::kwargs& named);

  /// The object that was given; none if there is none.
  py::handle at(const char* argument) const;
  /// Whether it was given, and is not None.
  bool has(const char* argument) const;

  /// A text.
  std::string text(const char* argument) const;
  /// A path, as str, bytes or os.PathLike.
  std::string path(const char* argument) const;
  /// A finite number.
  double number(const char* argument) const;
  /// A finite number; `otherwise` if it was not given.
  double number(const char* argument, double otherwise) const;
  /// A whole number between `min` and `max`.
  int integer(const char* argument, int min, int max) const;
  /// A seed: a whole number from 0 to 2^64 - 1; `otherwise` if it was not given.
  uint64_t seed(const char* argument, uint64_t otherwise) const;
  /// True or False; `otherwise` if it was not given.
  bool flag(const char* argument, bool otherwise) const;
  /// Something that can be called, or none.
  py::object function(const char* argument) const;
  /// Two whole numbers, the first below the second; the second may be None.
  std::pair<int, std::optional<int>> range(const char* argument) const;
  /// A time: seconds as float, or nanoseconds as int.
  Timestamp time(const char* argument) const;

  /// "Odometry.process(): time", to begin a message with.
  std::string where(const char* argument) const;
  /// Throws TypeError: what came, and what is wanted.
  [[noreturn]] void refuse(const char* argument, const std::string& wanted) const;

 private:
  const Signature& signature_;
  std::vector<py::object> values_;
};

/// The same of an object that is no argument by itself.
Timestamp time_of(py::handle object, const std::string& where);

/// Defines a method of a class; `function` takes the object and its Arguments.
template <class Class, class Function>
void define(Class& target, const std::string& signature, Function function, const std::string& doc) {
  const auto parsed = std::make_shared<const Signature>(signature);
  const std::string method = parsed->name().substr(parsed->name().rfind('.') + 1);
  target.def(
      method.c_str(),
      [parsed, function](typename Class::type& self, const py::args& given, const py::kwargs& named) {
        return function(self, Arguments(*parsed, given, named));
      },
      parsed->documentation(doc, true).c_str());
}

/// Defines a constructor; `function` takes Arguments.
template <class Class, class Function>
void define_init(Class& target, const std::string& signature, Function function) {
  const auto parsed = std::make_shared<const Signature>(signature);
  target.def(py::init([parsed, function](const py::args& given, const py::kwargs& named) {
               return function(Arguments(*parsed, given, named));
             }),
             parsed->documentation("", true).c_str());
}

/// Defines a function of the module; `function` takes Arguments.
template <class Function>
void define_function(py::module_& module, const std::string& signature, Function function,
                     const std::string& doc) {
  const auto parsed = std::make_shared<const Signature>(signature);
  module.def(
      parsed->name().c_str(),
      [parsed, function](const py::args& given, const py::kwargs& named) {
        return function(Arguments(*parsed, given, named));
      },
      parsed->documentation(doc, false).c_str());
}

}  // namespace edgevo::python
