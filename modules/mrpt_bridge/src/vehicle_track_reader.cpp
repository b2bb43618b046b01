// SPDX-License-Identifier: BSD-3-Clause
#include "vehicle_track_reader.h"

#include <mrpt/obs/CObservationGPS.h>
#include <mrpt/obs/CObservationOdometry.h>
#include <mrpt/obs/CObservationRobotPose.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>

#include "edgevo/core/angle.h"
#include "edgevo/core/clock_shifts.h"
#include "edgevo/core/error.h"
#include "edgevo/core/time_order.h"
#include "edgevo/mrpt_bridge/conversions.h"
#include "edgevo/mrpt_bridge/rawlog_reader.h"

namespace edgevo {
namespace {

using namespace mrpt::obs;

// From the centre of the earth, metres: WGS84's ellipsoid, by its radius at the equator (metres) and its
// flattening.
Eigen::Vector3d earth_centred(double latitude_deg, double longitude_deg, double height_m) {
  constexpr double kEquator = 6378137.0, kFlattening = 1 / 298.257223563;
  constexpr double kEccentricity2 = kFlattening * (2 - kFlattening);
  const double sin_lat = std::sin(rad(latitude_deg)), cos_lat = std::cos(rad(latitude_deg));
  const double across =
      kEquator / std::sqrt(1 - kEccentricity2 * sin_lat * sin_lat);  // radius of the prime vertical
  return {(across + height_m) * cos_lat * std::cos(rad(longitude_deg)),
          (across + height_m) * cos_lat * std::sin(rad(longitude_deg)),
          (across * (1 - kEccentricity2) + height_m) * sin_lat};
}

std::optional<Eigen::Vector3d> gps_position(const CObservation& observation) {
  const auto* gps = dynamic_cast<const CObservationGPS*>(&observation);
  if (!gps || !gps->hasMsgClass<gnss::Message_NMEA_GGA>()) return std::nullopt;
  const auto& fix = gps->getMsgByClass<gnss::Message_NMEA_GGA>().fields;
  if (fix.fix_quality == 0) return std::nullopt;
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

bool is_our_own(const std::string& label) { return label == "EDGE_VO" || label == "EDGE_VO_ODO"; }

void sort_by_time(VehicleTrack* track) {
  auto& p = track->positions;
  std::stable_sort(p.begin(), p.end(),
                   [](const VehiclePosition& a, const VehiclePosition& b) { return a.time < b.time; });
  p.erase(std::unique(p.begin(), p.end(),
                      [](const VehiclePosition& a, const VehiclePosition& b) { return a.time == b.time; }),
          p.end());
}

// Follows the clock of the images through a rawlog.
class ImageClock {
 public:
  explicit ImageClock(const std::vector<Timestamp>& times)
      : times_(times), without_gaps_(fill_missing(times)), shifts_(clock_shifts(times)) {}

  // An observation comes; if it is the next image, the clock goes on with it.
  void pass(Timestamp stated) {
    if (next_ < times_.size() && stated == times_[next_]) ++next_;
  }
  // Between the image before and the one after a step of the clock, that of the nearer time holds.
  Timestamp correct(Timestamp stated) const {
    if (times_.empty()) return stated;
    const size_t before = next_ > 0 ? next_ - 1 : 0, after = std::min(next_, times_.size() - 1);
    const size_t nearest = distance(stated, before) <= distance(stated, after) ? before : after;
    return {stated.ticks + shifts_[nearest]};
  }

 private:
  double distance(Timestamp stated, size_t image) const {
    return std::abs(seconds_between(without_gaps_[image], stated));
  }
  const std::vector<Timestamp>& times_;
  std::vector<Timestamp> without_gaps_;
  std::vector<int64_t> shifts_;
  size_t next_ = 0;
};

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
  VehicleTrack longest;
  for (auto& [label, track] : tracks)
    if (track.positions.size() > longest.positions.size()) longest = std::move(track);
  if (!longest.positions.empty()) {
    const Eigen::Vector3d first = longest.positions.front().position;
    for (VehiclePosition& p : longest.positions) p.position -= first;
  }
  sort_by_time(&longest);
  return longest;
}

}  // namespace edgevo
