// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The gyro among the sensors of a recording.
#include "edgevo/core/gyro_sample.h"
#include "edgevo/core/sensor_reading.h"

namespace edgevo {

/// Samples of the gyro among `readings`: of the inertial sensor with most rates that are not zero among the
/// first 1000 (an accelerometer alone states zeros). Empty if there is none among them.
GyroReadings gyro_of(SensorReadings readings);

}  // namespace edgevo
