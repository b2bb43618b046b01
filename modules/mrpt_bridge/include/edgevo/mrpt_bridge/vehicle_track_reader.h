#pragma once
// The positions of the vehicle that a rawlog's other sensors recorded, for a metric scale.
//
//   kOdometry    CObservationOdometry: the plane pose in the "odom" frame
//   kGps         CObservationGPS with an NMEA GGA message and a fix; latitude, longitude and height become
//                Cartesian metres (WGS84, from the centre of the earth, first fix at the origin)
//   kRobotPose   CObservationRobotPose
// Where several sensors of a kind were recorded, the one with the most positions counts. What edgevo itself
// wrote into a playback.rawlog (EDGE_VO, EDGE_VO_ODO) is no other sensor and does not count.
#include <string>

#include "edgevo/core/vehicle_track.h"

namespace edgevo {

/// Reads the rawlog once, its external images left alone. Positions in time order, one a time; a rawlog that
/// is cut short gives those before the cut. Throws InputError if it cannot be opened.
VehicleTrack read_vehicle_track(const std::string& rawlog_path, VehicleSensor sensor);

}  // namespace edgevo
