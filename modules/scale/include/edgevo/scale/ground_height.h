#pragma once
// The height of the camera over the ground that it drives over, seen in edges: lane marks, kerbs, cracks, shadows.
//
// Each edge point is looked at when the camera passes it. There, the ground under the camera's way lies one camera height below it,
// whatever the pitch of the camera: the normal of the ground is the camera's y axis made perpendicular to the way, and a point right below
// the camera has its height as its distance along this normal. Points far to the side are left out (parked cars, kerbs, a cambered road). What remains of
// things that are no ground lies above it and at many heights; the ground is the height at which most points lie (the mode).
// Ahead of the end of the path, points up to a few heights away are taken with the last direction of the way.
//
// Source: the idea of a ground plane of known distance is old (Song and Chandraker 2014; Zhou et al. 2016 for edges and dense
// roads); looking at points where they are passed is what sparse edges allow.
#include <optional>
#include <vector>

#include "edgevo/core/records.h"
#include "edgevo/scale/path.h"
#include "edgevo/scale/scale_estimate.h"
#include "edgevo/scale/scale_params.h"

namespace edgevo {

/// The height over one point of the ground.
struct HeightSample {
  double way = 0;     ///< of the path where the point is passed, units of the run
  double height = 0;  ///< of the camera over the point, units of the run, > 0
  Eigen::Vector3d p_world = Eigen::Vector3d::Zero();  ///< the point, units of the run
};

/// The points of `keyframe`, whose frame stands in `path`, that are passed within reach of the way. Those the path has not
/// passed yet are not in it, unless `is_path_ended`. Cost: points x frames until they are passed.
std::vector<HeightSample> ground_heights(const Pinhole& pinhole, const KeyframeRecord& keyframe, const Path& path, bool is_path_ended,
                                         const ScaleParams& params);

/// The scale that puts the mode of the heights at `camera_height` (metres). nullopt for too few points or where no height stands out.
std::optional<ScaleEstimate> fit_height(const std::vector<HeightSample>& samples, double camera_height, const ScaleParams& params);

/// The height of the camera over the ground along the whole run, unit of the run, from the keyframes alone; nullopt where no ground stands out.
std::optional<double> seen_camera_height(const Run& run, const ScaleParams& params);

}  // namespace edgevo
