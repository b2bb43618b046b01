// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include "arrays.h"
#include "edgevo/core/records.h"

namespace edgevo::python {

/// Nanoseconds since the epoch.
int64_t nanoseconds(Timestamp time);

/// A covariance, 6 x 6; NaN where it is not known.
py::array covariance_array(const Matrix6d& covariance);

}  // namespace edgevo::python
