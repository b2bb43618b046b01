// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// keyframes.simplemap: the keyframes with their edge points, for observations2map and robot-map-gui.
//
// Each pair holds the pose of the CAMERA in the world of the map files (T_map_world(run), z up) and one
// CObservation3DRangeScan with the points in the camera's axes and sensorPose = identity. It is the one
// combination that MRPT 2.5 turns into the right point map AND the right octomap, end points and free rays
// (measured). The poses carry no covariance. Lengths are in the unit of the run. Memory: a second copy of the
// points while it is written. A run without keyframes gives a valid, empty map.
#include <string>

#include "edgevo/core/point_filter.h"
#include "edgevo/core/records.h"

namespace edgevo {

/// Writes the points that pass `filter`; keyframes without any are skipped. Throws InputError if the file
/// cannot be written.
void write_simplemap(const Run& run, const PointFilter& filter, const std::string& path);

}  // namespace edgevo
