// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Inertial measurements of a rawlog.
#include <string>
#include <vector>

#include "edgevo/core/sensor_reading.h"

namespace edgevo {

/// All CObservationIMU with rates, rad/s, in the order of the rawlog, which is opened once more at the first
/// reading. A truncated rawlog gives those before the cut. `image_times`: as read_vehicle_track() has them.
SensorReadings read_rawlog_imus(const std::string& path, const std::vector<Timestamp>& image_times);

}  // namespace edgevo
