// SPDX-License-Identifier: BSD-3-Clause
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
  /// Pyramid of the host image.
  std::shared_ptr<const FramePyramid> pyramid;
  /// Points to be found in the target.
  std::vector<StudyPoint> points;
  /// Cloud of the points with noisy depths.
  ReferenceCloud cloud;
};

/// A target frame as the front-end delivers it.
struct TargetView {
  /// Pyramid of the target image.
  std::shared_ptr<const FramePyramid> pyramid;
  /// Exact motion.
  SE3 T_target_host;
  /// Result of the front-end.
  TrackResult track;
  /// Whether the front-end found no pose.
  bool is_lost = false;
  /// CPU time of the front-end, milliseconds.
  double track_ms = 0;
  /// Initial pose of adjustments: the tracked pose, or the predicted one if tracking is lost.
  SE3 T_start;
  /// Exact correspondence of each point of the host.
  std::vector<Correspondence> truth;
};

/// Host view with the cloud of its points.
HostView make_host(std::shared_ptr<const FramePyramid> pyramid, std::vector<StudyPoint> points);

/// Tracks the target as the odometry does. `T_step` is the exact motion of the previous step, from which the
/// front-end, running at this frame distance, would predict: constant velocity first, then its usual
/// alternatives.
TargetView make_target(const HostView& host, std::shared_ptr<const FramePyramid> pyramid,
                       const ViewPair& views, const SE3& T_step);

}  // namespace edgevo
