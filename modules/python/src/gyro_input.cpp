// SPDX-License-Identifier: BSD-3-Clause
#include "gyro_input.h"

#include <memory>
#include <vector>

#include "arguments.h"
#include "arrays.h"

namespace edgevo::python {

GyroSample gyro_sample(py::handle time, const std::string& time_where, py::handle rate,
                       const std::string& rate_where) {
  const std::vector<Eigen::Vector3d> rates = to_points(rate, rate_where);
  if (rates.size() != 1)
    throw bad_value(rate_where, "is " + describe(rate), "give three numbers in rad/s: one sample a call");
  return {time_of(py::reinterpret_borrow<py::object>(time), time_where), rates.front()};
}

GyroReadings gyro_samples(py::handle pairs, const std::string& where) {
  const auto samples = std::make_shared<std::vector<GyroSample>>();
  for (const py::handle item : py::iter(pairs)) {
    if (!py::isinstance<py::tuple>(item) || py::len(item) != 2)
      throw py::type_error(where + " holds " + describe(item) + "; (time, rate) are wanted");
    const auto pair = py::reinterpret_borrow<py::tuple>(item);
    samples->push_back(gyro_sample(pair[0], where + ": time", pair[1], where + ": rate"));
  }
  if (samples->empty()) return {};
  return [samples, next = size_t(0)]() mutable -> std::optional<GyroSample> {
    return next < samples->size() ? std::make_optional((*samples)[next++]) : std::nullopt;
  };
}

}  // namespace edgevo::python
