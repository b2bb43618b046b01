// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Results as arrays of numpy: read-only, each over memory of its own.
#include <pybind11/numpy.h>

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "edgevo/core/se3.h"

namespace edgevo::python {

namespace py = pybind11;

/// `array` so that assigning to it is an error.
py::array read_only(py::array array);

/// A matrix, rows x columns.
py::array to_array(const Eigen::MatrixXd& matrix);
/// A homogeneous matrix, 4 x 4; None if there is none.
py::object to_array(const std::optional<SE3>& T);
/// Points, N x 3.
py::array to_array(const std::vector<Eigen::Vector3d>& points);

/// An array of one axis, each value of `items` by `value`.
template <class T, class Items, class Value>
py::array column(const Items& items, Value value) {
  py::array_t<T> array(py::ssize_t(items.size()));
  T* out = array.mutable_data();
  for (const auto& item : items) *out++ = T(value(item));
  return read_only(std::move(array));
}

/// Points from an array of N x 3 or 3 numbers; `where` opens the message. Throws TypeError or InputError.
std::vector<Eigen::Vector3d> to_points(py::handle object, const std::string& where);

}  // namespace edgevo::python
