// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The positions of the vehicle that a rawlog's other sensors recorded, for a metric scale.
//
//   kOdometry    CObservationOdometry: the plane pose in the "odom" frame
//   kGps         CObservationGPS with an NMEA GGA message and a fix; latitude, longitude and height become
//                Cartesian metres (WGS84, from the centre of the earth, first fix at the origin)
//   kRobotPose   CObservationRobotPose
// If several sensors of a kind were recorded, the one with the most positions is used. Poses that edgevo
// itself wrote into a playback.rawlog (EDGE_VO...) are ignored.
#include <string>
#include <vector>

#include "edgevo/core/vehicle_track.h"

namespace edgevo {

/// Reads the rawlog once, without its external images. Positions in time order, one for each time; a
/// truncated rawlog yields those before the cut. Throws InputError if it cannot be opened.
/// `image_times`: stated times of the images in their order, if they are known. Where the clock was set back,
/// the times of positions are corrected as those of the frames are (core/time_order.h).
VehicleTrack read_vehicle_track(const std::string& rawlog_path, VehicleSensor sensor,
                                const std::vector<Timestamp>& image_times = {});

}  // namespace edgevo
