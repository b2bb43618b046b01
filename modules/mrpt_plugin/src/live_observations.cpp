// SPDX-License-Identifier: BSD-3-Clause
#include "live_observations.h"

#include <cstdio>
#include <filesystem>
#include <utility>

#include "edgevo/core/error.h"
#include "edgevo/mrpt_bridge/conversions.h"
#include "edgevo/mrpt_bridge/edge_scan.h"
#include "edgevo/mrpt_bridge/image_file.h"
#include "edgevo/mrpt_bridge/playback_pose.h"
#include "edgevo/mrpt_bridge/vehicle_observations.h"
#include "edgevo/scale/given_scale.h"
#include "edgevo/scale/scale_source.h"

namespace edgevo {
namespace {

// The map points visible in the frame, as if the frame were their host keyframe.
KeyframeRecord as_keyframe(const FrameRecord& record, const FrameView& view) {
  KeyframeRecord keyframe;
  keyframe.frame_index = record.index;
  keyframe.time = record.time;
  keyframe.segment = record.segment;
  keyframe.T_world_cam = *record.T_world_cam_live;
  for (const SeenPoint& p : view.points) {
    EdgePoint point;
    point.px = p.px;
    point.normal.setZero();  // not recorded
    point.idepth = p.idepth;
    point.idepth_sigma = p.idepth_sigma;
    keyframe.points.push_back(point);
  }
  return keyframe;
}

void write_image(const Grab& grab, const std::string& path) {
  if (grab.original.isEmpty() || !grab.original.isColor()) return write_png(path, grab.frame.image);
  if (!grab.original.saveToFile(path))
    throw InputError(path, "cannot be written", "free space, or record to another disk (rawlog_prefix)");
}

}  // namespace

LiveObservations::LiveObservations(const SensorConfig& config, const Camera& camera,
                                   const std::optional<SE3>& T_vehicle_cam)
    : config_(config), camera_(camera), T_vehicle_cam_(T_vehicle_cam) {}

mrpt::serialization::CSerializable::Ptr LiveObservations::image_of(const Grab& grab) const {
  auto obs = make_image_observation(grab.stated_time, config_.label, camera_, T_vehicle_cam_);
  if (images_folder_.empty()) {
    obs->image = grab.original.isEmpty() ? to_mrpt(grab.frame.image) : grab.original;
    return obs;
  }
  char number[16];
  std::snprintf(number, sizeof number, "_%06d.png", grab.frame.index);
  const std::string name = config_.label + number;
  write_image(grab, (std::filesystem::path(images_folder_) / name).string());
  obs->image.setExternalStorage(name);
  return obs;
}

Run LiveObservations::run_of(const FrameRecord& record, const SE3& T_world_odom,
                             const FrameView& view) const {
  Run run;
  run.pinhole = view.pyramid->finest().pinhole;
  run.T_vehicle_cam = T_vehicle_cam_;
  run.frames.push_back(record);
  run.frames.back().T_world_cam = T_world_odom * *record.T_world_cam_live;
  run.keyframes.push_back(as_keyframe(record, view));
  if (config_.metres_per_unit > 0) scale_run(config_.metres_per_unit, "factor", &run);
  if (is_in_metres_) scale_run(1, kKeptMapScale, &run);
  return run;
}

std::vector<mrpt::serialization::CSerializable::Ptr> LiveObservations::frames_of(
    const Run& run, const NewestPose& newest) const {
  const FrameRecord& frame = run.frames.front();
  const SE3 T_world_odom = *frame.T_world_cam * frame.T_world_cam_live->inverse();
  auto T_map_odom = mrpt::obs::CObservationRobotPose::Create();
  T_map_odom->timestamp = to_mrpt(frame.time);
  T_map_odom->sensorLabel = "EDGE_VO_MAP_ODOM";
  T_map_odom->pose.mean = to_mrpt(T_map_vehicle(run, T_world_odom));
  return {make_frames_observation(run, frame.time, "map_changes " + std::to_string(newest.world_changes)),
          T_map_odom};
}

std::vector<mrpt::serialization::CSerializable::Ptr> LiveObservations::make(const Grab& grab,
                                                                            const FrameRecord& record,
                                                                            const NewestPose& newest,
                                                                            const FrameView& view) {
  std::vector<mrpt::serialization::CSerializable::Ptr> observations{image_of(grab)};
  if (!record.T_world_cam_live) return observations;
  FrameRecord stated = record;
  stated.time = grab.stated_time;
  const Run run = run_of(stated, newest.T_world_odom, view);
  const FrameRecord& frame = run.frames.front();
  if (std::exchange(last_changes_, newest.world_changes) != newest.world_changes)
    for (const auto& observation : frames_of(run, newest)) observations.push_back(observation);
  observations.push_back(make_live_observation(run, frame));
  observations.push_back(make_pose_observation(run, frame, *frame.T_world_cam));
  observations.push_back(make_odometry_observation(run, frame, *frame.T_world_cam));
  if (const auto doubt = make_doubt_observation(frame)) observations.push_back(doubt);
  if (view.reference_keyframe != last_reference_) {
    const PointFilter filter{config_.max_relative_sigma, 0};
    observations.push_back(make_edge_scan(run.keyframes.front(), run.pinhole, filter, T_map_world(run)));
    last_reference_ = view.reference_keyframe;
  }
  return observations;
}

}  // namespace edgevo
