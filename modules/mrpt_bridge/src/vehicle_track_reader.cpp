// SPDX-License-Identifier: BSD-3-Clause
#include "vehicle_track_reader.h"

#include <mrpt/obs/CObservationGPS.h>
#include <mrpt/obs/CObservationOdometry.h>
#include <mrpt/obs/CObservationRobotPose.h>

#include <map>
#include <optional>
#include <utility>

#include "edgevo/core/earth_centred.h"
#include "edgevo/core/error.h"
#include "edgevo/core/image_clock.h"
#include "edgevo/mrpt_bridge/conversions.h"
#include "edgevo/mrpt_bridge/rawlog_reader.h"

namespace edgevo {
namespace {

using namespace mrpt::obs;

std::optional<Eigen::Vector3d> gps_position(const CObservation& observation) {
  const auto* gps = dynamic_cast<const CObservationGPS*>(&observation);
  if (!gps || !gps->hasMsgClass<gnss::Message_NMEA_GGA>()) return std::nullopt;
  const auto& fix = gps->getMsgByClass<gnss::Message_NMEA_GGA>().fields;
  // Both zero: what receivers state that know no place.
  if (fix.fix_quality == 0 || (fix.latitude_degrees == 0 && fix.longitude_degrees == 0)) return std::nullopt;
  return earth_centred(fix.latitude_degrees, fix.longitude_degrees, fix.altitude_meters);
}

std::optional<Eigen::Vector3d> position_of(const CObservation& observation, VehicleSensor sensor) {
  if (sensor == VehicleSensor::kGps) return gps_position(observation);
  if (sensor == VehicleSensor::kOdometry) {
    const auto* o = dynamic_cast<const CObservationOdometry*>(&observation);
    return o ? std::make_optional<Eigen::Vector3d>(o->odometry.x(), o->odometry.y(), 0.0) : std::nullopt;
  }
  const auto* o = dynamic_cast<const CObservationRobotPose*>(&observation);
  return o ? std::make_optional<Eigen::Vector3d>(from_mrpt(o->pose.mean).translation()) : std::nullopt;
}

// Positions of an odometer are those of the vehicle itself.
Eigen::Vector3d place_on_vehicle(const CObservation& observation, VehicleSensor sensor) {
  if (sensor == VehicleSensor::kOdometry) return Eigen::Vector3d::Zero();
  mrpt::poses::CPose3D pose;
  observation.getSensorPose(pose);
  return from_mrpt(pose).translation();
}

bool is_our_own(const std::string& label) { return label.rfind("EDGE_VO", 0) == 0; }

}  // namespace

VehicleTrack read_vehicle_track(const std::string& rawlog_path, VehicleSensor sensor,
                                const std::vector<Timestamp>& image_times) {
  RawlogReader reader(rawlog_path);
  ImageClock clock(image_times);
  std::map<std::string, VehicleTrack> tracks;  // by label
  try {
    while (const auto observation = reader.next()) {
      const Timestamp stated = from_mrpt(observation->timestamp);
      clock.pass(stated);
      const auto position = position_of(*observation, sensor);
      if (!position || !position->allFinite() || is_our_own(observation->sensorLabel)) continue;
      VehicleTrack& track = tracks[observation->sensorLabel];
      if (track.positions.empty()) track.sensor_on_vehicle = place_on_vehicle(*observation, sensor);
      track.positions.push_back({clock.correct(stated), *position});
    }
  } catch (const InputError&) {
    // The reader of the images meets the same damage and reports it.
  }
  return longest_track(std::move(tracks));
}

}  // namespace edgevo
