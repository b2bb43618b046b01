// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// By how much a sensor stamps its positions later than the camera stamps its images.
//
// At the right offset the sensor's path has the shape of the camera's: its residuals after a similarity are
// the sensor's own noise. At a wrong one every turn and every change of speed comes too late. The offset is
// that of the most probable residuals, over all intervals of the path, each with a scale of its own since
// that drifts.
//
// A sensor that is not at the camera lags behind it in turns as one that is late does. Its place on the
// vehicle is therefore estimated along, with a standard deviation of a metre: at constant speed only what is
// beyond that is laid to the clock. Changes of speed show the difference.
#include <optional>
#include <vector>

#include "edgevo/core/records.h"
#include "edgevo/core/vehicle_track.h"
#include "edgevo/scale/path.h"
#include "edgevo/scale/scale_params.h"

namespace edgevo {

/// The offset of `track`'s clock, within 2 s. nullopt where its stamps as they are fit as well by chance, and
/// where no offset fits. `sensor_in_camera`: metres. Cost: 0.1 s for 4,000 positions and more.
std::optional<ClockOffset> clock_offset(const std::vector<const Path*>& paths, const VehicleTrack& track,
                                        const Eigen::Vector3d& sensor_in_camera, const ScaleParams& params);

/// The track with its stamps corrected.
VehicleTrack corrected(VehicleTrack track, double late_s);

}  // namespace edgevo
