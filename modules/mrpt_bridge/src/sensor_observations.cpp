// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/mrpt_bridge/sensor_observations.h"

#include <mrpt/obs/CObservationGPS.h>
#include <mrpt/obs/CObservationIMU.h>
#include <mrpt/obs/CObservationOdometry.h>
#include <mrpt/obs/CObservationRobotPose.h>

#include <cmath>

#include "edgevo/mrpt_bridge/conversions.h"

namespace edgevo {
namespace {

using namespace mrpt::obs;

CObservation::Ptr make(const OdometryReading& reading, const SensorReading&) {
  auto obs = CObservationOdometry::Create();
  obs->odometry = mrpt::poses::CPose2D(to_mrpt(reading.T_odom_vehicle));
  obs->hasEncodersInfo = false;
  obs->hasVelocities = true;
  obs->velocityLocal = {reading.linear.x(), reading.linear.y(), reading.angular.z()};
  return obs;
}

// The time of day as GGA has it.
gnss::UTC_time utc_time(Timestamp time) {
  constexpr int64_t kMinute = 60 * Timestamp::kTicksPerSecond, kDay = 24 * 60 * kMinute;
  const int64_t of_day = (time.ticks % kDay + kDay) % kDay;
  gnss::UTC_time utc;
  utc.hour = uint8_t(of_day / (60 * kMinute));
  utc.minute = uint8_t(of_day / kMinute % 60);
  utc.sec = double(of_day % kMinute) / double(Timestamp::kTicksPerSecond);
  return utc;
}

CObservation::Ptr make(const GpsReading& reading, const SensorReading& about) {
  gnss::Message_NMEA_GGA gga;
  gga.fields.UTCTime = utc_time(about.time);
  gga.fields.latitude_degrees = reading.latitude_deg;
  gga.fields.longitude_degrees = reading.longitude_deg;
  gga.fields.altitude_meters = reading.height_m;
  gga.fields.fix_quality = 1;
  auto obs = CObservationGPS::Create();
  obs->sensorPose = to_mrpt(about.T_vehicle_sensor);
  obs->setMsg(gga);
  return obs;
}

CObservation::Ptr make(const ImuReading& reading, const SensorReading& about) {
  auto obs = CObservationIMU::Create();
  obs->sensorPose = to_mrpt(about.T_vehicle_sensor);
  const auto& w = reading.angular_velocity;
  const auto& a = reading.acceleration;
  obs->set(IMU_WX, w.x()), obs->set(IMU_WY, w.y()), obs->set(IMU_WZ, w.z());
  // Of a gyro alone there are none.
  if (!a.isZero()) obs->set(IMU_X_ACC, a.x()), obs->set(IMU_Y_ACC, a.y()), obs->set(IMU_Z_ACC, a.z());
  if (!reading.R_world_imu) return obs;
  const Eigen::Quaterniond& q = *reading.R_world_imu;
  obs->set(IMU_ORI_QUAT_X, q.x()), obs->set(IMU_ORI_QUAT_Y, q.y());
  obs->set(IMU_ORI_QUAT_Z, q.z()), obs->set(IMU_ORI_QUAT_W, q.w());
  return obs;
}

CObservation::Ptr make(const PoseReading& reading, const SensorReading&) {
  auto obs = CObservationRobotPose::Create();
  obs->pose.mean = to_mrpt(reading.T_map_vehicle);
  return obs;
}

}  // namespace

CObservation::Ptr make_sensor_observation(const SensorReading& reading) {
  const auto obs = std::visit([&](const auto& value) { return make(value, reading); }, reading.value);
  obs->timestamp = to_mrpt(reading.time);
  obs->sensorLabel = reading.label;
  return obs;
}

}  // namespace edgevo
