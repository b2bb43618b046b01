#pragma once
// A host frame with its points, and a target frame as the front-end delivers it: pose and covariance from
// edge alignment.
#include <memory>
#include <vector>

#include "edgevo/alignment/tracker.h"
#include "edgevo/simulation/correspondence.h"
#include "edgevo/study/study_points.h"

namespace edgevo {

/// A host frame with its points.
struct HostView {
  std::shared_ptr<const FramePyramid> pyramid;  ///< of the host image
  std::vector<StudyPoint> points;               ///< to be found
  ReferenceCloud cloud;                         ///< of the points with their noise
};

/// A target frame as the front-end delivers it.
struct TargetView {
  std::shared_ptr<const FramePyramid> pyramid;  ///< of the target image
  SE3 T_target_host;                            ///< exact
  TrackResult track;                            ///< of the front-end
  double track_ms = 0;                          ///< CPU time of the front-end
  SE3 T_start;  ///< where adjustments start: the tracked pose, the predicted one where tracking is lost
  std::vector<Correspondence> truth;  ///< of each point of the host
};

/// With the cloud of its points.
HostView make_host(std::shared_ptr<const FramePyramid> pyramid, std::vector<StudyPoint> points);

/// Tracks the target as the odometry does. `T_step` is the exact motion of the step before, from which the
/// front-end, running at this frame distance, would predict: constant velocity first, its usual alternatives
/// after it.
TargetView make_target(const HostView& host, std::shared_ptr<const FramePyramid> pyramid,
                       const ViewPair& views, const SE3& T_step);

}  // namespace edgevo
