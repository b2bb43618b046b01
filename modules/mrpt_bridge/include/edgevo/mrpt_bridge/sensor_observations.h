// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Readings of other sensors as MRPT's observations.
#include <mrpt/obs/CObservation.h>

#include "edgevo/core/sensor_reading.h"

namespace edgevo {

/// CObservationOdometry (the pose in the plane, with velocities), CObservationGPS (a GGA message),
/// CObservationIMU or CObservationRobotPose, with the time, label and place of the sensor.
mrpt::obs::CObservation::Ptr make_sensor_observation(const SensorReading& reading);

}  // namespace edgevo
