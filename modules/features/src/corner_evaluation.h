// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// From followed corners and the odometry's steps to the evidence.
#include <optional>
#include <vector>

#include "corner_chain.h"
#include "epipolar_check.h"
#include "motion_comparison.h"

namespace edgevo {

/// Everything of FeatureTracker but the images.
class CornerEvaluation {
 public:
  /// Takes the next image's correction (FramePyramid::correction), before its corners are followed.
  void change_lens(const ImageCorrection& lens) { chain_.change_lens(lens); }
  /// Where the corners are expected, if the odometry's motion is `T_cur_last`.
  std::vector<ExpectedCorner> expect(const std::optional<SE3>& T_cur_last) const {
    return chain_.expect(step_since_image(T_cur_last));
  }
  /// FeatureTracker::add(), for the corners of the image.
  std::optional<CornerEvidence> add(const CornerView& view, const std::optional<SE3>& T_cur_last,
                                    const std::optional<SE3>& T_cam_map = {});
  /// FeatureTracker::begin_map().
  void begin_map(double median_idepth);
  /// Corners that are not to be followed any more.
  std::vector<uint32_t> take_rejected() { return chain_.take_rejected(); }

 private:
  std::optional<SE3> step_since_image(const std::optional<SE3>& T_cur_last) const;

  CornerChain chain_;
  MotionComparison comparison_;
  EpipolarCheck epipolar_;
  SE3 T_cam_odometry_;     // the odometry's path: its steps, one after the other
  bool has_pose_ = false;  // of the image before
  double unit_ = 1;        // of the corners per unit of the odometry
};

}  // namespace edgevo
