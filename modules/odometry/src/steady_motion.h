#pragma once
// How steadily the camera moves, and what a frame owes to that: an unusual step must be much better supported than the usual one.
//
// Where all edges of the scene run along the motion (a corridor, a tunnel), few points tell how far the camera has gone, and glare and
// shadows, which move by themselves, can outvote them: tracking then jumps by several frames' way, at a share of inliers of 0.9.
// README.md, "A step out of the ordinary", has the figures.
#include <deque>
#include <optional>

#include "edgevo/alignment/tracker.h"

namespace edgevo {

class MotionModel;

/// The camera's translation a frame, in its own axes, over the frames of late.
class SteadyMotion {
 public:
  struct Step {
    Eigen::Vector3d translation;  ///< median of the last kSteps frames, tangent (v of core/se3.h), unit of the map
    Eigen::Vector3d deviation;    ///< rms of what single frames differ from it, axis by axis
  };

  /// Nothing until kSteps frames in a row and kFrames in all have been seen.
  std::optional<Step> usual() const;

  /// A frame's translation. `held`: usual() itself decided on it, which says nothing about how steady the camera is.
  void follow(const Eigen::Vector3d& translation, bool held);
  /// Frames without a pose: what comes after them is no longer next to what came before.
  void interrupt() { steps_.clear(); }

 private:
  static constexpr size_t kSteps = 9;
  static constexpr int kFrames = 20;  // that deviations are averaged over

  Eigen::Vector3d median() const;

  std::deque<Eigen::Vector3d> steps_;
  Eigen::Vector3d square_ = Eigen::Vector3d::Zero();  // of the deviations, mean
  int seen_ = 0;
};

/// Where the camera is under way evenly and `found` is a step out of the ordinary: the frame tracked near the usual one, if that leads to a
/// usual step and the image supports it nearly as well; and true then.
/// Cost: nothing but a comparison, as a rule; two evaluations of the pose and an alignment of the edges where the step is unusual.
bool hold_steady(const MotionModel& motion, const FramePyramid& current, const ReferenceCloud& cloud, const AlignmentParams& params,
                 TrackResult* found);

}  // namespace edgevo
