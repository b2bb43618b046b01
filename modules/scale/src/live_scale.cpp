// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/scale/live_scale.h"

#include <algorithm>

#include "moved_height.h"
#include "scale_course.h"

namespace edgevo {
namespace {

constexpr int kFramesBetweenFits = 5;  // the scale changes over intervals, not frames
// The points of one interval have host keyframes up to another interval before it.
constexpr double kRememberedIntervals = 3;

}  // namespace

Eigen::Vector3d sensor_in_camera(const VehicleTrack& track, const std::optional<SE3>& T_vehicle_cam) {
  if (!T_vehicle_cam) return Eigen::Vector3d::Zero();
  return T_vehicle_cam->inverse() * track.sensor_on_vehicle;
}

LiveScale::LiveScale(const Pinhole& pinhole, const ScaleSources& sources, VehicleTracks tracks,
                     std::optional<SE3> T_vehicle_cam, const ScaleParams& params)
    : pinhole_(pinhole),
      sources_(sources),
      tracks_(std::move(tracks)),
      T_vehicle_cam_(std::move(T_vehicle_cam)),
      params_(params) {}

void LiveScale::add_frame(const FrameRecord& frame) {
  const bool is_next = history_.empty() || frame.index > newest_frame_;
  const bool changes_segment =
      frame.index == newest_frame_ && has_pose_ && frame.T_world_cam_live && frame.segment != segment_;
  if (!is_next && !changes_segment) return;
  if (is_next) history_.emplace_back();
  newest_frame_ = frame.index;
  has_pose_ = frame.T_world_cam_live.has_value();
  if (has_pose_) extend_path(frame);
  history_.back() = newest_;
}

void LiveScale::extend_path(const FrameRecord& frame) {
  if (frame.segment != segment_) begin_segment(frame.segment);
  extend(frame.index, frame.time, *frame.T_world_cam_live, &path_);
  if (!tracks_.empty() && ++frames_since_fit_ >= kFramesBetweenFits) estimate();
  forget_what_lies_behind();
}

void LiveScale::add_keyframe(int id, const KeyframeRecord& keyframe) {
  if (!sources_.camera_height() || keyframe.segment != segment_) return;
  for (HeightSample& height :
       ground_heights(pinhole_, keyframe, down_in_camera(T_vehicle_cam_), path_, false, params_)) {
    height.keyframe_id = id;
    heights_.push_back(height);
  }
  estimate();
}

void LiveScale::apply(const MapMoved& moved) {
  if (moved.segment != segment_) return;
  for (HeightSample& height : heights_)
    if (const KeyframeMove* move = moved.find(height.keyframe_id))
      height.height *= height_ratio(moved, *move);
  estimate();
}

void LiveScale::rescale(int segment, int first_keyframe, double ratio) {
  if (segment != segment_) return;
  for (HeightSample& height : heights_)
    if (height.keyframe_id >= first_keyframe) height.height *= ratio;
  estimate();
}

// The scale of a new segment equals that of the old one only if the speed was kept: a guess, used until there
// is an estimate.
void LiveScale::begin_segment(int segment) {
  segment_ = segment;
  path_.clear();
  heights_.clear();
  frames_since_fit_ = 0;
}

double LiveScale::interval_units() const {
  return newest_ ? params_.interval / newest_->factor : path_.back().distance;
}

void LiveScale::forget_what_lies_behind() {
  if (!newest_) return;
  const double oldest = path_.back().distance - kRememberedIntervals * interval_units();
  // In large blocks, since each erase moves all that remains.
  if (path_[path_.size() / 4].distance < oldest)
    path_.erase(path_.begin(), std::find_if(path_.begin(), path_.end(),
                                            [&](const PathPose& p) { return p.distance >= oldest; }));
  heights_.erase(std::remove_if(heights_.begin(), heights_.end(),
                                [&](const HeightSample& h) { return h.distance < oldest; }),
                 heights_.end());
}

void LiveScale::estimate() {
  frames_since_fit_ = 0;
  if (path_.empty()) return;
  std::sort(heights_.begin(), heights_.end(),
            [](const HeightSample& a, const HeightSample& b) { return a.distance < b.distance; });
  MeasuredPath measured{&path_, {}, std::nullopt};
  for (const ScaleSource& source : sources_.list) {
    SourceSamples samples = positions_along(path_, source, tracks_, T_vehicle_cam_);
    if (source.kind == ScaleSource::Kind::kCameraHeight) samples.heights = heights_;
    measured.sources.push_back(std::move(samples));
  }
  const ScaleCourse course = solve_scale_course({measured}, params_, CourseModes::kOfGuess);
  if (!course.of_path.empty()) newest_ = course.of_path.front().back();
}

}  // namespace edgevo
