// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <vector>

#include "edgevo/core/records.h"
#include "scale_course.h"

namespace edgevo {

/// Where sources contradict the rest of the course, and where positions are displaced; by source, then time.
/// A source that measures nothing at all is named for the whole run.
std::vector<ScaleFault> scale_faults(const std::vector<MeasuredPath>& paths, const ScaleCourse& course);

}  // namespace edgevo
