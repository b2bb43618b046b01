// SPDX-License-Identifier: BSD-3-Clause
#include "corner_evaluation.h"

namespace edgevo {

// In the unit of the corners; nothing if the image before has no pose.
std::optional<SE3> CornerEvaluation::step_since_image(const std::optional<SE3>& T_cur_last) const {
  if (!T_cur_last || !has_pose_) return std::nullopt;
  return SE3(T_cur_last->rotation(), unit_ * T_cur_last->translation());
}

std::optional<CornerEvidence> CornerEvaluation::add(const CornerView& view,
                                                    const std::optional<SE3>& T_cur_last,
                                                    const std::optional<SE3>& T_cam_map) {
  const ChainStep step = chain_.add(view, step_since_image(T_cur_last));
  if (T_cur_last) T_cam_odometry_ = *T_cur_last * T_cam_odometry_;
  has_pose_ = T_cur_last.has_value();
  if (has_pose_)
    comparison_.add({step, T_cam_odometry_, T_cam_map.value_or(T_cam_odometry_)});
  else
    comparison_.add({step, {}, {}});
  unit_ = comparison_.unit().value_or(unit_);
  if (!has_pose_) return std::nullopt;
  CornerEvidence evidence;
  evidence.tracks = int(view.tracks.size());
  evidence.agreeing_share = epipolar_.add(view, T_cam_odometry_);
  comparison_.compare(&evidence);
  return evidence;
}

void CornerEvaluation::begin_map(double median_idepth) {
  chain_.expect_idepth(median_idepth);
  T_cam_odometry_ = SE3();
  has_pose_ = true;
  comparison_.forget_odometry();
  epipolar_.restart();
}

}  // namespace edgevo
