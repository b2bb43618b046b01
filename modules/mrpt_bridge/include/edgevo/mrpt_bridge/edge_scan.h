// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// A keyframe's edge points as an MRPT observation.
#include <mrpt/obs/CObservation3DRangeScan.h>

#include "edgevo/core/point_filter.h"
#include "edgevo/core/records.h"

namespace edgevo {

/// The points that pass `filter`, expressed in the frame F by T_F_cam, with sensorPose = identity: insert the
/// observation into a map from the pose of F. This is the only combination that MRPT 2.5's point maps and
/// octomaps read alike (they disagree about sensorPose; CObservationPointCloud is worse). Pixel indices are
/// those of the undistorted host image.
mrpt::obs::CObservation3DRangeScan::Ptr make_edge_scan(const KeyframeRecord& keyframe, const Pinhole& pinhole,
                                                       const PointFilter& filter, const SE3& T_F_cam);

}  // namespace edgevo
