// SPDX-License-Identifier: BSD-3-Clause
#include "arrays.h"

#include <algorithm>

#include "arguments.h"
#include "edgevo/core/error.h"

namespace edgevo::python {

py::array read_only(py::array array) {
  py::detail::array_proxy(array.ptr())->flags &= ~py::detail::npy_api::NPY_ARRAY_WRITEABLE_;
  return array;
}

py::array to_array(const Eigen::MatrixXd& matrix) {
  py::array_t<double> array({matrix.rows(), matrix.cols()});
  using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
  Eigen::Map<RowMajor>(array.mutable_data(), matrix.rows(), matrix.cols()) = matrix;
  return read_only(std::move(array));
}

py::object to_array(const std::optional<SE3>& T) {
  if (!T || !T->is_finite()) return py::none();
  return to_array(Eigen::MatrixXd(T->matrix()));
}

py::array to_array(const std::vector<Eigen::Vector3d>& points) {
  py::array_t<double> array({py::ssize_t(points.size()), py::ssize_t(3)});
  double* out = array.mutable_data();
  for (const Eigen::Vector3d& p : points) out = std::copy(p.data(), p.data() + 3, out);
  return read_only(std::move(array));
}

std::vector<Eigen::Vector3d> to_points(py::handle object, const std::string& where) {
  const std::string wanted = "; numbers, 3 or N x 3, are wanted";
  if (py::isinstance<py::str>(object) || object.is_none())
    throw py::type_error(where + " is " + describe(object) + wanted);
  const auto array = py::array_t<double, py::array::c_style | py::array::forcecast>::ensure(object);
  if (!array) {
    PyErr_Clear();
    throw py::type_error(where + " is " + describe(object) + wanted);
  }
  const bool is_point = array.ndim() == 1 && array.shape(0) == 3;
  const bool is_list = array.ndim() == 2 && array.shape(1) == 3;
  if (!is_point && !is_list) throw bad_value(where, "is " + describe(array), "give 3 or N x 3 numbers");
  std::vector<Eigen::Vector3d> points(size_t(array.size()) / 3);
  const double* value = array.data();
  for (Eigen::Vector3d& p : points) p = Eigen::Vector3d(value[0], value[1], value[2]), value += 3;
  for (const Eigen::Vector3d& p : points)
    if (!p.allFinite()) throw bad_value(where, "holds NaN or infinity", "give finite numbers");
  return points;
}

}  // namespace edgevo::python
