#pragma once
// How steadily the camera moves, and what a frame owes to that: an unusual step must be much better supported
// than the usual one.
//
// Where all edges of the scene run along the motion (a corridor, a tunnel), few points tell how far the
// camera has gone, and glare and shadows, which move by themselves, can outvote them: tracking then jumps by
// several frames' way, at a share of inliers of 0.9
// (share/lab/archive/2026-11-23_motion_outliers.md).
#include <deque>
#include <optional>

#include "edgevo/alignment/pose_choice.h"
#include "edgevo/core/se3.h"

namespace edgevo {

class MotionModel;

/// The camera's translation a frame, in its own axes, over the frames of late.
class SteadyMotion {
 public:
  struct Step {
    Eigen::Vector3d
        translation;  ///< median of the last kSteps frames, tangent (v of core/se3.h), unit of the map
    Eigen::Vector3d deviation;  ///< rms of what single frames differ from it, axis by axis
  };

  /// Nothing until kSteps frames in a row and kFrames in all have been seen.
  std::optional<Step> usual() const;

  /// A frame's translation. `held`: usual() itself decided on it, which says nothing about how steady the
  /// camera is.
  void follow(const Eigen::Vector3d& translation, bool held);
  /// Frames without a pose: what comes after them is no longer next to what came before.
  void interrupt() { steps_.clear(); }

 private:
  static constexpr size_t kSteps = 9;  // frames of the median: four bad ones in a row leave it alone
  static constexpr int kFrames =
      20;  // that deviations are averaged over: as many as tell a deviation to a sixth

  Eigen::Vector3d median() const;

  std::deque<Eigen::Vector3d> steps_;
  Eigen::Vector3d square_ = Eigen::Vector3d::Zero();  // of the deviations, mean
  int seen_ = 0;
};

/// The step that a frame is expected to make, of a camera that is under way evenly.
class UsualStep {
 public:
  /// Nothing at a standstill, in a turn on the spot, of a camera moved about by hand, and over a gap: there
  /// no step is usual.
  static std::optional<UsualStep> of(const MotionModel& motion);

  /// How likely it is that the frame is there, beside the usual step: for PoseJudge.
  double likelihood(const SE3& T_cur_ref) const;
  /// Its translation differs from the usual one by more than the camera's steps do.
  bool is_unusual(const SE3& T_cur_ref) const;
  /// The image tells it apart from the usual one. Cost: two projections a point.
  bool is_apart(const Pinhole& pinhole, const ReferenceCloud& cloud, const SE3& T_cur_ref) const;
  /// The frame near the usual step.
  PoseHypothesis hypothesis() const;

 private:
  SE3 T_last_ref_, T_usual_ref_;
  SteadyMotion::Step step_;
};

}  // namespace edgevo
